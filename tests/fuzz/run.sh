#!/usr/bin/env bash
# Fuzzes the readers and prints a table: tests/fuzz/run.sh BUILD [EXECUTIONS [READER...]]
# BUILD is that of the preset fuzz (cmake --preset fuzz && cmake --build --preset fuzz). What is
# found stands in BUILD/fuzz-found/READER; inputs that reach more code are kept in BUILD/fuzz-corpus.
# KEEP=1 writes the smallest set of them that reaches the same code into tests/fuzz/corpus.
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
build=$(cd "$1" && pwd) executions=${2:-1000000}
shift; [ $# -eq 0 ] || shift
bin=$build/tests/fuzz
"$bin/genio-fuzz-seeds" "$build/fuzz-seeds"
readers=("$@")
[ $# -gt 0 ] || readers=($(cd "$build/fuzz-seeds" && ls -d -- */ | tr -d /))
# The quarantine of freed memory would count as memory that a reader takes.
export ASAN_OPTIONS=quarantine_size_mb=16:detect_leaks=0:allocator_may_return_null=0
limits=(-timeout=5 -rss_limit_mb=1024 -malloc_limit_mb=512 -max_len=4096)

echo "| Reader | Executions | Code reached | Findings |"
echo "|---|---|---|---|"
for reader in "${readers[@]}"; do
  export GENIO_FUZZ_READER=$reader
  found=$build/fuzz-found/$reader corpus=$build/fuzz-corpus/$reader kept=$source/tests/fuzz/corpus/$reader
  mkdir -p "$found" "$corpus"
  seeds=("$build/fuzz-seeds/$reader")
  [ ! -d "$kept" ] || seeds+=("$kept")
  log=$found/log
  "$bin/genio-fuzz" "${limits[@]}" -runs="$executions" -dict="$build/fuzz-seeds/$reader.dict" \
    -artifact_prefix="$found/" -print_final_stats=1 "$corpus" "${seeds[@]}" >"$log" 2>&1 || true
  count=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  cover=$(grep -o 'cov: [0-9]*' "$log" | tail -1 | cut -d' ' -f2)
  echo "| $reader | ${count:-?} | ${cover:-?} | $(find "$found" -type f ! -name log | wc -l) |"
  if [ -n "${KEEP:-}" ]; then
    mkdir -p "$kept" "$build/fuzz-least/$reader"
    "$bin/genio-fuzz" "${limits[@]}" -merge=1 -use_counters=0 "$build/fuzz-least/$reader" "${seeds[@]}" "$corpus" >/dev/null 2>&1 || true
    cp -n "$build/fuzz-least/$reader"/* "$kept/" 2>/dev/null || true
  fi
done
