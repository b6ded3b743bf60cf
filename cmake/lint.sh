#!/usr/bin/env bash
# Layout by clang-format and faults by clang-tidy; fails where either has something to say.
#   cmake/lint.sh         files changed against the upstream branch (without one, against the commit
#                         before the last): each by itself, all checks of .clang-tidy
#   cmake/lint.sh --all   the whole tree (also where CI=true): a folder at a time, so that headers are
#                         read once for all its files, and of the checks those that are quick.
# All checks on the whole tree would take too long; the quick ones take some ten minutes.
set -eu
cd "$(dirname "$0")/.."

quick='-*,bugprone-argument-comment,bugprone-copy-constructor-init,bugprone-dangling-handle,
  bugprone-fold-init-type,bugprone-inaccurate-erase,bugprone-infinite-loop,
  bugprone-integer-division,bugprone-move-forwarding-reference,bugprone-parent-virtual-call,
  bugprone-string-constructor,bugprone-unused-raii,bugprone-unused-return-value,
  bugprone-use-after-move,performance-for-range-copy,
  performance-move-const-arg,performance-unnecessary-copy-initialization,
  performance-unnecessary-value-param,modernize-use-override,readability-container-size-empty'

all_files() {
  git ls-files --cached --others --exclude-standard '*.cpp' '*.hpp' 2>/dev/null ||
    find . -path ./build -prune -o -name '*.[ch]pp' -print  # of a tree without its history
}

changed_files() {
  local base
  base=$(git merge-base HEAD '@{upstream}' 2>/dev/null) ||
    base=$(git rev-parse --verify --quiet HEAD~1) || { all_files; return; }
  { git diff --name-only --diff-filter=d "$base" -- '*.cpp' '*.hpp'
    git ls-files --others --exclude-standard '*.cpp' '*.hpp'; } | sort -u
}

# Compile commands without precompiled headers, which clang cannot read, in build/$1.
configure() {
  cmake -S . -B "build/$1" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD="$2" \
        -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON >/dev/null
  cmake --build "build/$1" --target genio_messages_generated >/dev/null
}

# The sources of build/$1 among those named on standard input, or all of them.
commanded() {
  python3 -c 'import json, os, sys
wanted = {os.path.abspath(line.strip()) for line in sys.stdin}
files = {c["file"] for c in json.load(open(sys.argv[1] + "/compile_commands.json"))}
chosen = files & wanted if wanted else files
print("\n".join(sorted(f for f in chosen if not os.path.basename(f).startswith("pch"))))' "build/$1"
}

# tidy BUILD [--checks=...]: over the files on standard input.
tidy() {
  local build=build/$1; shift
  xargs -r -P "$(nproc)" -n 1 clang-tidy -p "$build" --quiet --warnings-as-errors='*' \
        --extra-arg=-Wno-unknown-warning-option --extra-arg=-Wno-unused-command-line-argument "$@" 2> >(grep -v 'warnings\? generated' >&2)
}

if [ "${1:-}" = --all ] || [ "${CI:-}" = true ]; then
  files=$(all_files)
else
  files=$(changed_files)
fi
[ -n "$files" ] || exit 0

xargs clang-format --dry-run --Werror <<<"$files" ||
  { echo "mend the layout: clang-format -i on the files above" >&2; exit 1; }

if [ "${1:-}" = --all ] || [ "${CI:-}" = true ]; then
  configure lint ON
  commanded lint </dev/null | tidy lint --checks="$(tr -d ' \n' <<<"$quick")"
else
  configure lint-files OFF
  # A header is read with the source of its name.
  sed 's/\.hpp$/.cpp/' <<<"$files" | sort -u | commanded lint-files | tidy lint-files
fi
