#!/usr/bin/env bash
# cmake/lint.sh refuses a file that is laid out otherwise, and says which; it passes where nothing
# changed. Usage: lint_test.sh SOURCE_DIR
set -eu
source=$1
command -v clang-format >/dev/null || exit 77
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
mkdir "$work/cmake"
cp "$source/cmake/lint.sh" "$work/cmake"
cp "$source/.clang-format" "$source/.clang-tidy" "$work"
cd "$work"
fail() { echo "$1" >&2; cat out >&2; exit 1; }

git init -q .
git config user.name t && git config user.email t@t
git add -A && git commit -qm first
git commit -qm second --allow-empty
CI= cmake/lint.sh >out 2>&1 || fail "nothing changed, and yet it was refused"

echo 'int  f( ){return 1 ;}' >wrong.cpp
if CI= cmake/lint.sh >out 2>&1; then fail "a file laid out otherwise was passed"; fi
grep -q 'wrong.cpp' out || fail "the file is not named"
grep -q 'mend the layout' out || fail "it is not said how to mend it"
