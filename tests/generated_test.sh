#!/usr/bin/env bash
# The shipped generic tongue is what its generator makes, to rounding of the last digit.
set -eu
generator=$1 source=$2
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
"$generator" "$made"
for file in mesh.vtu fibres.vtp palate.obj jaw.obj hyoid.obj model.toml; do
  awk -v file="$file" 'NR == FNR { a[FNR] = $0; n = FNR; next }
    { split(a[FNR], p); m = split($0, q)
      for (i = 1; i <= m; i++)
        if (p[i] != q[i] && (p[i] - q[i] > 2e-6 || q[i] - p[i] > 2e-6 || p[i] + 0 == 0)) {
          print file ":" FNR ": " a[FNR] " | " $0; exit 1 } }
    END { if (n != FNR) { print file ": " n " and " FNR " lines"; exit 1 } }' \
    "$source/data/generic/$file" "$made/$file"
done
