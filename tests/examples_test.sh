#!/usr/bin/env bash
# The shipped examples are what their generator makes, to rounding of the last digit.
# Usage: examples_test.sh GENERATOR SOURCE_DIR
set -eu
generator=$1 source=$2
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
"$generator" "$source/data/generic" "$made"
cd "$source/data/examples"
# What `genio indent` simulates has a test of its own.
files() { find "$1" -type f ! -name README.md ! -path '*/indentation/*' -printf '%P\n' | sort; }
diff <(files .) <(files "$made")
for file in $(files .); do
  awk -F'[,\t ]' -v file="$file" '
    function is_number(s) { return s ~ /^-?[0-9]+(\.[0-9]+)?$/ }
    NR == FNR { a[FNR] = $0; n = FNR; next }
    { split(a[FNR], p); m = split($0, q)
      for (i = 1; i <= m; i++) {
        if (p[i] == q[i]) continue
        if (is_number(p[i]) && is_number(q[i]) && (p[i] - q[i]) ^ 2 < 0.0101 ^ 2) continue
        print file ":" FNR ": " a[FNR] " | " $0; exit 1 } }
    END { if (n != FNR) { print file ": " n " and " FNR " lines"; exit 1 } }' \
    "$file" "$made/$file"
done
