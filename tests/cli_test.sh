#!/usr/bin/env bash
# The command line as a user meets it: exit statuses, one-line errors, JSON keys, files.
set -u
genio=$1 source=$2
tests=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
. "$tests/expect.sh"
example=$source/data/examples/example_shape.csv
expect 0 '"min_corner_jacobian_ratio"' "$genio" info --json
expect 0 '"volume_change_percent"' "$genio" forward --force GGP=2 --json --out shape
[ -s shape/shape.vtu ] || { echo "FAILED: no shape.vtu"; failed=1; }
expect 2 'is no journal of Genio' "$genio" journal "$example" list
expect 2 'expected one of list, export and prune' "$genio" journal nowhere
expect 2 'expected --older-than, --keep-mb or --delivered' "$genio" journal nowhere prune
expect 2 "'journal list' does not take it" "$genio" journal nowhere list --out o
expect 2 'did you mean GGP' "$genio" forward --force GPG=2
expect 2 'above the muscle' "$genio" forward --force GGP=500
expect 2 'expected NAME=NUMBER' "$genio" forward --force GGP=nan
expect 2 'did you mean z' "$genio" forward --effect gravity.z=-9.81 --effect gravity.zz=1
expect 0 '"rise_time_s"' "$genio" forward --dynamic --force GGP=2 --duration 0.01 --json --out motion
[ -s motion/motion.pvd ] && [ "$(wc -l <motion/landmarks.csv)" -gt 5 ] || { echo "FAILED: no motion"; failed=1; }
printf 'time_s,GGP_N\n0,0\n0.01,2\n' >commands.csv
expect 0 '"steps":5' "$genio" forward --dynamic --commands commands.csv --duration 0.01 --json
expect 2 'not together' "$genio" forward --dynamic --commands commands.csv --force GGP=1
expect 2 'expected a header' "$genio" forward --dynamic --commands "$example"
expect 0 'converged' "$genio" forward --effect jaw_opening.angle=4 --json
expect 2 'expected -5 to 40 deg' "$genio" forward --effect jaw_opening.angle=400
expect 2 'did you mean' "$genio" forward --effect jaw_openning.angle=4
expect 2 'no such model file' "$genio" info --model nowhere
expect 0 '"verdict":"explained"' "$genio" invert --target "$example" --json --out results
for kind in svg png csv json vtu; do
  [ -s results/frame00001.$kind ] || { echo "FAILED: no results/frame00001.$kind"; failed=1; }
done
expect 2 'holds results already' "$genio" invert --target "$example" --out results
expect 2 'does nothing without --out' "$genio" invert --target "$example" --resume
# Four frames in two processes; an interruption in mid-line; what was known is not computed again.
awk -F, -v OFS=, 'NR==1 {print; next} {for (f = 1; f <= 4; ++f) {$1 = f; l[f] = l[f] $0 "\n"}}
  END {for (f = 1; f <= 4; ++f) printf "%s", l[f]}' "$example" >four.csv
expect 0 'of 4 frames' "$genio" invert --target four.csv --threads 2 --out four
[ "$(wc -l <four/results.jsonl)" -eq 4 ] && [ -s four/summary.csv ] && [ -s four/summary.png ] || { echo "FAILED: four/"; failed=1; }
{ head -n 1 four/results.jsonl; sed -n 2p four/results.jsonl | head -c 500; } >cut && cp cut four/results.jsonl
expect 2 'was made with sequence = false' "$genio" invert --target four.csv --out four --resume --sequence
expect 0 'known from the run before' "$genio" invert --target four.csv --out four --resume
[ "$(wc -l <four/results.jsonl)" -eq 4 ] || { echo "FAILED: resumed four/"; failed=1; }
[ "$(head -c 500 four/results.jsonl)" = "$(head -c 500 cut)" ] || { echo "FAILED: a known answer changed"; failed=1; }
# All frames together: a checkpoint, taken up; a movement that leaves commands to simulate.
expect 0 '4 explained' "$genio" invert --target four.csv --smooth --threads 2 --out smooth
[ -s smooth/checkpoint.json ] && [ "$(wc -l <smooth/results.jsonl)" -eq 4 ] || { echo "FAILED: smooth/"; failed=1; }
rm smooth/results.jsonl; echo >smooth/results.jsonl
expect 0 'all frames together' "$genio" invert --target four.csv --smooth --threads 2 --out smooth --resume
echo '{"unknowns":[["x"]]}' >smooth/checkpoint.json; echo >smooth/results.jsonl
expect 2 'is damaged' "$genio" invert --target four.csv --smooth --threads 2 --out smooth --resume
expect 2 'not together' "$genio" invert --target four.csv --smooth --sequence
awk -F, -v OFS=, 'NR==1 {print $0, "time_s"; next} {print $0, 0.02}' "$example" >timed.csv
expect 0 '"verdict":' "$genio" invert --target timed.csv --dynamic --from-rest --start-s 0 --knot-s 0.02 --step-s 0.004 --json --out movement
[ -s movement/commands.csv ] && [ -s movement/motion/motion.pvd ] || { echo "FAILED: movement/"; failed=1; }
expect 0 '"status":"converged"' "$genio" forward --dynamic --commands movement/commands.csv --duration 0.01 --json
expect 2 'rise in time' "$genio" invert --target four.csv --dynamic --start-s 0
expect 0 '"verdict":"explained"' "$genio" invert --target "$example" --full-space --json
# Other programs' files: what they do not say is asked for.
awk -F, 'NR>1 {printf "%s,%s\n", 5*$3, 600-5*$4}' "$example" >pixels.csv
expect 2 'give --units or --mm-per-px' "$genio" invert --target pixels.csv
expect 2 '--facing right' "$genio" invert --target pixels.csv --mm-per-px 0.2
expect 2 'which way the face looks' "$genio" invert --target pixels.csv --mm-per-px 0.2 --registered
printf 'FRAME\tTIME\tPOINT\tX\tY\n1\t0\t1\tabc\t2\n' >bad.tsv
expect 2 "bad.tsv:2: field X: 'abc'" "$genio" invert --target bad.tsv
printf 'muscle,mean,sd\nMH,0.3,0.01\n' >emg.csv
expect 0 '"MH":0.' "$genio" invert --target "$example" --prior emg.csv --json
printf 'muscle,mean,sd\nMX,0.3,0.01\n' >emg.csv
expect 2 'emg.csv: EMG of MX: no such muscle' "$genio" invert --target "$example" --prior emg.csv
expect 0 '"alternatives"' "$genio" invert --target "$example" --starts 3 --robust --json
expect 2 'no such file' "$genio" invert --target nothing.csv
printf 'frame,point,x_mm,z_mm\n1,1,80,abc\n' >bad.csv
expect 2 'bad.csv:2: field z_mm' "$genio" invert --target bad.csv
printf 'frame,point,x_mm,z_mm\n1,1,0.08,0.11\n1,2,0.09,0.12\n1,3,0.1,0.11\n' >metres.csv
expect 1 'cannot be laid beside the model' "$genio" invert --target metres.csv
expect 2 'expected A-B' "$genio" invert --target "$example" --frames 3-x
expect 2 'no such frame' "$genio" invert --target "$example" --frames 7
{ printf 'sp\t1\t01/02/2020 10:00:00\tword\ta\t0\t0\t0\t0\t0\t0'; for k in $(seq 42); do printf '\t%d\t3' "$k"; done; echo; } >fan.tsv
expect 0 'registered by the contours alone' "$genio" invert --target fan.tsv --format aaa
# Which frames, by time and by what was said; time and words reach every output.
printf 'frame,x_mm,z_mm,time_s\n' >words.csv
for f in 1 2 3 4 5; do awk -F, -v f=$f 'NR>1 {printf "%d,%s,%s,%s\n", f, $3, $4, 0.1*f}' "$example" >>words.csv; done
printf 'File type = "ooTextFile"\nObject class = "TextGrid"\n0 1 <exists> 1\n"IntervalTier" "words" 0 1 3\n0 0.15 "" 0.15 0.25 "ata" 0.35 0.45 "a,k"\n' >words.TextGrid
expect 0 '"label":"ata"' "$genio" invert --target words.csv --textgrid words.TextGrid --tier words --json --out words
grep -q '^2,0.2,ata,,,converged' words/summary.csv && grep -q '^4,0.4,"a,k",,,converged' words/summary.csv || { echo "FAILED: words/summary.csv"; failed=1; }
grep -q '"label": "ata"' words/frame00002.json && grep -q 'at 0.200 s: ata' words/frame00002.svg || { echo "FAILED: words/frame00002"; failed=1; }
expect 2 'did you mean words?' "$genio" invert --target words.csv --textgrid words.TextGrid --tier word
expect 2 'gives none' "$genio" invert --target four.csv --textgrid words.TextGrid
expect 2 'its times are 0.100 to 0.500 s' "$genio" invert --target words.csv --frames 1.2s-1.8s
# Another range goes on where the first ended, and runs of two ranges are one.
expect 0 'frame 2 at 0.200 s: explained' "$genio" invert --target words.csv --frames 0.2s --quiet --out first
[ -s err ] && { echo "FAILED: --quiet is not quiet"; cat err; failed=1; }
expect 0 'frame 4' "$genio" invert --target words.csv --frames 4 --resume --out first
expect 0 '"frame":3' "$genio" invert --target words.csv --frames 3 --json --out second
expect 0 '"frames":3' "$genio" merge first second --out both --json
[ "$(cut -d, -f1 both/summary.csv | paste -sd,)" = frame,2,3,4 ] && [ -s both/frame00003.png ] || { echo "FAILED: both/"; failed=1; }
expect 2 'was made with noise_mm = 0.5, not 1' "$genio" invert --target words.csv --noise-mm 1 --resume --out both
sed -i 's/0\.5$/0.6/' words.csv
expect 2 'whose content is not that of' "$genio" invert --target words.csv --resume --out both
# An option that does not apply says so.
expect 2 'does nothing without --dynamic' "$genio" invert --target words.csv --knot-s 0.1
expect 2 'does nothing without --textgrid' "$genio" invert --target words.csv --tier words
expect 2 'not together with --palate' "$genio" invert --target fan.tsv --palate fan.tsv --registered
expect 2 'sensors are named' "$genio" invert --target words.csv --sensors 3=tip
expect 2 '--units: does not apply' "$genio" invert --target words.csv --units mm
expect 2 '0: expected a number above 0' "$genio" invert --target words.csv --noise-mm 0
expect 2 '--ignore-marks: does not apply' "$genio" invert --target words.csv --ignore-marks
expect 2 '--noise-mm: does not apply' "$genio" invert --target "$example" --noise-mm 1
expect 2 'does nothing without --dynamic' "$genio" forward --duration 1
expect 2 "'request status' does not take it" "$genio" request status --target words.csv
expect 2 'did you mean invert' "$genio" invrt --target words.csv
expect 2 'did you mean --target' "$genio" invert --targt words.csv
expect 2 'did you mean palate_contact' "$genio" forward --without palate_contakt
expect 0 'Examples:' "$genio"
expect 0 '"name":"aaa"' "$genio" formats --json
expect 0 'complete -o filenames -F _genio genio' "$genio" completion bash
expect 0 '.SS genio invert' "$genio" man
"$genio" completion bash >completion && source completion
COMP_WORDS=(genio invert --tex) COMP_CWORD=2 COMPREPLY=() && _genio
[ "${COMPREPLY[*]}" = --textgrid ] || { echo "FAILED: completion says ${COMPREPLY[*]}"; failed=1; }
# A disk that is full, a folder that is a file: one line, and nothing half written.
mkdir full && ln -s /dev/full full/frame00001.svg
expect 2 'No space left on device' "$genio" invert --target "$example" --out full
[ -s full/results.jsonl ] && { echo "FAILED: full/results.jsonl"; failed=1; }
ls full | grep -q '\.new$' && { echo "FAILED: left over in full/"; failed=1; }
expect 2 'cannot be made' "$genio" invert --target "$example" --out words.csv/below
(ulimit -f 4; expect 2 'File too large' "$genio" invert --target "$example" --out large; exit $failed) || failed=1
expect 1 'genio serve' "$genio" request --lcm tcpq://127.0.0.1:7799 --target "$example" --timeout-s 1
[ "$(grep -c . err)" -le 2 ] || { echo "FAILED: a library prints"; cat err; failed=1; }
# A stack of contours becomes a closed surface.
awk 'BEGIN {print "slice,point,x_mm,y_mm,z_mm"; for (s = 0; s < 6; ++s) for (p = 0; p < 40; ++p) {
  a = p * 3.14159265 / 20; printf "%d,%d,%.4f,%.4f,%.1f\n", s, p, 9 * cos(a), 9 * sin(a), 3 * s}}' >stack.csv
expect 0 '"closed":true' "$genio" surface stack.csv --out stack.obj --triangles 300 --step 0.8 --json
expect 0 '"euler":2' "$genio" surface stack.obj --out again.obj --distance 0.2 --keep 9,0,6,3 --json
expect 2 'does nothing without --keep' "$genio" surface stack.csv --out s.obj --keep-distance 1
expect 2 '--label: goes with a label volume only' "$genio" surface stack.csv --out s.obj --label 3
expect 2 'unknown kind' "$genio" surface "$source/README.md" --out s.obj
expect 2 'expected a name in .obj' "$genio" surface stack.csv --out s.stl
expect 2 'no column slice' "$genio" surface "$example" --out s.obj
# Benchmarks are a program beside this one.
expect 0 'Benchmarks:' "$genio" bench --help
expect 2 'not in' "$genio" bench nothing
expect 2 'bench peer: needs --data' "$genio" bench peer
# Tissue constants from an indentation: what is refused, and what few equilibria give.
printf 'depth_mm,force_N\n1,0.01\n2,0.03\n' >few.csv
expect 2 'expected at least 5' "$genio" indent --data few.csv --out few
expect 2 'expected a file with force_N' "$genio" indent --out few
expect 2 'not together' "$genio" indent --data few.csv --simulate --out few
expect 2 'does nothing without' "$genio" indent --data few.csv --depth-mm 3 --out few
expect 2 'expected --layers 2' "$genio" indent --data few.csv --fit-mucosa --out few
printf 'depth_mm,force_N\n0.2,0.0016\n0.4,0.0032\n0.6,0.0049\n0.8,0.0067\n1,0.0085\n' >five.csv
expect 0 '"young_modulus_kPa"' "$genio" indent --data five.csv --half-width-mm 20 --out five --json --into stiffer
[ -s five/result.json ] && [ -s five/curve.csv ] || { echo "FAILED: five/"; failed=1; }
expect 0 '"a10"' "$genio" info --model stiffer --json
# The first example is what its page says.
expect 0 '200 simulated forces' "$genio" indent --simulate --indenter sphere --radius-mm 7 --thickness-mm 15 \
  --depth-mm 7 --rows 200 --layers 1 --a10-Pa 193.333 --a20-Pa 90.625 --seed 1 --out rear_muscle
paste -d, rear_muscle/data.csv "$source/data/examples/indentation/rear_muscle.csv" | awk -F, '
  NF == 6 { rows++; for (i = 1; i <= 3; i++) if (($i - $(i + 3)) ^ 2 > 2e-5 ^ 2) off = 1 }
  END { exit off || rows != 201 }' || { echo "FAILED: rear_muscle.csv is another"; failed=1; }
expect 2 "no data set's name contains" "$genio" bench discover --only no-such-case
mkdir alone && cp "$genio" alone/ && expect 2 'genio-bench is missing' alone/genio bench forward
exit $failed
