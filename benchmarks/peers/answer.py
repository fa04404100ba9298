"""Time to answer: the longest step at which a program still gives the soft, open tray's outflow."""
def time_to_answer(bench, seeds, say): pass
