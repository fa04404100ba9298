#!/usr/bin/python3
"""The Python package reads what the program writes, in either dialect; refuses what is none; bins and draws; its README and notebook hold.

    tests/python/test_package.py VIBROSOW [unittest's arguments]"""
import csv
import gc
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from unittest import mock

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = str(Path(sys.argv.pop(1)).resolve())
os.environ["MPLBACKEND"] = "Agg"
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "python"))

import pandas
from matplotlib import pyplot
from pandas.testing import assert_frame_equal

import vibrosow
from vibrosow.run import seconds
from vibrosow.study import FIGURES

STUDY = f"""title = "Odd; \\"names\\", of layouts"
base = "{ROOT}/seeders/wheat-tray.toml"
replicates = 2
[set]
run.duration = "0.12 s"
run.measure_from = "0.05 s"
tray.motion.frequency = "16 Hz"
tray.motion.ramp = "0.05 s"
contact.shell_compression = 1e-5
[[layout]]
name = "one; \\"two\\", three"
tray.holes.count = 3
[[layout]]
name = "NA"
tray.motion.amplitude = "5.5 mm"
[[layout]]
name = "the same, named again"
tray.motion.amplitude = "5.5 mm"
[[layout]]
name = "holes beside the floor"
tray.holes.span = "4 m"
"""


def run_program(*words):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True)
    if done.returncode not in (0, 1):
        raise AssertionError(f"vibrosow {' '.join(map(str, words))}: {done.returncode}: {done.stderr}")


def setUpModule():
    """A sweep, its reports in the other dialect and without its kept runs, and a run in both dialects, one of them with a record."""
    global work
    holder = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(holder.cleanup)
    work = Path(holder.name)
    (work / "study.toml").write_text(STUDY, encoding="utf-8")
    run_program("sweep", work / "study.toml", "--out", work / "comma", "--quiet")
    shutil.copytree(work / "comma", work / "semicolon")
    run_program("export", work / "semicolon", "--csv", "semicolon")
    shutil.copytree(work / "comma", work / "reports", ignore=shutil.ignore_patterns("cases"))
    for dialect in ("comma", "semicolon"):
        run_program("run", ROOT / "seeders/wheat-tray.toml", "--set", "run.duration=0.1 s", "--set", "run.measure_from=0 s", "--set",
                    "record.every=0.05 s", "--set", "record.cell=1 cm", "--csv", dialect, "--out", work / f"run-{dialect}", "--quiet")


def write_table(path, header, *rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([header.split(","), *rows])


def made_run(folder, seeds, **info):
    """A run's folder of these (time s, hole), with holes 1, 2, 10 in its summary."""
    folder.mkdir()
    content = {"title": "made", "status": "finished", "outside_the_model": False, "dt_s": 1e-4, "end_time_s": 0.25,
               "outflow": {"window_s": [0.1, 0.25], "depth_factor": None}} | info
    (folder / "run.json").write_text(json.dumps(content), encoding="utf-8")
    write_table(folder / "outflow.csv", "time_s,hole,lot", *([time, hole, "pea"] for time, hole in seeds))
    write_table(folder / "summary.csv", "hole,lot", ["1", "pea"], ["2", "pea"], ["10", "pea"], ["all", "all"])
    return vibrosow.open_run(folder)


def made_study(folder, rows):
    """A study's folder of these (status, rate, its half width, evenness, low, high)."""
    folder.mkdir()
    header = ("layout,name,status,reason,tray.holes.count,replicates,rate_g_per_s,rate_g_per_s_ci95,depth_factor,unevenness_cv_percent,"
              "unevenness_cv_percent_low,unevenness_cv_percent_high")
    write_table(folder / "sweep.csv", header, *([number, "", status, "", number, 4 if rate != "" else 0, rate, half, 1, *evenness]
                                                for number, (status, rate, half, *evenness) in enumerate(rows, 1)))
    for name in ("sweep_holes.csv", "sweep_runs.csv"):
        write_table(folder / name, "layout,name")
    return vibrosow.open_study(folder)


class Case(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.addCleanup(pyplot.close, "all")
        self.folder = Path(holder.name)

    def copy(self, name):
        return Path(shutil.copytree(work / name, self.folder / name))


class Dialects(Case):
    def test_a_study_is_the_same_in_both(self):
        comma, semicolon = vibrosow.open_study(work / "comma"), vibrosow.open_study(work / "semicolon")
        self.assertIn(";", (work / "semicolon/sweep.csv").read_text(encoding="utf-8").split("\n")[0])
        # A plan, of which the second is made, names files from the study's folder.
        for table in ("layouts", "holes", "runs"):
            assert_frame_equal(getattr(comma, table).replace(re.escape(f"{work}/"), "", regex=True), getattr(semicolon, table))

    def test_a_run_is_the_same_in_both(self):
        comma, semicolon = vibrosow.open_run(work / "run-comma"), vibrosow.open_run(work / "run-semicolon")
        for table in ("summary", "events", "records", "profile", "flow"):
            assert_frame_equal(getattr(comma, table), getattr(semicolon, table))
        self.assertGreater(len(comma.snapshots), 1)
        for number in comma.snapshots:
            assert_frame_equal(comma.snapshot(number), semicolon.snapshot(number))
            assert_frame_equal(comma.snapshot(number, "fields"), semicolon.snapshot(number, "fields"))

    def test_numbers_are_numbers_and_texts_texts(self):
        study = vibrosow.open_study(work / "semicolon")
        self.assertEqual(list(study.layouts["name"]), ['one; "two", three', "NA", "the same, named again", "holes beside the floor"])
        self.assertEqual(list(study.layouts.status), ["ok", "ok", "ok", "invalid"])
        self.assertEqual(list(study.layouts["tray.motion.amplitude_mm"])[1:3], [5.5, 5.5])
        self.assertTrue(math.isnan(study.layouts["tray.motion.amplitude_mm"][0]))
        self.assertEqual({*study.holes.hole}, {"1", "2", "3", "4", "5"})
        self.assertEqual({*study.totals.hole}, {"all"})
        self.assertRegex(repr(study), "4 layouts, [0-4] of them not ok, [0-9]+ doubts?>$")
        self.assertEqual(study.layouts.rate_g_per_s.dtype, float)


class Joins(Case):
    def test_every_run_has_the_name_of_its_case(self):
        runs = vibrosow.open_study(work / "comma").runs
        self.assertEqual(len(runs), 6)
        for case in runs.case:
            self.assertTrue((work / "comma/cases" / case[:2] / f"{case}.case").is_file(), case)
        by_layout = runs.groupby("layout").case.apply(list)
        self.assertEqual(by_layout[2], by_layout[3])  # of one scene
        self.assertEqual(len({*by_layout[1], *by_layout[2]}), 4)

    def test_title_and_plan_are_of_the_kept_runs(self):
        study = vibrosow.open_study(work / "comma")
        self.assertEqual(study.title, 'Odd; "names", of layouts')
        self.assertEqual(study.plan["random_seed"], 1)

    def test_reports_alone_have_neither(self):
        study = vibrosow.open_study(work / "reports")
        self.assertIsNone(study.plan)
        self.assertIsNone(study.title)
        self.assertNotIn("case", study.runs)
        self.assertIsNone(study.records)
        self.assertIsNone(study.comparison)
        with self.assertRaisesRegex(vibrosow.VibrosowError, "cases/plan"):
            study.case(1, 1, PROGRAM)

    def test_a_run_without_a_case_is_told(self):
        folder = self.copy("comma")
        plan = next(folder.glob("cases/plans/*.json"))
        content = json.loads(plan.read_text(encoding="utf-8"))
        first = content["runs"][0]
        first["random_seed"] += 1
        first["cases"] = first["cases"].split(maxsplit=1)[1]
        plan.write_text(json.dumps(content), encoding="utf-8")
        study = vibrosow.open_study(folder)
        self.assertEqual(study.runs.case[0], "")
        with self.assertRaisesRegex(vibrosow.VibrosowError, "layout 1 with random seed 1: its plan names none"):
            study.case(1, 1, PROGRAM)


class CasesOfRuns(Case):
    def test_a_kept_run_is_the_row_of_the_study(self):
        study = vibrosow.open_study(work / "comma")
        for row in study.runs.itertuples():
            run = study.case(row.layout, row.random_seed, PROGRAM)
            self.assertEqual(run.info["random_seed"], row.random_seed)
            self.assertEqual(run.info["balance"]["counted"], row.counted)
            self.assertEqual(run.outflow().sum().sum(), row.counted + row.spilled)
            self.assertAlmostEqual(run.info["outflow"]["rate_g_per_s"], row.rate_g_per_s, delta=1e-5 * row.rate_g_per_s)

    def test_it_lasts_as_long_as_it_is_held(self):
        run = vibrosow.open_study(work / "semicolon").case(1, 2, PROGRAM)
        folder = run.folder
        gc.collect()
        self.assertTrue(folder.is_dir())
        del run
        gc.collect()
        self.assertFalse(folder.exists())

    def test_the_program_is_given_or_in_the_environment_or_on_the_path(self):
        study = vibrosow.open_study(work / "comma")
        (self.folder / "vibrosow").symlink_to(PROGRAM)
        nowhere = {"VIBROSOW": "", "PATH": str(self.folder / "nothing")}
        with mock.patch.dict(os.environ, nowhere | {"VIBROSOW": PROGRAM}):
            self.assertEqual(study.case(1, 1).info["random_seed"], 1)
        with mock.patch.dict(os.environ, nowhere | {"PATH": str(self.folder)}):
            self.assertEqual(study.case(1, 1).info["random_seed"], 1)
        with mock.patch.dict(os.environ, nowhere), self.assertRaisesRegex(vibrosow.ProgramError, "no program vibrosow: give program"):
            study.case(1, 1)
        with self.assertRaisesRegex(vibrosow.ProgramError, "no program /nowhere/vibrosow"):
            study.case(1, 1, Path("/nowhere/vibrosow"))

    def test_what_the_program_says_is_passed_on(self):
        folder = self.copy("comma")
        for case in folder.glob("cases/*/*.case"):
            case.unlink()
        (self.folder / "temporary").mkdir()
        with mock.patch.object(tempfile, "tempdir", str(self.folder / "temporary")):
            with self.assertRaisesRegex(vibrosow.ProgramError, r"--run [0-9a-f]+ .*: vibrosow: "):
                vibrosow.open_study(folder).case(1, 1, PROGRAM)
        self.assertEqual(list(self.folder.glob("temporary/*")), [])

    def test_reports_of_another_plan_are_told(self):
        folder = self.copy("comma")
        reports = (folder / "sweep_runs.csv").read_bytes()
        run_program("sweep", work / "study.toml", "--out", folder, "--set", "run.duration=0.1 s", "--quiet")
        (folder / "sweep_runs.csv").write_bytes(reports)
        with self.assertRaisesRegex(vibrosow.VibrosowError, "not the one that its reports are of"):
            vibrosow.open_study(folder).case(1, 1, PROGRAM)

    def test_a_run_that_is_none_of_the_study(self):
        with self.assertRaisesRegex(KeyError, "no run of layout 4 with random seed 1"):  # invalid: it has none
            vibrosow.open_study(work / "comma").case(4, 1, PROGRAM)


class Refusals(Case):
    def refuses(self, error, message, opens, folder):
        self.assertTrue(issubclass(error, vibrosow.VibrosowError))
        with self.assertRaisesRegex(error, message):
            opens(folder)

    def test_a_folder_that_is_none(self):
        for opens in (vibrosow.open_study, vibrosow.open_run):
            self.refuses(vibrosow.NotAReport, "is not a folder", opens, self.folder / "nothing")
            self.refuses(vibrosow.NotAReport, "holds no reports of vibrosow", opens, self.folder)

    def test_reports_of_another_command(self):
        self.refuses(vibrosow.NotAReport, "holds the reports of vibrosow run, not of sweep", vibrosow.open_study, work / "run-comma")
        self.refuses(vibrosow.NotAReport, "holds the reports of vibrosow sweep, not of run", vibrosow.open_run, work / "comma")

    def test_kept_runs_without_reports(self):
        folder = self.copy("comma")
        for file in folder.glob("*.*"):
            file.unlink()
        self.refuses(vibrosow.NotAReport, "`vibrosow export` makes them", vibrosow.open_study, folder)

    def test_a_set_that_is_not_complete(self):
        folder = self.copy("run-comma")
        listed = json.loads((folder / "files.json").read_text())
        (folder / "files.json").write_text(json.dumps(listed | {"complete": False}))
        self.refuses(vibrosow.Incomplete, "not complete", vibrosow.open_run, folder)

    def test_a_list_that_is_not_ours(self):
        folder = self.copy("run-comma")
        for text in ("[1, 2]", "{", "\xff"):
            (folder / "files.json").write_text(text, encoding="latin-1")
            self.refuses(vibrosow.NotAReport, "files.json was not written by vibrosow", vibrosow.open_run, folder)

    def test_a_file_that_is_missing(self):
        for name, opens in (("run-comma", vibrosow.open_run), ("comma", vibrosow.open_study), ("reports", vibrosow.open_study)):
            folder = self.copy(name)
            missing = "summary.csv" if name == "run-comma" else "sweep_holes.csv"
            (folder / missing).unlink()
            self.refuses(vibrosow.MissingFile, missing, opens, folder)
            self.assertTrue(issubclass(vibrosow.MissingFile, FileNotFoundError))

    def test_a_listed_file_that_is_missing_is_told_when_it_is_read(self):
        folder = self.copy("run-comma")
        run = vibrosow.open_run(folder)
        for name in ("records.csv", "fields_001.csv"):
            (folder / name).unlink()
        with self.assertRaisesRegex(vibrosow.MissingFile, "records.csv is missing"):
            run.records
        with self.assertRaisesRegex(vibrosow.MissingFile, "fields_001.csv is missing"):
            run.snapshot(1, "fields")
        with self.assertRaisesRegex(KeyError, "no snapshot 77"):
            run.snapshot(77)

    def test_a_plan_that_is_missing(self):
        folder = self.copy("comma")
        next(folder.glob("cases/plans/*.json")).unlink()
        with self.assertRaisesRegex(vibrosow.MissingFile, "plans"):
            vibrosow.open_study(folder).runs

    def test_a_table_that_is_none(self):
        folder = self.copy("reports")
        for content in (b"", b"layout,name\n1,a\n2,b,c\n", b"layout,name\n1,\xff\n"):
            (folder / "sweep.csv").write_bytes(content)
            with self.subTest(content), self.assertRaisesRegex(vibrosow.NotAReport, "no table"):
                vibrosow.open_study(folder).layouts


class Recordings(Case):
    """The page of a run, made of a template that is nothing but its two places."""
    TEMPLATE = ('<script id="report-data" type="application/json">@REPORT_DATA@</script>\n'
                '<script id="recording" type="text/plain">@RECORDING@</script>')

    def page_of(self, *words):
        """The folder of a run with its page."""
        data = self.folder / "data"
        (data / "pages").mkdir(parents=True)
        for shipped in ("models", "seeders"):
            (data / shipped).symlink_to(ROOT / shipped)
        (data / "pages/report-with-simulator.html").write_text(self.TEMPLATE, encoding="utf-8")
        with mock.patch.dict(os.environ, VIBROSOW_DATA=str(data)):
            run_program("run", ROOT / "seeders/wheat-tray.toml", "--html", "--set", "run.duration=0.3 s", "--set", "run.measure_from=0.1 s",
                        "--set", "record.times=[\"0.1 s\", \"0.3 s\"]", "--quiet", "--out", self.folder / "run", *words)
        return self.folder / "run"

    def test_the_last_frame_is_the_last_snapshot(self):
        run = vibrosow.open_run(self.page_of())
        frames = list(run.recording)
        self.assertEqual(len(frames), len(run.recording))
        self.assertEqual((frames[0].time_s, frames[-1].time_s), (0, run.info["end_time_s"]))
        last, snapshot = frames[-1], run.snapshot(2).set_index("id")
        self.assertEqual(list(last.grains.index), list(snapshot.index))
        tray = last.vessels.loc["tray"]
        for name in ("x", "y"):
            off = last.grains[f"{name}_m"] - tray[f"{name}_m"] - 1e-3 * snapshot[f"{name}_mm"]
            self.assertLess(off.abs().max(), 0.501 * run.recording.unit_m)
        self.assertTrue((1e3 * last.grains.radius_m - snapshot.radius_mm).abs().max() < 1e-4)

    def test_contacts_are_where_grains_touch(self):
        recording = vibrosow.open_run(self.page_of()).recording
        frames = [frame for frame in recording if frame.contacts is not None]
        self.assertTrue(20 < len(frames) <= 50)
        pairs = touches = 0
        for frame in frames:
            grains, contacts = frame.grains, frame.contacts
            self.assertTrue((contacts.force_N >= 0).all())
            two = contacts[contacts.partner >= 0]
            one, other = grains.loc[two.grain], grains.loc[two.partner]
            apart = ((one.x_m.values - other.x_m.values)**2 + (one.y_m.values - other.y_m.values)**2)**0.5
            self.assertTrue((apart < one.radius_m.values + other.radius_m.values + 2 * recording.unit_m).all())
            alone = contacts[contacts.partner < 0]
            own = grains.loc[alone.grain]
            reach = ((alone.x_m.values - own.x_m.values)**2 + (alone.y_m.values - own.y_m.values)**2)**0.5 / own.radius_m.values
            self.assertTrue(((reach > 0.9) & (reach < 1.01)).all())
            pairs, touches = pairs + len(two), touches + len(alone)
        self.assertTrue(pairs > 1000 and touches > 100, (pairs, touches))

    def test_the_map_is_of_the_bed(self):
        recording = vibrosow.open_run(self.page_of()).recording
        cells, head = recording.map, recording.header["map"]
        self.assertEqual(len(cells), head["columns"] * head["rows"])
        self.assertTrue(0.1 <= head["from_s"] < head["to_s"] <= 0.3 + 1e-4)
        self.assertTrue(0.7 < cells.packing_fraction.max() < 1)
        self.assertTrue((cells.packing_fraction == 0).equals(cells.vx_m_per_s.isna()))
        in_hopper = recording.hopper_map
        self.assertTrue(in_hopper.packing_fraction.max() > 0.7 and in_hopper.x_m.max() < 0.1)
        in_cells = ((cells.packing_fraction.sum() + in_hopper.packing_fraction.sum()) * head["cell_m"]**2)
        last = list(recording)[-1].grains
        self.assertLess(abs(in_cells / (math.pi * last.radius_m**2).sum() - 1), 0.2)

    def test_a_page_counts_as_the_summary_does(self):
        folder = self.page_of()
        data = json.loads(re.search(r'application/json">(.*?)</script>', (folder / "report.html").read_text(encoding="utf-8"))[1])
        run = vibrosow.open_run(folder)
        summary = run.summary.set_index("hole").grains.drop("all")
        self.assertEqual({str(hole["hole"]): hole["counted"] for hole in data["holes"]}, summary.to_dict())
        self.assertEqual(sum(hole["counted_all"] for hole in data["holes"]), run.info["balance"]["counted"])
        self.assertEqual(len(data["events"]["time_s"]), len(run.events))

    def test_a_title_ends_no_script(self):
        page = self.page_of("--set", "title=</script><img src=x onerror=alert(1)>") / "report.html"
        text = page.read_text(encoding="utf-8")
        self.assertEqual(text.count("</script>"), 2)
        self.assertIn("\\u003c/script>\\u003cimg", text)

    def test_without_a_page_there_is_none(self):
        self.assertIsNone(vibrosow.open_run(work / "run-comma").recording)
        (self.folder / "report.html").write_text(self.TEMPLATE.replace("@RECORDING@", ""), encoding="utf-8")
        with self.assertRaises(vibrosow.NotAReport):
            vibrosow.Recording(self.folder / "report.html")


class Bins(Case):
    def test_every_seed_is_in_its_bin_and_hole(self):
        table = made_run(self.folder / "made", [(0, 1), (0.0999, 2), (0.1, 2), (0.15, 10), (0.2, "spilled"), (0.25, 1)]).outflow("0.1 s")
        self.assertEqual(list(table), ["1", "2", "10", "spilled"])
        self.assertEqual(table.values.tolist(), [[1, 1, 0, 0], [0, 1, 1, 0], [1, 0, 0, 1]])
        self.assertEqual([(bin.left, bin.right) for bin in table.index], [(0, 0.1), (0.1, 0.2), (0.2, 0.25)])

    def test_an_end_a_step_late_is_no_bin_of_its_own(self):
        table = made_run(self.folder / "made", [(0.20005, 1)], end_time_s=0.20006).outflow("100 ms")
        self.assertEqual([(bin.left, bin.right) for bin in table.index], [(0, 0.1), (0.1, 0.20006)])
        self.assertEqual(table["1"].tolist(), [0, 1])

    def test_no_seeds_are_zeros(self):
        table = made_run(self.folder / "made", []).outflow(0.05)
        self.assertEqual(table.shape, (5, 3))
        self.assertEqual(table.values.sum(), 0)

    def test_a_run_keeps_its_seeds(self):
        run = vibrosow.open_run(work / "run-comma")
        for bin in ("1 ms", "0.03 s", 0.05, "1 min"):
            self.assertEqual(run.outflow(bin).sum().sum(), len(run.events))
        by_hole = run.summary[run.summary.hole != "all"].set_index("hole").grains
        self.assertEqual(run.outflow().sum().to_dict(), by_hole.to_dict())

    def test_times(self):
        self.assertEqual([seconds(time) for time in ("0.1 s", "20ms", " 2 min ", 3, "4", 5.5)], [0.1, 0.02, 120, 3, 4, 5.5])
        for wrong in ("0 s", "-1 s", "0,1 s", "1 h", "nan", "inf s", "", None, [1]):
            with self.subTest(wrong), self.assertRaisesRegex(ValueError, "no time above 0"):
                seconds(wrong)
        with self.assertRaisesRegex(ValueError, "shorter than the run's time step"):
            made_run(self.folder / "made", []).outflow("0.05 ms")


class Best(Case):
    def test_those_that_differ_beyond_chance_are_left_out(self):
        study = made_study(self.folder / "made", [  # from the largest, 10 +- 3: within 5 of it with 4 of its own
            ("ok", 10, 3, "", "", ""), ("ok", 5.1, 4, "", "", ""), ("ok", 4.9, 4, "", "", ""), ("ok", 1, "", "", "", ""),
            ("outside the model", 20, 1, "", "", ""), ("invalid", "", "", "", "", "")])
        self.assertEqual(list(study.best().layout), [1, 2, 4])  # one run alone cannot be told apart
        self.assertEqual(list(study.best(least=True).layout), [4, 3, 2, 1])

    def test_uneven_intervals(self):
        study = made_study(self.folder / "made", [  # from the smallest, 0 to 3: by 4 downwards and 3 upwards, 5
            ("ok", 1, 1, "", 0, 3), ("ok", 1, 1, 4.9, 0.9, 9), ("ok", 1, 1, 5.1, 1.1, 50), ("ok", 1, 1, "", "", "")])
        self.assertEqual(list(study.best("unevenness_cv_percent", least=True).layout), [1, 2])
        self.assertTrue(math.isnan(study.intervals("unevenness_cv_percent").value[1]))

    def test_columns_without_intervals_are_refused(self):
        study = made_study(self.folder / "made", [("ok", 1, 1, "", "", "")])
        with self.assertRaisesRegex(ValueError, "'raw_cv_percent' has no interval; those that have: rate_g_per_s"):
            study.best("raw_cv_percent")
        with self.assertRaisesRegex(vibrosow.VibrosowError, "no layout that can be compared has unevenness_cv_percent"):
            study.best("unevenness_cv_percent")
        with self.assertRaisesRegex(vibrosow.VibrosowError, "no layout has unevenness_cv_percent"):
            study.plot_rates(figure="unevenness_cv_percent")


class Plots(Case):
    def test_every_interval_is_drawn(self):
        study = vibrosow.open_study(ROOT / "reports/wheat-holes")
        axes = study.plot_rates()
        lines = {round(segment[0][1]): (segment[0][0], segment[1][0]) for segment in axes.collections[0].get_segments()}
        for place, row in enumerate(study.layouts.itertuples()):
            low, high = lines[place]
            self.assertAlmostEqual(low, row.rate_g_per_s - row.rate_g_per_s_ci95)
            self.assertAlmostEqual(high, row.rate_g_per_s + row.rate_g_per_s_ci95)
        self.assertEqual(list(axes.lines[0].get_xdata()), list(study.layouts.rate_g_per_s))
        self.assertEqual(axes.get_yticklabels()[17].get_text(), "18, count 5, span_mm 420, frequency_Hz 11")
        self.assertEqual(axes.get_xlabel(), "mass flow through all holes, g/s, of the 2D slice\n95 % intervals over 5 random seeds")

    def test_what_decides_nothing_is_hollow(self):
        axes = vibrosow.open_study(ROOT / "reports/paper-a-fig4").plot_rates()
        self.assertEqual([line.get_markerfacecolor() for line in axes.lines], ["#1b6ca8", "white"])
        self.assertEqual(list(axes.lines[1].get_ydata()), [0])
        self.assertIn("outside the model", axes.get_legend().get_texts()[0].get_text())

    def test_a_mean_of_some_of_the_runs_is_hollow(self):
        rows = [("ok", 1, 1, "", "", ""), ("interrupted", 2, 1, "", "", ""), ("outside the model", 2, 1, "", "", ""),
                ("invalid", "", "", "", "", "")]
        axes = made_study(self.folder / "made", rows).plot_rates()
        self.assertEqual(axes.get_legend().get_texts()[0].get_text(), "interrupted or outside the model: decides nothing")
        self.assertEqual([list(line.get_ydata()) for line in axes.lines], [[0], [1, 2]])

    def test_rates_in_space_are_the_tray_s_and_one_run_has_no_interval(self):
        axes = vibrosow.open_study(ROOT / "reports/round-holes").plot_rates()
        self.assertEqual(axes.get_xlabel(), "mass flow through all holes, g/s, of the tray\none random seed, so no intervals")

    def test_axes_may_be_given(self):
        axes = pyplot.subplots()[1]
        self.assertIs(vibrosow.open_study(work / "comma").plot_rates(axes, "tray_rate_g_per_s"), axes)
        self.assertEqual(axes.get_title(), 'Odd; "names", of layouts')
        self.assertIs(vibrosow.open_run(work / "run-comma").plot_outflow(axes), axes)

    def test_outflow_is_per_second(self):
        axes = made_run(self.folder / "made", [(0.01, 1), (0.02, 1), (0.21, 1)], status="stopped by the guard",
                        outside_the_model=True).plot_outflow(bin="0.1 s")
        steps = [patch for patch in axes.patches if patch.get_label() == "hole 1"][0].get_data()
        self.assertTrue(all(abs(value - wanted) < 1e-9 for value, wanted in zip(steps.values, (20, 0, 20))))
        self.assertEqual(axes.get_title(), "made\nstopped by the guard; outside the model")
        self.assertEqual(axes.get_ylabel(), "seeds that leave, 1/s, of the 2D slice")
        axes.figure.canvas.draw()

    def test_labels_say_the_unit_that_the_program_says(self):
        text = subprocess.run([PROGRAM, "columns"], capture_output=True, text=True, check=True).stdout
        table = text.split("### `sweep.csv`")[1].split("###")[0]
        units = dict(re.findall(r"^\| `(\w+)` \| (\S*) +\|", table, re.MULTILINE))
        with_interval = {re.sub("_(ci95|low|high)$", "", name) for name in units if re.search("_(ci95|low|high)$", name)}
        self.assertEqual(with_interval, {*FIGURES})
        for name, label in FIGURES.items():
            self.assertRegex(label, rf", {re.escape(units[name])}($|[ ,])")


class Answers(Case):
    def test_each_command_s_folder_is_opened_as_what_it_is(self):
        for name, command, rows in (("decision/guaranteed", "decide", 60), ("wheat-front", "optimise", 20), ("accuracy-tray", "accuracy", 5)):
            answer = vibrosow.open(ROOT / "reports" / name)
            self.assertEqual(answer.command, command)
            self.assertGreaterEqual(len(answer.rows), rows)
            self.assertRegex(repr(answer), f"^<vibrosow {command}: .*, {len(answer.rows)} rows, ([0-9]+ doubts?|doubts not known)>$")
        self.assertIsInstance(vibrosow.open(ROOT / "reports/wheat-holes"), vibrosow.Study)
        self.assertRaisesRegex(vibrosow.NotAReport, "is not a folder", vibrosow.open, self.folder / "nowhere")
        self.assertRaisesRegex(vibrosow.NotAReport, "holds no reports", vibrosow.open, ROOT / "docs")

    def test_doubts_stand_beside_an_answer_and_a_run(self):
        soft = ["--set", "contact.shell_compression=0.004", "--set", "run.duration=0.3 s", "--set", "run.measure_from=0.1 s", "--quiet"]
        run_program("run", "wheat-tray", *soft, "--out", self.folder / "run")
        run_program("decide", "wheat-demo", "--goal", "rate", "--within", "30 %", *soft, "--out", self.folder / "decision")
        run, decision = vibrosow.open(self.folder / "run"), vibrosow.open(self.folder / "decision")
        self.assertIn("the guard warned", {*run.doubts.kind})
        self.assertTrue(run.doubts[run.doubts.kind == "the guard warned"].serious.all())
        self.assertRegex(repr(run), "finished, .* g/s, [1-9] doubts>$")
        self.assertEqual(run.total.grains, run.holes.grains.sum())
        self.assertEqual(run.total.hole, "all")
        warned = decision.doubts.set_index("kind").loc["the guard warned"]
        self.assertEqual(warned.runs, warned.of_runs)
        self.assertTrue(warned.layouts)
        self.assertIsNone(decision.table("posterior.csv"))
        run_program("sweep", "wheat-demo", *soft, "--set", "replicates=1", "--out", self.folder / "sweep")
        swept = vibrosow.open(self.folder / "sweep").doubts.set_index("kind").loc["the guard warned"]
        self.assertTrue(swept.serious)
        self.assertEqual(swept.layouts, [1, 2, 3, 4])
        self.assertIsNone(vibrosow.open(ROOT / "reports/wheat-holes").doubts)
        run_program("accuracy", "wheat-tray", *soft, "--steps-per-contact", "12,24", "--shell-compression", "0.002,0.004", "--replicates", "1",
                    "--out", self.folder / "accuracy")
        of_settings = vibrosow.open(self.folder / "accuracy").doubts
        self.assertTrue(of_settings[of_settings.kind == "the guard warned"].serious.all())
        self.assertTrue(of_settings.text.str.contains("in 2D").any())


class Shipped(Case):
    def test_every_committed_sweep_can_be_read_and_drawn(self):
        folders = [path.parent for path in ROOT.glob("reports/**/sweep.csv")]
        self.assertGreater(len(folders), 5)
        for folder in folders:
            study = vibrosow.open_study(folder)
            self.assertEqual(len(study.layouts), study.layouts.layout.max())
            self.assertLessEqual({*study.holes.layout}, {*study.layouts.layout})
            if study.compared.any():
                self.assertGreater(len(study.best()), 0)
            else:
                self.assertRaisesRegex(vibrosow.VibrosowError, "no layout that can be compared", study.best)
            study.plot_rates()
            pyplot.close("all")

    def test_the_version_is_the_project_s(self):
        self.assertIn(f"project(vibrosow VERSION {vibrosow.__version__} ", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))

    def test_the_readme_s_lines_run(self):
        readme = (ROOT / "python/README.md").read_text(encoding="utf-8")
        self.assertLessEqual(len(readme.splitlines()), 40)
        (self.folder / "out").mkdir()
        (self.folder / "out/wheat-demo").symlink_to(work / "comma")
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        os.chdir(self.folder)
        with mock.patch.dict(os.environ, {"VIBROSOW": PROGRAM}), redirect_stdout(StringIO()) as said:
            exec(re.search(r"```python\n(.*?)```", readme, re.DOTALL)[1], {})
        self.assertIn('Odd; "names", of layouts', said.getvalue())
        self.assertTrue((self.folder / "layouts.png").is_file())

    def test_the_notebook_s_test_notices(self):
        draws, cell = "from matplotlib import pyplot; pyplot.plot([1, 2])", {"cell_type": "code", "execution_count": None, "outputs": []}
        cases = {"good": ([draws], ""), "raises": ([draws, "1 / 0"], "raises, code cell 2"), "draws-not": (["1"], "no figure"),
                 "environment": ([draws, "import os; os.environ['X'] == 'a=b' or 1 / 0"], "")}
        for name, (sources, wanted) in cases.items():
            cells = [{"cell_type": "markdown", "source": ["# a"]}] + [cell | {"source": [source]} for source in sources]
            notebook = self.folder / f"{name}.ipynb"
            notebook.write_text(json.dumps({"cells": cells}))
            done = subprocess.run([ROOT / "tests/python/execute-notebook", notebook, "X=a=b"], capture_output=True, text=True)
            self.assertEqual(done.returncode == 0, wanted == "", done.stderr)
            for part in wanted.split(", "):
                self.assertIn(part, done.stderr)


if __name__ == "__main__":
    unittest.main()
