"""Reads what `vibrosow sweep` and `vibrosow run` write. Columns, with their units: docs/OUTPUT.md, or `vibrosow columns`."""
from .folder import Incomplete, MissingFile, NotAReport, ProgramError, VibrosowError
from .recording import Frame, Recording
from .run import Run, open_run
from .study import Study, open_study

__version__ = "0.2.0"  # as in CMakeLists.txt; a test compares
__all__ = ["Frame", "Incomplete", "MissingFile", "NotAReport", "ProgramError", "Recording", "Run", "Study", "VibrosowError", "open_run", "open_study"]
