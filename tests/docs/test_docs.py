#!/usr/bin/env python3
"""What the documents name exists: files, reports, commands and their options; and the front page is short.

    tests/docs/test_docs.py VIBROSOW"""
import csv
import math
import re
import shlex
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCUMENTS = [path for pattern in ("*.md", "docs/*.md", "docs/*/*.md", "seeders/*.md", "reports/*.md", "reports/*/*.md", "benchmarks/peers/*.md", "python/*.md") for path in ROOT.glob(pattern)]
HISTORY = ["CHANGELOG.md"]  # names what is gone
ROOMS = "seeders|scripts|reports|models|docs|tests|benchmarks|examples|src|include|python"
failures = []


def expect(holds, message):
    if not holds:
        failures.append(message)


def table(name):
    with open(ROOT / "reports" / name, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def rows_with(name, texts):
    return [row for row in table(name) if all(row[key] == str(value) for key, value in texts.items())]


def column(name, key, texts={}):
    return [float(row[key]) for row in rows_with(name, texts) if row[key]]


def cell(name, key, texts):
    values = column(name, key, texts)
    if len(values) != 1:
        raise ValueError(f"{name}: {len(values)} rows with {texts}")
    return values[0]


def holes(count, span_mm, frequency_hz):
    return {"tray.holes.count": count, "tray.holes.span_mm": span_mm, "tray.motion.frequency_Hz": frequency_hz}


def relative(*of):
    """Half width of the rate's interval over the rate, of such a layout of wheat-holes."""
    return cell("wheat-holes/sweep.csv", "rate_g_per_s_ci95", holes(*of)) / cell("wheat-holes/sweep.csv", "rate_g_per_s", holes(*of))


def mean_rate(count):
    rates = column("wheat-holes/sweep.csv", "rate_g_per_s", {"tray.holes.count": count})
    return sum(rates) / len(rates)


def near(name, texts, rate, half):
    """Whether a layout's rate and its interval are these, as rounded as they are."""
    def rounded(value, to):
        return round(value, 1 if to != int(to) else 0) == to
    return rounded(cell(name, "rate_g_per_s", texts), rate) and rounded(cell(name, "rate_g_per_s_ci95", texts), half)


def held_out():
    """By how many percent the predicted rate of each material that others measured is too high, geometric mean of its rows; all of still holes and slots."""
    rows = table("held-out/held-out.csv")
    expect(all(row["condition"].startswith("still ") for row in rows), "held-out.csv: not of still holes and slots alone")
    ratios = {}
    for row in rows:
        ratios.setdefault(row["material"], []).append(math.log(float(row["predicted"]) / float(row["measured"])))
    return [round(100 * (math.exp(sum(one) / len(one)) - 1)) for one in ratios.values()]


def costs_ns(space):
    """What a grain-step of each shipped seeder cost, "2D" or "3D"."""
    rows = [row for row in table("performance/predicted-time.csv") if row["ns"]]
    seeders = {path.stem: tomllib.loads(path.read_text(encoding="utf-8")) for folder in ("seeders", "seeders/papers", "seeders/verification")
               for path in (ROOT / folder).glob("*.toml")}
    return [float(row["ns"]) for row in rows if (seeders[row["seeder"]].get("space") == "3d") == (space == "3D")]


def settings(name):
    return {tuple(row[key] for key in ("case", "space", "law", "scheme", "friction")) for row in table(name)}


def check_claims():
    """That each sentence of claims.toml stands in its document, and holds of the committed tables."""
    known = {one.__name__: one for one in (cell, column, costs_ns, holes, relative, mean_rate, near, settings, held_out, rows_with, table)} | {"math": math}
    for claim in tomllib.loads((ROOT / "tests/docs/claims.toml").read_text(encoding="utf-8"))["claim"]:
        for document, says in [(claim["document"], claim["says"]), *claim.get("also", [])]:
            text = " ".join((ROOT / document).read_text(encoding="utf-8").split())
            expect(" ".join(says.split()) in text, f"{document} does not say: {says}")
        expect(eval(" ".join(claim["holds"].split()), known), f"{claim['document']}: not so by the tables: {claim['says']}")


def run(*words):
    return subprocess.run(words, capture_output=True, text=True, cwd=ROOT)


def check_links(path, text):
    for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", text):
        if "://" not in target:
            expect((path.parent / target).exists(), f"{path.relative_to(ROOT)}: link to {target}, which does not exist")


def check_paths(path, text):
    for target in re.findall(rf"`((?:{ROOMS})/[\w./-]*\w)", text):
        expect((ROOT / target).exists(), f"{path.relative_to(ROOT)}: names {target}, which does not exist")
    for target in re.findall(r"`([a-z0-9]+/\w+\.[ch]pp)`", text):
        expect((ROOT / "src" / target).exists() or (ROOT / target).exists(), f"{path.relative_to(ROOT)}: names {target}, which is not in src")


def check_reports(path, text):
    recipes = tomllib.loads((ROOT / "reports/recipes.toml").read_text())
    for names in re.findall(r"scripts/make-reports((?:\s+[a-z][\w-]+)+)`", text):
        for name in names.split():
            expect(name in recipes, f"{path.relative_to(ROOT)}: scripts/make-reports {name}: there is no such recipe")


def commands_in(text):
    """Words of each line, indented or in a fenced block, and of each backticked text that begins with vibrosow; comments are left out."""
    blocks = re.findall(r"^ *```.*\n(.*?)^ *```", text, re.MULTILINE | re.DOTALL)
    fenced = [line for block in blocks for line in re.findall(r"^ *(?:\$ )?(vibrosow .*)$", block.replace("\\\n", " "), re.MULTILINE)]
    prose = re.sub(r"^ *```.*\n.*?^ *```", "", text, flags=re.MULTILINE | re.DOTALL)
    indented = re.findall(r"^ {4,}(vibrosow .*)$", prose, re.MULTILINE)
    quoted = [" ".join(one.split()) for one in re.findall(r"`(vibrosow [^`]*)`", prose)]
    return [shlex.split(re.split(r" (?:\||>|&&) ", line)[0], comments=True)[1:] for line in fenced + indented + quoted]


def written_by(commands):
    """What the commands of a document write with --out, as "plan/"."""
    return tuple(words[k + 1].rstrip("/") + "/" for words in commands for k, word in enumerate(words[:-1]) if word == "--out")


def is_placeholder(word):
    """STUDY.toml, my-tray.toml: files of the reader."""
    return re.search(r"\b[A-Z]{3,}\b", word) or Path(word).name.startswith("my-")


def check_command(program, name, words, made):
    if words[0].startswith("-"):
        return expect(run(program, *words).returncode == 0, f"{name}: vibrosow {' '.join(words)} fails")
    help_text = run(program, words[0], "--help")
    expect(help_text.returncode == 0, f"{name}: there is no command vibrosow {words[0]}")
    for option in words[1:]:
        if option.startswith("--"):
            expect(re.search(rf"{option}\b", help_text.stdout), f"{name}: vibrosow {words[0]} has no option {option}")
    files = [word for word in words[1:] if word.endswith(".toml") and not is_placeholder(word) and not f"{word}/".startswith(made)]
    for file in files:
        expect((ROOT / file).exists(), f"{name}: vibrosow {words[0]} {file}: there is no such file")
    sets = [word for k, word in enumerate(words) if k and words[k - 1] == "--set"]
    if sets and files:
        checked = run(program, "check", *files, *(part for one in sets for part in ("--set", one)))
        expect(checked.returncode == 0, f"{name}: vibrosow {' '.join(words)}: {checked.stderr}")


def check_seeder_of_front_page(program, text):
    seeders = re.findall(r"```toml\n(.*?)```", text, re.DOTALL)
    expect(len(seeders) == 1, "README.md: not one seeder")
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
        file.write(seeders[0])
        file.flush()
        checked = run(program, "check", file.name)
        expect(checked.returncode == 0, f"README.md: its seeder is refused: {checked.stderr}")


def check_accuracy_levels():
    """What the program says of its levels is what was measured, and what scripts/figures gathers is what it sets."""
    source = (ROOT / "src/scene/accuracy_level.hpp").read_text(encoding="utf-8")
    figures = (ROOT / "scripts/vibrosow_figures/accuracy.py").read_text(encoding="utf-8")
    with open(ROOT / "reports/accuracy-levels/levels.csv", newline="", encoding="utf-8") as file:
        measured = list(csv.DictReader(file))
    levels = re.findall(r'"(\w+)", (\S+), (\d+), ([\d.]+), ([\d.]+), ([\d.]+)}', source)
    expect(len(levels) == 3, "accuracy_level.hpp: not three levels")
    grains = {float(row["shell_compression"]): float(row["fitted_error_percent"]) + float(row["fitted_error_band95"])
              for row in rows_with("grains-softness/accuracy.csv", {"steps_per_contact": "18"})}
    is_3d = {row["scene"]: 'space = "3d"' in (ROOT / f"seeders/{row['scene']}.toml").read_text(encoding="utf-8") for row in measured}
    for name, compression, steps, in_2d, in_3d, of_grains in levels:
        bound = grains.get(float(compression), grains[3e-5])  # "reference" was not tried with grains
        expect(abs(float(of_grains) - bound) <= 0.1, f"accuracy_level.hpp: grains err by {bound} % at {name}, not {of_grains} %")
        expect(f'("{name}", {compression}, {steps})' in figures, f"scripts/figures: another level {name}")
        for space, error in ((False, in_2d), (True, in_3d)):
            worst = max(float(row["error_bound_percent"]) for row in measured if row["level"] == name and is_3d[row["scene"]] == space)
            expect(worst <= float(error) < worst + 0.1, f"accuracy_level.hpp: {name} errs by {worst} %, not {error} %")


def check_tables():
    """The tables of numbers are those that the reports' CSV files give."""
    checked = run(str(ROOT / "scripts/figures"), "documents", "--check")
    expect(checked.returncode == 0, f"scripts/figures documents --check: {checked.stderr.strip()}")
    expect(len(set(column("relations/relations.csv", "relation"))) == 10, "relations.csv: not ten relations")


def check_pictures():
    """A document shows each picture, or links to it."""
    linked = {(path.parent / link).resolve() for path in DOCUMENTS
              for link in re.findall(r"\]\(([^)\s]+)\)", path.read_text(encoding="utf-8"))}
    for folder in ("reports", "docs", "src"):
        for picture in sorted(path for path in (ROOT / folder).rglob("*") if path.suffix in (".png", ".jpg", ".gif", ".svg", ".webp")):
            expect(picture in linked, f"{picture.relative_to(ROOT)}: no document shows it")


def check_anchors():
    """Each point of the pages' table that is met names the test that tries it."""
    rows = [line.strip("| ").split("|") for line in (ROOT / "reports/pages/anchors.md").read_text(encoding="utf-8").splitlines() if line.startswith("| ")]
    for _, what, here, *tried in rows[1:]:
        file, _, title = (tried[0] if tried else "").strip().partition(": ")
        expect(file or here.strip().startswith("no"), f"anchors.md: {what.strip()}: no test tries it")
        if file:
            tests = (ROOT / "tests/web" / file).read_text(encoding="utf-8")
            expect(f"test('{title}'" in tests or f'test("{title}"' in tests, f"anchors.md: {file} has no test '{title}'")


def check_citation():
    """CITATION.cff has the fields that its schema (1.2.0) requires, the program's version and licence, and the papers of theory.md."""
    text = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    for field in ("cff-version: 1.2.0", "message: ", "title: Vibrosow", "authors:", "license: MIT"):
        expect(re.search(rf"^{field}", text, re.MULTILINE), f"CITATION.cff: has no \"{field}\"")
    version = re.search(r"^version: (\S+)$", text, re.MULTILINE)
    expect(version and f"project(vibrosow VERSION {version[1]} " in (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"),
           "CITATION.cff: its version is not that of CMakeLists.txt")
    theory = " ".join((ROOT / "docs/explanation/theory.md").read_text(encoding="utf-8").split())
    titles = re.findall(r"^    title: (.*)$", text, re.MULTILINE)
    expect(len(titles) == 2, "CITATION.cff: does not name two papers")
    for title in titles:
        expect(f'"{title}"' in theory, f"CITATION.cff: theory.md knows no \"{title}\"")


def check_changelog():
    version = re.search(r"results_version = (\d+);", (ROOT / "src/result/results_version.hpp").read_text(encoding="utf-8"))[1]
    expect(f"Results are of version {version}:" in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"),
           f"CHANGELOG.md does not say that results are of version {version}")


def main():
    program = str(Path(sys.argv[1]).resolve())
    for path in DOCUMENTS:
        text = path.read_text(encoding="utf-8")
        check_links(path, text)
        if path.name in HISTORY:
            continue
        check_paths(path, text)
        check_reports(path, text)
        commands = commands_in(text)
        for words in commands:
            check_command(program, path.relative_to(ROOT), words, written_by(commands))
    check_accuracy_levels()
    check_tables()
    check_citation()
    check_changelog()
    check_anchors()
    check_pictures()
    front = (ROOT / "README.md").read_text(encoding="utf-8")
    check_seeder_of_front_page(program, front)
    expect(len(front.split()) <= 600, f"README.md has {len(front.split())} words, more than 600")
    check_claims()
    features = run(str(ROOT / "scripts/features"), "--print").stdout
    expect((ROOT / "docs/reference/features.md").read_text(encoding="utf-8") == features, "docs/reference/features.md is not what scripts/features writes")
    commands = run(str(ROOT / "scripts/commands"), "--print", program).stdout
    expect((ROOT / "docs/reference/commands.md").read_text(encoding="utf-8") == commands, "docs/reference/commands.md is not what scripts/commands writes")
    expect(len(commands_in(front)) >= 5, "README.md: fewer than five commands found")
    for failure in failures:
        print(failure)
    sys.exit(1 if failures else 0)


main()
