"""What `vibrosow decide`, `optimise`, `accuracy` and `calibrate` write."""
from functools import cached_property

from .folder import Folder, NotAReport, count_of, doubts_table, read_json
from .run import Run
from .study import Study

# Of each command: the table with a row for each layout, setting or number, and the JSON file with the answer, if it has one.
FILES = {
    "decide": ("decision.csv", "decision.json"),
    "optimise": ("pareto.csv", "optimise.json"),
    "accuracy": ("accuracy.csv", "promise.json"),
    "calibrate": ("calibration.csv", None),
}


class Answer:
    """The answer of one of these commands. Files are read when they are asked for; their columns and units are in docs/reference/output.md."""

    def __init__(self, folder, command):
        self._folder = Folder(folder, command, FILES[command][:1])
        self.folder, self.command = self._folder.path, command

    rows = cached_property(lambda self: self._folder.table(FILES[self.command][0]))  # decision.csv, pareto.csv, accuracy.csv or calibration.csv

    @cached_property
    def info(self):
        """decision.json, optimise.json or promise.json as a dict; empty where the command had none to write."""
        name = FILES[self.command][1]
        return read_json(self.folder / name) if name and (self.folder / name).exists() else {}

    @cached_property
    def doubts(self):
        """What speaks against the runs of the layouts (of accuracy: settings) that the answer names, a row each; empty where nothing does,
        None in a folder that does not tell."""
        named = "settings" if self.command == "accuracy" else "layouts"
        return doubts_table(self.info, named) if "doubts" in self.info else self._folder.doubts(named)

    def table(self, name):
        """Another CSV file of the folder, such as "posterior.csv" or "accuracy_runs.csv"; None where there is none."""
        return self._folder.table(name)

    def __repr__(self):
        return f"<vibrosow {self.command}: {self.folder}, {len(self.rows)} rows, {count_of(self.doubts)}>"


def command_of(folder):
    """The command that wrote a folder's reports; None where nothing tells."""
    path = Folder.of(folder)
    if (path / "files.json").exists():
        return read_json(path / "files.json").get("command")
    needed = {"run": "run.json", "sweep": "sweep.csv", **{command: files[0] for command, files in FILES.items()}}
    return next((command for command, name in needed.items() if (path / name).is_file()), None)


def open(folder):
    """The Run, Study or Answer that a command wrote into a folder. NotAReport, Incomplete, MissingFile: where it is none, not whole,
    lacks a file."""
    command = command_of(folder)
    if command == "run":
        return Run(folder)
    if command == "sweep":
        return Study(folder)
    if command in FILES:
        return Answer(folder, command)
    raise NotAReport(f"{folder} holds no reports of vibrosow that this package reads" + (f": they are of {command}" if command else ""))
