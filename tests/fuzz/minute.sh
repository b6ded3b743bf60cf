#!/usr/bin/env bash
# Fuzzes for a minute what reads bytes from the network, beginning with the kept corpus:
# tests/fuzz/minute.sh [SECONDS]. Fails where something is found, and says where it stands.
set -eu
cd "$(dirname "$0")/../.."
seconds=${1:-60}
build=build/fuzz bin=$PWD/build/fuzz/tests/fuzz
[ -f $build/build.ninja ] || cmake --preset fuzz >/dev/null
cmake --build $build --target genio-fuzz-network genio-fuzz-network-seeds >$build/network.log ||
  { cat $build/network.log >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$bin/genio-fuzz-network-seeds" "$work/seeds"
export ASAN_OPTIONS=quarantine_size_mb=16:detect_leaks=0:allocator_may_return_null=0
readers=($(cd "$work/seeds" && ls -d -- */ | tr -d /))
each=$(( (seconds + ${#readers[@]} - 1) / ${#readers[@]} ))  # none would be no limit
failed=
for reader in "${readers[@]}"; do
  found=$build/fuzz-found/$reader
  mkdir -p "$found" "$work/new/$reader"
  folders=("$work/new/$reader" "$work/seeds/$reader")
  [ ! -d "tests/fuzz/corpus/$reader" ] || folders+=("tests/fuzz/corpus/$reader")
  # A machine that others use too may be slow; a hang lasts longer.
  if GENIO_FUZZ_READER=$reader "$bin/genio-fuzz-network" -timeout=60 -rss_limit_mb=1024 \
       -malloc_limit_mb=512 -max_len=4096 -max_total_time=$((each > 0 ? each : 1)) \
       -artifact_prefix="$found/" -dict="$work/seeds/$reader.dict" -print_final_stats=1 \
       "${folders[@]}" >"$work/log" 2>&1; then
    echo "fuzzed $reader: $(sed -n 's/^stat::number_of_executed_units: *//p' "$work/log") executions, nothing found"
  else
    failed="$failed $reader"
    grep -E 'ERROR|Test unit written|what\(\)' "$work/log" >&2 || tail -20 "$work/log" >&2
  fi
done
[ -z "$failed" ] || { echo "the fuzzer found something in:$failed" >&2; exit 1; }
