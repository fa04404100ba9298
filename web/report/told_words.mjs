// What the order of layouts says of each: by the intervals of a figure, or by what a decision found.

const judged = { best: 'first', 'not shown to be worse': 'alike', undecided: 'alike', worse: 'apart' };

/** "first", "alike" or "apart" by what the decision found of a layout that was compared. */
export function toldByDecision(layout) {
  return judged[layout.standing] ?? 'no interval';
}

function byIntervals(best) {
  return {
    note: ({ told, layout }) => ({ first: best, alike: 'not told apart', apart: '', 'no interval': 'no interval' })[told] ?? layout.status,
    first: `the ${best}`, alike: 'not told apart from it: the 95 % intervals overlap (this is no test)', apart: 'the intervals do not overlap',
    'not-ok': 'not compared', band: 'interval of the first',
  };
}

const shortened = { 'not shown to be worse': 'not shown worse' };

function byDecision(confidence, isUndecided) {
  return {
    note: ({ told, layout }) => (told === 'not compared' ? layout.status : shortened[layout.standing] ?? layout.standing),
    first: 'the best', alike: isUndecided ? 'undecided' : 'not shown to be worse', apart: `worse, with a ${confidence}`,
    'not-ok': 'not among those that are compared', band: 'interval of the best',
  };
}

/** { note(row), and what the legend says of each } of rows in the order of a figure. */
export function toldWords(data, figure, leastFirst) {
  if (!figure.judged) return byIntervals(leastFirst ? 'least' : 'most');
  return byDecision(data.confidence ?? 'confidence that is not known', data.layouts.some((layout) => layout.standing === 'undecided'));
}
