#!/usr/bin/env bash
# The unit that is installed is one that systemd understands, and that gives little away.
# systemd_unit_test.sh BUILD GENIO. Skips (77) where systemd-analyze is missing.
set -eu
build=$1 genio=$2
command -v systemd-analyze >/dev/null || { echo "skipped: there is no systemd-analyze"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
fail() { echo "FAILED: $*"; failed=1; }
for prefix in "$work/usr" "$work/50%n"; do
  mkdir -p "$prefix/bin"
  cp "$genio" "$prefix/bin/genio"
  cmake --install "$build" --prefix "$prefix" --component unit >"$work/log" || { cat "$work/log"; exit 1; }
  unit=$prefix/lib/systemd/system/genio.service
  said=$(systemd-analyze verify --man=no "$unit" 2>&1) || fail "$unit is refused: $said"
  [ -z "$said" ] || fail "$unit: $said"
done
# It would be found if it were there: the check can fail.
rm "$work/usr/bin/genio"
! systemd-analyze verify --man=no "$work/usr/lib/systemd/system/genio.service" 2>/dev/null ||
  fail "a program that is missing is not noticed"
# Where units are packed, they name the place at which they will stand.
DESTDIR=$work/packed cmake --install "$build" --prefix /usr --component unit >/dev/null
grep -q '^ExecStart=/usr/bin/genio serve ' "$work/packed/usr/lib/systemd/system/genio.service" ||
  fail "DESTDIR is in the unit"
# In tenths: 15 of 100 is 1.5 of 10.
systemd-analyze security --offline=true --threshold=15 --no-pager \
  "$work/packed/usr/lib/systemd/system/genio.service" >"$work/security" ||
  { fail "exposed more than 1.5 of 10"; cat "$work/security"; }
tail -1 "$work/security"
exit $failed
