#!/usr/bin/env bash
# A corpus on this machine: bad rows, refused recordings, a killed task, a changed recording.
set -eu
genio=$1 source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "FAILED: $*"; exit 1; }
# expect STATUS WORD COMMAND...: exit status, and WORD somewhere in what it prints
expect() {
  local status=$1 word=$2 got=0; shift 2
  "$@" >out 2>err || got=$?
  [ $got -eq "$status" ] && grep -qF -- "$word" out err || { cat out err; fail "$* -> $got, expected $status and '$word'"; }
  if [ "$status" -eq 2 ] && [ "$(grep -c . err)" -ne 1 ]; then cat err; fail "$* prints more than one line"; fi
}
# The example as a recording of so many frames that differ: repeat FRAMES SHIFT_MM >FILE
repeat() {
  awk -F, -v OFS=, -v n="$1" -v by="$2" 'NR==1 {print; next} {r[NR] = $0}
    END {for (f = 1; f <= n; ++f) for (k = 2; k <= NR; ++k) {split(r[k], c, ",");
         print f, c[2], c[3], c[4] + by * f, c[5], c[6]}}' "$source/data/examples/example_shape.csv"
}
mkdir s1 s2
repeat 12 0.05 >s1/long.csv
cp "$source"/data/examples/recording/*.tsv s2
head -c 300 s2/contours.tsv >s2/broken.tsv
cat >manifest.csv <<CSV
recording,palate,speaker,options
s1/long.csv,,S1,
s2/contours.tsv,s2/palate.tsv,S2,"--labels ""front,back"" --sequence"
s2/broken.tsv,s2/palate.tsv,S2,
CSV
# Every bad cell is found before anything is done, and named by line and column.
bad() { printf 'recording,palate,model,options\n%s\n' "$1" >bad.csv; expect 2 "$2" "$genio" corpus bad.csv --out bad; }
bad 's1/none.csv,,,' 'bad.csv:2: column recording:'
bad 's1/long.csv,s1/none.csv,,' 'bad.csv:2: column palate:'
bad 's1/long.csv,,,--statrs 3' 'column options: --statrs: genio invert has no such option; did you mean --starts?'
bad 's1/long.csv,,,--out x' "--out is the corpus's own"
bad 's1/long.csv,,,--palate=x' '--palate is not given here but in the column palate'
bad 's1/long.csv,,,--tier words' 'column options: --tier: does nothing without --textgrid'
bad 's1/long.csv,,,"--labels ""a"' 'a quote is not closed'
bad 's1/long.csv,,,--starts 3,more' 'bad.csv:2: has 5 cells, and the header 4 columns'
printf 'recording,palete\ns1/long.csv,\n' >bad.csv
expect 2 "bad.csv:1: no such column: 'palete'; did you mean palate?" "$genio" corpus bad.csv --out bad
[ ! -e bad ] || fail "a bad manifest left a folder"
expect 2 'a manifest is needed' "$genio" corpus --out bad
expect 2 'expected the folder of a corpus' "$genio" corpus --task 0 --out bad
# One worker is killed in the middle: the task is named, the rest is done.
"$genio" corpus manifest.csv --out corpus --share 8 >out 2>err & main=$!
while kill -0 $main 2>/dev/null && [ ! -s corpus/tasks/0000/s1_long/results.jsonl ]; do sleep 0.05; done
[ -s corpus/tasks/0000/s1_long/results.jsonl ] || { cat out err; fail "task 0 gives no line"; }
kill -9 "$(grep -ls "^PPid:[[:space:]]*$main\$" /proc/[0-9]*/status | cut -d/ -f3)"
status=0; wait $main || status=$?
[ $status -eq 1 ] || fail "a killed task ends in status $status"
grep -q 'failed   task 0: its process was killed by signal 9' out || { cat out err; fail "the killed task is not named"; }
grep -q '"reason": "its process was killed' corpus/corpus.json || fail "corpus.json does not name the killed task"
grep -q '^s1_long,s1/long.csv,S1,7,,,,open,' corpus/results.csv || fail "an open frame has no row"
before=$(head -n 1 corpus/tasks/0000/s1_long/results.jsonl)
# The rest is made good, and nothing is there twice.
expect 1 'refused  s2_broken' "$genio" corpus manifest.csv --out corpus --resume --threads 2
[ "$(head -n 1 corpus/tasks/0000/s1_long/results.jsonl)" = "$before" ] || fail "a known answer was computed again"
cut -d, -f1,4 corpus/results.csv | tail -n +2 >keys
printf 's1_long,%d\n' $(seq 12) >expected; printf 's2_contours,%d\n' 2 3 >>expected
cmp keys expected || fail "results.csv has other frames"
[ "$(wc -l <corpus/s1_long/results.jsonl)" -eq 12 ] && [ -s corpus/s1_long/frame00012.png ] &&
  [ -s corpus/s1_long/summary.png ] || fail "corpus/s1_long"
grep -q '"speaker":"S1"' corpus/s1_long/results.jsonl || fail "the speaker is not in the answers"
# Another run gives the same, whatever was killed.
expect 1 'refused' "$genio" corpus manifest.csv --out again --share 8 --json
"$source/tests/same_corpus.py" corpus/results.csv again/results.csv
# New rows are read, and the old ones are not computed again.
repeat 1 -0.2 >s1/short.csv
echo 's1/short.csv,,S1,' >>manifest.csv
cp corpus/s1_long/results.jsonl known
expect 1 '4 recordings, 1 refused; 15 frames' "$genio" corpus manifest.csv --out corpus --resume
cmp known corpus/s1_long/results.jsonl || fail "known answers changed"
# A changed option, and a changed recording, are noticed, by the run and by a task.
sed -i 's/^s1\/long.csv,,S1,$/s1\/long.csv,,S1,--noise-mm 1/' manifest.csv
expect 2 'was planned with noise_mm = 0.5, not 1' "$genio" corpus manifest.csv --out corpus --resume
sed -i 's/--noise-mm 1//' manifest.csv
repeat 12 0.1 >s1/long.csv
expect 2 'manifest.csv:2: s1_long was planned with target' "$genio" corpus manifest.csv --out corpus --resume
rm corpus/tasks/0000/s1_long/results.jsonl
expect 2 'whose content is not that of' "$genio" corpus --task 0 --out corpus
expect 1 'failed   task 0, s1_long' "$genio" corpus --merge --out corpus
rm -r corpus/s1_long
expect 1 '15 frames' "$genio" corpus manifest.csv --out corpus --resume
[ "$(cut -d, -f1,4 corpus/results.csv | sort | uniq -d)" = "" ] || fail "a frame is there twice"
expect 2 'holds a corpus already' "$genio" corpus manifest.csv --out corpus
echo "a corpus on this machine: as documented"
