#!/usr/bin/env bash
# Key files as a user meets them, and a server that asks for one.
# usage: key_test.sh GENIO SOURCE
set -u
genio=$1 example=$2/data/examples/example_shape.csv
tests=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
cd "$work" || exit 1
url=tcpq://127.0.0.1:$((20000 + RANDOM % 20000))
server=0
finish() {
  [ $server -eq 0 ] || kill $server 2>/dev/null
  wait 2>/dev/null
  rm -rf "$work"
}
trap finish EXIT
errors=one_line
. "$tests/expect.sh"
(umask 0; "$genio" key lab.key 2>/dev/null) || { echo "FAILED: genio key"; failed=1; }
[ "$(stat -c %a lab.key)" = 600 ] || { echo "FAILED: lab.key has mode $(stat -c %a lab.key)"; failed=1; }
grep -qE '^[0-9a-f]{64}$' lab.key && [ "$(wc -l <lab.key)" -eq 1 ] || { echo "FAILED: lab.key"; failed=1; }
expect 2 'is there already' "$genio" key lab.key
expect 2 'cannot be made' "$genio" key nowhere/lab.key
expect 2 'file is required' "$genio" key
cp lab.key open.key && chmod 640 open.key
head -c 40 lab.key >short.key; { cat lab.key; echo 00; } >long.key; tr 'a-f0-9' x <lab.key >words.key
chmod 600 short.key long.key words.key
for command in "serve --lcm $url" "request --lcm $url --target $example" \
               "request status --lcm $url" "request cancel x-1 --lcm $url"; do
  expect 2 'open.key: its mode 0640 lets others' "$genio" $command --key open.key
  expect 2 'short.key: is no key; expected one line of 64' "$genio" $command --key short.key
  expect 2 'words.key: is no key' "$genio" $command --key words.key
  expect 2 'long.key: is too long' "$genio" $command --key long.key
  expect 2 'nowhere.key: cannot be read' "$genio" $command --key nowhere.key
done
"$genio" serve --lcm $url --key lab.key --journal journal 2>log & server=$!
expect 0 '"version"' "$genio" request status --lcm $url --key lab.key --timeout-s 60
expect 0 '"status":"converged"' "$genio" request --lcm $url --key lab.key --target "$example" --json
expect 1 'use --key' "$genio" request --lcm $url --target "$example"
expect 1 '--key is needed' "$genio" request status --lcm $url --timeout-s 3
expect 1 'refused' "$genio" request cancel x-1 --lcm $url --key lab.key
"$genio" key other.key 2>/dev/null
expect 1 'another key' "$genio" request --lcm $url --key other.key --target "$example" --timeout-s 3
expect 1 'another key' "$genio" request status --lcm $url --key other.key --timeout-s 3
expect 0 '"dropped"' "$genio" request status --lcm $url --key lab.key --timeout-s 60 --json
grep -qE '"unsigned":[1-9]' out && grep -qE '"forged":[1-9]' out ||
  { echo "FAILED: drops are not counted"; cat out; failed=1; }
[ "$(stat -c %a journal)" = 600 ] || { echo "FAILED: journal has mode $(stat -c %a journal)"; failed=1; }
kill $server; wait $server || { echo "FAILED: the server ended with $?"; cat log; failed=1; }
server=0
exit $failed
