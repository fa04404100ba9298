"""A folder of reports: whether it is one and whole, and its files."""
import json
from pathlib import Path

import pandas

TEXTS = ("name", "status", "reason", "note", "hole", "lot", "outside_the_model")


class VibrosowError(Exception):
    """Any error of this package that is not of a wrong argument."""


class NotAReport(VibrosowError):
    """The folder holds no reports of the wanted command, or a file in it is not one of vibrosow's."""


class Incomplete(VibrosowError):
    """The reports are being replaced, or whoever was writing them was ended."""


class MissingFile(VibrosowError, FileNotFoundError):
    """A file of the reports is not there."""


class ProgramError(VibrosowError):
    """The program vibrosow is not where it was looked for, or it refused; then its own words follow."""


def read_json(path):
    """The object in a JSON file. MissingFile without it, NotAReport where it holds none."""
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise MissingFile(f"{path} is missing") from None
    except ValueError as fault:
        raise NotAReport(f"{path} was not written by vibrosow: {fault}") from None
    if not isinstance(content, dict):
        raise NotAReport(f"{path} was not written by vibrosow: it holds no object")
    return content


def read_table(path):
    """A CSV file of either dialect, told apart by the separator in its header line. Empty numbers are NaN, empty texts "".
    The columns in TEXTS are text: hole "1" as well as "all". MissingFile without the file, NotAReport where it is no table."""
    try:
        with open(path, encoding="utf-8") as file:
            semicolon = ";" in file.readline().split(",")[0]  # the first column's name has neither
        table = pandas.read_csv(path, sep=";" if semicolon else ",", decimal="," if semicolon else ".", keep_default_na=False,
                                na_values=[""], dtype={name: str for name in TEXTS})
    except FileNotFoundError:
        raise MissingFile(f"{path} is missing") from None
    except ValueError as fault:  # of pandas and of the encoding too
        raise NotAReport(f"{path} is no table of vibrosow: {fault}") from None
    return table.fillna({name: "" for name in TEXTS if name in table})


def share_of_tray(depth_factors):
    """What rates without `tray` in their name are of. The factor is 1 in space, and of a plane as thick as the tray."""
    whole = {factor == 1 for factor in depth_factors}
    return "of the tray" if whole == {True} else "of the 2D slice" if True not in whole else "of the 2D slice or the tray"


def doubts_table(content, named):
    """The doubts in a JSON object of the program's, a row each; `named`: what their numbers are of."""
    return pandas.DataFrame(content["doubts"], columns=["kind", "serious", "text", "what_to_do", named, "runs", "of_runs"])


def count_of(doubts):
    return "doubts not known" if doubts is None else f"{len(doubts)} doubt{'' if len(doubts) == 1 else 's'}"


class Folder:
    """The reports of one command in one folder. NotAReport where it holds none of them, Incomplete where files.json says so, MissingFile
    where only some of the `needed` are there. Committed reports have no files.json: then the needed files tell."""

    def __init__(self, path, command, needed):
        self.path, self.listed = self.of(path), []
        if (self.path / "files.json").exists():
            content = read_json(self.path / "files.json")
            self.listed = content.get("files", [])
            if content.get("command") != command:
                raise NotAReport(f"{self.path} holds the reports of vibrosow {content.get('command')}, not of {command}")
            if content.get("complete") is not True:
                raise Incomplete(f"{self.path}: files.json says that its reports are not complete; the command that writes them is under "
                                 "way, or has to be given again")
        absent = [name for name in needed if not (self.path / name).is_file()]
        if not self.listed and len(absent) == len(needed):
            kept = "; of the runs that it keeps `vibrosow export` makes them" if (self.path / "cases").is_dir() else ""
            raise NotAReport(f"{self.path} holds no reports of vibrosow {command}: there is no {needed[0]}{kept}")
        if absent:
            raise MissingFile(f"{self.path / absent[0]} is missing")

    @staticmethod
    def of(path):
        """The path of a folder. NotAReport where it is none."""
        if not Path(path).is_dir():
            raise NotAReport(f"{path} is not a folder")
        return Path(path)

    def table(self, name):
        """The DataFrame of a CSV file; None where the command had none to write."""
        return read_table(self.path / name) if name in self.listed or (self.path / name).exists() else None

    def doubts(self, named):
        """Those of doubts.json; None without it."""
        path = self.path / "doubts.json"
        return doubts_table(read_json(path), named) if "doubts.json" in self.listed or path.exists() else None
