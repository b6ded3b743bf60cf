#!/usr/bin/env bash
# A corpus as a job array on a Slurm of one node: the same results as here, whatever is killed.
set -eu
genio=$1 source=$2
if [ -z "${SLURM_CONF:-}" ]; then
  exec "$source/tests/one_node_slurm.sh" 2 "$0" "$@"
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "FAILED: $*"; tail -n 20 "$work"/cluster*/slurm/*.log 2>/dev/null; exit 1; }
ended() {  # until no job is left, requeued ones included
  while [ -n "$(squeue --noheader)" ]; do sleep 0.3; done
}
awk -F, -v OFS=, 'NR==1 {print; next} {r[NR] = $0}
  END {for (f = 1; f <= 12; ++f) for (k = 2; k <= NR; ++k) {split(r[k], c, ",");
       print f, c[2], c[3], c[4] + 0.05 * f, c[5], c[6]}}' "$source/data/examples/example_shape.csv" >long.csv
cp "$source"/data/examples/recording/*.tsv .
printf 'recording,palate,speaker\nlong.csv,,S1\ncontours.tsv,palate.tsv,S2\n' >manifest.csv
"$genio" corpus manifest.csv --out here --share 8 --threads 2 --quiet >/dev/null
# The folder's name has what shells and Slurm take apart.
"$genio" corpus manifest.csv --out "cluster 1%a" --share 8 --slurm --at-once 2 --sbatch-option=--time=10 --json >submitted
grep -q '"tasks":\[0,1\]' submitted || { cat submitted; fail "not all tasks were submitted"; }
array=$(sed 's/.*"array_job":"\([0-9]*\)".*/\1/' submitted)
grep -qx '#SBATCH --array=0-1%2' "cluster 1%a/slurm/tasks.sh" || fail "the array is another"
# One task is killed from outside once it has given an answer, and one is put back by Slurm.
while [ -n "$(squeue --noheader)" ] && [ ! -s "cluster 1%a/tasks/0000/long/results.jsonl" ]; do sleep 0.05; done
for pid in $(pgrep -x genio); do  # in this test's own namespace of processes
  tr '\0' ' ' <"/proc/$pid/cmdline" | grep -q -- '--task 0 ' && kill -9 "$pid"
done
scontrol requeue "${array}_1" || fail "task 1 does not run any more"
ended
grep -q 'Killed' "cluster 1%a/slurm/task_0.log" || fail "task 0 was not killed"
[ "$(grep -c . "cluster 1%a/tasks/0000/time.jsonl")" -eq 1 ] || fail "task 0 came to its end more than once"
[ -s "cluster 1%a/results.csv" ] || fail "nothing was merged"
"$source/tests/same_corpus.py" here/results.csv "cluster 1%a/results.csv" || fail "other results"
grep -q '"failed": \[\]' "cluster 1%a/corpus.json" || fail "a task counts as failed"
# What is missing, and no more, is submitted again.
rm "cluster 1%a/tasks/0001/"*/results.jsonl
"$genio" corpus manifest.csv --out "cluster 1%a" --resume --slurm --json --quiet >submitted
grep -q '"tasks":\[1\]' submitted || { cat submitted; fail "other tasks were submitted again"; }
ended
"$source/tests/same_corpus.py" here/results.csv "cluster 1%a/results.csv" || fail "other results after --resume"
# What sbatch refuses is said, and the options that are the corpus's own.
refused() {
  if "$genio" corpus manifest.csv --out cluster2 --slurm "$@" >out 2>err; then fail "$* was accepted"; fi
  rm -rf cluster2
}
refused --sbatch-option=--partition=none
grep -q 'Invalid partition' err || { cat err; fail "what sbatch said is lost"; }
refused --sbatch-option=--array=1
grep -q "is the corpus's own" err || { cat err; fail "--array was not refused"; }
echo "a corpus as a job array: the same as here"
