#!/usr/bin/env bash
# The program as a user runs it. Usage: test_program.sh PROGRAM; ends with 0 when every check holds.
set -u
program=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
# expect CODE PATTERN ARGUMENTS...: exit code and a pattern in what was printed, of which tables fit 80 columns. Only paths, and the
# header of a CSV file that is there to be copied, are as long as they are.
expect() {
  local code=$1 pattern=$2; shift 2
  local table; table=$("$program" "$@" 2>messages); local got=$?
  local printed; printed=$table$'\n'$(<messages)
  local wide; wide=$(awk 'length > 80 && !/\// && !/,hole,lot,repeat,/' <<<"$table")
  [ -z "$wide" ] || fail "vibrosow $*: wider than 80 columns: $wide"
  [ $got -eq "$code" ] || fail "vibrosow $*: exit code $got, not $code: $printed"
  grep -qE -- "$pattern" <<<"$printed" || fail "vibrosow $*: nothing like \"$pattern\" in: $printed"
}
have() { local file; for file in "$@"; do [ -s "$file" ] || fail "$file is missing or empty"; done; }

cat >seeder.toml <<'END'
title = "Small tray"
[seeds.wheat]
diameter = "4 mm"
mass = "40 mg"
[contact]
shell_compression = 1e-3
friction = 0.3
restitution = 0.5
[tray]
length = "12 cm"
height = "6 cm"
fill = { count = 40, packing = "layers" }
[tray.holes]
count = 2
width = "16 mm"
[run]
duration = "0.1 s"
measure_from = "0.02 s"
END
cat >study.toml <<'END'
base = "seeder.toml"
replicates = 2
[vary]
tray.holes.count = [1, 2]
END

expect 0 "sweep .*layout" --help
expect 0 "^vibrosow [0-9]" --version
expect 2 "." nonsense
expect 2 "." run
expect 2 "." run seeder.toml --jobs 0
expect 2 "nowhere.toml" run nowhere.toml
expect 2 "random-seed.*-1" run seeder.toml --random-seed -1
expect 2 "random-seed.*whole number" run seeder.toml --random-seed 99999999999999999999999
expect 2 "steps-per-contact.*nan" accuracy seeder.toml --steps-per-contact nan
expect 2 "shell-compression.*1e-09 to 0.5" accuracy seeder.toml --shell-compression inf
expect 2 "slip-speed.*range" accuracy seeder.toml --slip-speed "1e300 m/s"
expect 2 "youngs-modulus.*law elastic-shell.*shell_compression" accuracy seeder.toml --youngs-modulus "5 MPa"
expect 2 "threads" run seeder.toml --threads 0
expect 0 "pairs +[0-9.]+ +[0-9.]+ %" run seeder.toml --profile --out profiled
grep -q '"neighbours"' profiled/timing.json || fail "timing.json has no shares"
expect 0 "wheat" presets crops
expect 0 "wheat-steel +Wheat on steel" presets contacts
expect 0 "wheat-ball +Wheat as balls" presets crops
expect 0 "wheat-holes" presets
for command in run sweep decide optimise calibrate bench-sheet work submit status report export verify pack accuracy plan new check presets columns; do expect 0 "^Usage: vibrosow $command" $command --help; done
expect 0 "wheat-tray +Wheat tray" presets seeders
"$program" presets seeders | awk '/^seeders to start from/ { start = NR } /paper-a-fig3 / { paper = paper ? paper : NR }
  /^  silo / { silo = NR } END { exit !(start && start < paper && paper < silo) }' || fail "presets: seeders do not come first"

sed 's/width = "16 mm"/widht = "16 mm"/' seeder.toml >misspelled.toml
expect 2 "misspelled.toml:15.*widht.*width" check misspelled.toml
sed 's/width = "16 mm"/width = "16"/' seeder.toml >unitless.toml
expect 2 "unitless.toml:15" run unitless.toml
expect 2 "too long.*longest safe step" check seeder.toml --set "numerics.dt=1 ms"
expect 2 "too long" run seeder.toml --set "numerics.dt=1 ms"
expect 0 "friction" check seeder.toml
expect 0 "^tray.holes.count,hole" check study.toml

# Names of what is shipped; the wrong command for a file; keys taken out; what can hardly be meant.
expect 0 "^Wheat tray" check wheat-tray
expect 0 "layouts" check wheat-demo
# What a scene is computed with, and advice that fits it.
expect 0 "law +elastic-shell: .*shell" check seeder.toml
expect 0 "friction +sliding: .* 20 mm/s" check seeder.toml
expect 0 "friction +spring" check wheat-tray
expect 0 "scheme +gear5" check seeder.toml --set numerics.integrator=gear5
expect 2 "take a smaller contact.shell_compression: " check paper-a-fig3
hertz=(--set contact.law=hertz --set contact.shell_compression= --set "contact.youngs_modulus=0.1 MPa")
expect 0 "law +hertz: Hertz" check seeder.toml "${hertz[@]}"
expect 0 "take a larger contact.youngs_modulus" check seeder.toml "${hertz[@]}" --set "tray.motion.kind=harmonic" \
  --set "tray.motion.amplitude=1 cm" --set "tray.motion.frequency=9 Hz"
short=(--set "run.duration=0.2 s" --set "run.measure_from=0.1 s")
expect 0 "^whole tray" run wheat-tray --out shipped "${short[@]}"
expect 0 "unevenness \(CV\)" run wheat-tray --out shipped "${short[@]}"
expect 0 "span 420 mm, count 5, frequency 9 Hz" sweep wheat-holes --out shipped-sweep "${short[@]}" --set replicates=2 --set "vary.tray.motion.frequency=[\"9 Hz\"]" \
  --set "vary.tray.holes.count=[1, 5]"
expect 0 "^velocity-verlet" accuracy wheat-tray --out shipped-accuracy "${short[@]}" \
  --integrator velocity-verlet --steps-per-contact 20,40 --shell-compression 3e-4 --replicates 2
expect 2 "slip-speed: .* has none" accuracy wheat-tray --slip-speed "20 mm/s"
expect 2 "did you mean \"wheat-tray\"" run wheat-trey
expect 2 "study.toml: this is a study: use vibrosow sweep" run study.toml
expect 2 "seeder.toml: this is a seeder" sweep seeder.toml
space=(--set "space=3d" --set "tray.depth=4 cm" --set "tray.fill.count=400" --set "tray.holes.shape=round")
expect 0 "hole 2 at 80.00 mm, 20.00 mm from the front, 16.00 mm in diameter" check seeder.toml "${space[@]}"
expect 0 "2D over 3D [0-9.]+" check seeder.toml --both "${space[@]}"
expect 0 "^whole tray: [0-9.]+ g/s" run seeder.toml --out in-space "${space[@]}"
grep -q ",z_mm" in-space/outflow.csv || fail "outflow.csv of a run in space has no z"
grep -q "across_mm" in-space/summary.csv || fail "summary.csv of a run in space does not say where holes lie across"
# What a rate in space is expected to be until one weighs, in four parts; of a tray outside the table of one hole with a doubt; not in the plane.
brief=(--set accuracy=draft --set "run.duration=0.6 s" --set "run.measure_from=0.3 s")
until="g/s, expect [0-9.]+ to [0-9.]+ g/s until you weigh"
expect 0 "^[0-9.]+ $until" run pellet-precision --out precision "${brief[@]}"
expect 0 "^Note: tray.holes.width: 1.53 seeds is outside the table of one hole" run pellet-precision --out precision "${brief[@]}"
python3 - precision <<'END' || fail "precision: summary.csv and run.json do not agree about what is expected"
import csv, json, sys
*holes, whole = csv.DictReader(open(f"{sys.argv[1]}/summary.csv"))
outflow = json.load(open(f"{sys.argv[1]}/run.json"))["outflow"]
names = ["expected_low_g_per_s", "expected_high_g_per_s", "chance_percent", "numerics_percent", "tolerance_percent", "model_percent"]
assert all(abs(float(whole[name]) / outflow[name] - 1) < 1e-5 for name in names), whole
assert not any(hole[name] for hole in holes for name in names), holes
assert float(whole["expected_low_g_per_s"]) < float(whole["rate_g_per_s"]) < float(whole["expected_high_g_per_s"])
assert abs(outflow["numerics_percent"] - 5.5) < 1e-9, outflow  # the level's own
END
expect 0 "compared by chance alone" sweep study.toml --out expecting "${space[@]}" --set accuracy=draft --set "tray.motion.kind=harmonic" \
  --set "tray.motion.amplitude=8 mm" --set "tray.motion.frequency=5 Hz" --set "run.duration=0.6 s" --html
python3 - expecting/sweep.csv <<'END' || fail "expecting/sweep.csv has not every part: $(<expecting/sweep.csv)"
import csv, sys
layouts = list(csv.DictReader(open(sys.argv[1])))
assert len(layouts) == 2
for one in layouts:
    assert all(float(one[f"{part}_percent"]) > 0 for part in ("chance", "numerics", "tolerance", "model")), one
    assert float(one["expected_low_g_per_s"]) < float(one["rate_g_per_s"]) < float(one["expected_high_g_per_s"])
END
grep -q '"expected":"Until you weigh, expect ' expecting/report.html || fail "the page of a sweep in space does not say what to expect"
expect 0 "compared by chance alone" decide study.toml --goal rate --within "20 %" --out deciding "${space[@]}" --set accuracy=draft --reuse expecting \
  --set "tray.motion.kind=harmonic" --set "tray.motion.amplitude=8 mm" --set "tray.motion.frequency=5 Hz" --set "run.duration=0.6 s"
"$program" run seeder.toml --out flat | grep -q "until you weigh" && fail "in 2D a range is given"
expect 0 "tray.holes.shape: in 2D a round hole is taken for a slot" check seeder.toml --set "tray.holes.shape=round"
expect 2 "tray.depth: is missing" run seeder.toml --set "space=3d"
expect 2 "for one seeder, not for a study" check study.toml --both
# A key of one space is there for the other: a round hole lets less out than a slot from front to back, by --set and by the file, from the
# plane and from space.
ratio() { "$program" check seeder.toml --both --set "run.duration=0.4 s" --set "tray.depth=4 cm" --set "tray.fill.count=$1" --set "space=$2" --set "tray.holes.shape=$3" 2>/dev/null | awk '/2D over 3D/ { print $4 }'; }
slot=$(ratio 60 2d slot) round=$(ratio 60 2d round) back=$(ratio 600 3d round)
awk -v slot="$slot" -v round="$round" -v back="$back" 'BEGIN { exit !(slot > 0 && round > 1.5 * slot && back > 1.5 * slot) }' ||
  fail "2D over 3D: $slot of slots, $round of round holes, $back of the same from space"
# A lot that was asked for is there, or is refused in the same words by all.
sed 's/^mass = "40 mg"/mass = "40 mg"\nmass_fraction = "50 %"\n[seeds.pea]\ndiameter = "14 mm"\nmass = "1700 mg"\nmass_fraction = "50 %"/' seeder.toml >mixture.toml
sed 's/"seeder.toml"/"mixture.toml"/' study.toml >mixtures.toml
fewer=(--set tray.fill.count=16 --set "tray.holes.width=17 mm")
gone="tray.fill.count: of 16 seeds none is of pea: 2.3 % of the seeds, 50 % of their mass, were asked for; from 44 seeds on there is one"
expect 2 "$gone" check mixture.toml "${fewer[@]}"
expect 2 "$gone" run mixture.toml --out gone "${fewer[@]}"
expect 2 "$gone" sweep mixtures.toml --out gone "${fewer[@]}"
expect 0 "pea +1 seeds, 2.5 % by number .asked 2.299 %., 52.15 % by mass .asked 50 %." check mixture.toml --set "tray.holes.width=17 mm" --set "tray.height=200 mm"
expect 0 "warning: tray.fill.count: of 40 seeds 1 are of pea: 2.5 % by number instead of 2.3 %" check mixture.toml --set "tray.holes.width=17 mm" --set "tray.height=200 mm"
sed -i 's/count = 40/count = 16/' mixture.toml
expect 2 "^vibrosow: mixture.toml:[0-9]+: tray.fill.count: of 16 seeds none is of pea" check mixture.toml
expect 0 "hole 1 at 20.00 mm" check seeder.toml --set "tray.holes.count=" --set 'tray.holes.at=["20 mm"]'
expect 0 "^vibrosow: warning: tray.holes.width: 3 mm is narrower" check seeder.toml --set "tray.holes.width=3 mm"
expect 0 "^vibrosow: warning: tray.holes.width: 3 mm is narrower" sweep study.toml --out narrow --set "tray.holes.width=3 mm"
grep -q "^1,.*is narrower" narrow/sweep.csv || fail "sweep.csv does not carry the warning"
expect 0 "^vibrosow: warning: tray.holes.width: 3 mm is narrower" accuracy seeder.toml --out narrow-accuracy \
  --integrator velocity-verlet --steps-per-contact 20 --shell-compression 1e-3 --slip-speed "20 mm/s" --replicates 1 \
  --set "tray.holes.width=3 mm"
expect 0 "^vibrosow: warning: tray.holes.width: 3 mm is narrower" run seeder.toml --out narrow-run --set "tray.holes.width=3 mm"
grep -q "is narrower" narrow-run/run.json || fail "run.json does not carry the warning"
# Once in each answer, also in that of a run of a study, and of accuracy.
a_narrow_run=$(basename "$(find narrow/cases -name '*.case' | sort | head -n 1)" .case)
expect 0 "reports: narrow-one" export narrow --run "$a_narrow_run" --out narrow-one
accuracy=(--integrator velocity-verlet --slip-speed "20 mm/s" --set "tray.holes.width=3 mm")
expect 0 "^(Note|Doubtful): tray.holes.width: 3 mm is narrower" accuracy seeder.toml --out narrow-accuracy --steps-per-contact 20 \
  --shell-compression 1e-3 --replicates 1 "${accuracy[@]}"
expect 0 "^(Note|Doubtful): tray.holes.width: 3 mm is narrower" accuracy seeder.toml --out narrow-promise --within "50 %" \
  --set "tray.holes.width=3 mm"
for file in narrow-run/report.json narrow-run/run.json narrow-one/report.json narrow-one/run.json narrow-accuracy/report.json \
  narrow-promise/report.json narrow-promise/promise.json; do
  told=$(grep -oE '"text": ?"tray.holes.width' $file | wc -l)
  [ "$told" -eq 1 ] || fail "$file tells $told times of a narrow hole"
done

# A drawing with a line across the first hole and another on a layer that is switched off.
# shellcheck disable=SC2016  # $INSUNITS is a name of the drawing
printf '%s\n' 0 SECTION 2 HEADER 9 '$INSUNITS' 70 4 0 ENDSEC 0 SECTION 2 TABLES 0 LAYER 2 NOTES 70 0 62 -7 0 ENDSEC 0 SECTION 2 ENTITIES \
  0 LINE 8 WALL 10 20 20 0 11 60 21 0 0 LINE 8 NOTES 10 0 20 30 11 120 21 30 0 ENDSEC 0 EOF >outline.dxf
drawn=(--set 'tray.pieces={ file = "outline.dxf" }')
expect 0 "drawing outline.dxf: 1 piece from \(20, 0\) to \(60, 0\) mm, layer WALL; left out:" check seeder.toml "${drawn[@]}"
expect 0 "^vibrosow: warning: tray.pieces: piece 1 covers hole 1" check seeder.toml "${drawn[@]}"
expect 0 "drawing outline.dxf: 1 piece" run seeder.toml --out drawn-run "${drawn[@]}"
grep -q "piece 1 covers hole 1" drawn-run/run.json || fail "run.json does not carry the warning of a covered hole"
expect 0 "tilted by 5 degree, right end up" check seeder.toml --set "tray.tilt=5 degree"
"$program" check seeder.toml --set "tray.tilt=5 degree" | tr -s ' \n' ' ' | grep -q "gravity and the direction of its motion are not: 0 degree is level" ||
  fail "check does not say in which frame gravity and the direction of a tilted tray's motion are"
fast=(--set "tray.motion.kind=harmonic" --set "tray.motion.direction=0 degree" --set "tray.motion.amplitude=0.1 um" --set "tray.motion.frequency=6 kHz")
expect 0 "at most 8.333e-06 s: 20 steps in a period of the motion" check seeder.toml "${fast[@]}"
expect 2 "longest safe step is 8.333e-06 s \(bound by 20 steps in a period of the motion\)" run seeder.toml "${fast[@]}" --set "numerics.dt=50 us"

# No abort, whatever the name of a file, the units' database or the length of a key.
grep -v title seeder.toml >"$(printf 'caf\xe9.toml')"
expect 0 "reports: bytes" run "$(printf 'caf\xe9.toml')" --out bytes
(export UDUNITS2_XML_PATH=/no/such/file.xml; expect 2 "unit database .*/no/such/file.xml" check seeder.toml; exit $failures) || failures=1
expect 2 "more than 32 parts" check seeder.toml --set "$(printf 'a.%.0s' {1..40000})a=1"

expect 0 "reports: one" run seeder.toml --out one
have one/outflow.csv one/summary.csv one/run.json one/timing.json
expect 0 "" run seeder.toml --quiet
have out/seeder/outflow.csv
[ -z "$("$program" run seeder.toml --quiet --out quiet 2>&1)" ] || fail "--quiet prints"
cmp -s one/outflow.csv out/seeder/outflow.csv || fail "the same random seed gives other bytes"
expect 0 "" run seeder.toml --random-seed 2 --out other
cmp -s one/outflow.csv other/outflow.csv && fail "another random seed gives the same bytes"

expect 0 "reports: one-job" sweep study.toml --out one-job --jobs 1
expect 0 "reports: two-jobs" sweep study.toml --out two-jobs --jobs 2
for file in sweep.csv sweep_holes.csv sweep_runs.csv; do
  have one-job/$file
  cmp -s one-job/$file two-jobs/$file || fail "$file depends on --jobs"
done

# Runs are kept: nothing is simulated twice, and their folder can be looked at.
expect 0 "([0-9]+) of the runs were kept from before" sweep study.toml --out one-job
expect 0 "of the runs were kept from before" sweep study.toml --out reusing --reuse two-jobs
cmp -s reusing/sweep_runs.csv one-job/sweep_runs.csv || fail "sweep_runs.csv depends on where runs come from"
expect 2 "reuse: out/nowhere holds no runs of a sweep" sweep study.toml --out reusing --reuse out/nowhere
expect 0 "^([0-9]+) of \1 runs are there, 0 are missing" status one-job
expect 0 "^[0-9]+ runs, 0 damaged" verify one-job
a_case=$(find one-job/cases -name '*.case' | sort | head -n 1)
cp one-job/sweep.csv whole.csv
truncate -s 200 "$a_case"
expect 0 "damaged: $(basename "$a_case" .case)" verify one-job
expect 0 " 0 are missing" status one-job
rm "$a_case"
expect 0 " 1 are missing" status one-job
expect 2 "1 of [0-9]+ runs are missing" export one-job --complete
expect 0 "warning: runs are missing" export one-job
expect 0 "warning: runs are missing" draw one-job --chart ranking --out missing.svg
mkdir -p "$a_case/full"  # what stands there cannot be replaced
expect 2 "runs are not kept: .*$(basename "$a_case")" verify one-job
rm -r "$a_case"
grep -q ",missing," one-job/sweep_runs.csv || fail "a missing run is not said to be missing"
cmp -s one-job/sweep.csv whole.csv && fail "an export of what is missing is whole"
expect 0 "reports: one-job" sweep study.toml --out one-job
cmp -s one-job/sweep.csv whole.csv || fail "a run made again is another"
expect 0 "reports: one-job" export one-job
cmp -s one-job/sweep.csv whole.csv || fail "an export differs from the sweep"
expect 2 "neither report.json nor cases/plan" status set

# Shares of a plan, on one folder or packed.
expect 0 "^shard 2/3: 0 runs made" work one-job --shard 2/3
expect 2 "shard: \"4/3\" is no share" work one-job --shard 4/3
expect 0 "\"--bundle\" is called --shard now" work one-job --bundle 2/3
expect 2 "shard: \"4/3\" is no share" work one-job --bundle=4/3
expect 2 "a plan is named by 16 of the digits" work one-job --plan nowhere
expect 0 "^[0-9]+ runs packed" pack one-job
[ -z "$(find one-job/cases -name '*.case')" ] || fail "packed runs have files of their own"
expect 0 "reports: one-job" export one-job --complete
cmp -s one-job/sweep.csv whole.csv || fail "packed runs make other reports"
a_run=$(basename "$a_case" .case)
expect 0 "reports: of-a-run" export one-job --run "$a_run" --out of-a-run
for file in run.json summary.csv outflow.csv; do have of-a-run/$file; done
printf '%s\n' 'base = "seeder.toml"' 'replicates = 1' '[set]' 'seeds.wheat.number_fraction = "60 %"' \
  'seeds.weed = { diameter = "3 mm", mass = "20 mg", number_fraction = "40 %" }' >mixed.toml
expect 0 "reports: mixed" sweep mixed.toml --out mixed
expect 0 "reports: mixed-one" export mixed --run "$(basename "$(find mixed/cases -name '*.case')" .case)" --out mixed-one
expect 0 "reports: mixed-run" run seeder.toml --out mixed-run --set 'seeds.wheat.number_fraction="60 %"' --set 'seeds.weed.diameter="3 mm"' \
  --set 'seeds.weed.mass="20 mg"' --set 'seeds.weed.number_fraction="40 %"'
drawn() { sed -n '/"mixture"/,/"outflow"/p' "$1/run.json"; }
[ -n "$(drawn mixed-one)" ] || fail "an exported run has no shares"
[ "$(drawn mixed-one)" = "$(drawn mixed-run)" ] || fail "an exported run has other shares than the run: $(drawn mixed-one)"
expect 0 "reports: high" run seeder.toml --out high --html --set tray.fill.count= --set 'tray.fill.height="14 mm"'
grep -q "resumed run" messages && fail "a fill by its height is no resumed run: $(<messages)"
expect 2 "its plan has no run nowhere" export one-job --run nowhere --out of-none
expect 0 '"event":"end"' sweep study.toml --out one-job --progress json
printf '%s\n' 'base = "seeder.toml"' 'replicates = { interval = "50 %", most = 12 }' > by-need.toml
expect 0 "reports: by-need" sweep by-need.toml --out by-need
[ "$(find by-need/cases -name '*.case' | wc -l)" -ge 10 ] || fail "fewer than ten runs by need"

# A plan of a first round says that its interval needs another, which submit plans.
printf '%s\n' 'base = "seeder.toml"' 'replicates = { interval = "0.5 %", most = 12 }' '[set]' 'tray.fill = { count = 60 }' 'run.duration = "0.2 s"' \
  'tray.motion = { kind = "harmonic", frequency = "15 Hz", amplitude = "4 mm" }' > tight.toml
expect 0 "SBATCH" submit tight.toml --out tight --time "1 h" --dry-run
expect 0 "^2 more runs are needed for the interval that is wanted: vibrosow submit" work tight
expect 0 "^2 more runs are needed for the interval that is wanted: vibrosow submit" status tight
expect 2 "tight: 2 more runs are needed .*: vibrosow submit tight plans them" export tight --complete
[ -e tight/sweep.csv ] && fail "an export that is not complete is written"
expect 0 "warning: 2 more runs are needed" export tight
grep -q "after 10 of at most 12 runs the rate's interval is still wider than 0.5 %, and more are needed" tight/sweep.csv || fail "$(<tight/sweep.csv)"
expect 0 "SBATCH" submit tight --time "1 h" --dry-run
expect 0 "2 runs made, 10 were there, 0 left" work tight
expect 0 "^12 of 12 runs are there, 0 are missing" status tight
expect 0 "reports: tight" export tight --complete
grep -q "after 12 runs the rate's interval is still wider than 0.5 %" tight/sweep.csv || fail "$(<tight/sweep.csv)"

# Slurm's scripts; a study moved away afterwards is still the same.
expect 0 "#SBATCH --array=1-2%1" submit study.toml --out submitted --time "1 h" --shards 2 --array-limit 1 --dry-run
expect 0 "exec .* work .*submitted" submit submitted --time "1 h" --shards 2 --dry-run
expect 2 "less than 2 min" submit submitted --time "1 min"
cp study.toml moved-study.toml
expect 0 "SBATCH" submit moved-study.toml --out moved --time "1 h" --shards 2 --dry-run
rm moved-study.toml
expect 0 "^shard 1/2" work moved --shard 1/2
expect 0 "^shard 2/2" work moved --shard 2/2
expect 0 "reports: moved" export moved --complete
cmp -s moved/sweep.csv whole.csv || fail "shares make other reports than a sweep"
"$program" sweep study.toml --out drafts --set accuracy=draft --quiet || fail "no drafts"
expect 0 " 0 are missing" status drafts

# Tables of one study do not stay beside the plan of another.
cp -r drafts other-drafts
expect 0 "drafts held reports of another study, or without their plan, which are removed" submit study.toml --time "1 h" --dry-run --out drafts
[ -e drafts/sweep.csv ] && fail "the tables of another study stay beside a plan"
"$program" sweep study.toml --out other-drafts --quiet || fail "no sweep in another one's folder"
cmp -s other-drafts/sweep.csv whole.csv || fail "a study that takes the place of another has other tables"
"$program" submit study.toml --time "1 h" --dry-run --out other-drafts 2>&1 | grep "held reports" && fail "the same study is taken for another"

# A folder belongs to one command; a second run replaces its set, whole.
"$program" run seeder.toml --quiet --out set --set 'record={ times = ["0 s", "0.1 s"], cell = "1 cm" }' || fail "no record"
have set/grains_002.csv set/files.json
expect 0 "reports: set" run seeder.toml --out set
[ -e set/grains_002.csv ] && fail "a second run leaves files of the first"
expect 2 "set holds the reports of vibrosow run, not of sweep" sweep study.toml --out set
mkdir foreign && echo mine >foreign/sweep.csv
expect 2 "foreign/sweep.csv would be overwritten" sweep study.toml --out foreign
[ "$(cat foreign/sweep.csv)" = mine ] || fail "a foreign file was overwritten"
expect 0 "reports: out/seeder-accuracy" accuracy seeder.toml --integrator velocity-verlet --steps-per-contact 20 \
  --shell-compression 1e-3 --slip-speed "20 mm/s" --replicates 1
expect 0 "reports: semicolon" run seeder.toml --csv semicolon --out semicolon
head -2 semicolon/summary.csv | tail -1 | grep -qE '^1;wheat;40;16;[0-9]+;[0-9]+,[0-9]+;' || fail "no decimal commas"
expect 2 "csv.*comma,semicolon" run seeder.toml --csv tabs

expect 0 "cost" accuracy seeder.toml --out accuracy --integrator velocity-verlet --steps-per-contact 5,20 \
  --shell-compression 1e-3 --slip-speed "20 mm/s" --replicates 2
have accuracy/accuracy.csv accuracy/accuracy_timing.csv accuracy/timing.json
[ "$(wc -l <accuracy/accuracy.csv)" -eq 3 ] || fail "accuracy.csv has not two rows"
[ "$(wc -l <accuracy/accuracy_runs.csv)" -eq 3 ] || fail "accuracy_runs.csv has not two rows"
expect 0 "A rate within 50 %: " accuracy seeder.toml --within "50 %" --out promise
have promise/promise.json promise/numerics.toml promise/accuracy_errors.csv
grep -q "^steps_per_contact = " promise/numerics.toml || fail "numerics.toml sets no step"
kept=$(find promise/cases -name '*.case' | sort)
expect 0 "(.*) of the \\1 runs were kept from before" accuracy seeder.toml --within "50 %" --out promise
head -n 3 <<<"$kept" | xargs rm
cp promise/promise.json promise/accuracy_runs.csv .
expect 0 "pilots, without those that are kept" accuracy seeder.toml --within "50 %" --out promise --jobs 1
for file in promise.json accuracy_runs.csv; do cmp "$file" "promise/$file" || fail "a promise from kept runs differs"; done
[ "$(find promise/cases -name '*.case' | sort)" = "$kept" ] || fail "runs of a promise are not kept"
expect 0 "cannot be promised" accuracy seeder.toml --within "0.01 %" --out promise
[ -e promise/numerics.toml ] && fail "an impossible promise leaves keys"
expect 2 "within: \"0 %\" is out of range" accuracy seeder.toml --within "0 %"
expect 2 "within: .*3.*percent|within: .*\"3\"" accuracy seeder.toml --within 3
expect 2 "budget excludes --within|within excludes --budget" accuracy seeder.toml --within "3 %" --budget "1 min"
expect 2 "replicates excludes --within|within excludes --replicates" accuracy seeder.toml --within "3 %" --replicates 7
expect 2 "choose the setting themselves" accuracy seeder.toml --within "3 %" --steps-per-contact 20

# A file may grow to 512 bytes only: as on a full disk.
printed=$(bash -c 'trap "" XFSZ; ulimit -f 1; exec "$0" run seeder.toml --out full --quiet --set "run.duration=0.3 s"' "$program" 2>&1)
[ $? -eq 2 ] || fail "a full disk does not end with 2: $printed"
grep -q "cannot be written" <<<"$printed" || fail "a full disk is not named: $printed"
[ -z "$(find full -type f 2>/dev/null)" ] || fail "a full disk leaves $(find full -type f)"

# The same without the shell's help against the signal; and a table that cannot be printed.
printed=$(bash -c 'ulimit -f 1; exec "$0" run seeder.toml --out full --quiet --set "run.duration=0.3 s"' "$program" 2>&1)
[ $? -eq 2 ] || fail "a file over the size limit does not end with 2: $printed"
[ -z "$(find full -type f 2>/dev/null)" ] || fail "a file over the size limit leaves $(find full -type f)"
if [ -w /dev/full ]; then
  printed=$("$program" check seeder.toml 2>&1 >/dev/full)
  [ $? -eq 2 ] || fail "a check that cannot be printed does not end with 2"
  grep -q "^vibrosow: .*space" <<<"$printed" || fail "a full standard output is not named: $printed"
  printf 'base = "seeder.toml"\n[[layout]]\nname = "fits"\n[[layout]]\nname = "does not"\ntray.holes.span = "1 m"\n[vary]\n
contact.friction = { from = 0, to = 1, step = 0.01 }\n' >many.toml
  printed=$("$program" check many.toml 2>&1 >/dev/full)
  [ $? -eq 2 ] || fail "a long check that cannot be printed does not end with 2: $printed"
fi
# The table is printed all the same, even when quiet: it is all that is left.
printed=$(bash -c 'ulimit -f 1; exec "$0" run seeder.toml --out full --quiet --set "run.duration=0.3 s"' "$program" 2>/dev/null)
grep -q "put in 40 = inside" <<<"$printed" || fail "a full disk takes the table too: $printed"

# A reader that has gone, closed streams and a full standard error stop nothing.
"$program" run seeder.toml --out streams-1 2>&1 | true
[ "${PIPESTATUS[0]}" -eq 0 ] || fail "a closed pipe stops a run"
"$program" run seeder.toml --out streams-2 >&- 2>&- || fail "closed streams stop a run"
have streams-1/run.json streams-2/run.json
"$program" run nowhere.toml 2>&-
[ $? -eq 2 ] || fail "a message to a closed standard error does not end with 2"
if [ -w /dev/full ]; then
  "$program" run nowhere.toml 2>/dev/full
  [ $? -eq 2 ] || fail "a message to a full standard error does not end with 2"
  "$program" run seeder.toml --out streams-3 >/dev/full 2>&1
  [ $? -eq 2 ] || fail "a table that cannot be printed does not end with 2"
  have streams-3/run.json
fi

# No second thread to be had. Only a user with a limit of processes can see that; root has none.
if [ "$(id -u)" -eq 0 ] && command -v setpriv >/dev/null; then
  chmod a+rx "$work" && mkdir nobody && chmod a+rwx nobody
  # shellcheck disable=SC2016
  printed=$(setpriv --reuid=65534 --regid=65534 --clear-groups bash -c \
    'ulimit -u 1; exec "$0" sweep study.toml --jobs 2 --quiet --out nobody/out' "$program" 2>&1)
  code=$?
  # Not where this user may not even read the program.
  [ $code -eq 126 ] || [ $code -eq 0 ] || fail "without threads the program ends with $code: $printed"
  [ $code -eq 126 ] || grep -q "1 thread of the 2" <<<"$printed" || fail "nothing is said of threads: $printed"
fi
mkdir closed && chmod 555 closed
if [ ! -w closed ]; then  # root may write everywhere
  expect 2 "^vibrosow: closed: cannot be written into" run seeder.toml --out closed --set "run.duration=9000 s"
fi

# Ctrl-C, and what a system sends that shuts down: the first layouts are done in a moment, the last would take hours. Job control, because a background job of a
# plain script ignores SIGINT.
cat >long.toml <<'END'
base = "seeder.toml"
replicates = 1
[vary]
run.duration = ["0.1 s", "9000 s"]
END
set -m
for signal in INT TERM HUP; do
  "$program" sweep long.toml --out long --jobs 1 --quiet &
  pid=$!
  sleep 1
  kill -$signal $pid
  wait $pid
  [ $? -eq 130 ] || fail "SIG$signal does not end with 130"
  have long/sweep.csv
  grep -q '^1,,ok,' long/sweep.csv || fail "SIG$signal lost what was finished: $(cat long/sweep.csv)"
  grep -q '^2,,incomplete,' long/sweep.csv || fail "the interrupted layout is not marked: $(cat long/sweep.csv)"
  rm -r long
done
set +m

# Decisions: the same for any number of jobs, killed or not; what cannot be decided is told before anything is written.
cat >noisy.toml <<'END'
title = "Noisy trays"
base = "seeder.toml"
[set]
tray.depth = "4 cm"
tray.fill = { count = 60 }
tray.motion = { kind = "harmonic", frequency = "15 Hz", amplitude = "4 mm" }
run.duration = "0.2 s"
[vary]
tray.holes.width = ["12 mm", "16 mm", "20 mm"]
END
decide=(--goal rate --within "5 %" --confidence "90 %")
expect 0 "The best:" decide noisy.toml "${decide[@]}" --jobs 1 --out decided
have decided/decision.csv decided/decision.json
expect 0 "Cost: [0-9]+ runs, .* grain-steps; without leaving" decide noisy.toml "${decide[@]}" --jobs 2 --out decided-by-two
cmp -s decided/decision.csv decided-by-two/decision.csv || fail "a decision depends on the number of jobs"
expect 0 "are there, 0 are missing" status decided
"$program" decide noisy.toml "${decide[@]}" --jobs 1 --out killed --quiet 2>messages &
sleep 0.3
{ kill -KILL $! && wait $!; } 2>messages
expect 0 "The best:" decide noisy.toml "${decide[@]}" --jobs 1 --out killed
cmp -s decided/decision.csv killed/decision.csv || fail "a killed decision goes on to another"
expect 0 "Clogging is not tested" decide noisy.toml "${decide[@]}" --procedure posterior --out posterior --reuse decided
expect 0 "no layout meets the rate" decide noisy.toml "${decide[@]}" --rate "1 seeds/s +- 5 %" --out no-rate --reuse decided
expect 0 "Drafts: .*pilot" decide noisy.toml "${decide[@]}" --set contact.shell_compression=1e-4 --drafts --out with-drafts
expect 2 "as soft as drafts" decide noisy.toml "${decide[@]}" --drafts --out not-there
expect 2 "none of unevenness, instability" decide noisy.toml --goal unevennes --out not-there
expect 2 "has no tolerance" decide noisy.toml --goal rate --rate "43 seeds/s" --out not-there
expect 2 "in 2D without tray.depth" decide study.toml --goal rate --rate "43 seeds/s +- 5 %" --out not-there
expect 2 "within: \"60 %\" is out of range" decide noisy.toml --goal rate --within "60 %" --out not-there
expect 2 "confidence: .*unit" decide noisy.toml --goal rate --confidence 95 --out not-there
expect 2 "5 cannot decide" decide noisy.toml --goal rate --most 5 --out not-there
expect 2 "this is a seeder" decide seeder.toml --goal rate --out not-there
[ -e not-there ] && fail "a decision that cannot be made left a folder"
expect 2 "holds the reports of vibrosow sweep, not of decide" decide noisy.toml --goal rate --out one-job
"$program" decide long.toml --goal rate --jobs 1 --quiet --out long &
pid=$!
sleep 1.5
kill -TERM $pid
wait $pid
[ $? -eq 130 ] || fail "an interrupted decision does not end with 130"
grep -q '"interrupted": true' long/decision.json || fail "an interrupted decision does not say so"

# Fronts: likewise, and they are studies.
cat >space.toml <<'END'
title = "Noisy space"
base = "seeder.toml"
proposals = 4
[set]
tray.depth = "4 cm"
tray.fill = { count = 60 }
tray.motion = { kind = "harmonic", frequency = "15 Hz", amplitude = "4 mm" }
run.duration = "0.2 s"
[vary]
tray.holes.width = { from = "12 mm", to = "20 mm" }
tray.motion.frequency = { from = "10 Hz", to = "20 Hz" }
END
printf 'base = "seeder.toml"\n' >study-of-one.toml
optimise=(--goals "rate,power" --runs 24 --clogging "100 %")
expect 0 "Cost: [0-9]+ layouts, [0-9]+ runs" optimise space.toml "${optimise[@]}" --jobs 1 --out front
have front/pareto.csv front/optimise.json front/front.toml
"$program" optimise space.toml "${optimise[@]}" --jobs 2 --out killed-front --quiet 2>messages &
sleep 0.3
{ kill -KILL $! && wait $!; } 2>messages
expect 0 "decide killed-front/front.toml" optimise space.toml "${optimise[@]}" --jobs 2 --out killed-front
cmp -s front/pareto.csv killed-front/pareto.csv || fail "a killed search goes on to another front, or depends on the number of jobs"
expect 0 "layout" sweep front/front.toml --reuse front --set replicates=2 --out swept-front
expect 2 "none of unevenness, instability" optimise space.toml --goals unevennes --out no-front
expect 2 "rate_error needs the rate" optimise space.toml --goals rate_error,power --out no-front
expect 2 "no \[vary\]" optimise study-of-one.toml --goals rate,power --out no-front
expect 2 "do not take" optimise space.toml --goals frequency_sensitivity,power --runs 8 --out no-front
[ -e no-front ] && fail "a search that cannot begin left a folder"

[ $failures -eq 0 ] && echo "all checks hold"
exit $((failures > 0))
