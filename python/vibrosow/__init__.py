"""Reads what `vibrosow run`, `sweep`, `decide`, `optimise`, `accuracy` and `calibrate` write. Columns, with their units: docs/reference/output.md, or `vibrosow help columns`."""
from .answer import Answer, open
from .folder import Incomplete, MissingFile, NotAReport, ProgramError, VibrosowError
from .recording import Frame, Recording
from .run import Run, open_run
from .study import Study, open_study

__version__ = "0.2.0"  # as in CMakeLists.txt; a test compares
__all__ = ["Answer", "Frame", "Incomplete", "MissingFile", "NotAReport", "ProgramError", "Recording", "Run", "Study", "VibrosowError", "open", "open_run", "open_study"]
