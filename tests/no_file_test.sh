#!/usr/bin/env bash
# A device, a pipe, a folder or a file without line ends in the place of each input: one line, at
# once. no_file_test.sh GENIO SOURCE
set -u
genio=$1 source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkfifo pipe.csv
mkdir folder.csv
head -c 9000000 /dev/zero | tr '\0' 7 >line.csv
failed=0
target=$source/data/examples/example_shape.csv
# Each COMMAND with IT in the place of a file.
while read -r arguments; do
  for it in /dev/zero pipe.csv folder.csv nowhere.csv; do
    # shellcheck disable=SC2086
    timeout 60 "$genio" ${arguments//IT/$it} >out 2>err; got=$?
    if [ $got -ne 2 ] || [ "$(grep -c . err)" -ne 1 ] || ! grep -qF "$it" err; then
      echo "FAILED: ${arguments//IT/$it} -> $got, expected 2 and one line that names it"; cat err; failed=1
    fi
  done
done <<END
invert --target IT
invert --target IT --format csv
invert --target IT --format aaa
invert --target IT --format ssff --sensors 1=tip
invert --target $source/data/examples/recording/contours.tsv --palate IT
invert --target $target --prior IT
invert --target $target --textgrid IT
discover --observations IT --out o
forward --dynamic --commands IT
journal IT list
journal IT prune --delivered
END
for arguments in "invert --target line.csv" "invert --format aaa --target line.csv" \
                 "forward --dynamic --commands line.csv" "invert --target $target --prior line.csv"; do
  # shellcheck disable=SC2086
  (ulimit -v 2000000; timeout 60 "$genio" $arguments >out 2>err); got=$?
  [ $got -eq 2 ] && [ "$(grep -c . err)" -eq 1 ] && [ "$(wc -c <err)" -lt 1000 ] ||
    { echo "FAILED: $arguments -> $got"; head -c 2000 err; failed=1; }
done
exit $failed
