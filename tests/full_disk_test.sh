#!/usr/bin/env bash
# Where nothing can be written: one line and an exit status, and nothing that a later --resume trusts.
# full_disk_test.sh GENIO SOURCE. Skips (77) where it may not mount.
set -u
if [ "${GENIO_MOUNTS:-}" != mine ]; then
  for how in "unshare -m" "unshare -rm"; do
    $how mount -t tmpfs none /mnt 2>/dev/null && GENIO_MOUNTS=mine exec $how bash "$0" "$@"
  done
  echo "skipped: mounting is not allowed here"; exit 77
fi
genio=$1 source=$2
work=$(mktemp -d)
mkdir "$work/disk"
mount -t tmpfs none "$work/disk" -o size=1m
trap 'umount "$work/disk"; rm -rf "$work"' EXIT
cd "$work"
failed=0
fail() { echo "FAILED: $*"; cat out err; failed=1; }
# refused WORD COMMAND...: exit status 2, and one line on standard error, with WORD in it
refused() {
  local word=$1; shift
  "$@" >out 2>err; local got=$?
  [ $got -eq 2 ] && [ "$(grep -c . err)" -eq 1 ] && grep -qF -- "$word" err ||
    fail "$* -> $got, expected 2 and one line with '$word'"
}
answers() { python3 -c 'import json, sys
for line in open(sys.argv[1]): a = json.loads(line); print(a["frame"], a["verdict"], a["forces_N"])' "$1"; }
disk() { rm -rf disk/*; mount -o "remount,size=$1" "$work/disk"; }

target=$source/data/examples/example_shape.csv
"$genio" invert --target "$target" --out whole --quiet >out 2>err || fail "no answer at all"
full='No space left on device'

# The disk is full after one file, and in the midst of each of the others.
for size in 4k 16k 32k 64k 160k 176k 200k; do
  disk $size
  refused 'cannot be written' "$genio" invert --target "$target" --out disk/run --quiet
  [ -z "$(find disk -name '*.new')" ] || fail "half a file is left at $size"
  for picture in disk/run/*.png; do
    [ ! -e "$picture" ] || cmp -s "$picture" "whole/${picture##*/}" || fail "$picture is cut off"
  done
done
# What is left is taken up and gives the answers of a run that was never disturbed.
mount -o remount,size=4m "$work/disk"
"$genio" invert --target "$target" --out disk/run --quiet --resume >out 2>err || fail "resume"
[ "$(answers disk/run/results.jsonl)" = "$(answers whole/results.jsonl)" ] || fail "other answers"
for file in whole/*; do [ -s "disk/run/${file##*/}" ] || fail "${file##*/} is missing"; done

# A last line that was cut off is no answer.
truncate -s -40 disk/run/results.jsonl
"$genio" invert --target "$target" --out disk/run --quiet --resume >out 2>err || fail "resume"
[ "$(answers disk/run/results.jsonl)" = "$(answers whole/results.jsonl)" ] || fail "half an answer"

disk 4k
refused "$full" "$genio" forward --force GGP=2 --out disk/shape
refused 'cannot be written' "$genio" forward --dynamic --force GGP=2 --duration 0.01 --out disk/motion
disk 1m
mount -o remount,ro "$work/disk"
refused 'Read-only file system' "$genio" forward --force GGP=2 --out disk/shape
refused 'Read-only file system' "$genio" invert --target "$target" --out disk/run --quiet
mount -o remount,rw "$work/disk"
: >file
refused 'file' "$genio" forward --force GGP=2 --out file

# Standard output may be full too, however little is printed.
for arguments in "info" "info --json" "forward --force GGP=2" "forward --force GGP=2 --json" \
                 "formats" "formats --json" "--help" "--version" "completion bash" \
                 "invert --quiet --target $target" "invert --quiet --json --target $target"; do
  # shellcheck disable=SC2086
  "$genio" $arguments >/dev/full 2>err; got=$?
  [ $got -eq 2 ] && grep -qF "standard output: cannot be written" err && [ "$(grep -c . err)" -le 2 ] ||
    { : >out; fail "$arguments >/dev/full -> $got"; }
done
exit $failed
