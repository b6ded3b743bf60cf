#!/usr/bin/env bash
# Another project finds the installed package, with compiler flags of its own.
set -eu
build=$1 source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/genio" >"$work/log"
cmake -G Ninja -S "$source/tests/install" -B "$work/user" -DCMAKE_PREFIX_PATH="$work/genio" \
  -DCMAKE_BUILD_TYPE=Debug >>"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
cmake --build "$work/user" >>"$work/log" 2>&1 || { tail -30 "$work/log"; exit 1; }
"$work/user/user" "$work/genio/share/genio/generic/model.toml"
"$work/genio/bin/genio" info --json | grep -q nodes
# The pages are made where all is built, as it is where this test runs.
grep -q 'genio invert' "$work/genio/share/man/man1/genio.1"
PYTHONPATH="$work/genio/share/genio/python" python3 -B -c 'from genio_client import Client'
bash -n "$work/genio/share/bash-completion/completions/genio"
