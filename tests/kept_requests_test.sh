#!/bin/bash
# A server that is killed in the middle of its work, and started again, owes nobody a reply.
# usage: kept_requests_test.sh GENIO SOURCE
set -u
genio=$1
cd "$2" || exit 1
folder=$(mktemp -d)
port=$((20000 + RANDOM % 20000))
url=tcpq://127.0.0.1:$port
server=0
clients=()
start() {
  "$genio" serve --lcm $url --journal "$folder/journal" >>"$folder/serve.log" 2>&1 &
  server=$!
}
finish() {
  kill "$server" "${clients[@]}" 2>/dev/null
  wait 2>/dev/null
  rm -rf "$folder"
}
trap finish EXIT
fail() {
  echo "FAILED: $*"
  cat "$folder"/serve.log "$folder"/*.err
  exit 1
}

start
for k in 1 2 3; do
  "$genio" request --lcm $url --target data/examples/word/contours.csv --timeout-s 300 \
    --starts 4 --json >"$folder/$k.json" 2>"$folder/$k.err" &
  clients+=($!)
done
for life in 1 2 3; do
  sleep $((2 + life))
  kill -9 $server
  wait $server 2>/dev/null
  start
done
for k in 0 1 2; do
  wait "${clients[$k]}" || fail "client $((k + 1)) ended with $?"
done
for k in 1 2 3; do
  [ "$(grep -c '"status":"converged"' "$folder/$k.json")" = 5 ] || fail "client $k lacks replies"
done
[ "$(grep -c converged "$folder/serve.log")" -ge 15 ] || fail "fewer answers than requests"
python3 - "$folder" <<'CHECK' || fail "two clients, two answers"
import json, sys
answers = [[json.loads(line)["activation"] for line in open(f"{sys.argv[1]}/{k}.json")]
           for k in (1, 2, 3)]
for other in answers[1:]:
    for a, b in zip(answers[0], other, strict=True):
        assert a.keys() == b.keys() and all(abs(a[m] - b[m]) < 1e-3 for m in a), (a, b)
CHECK
kill $server
wait $server || fail "the server ended with $? after SIGTERM"
counts=$("$genio" journal "$folder/journal" list 2>&1) || fail "$counts"
[ "$(echo "$counts" | grep -c delivered)" -ge 15 ] || fail "not all replies count as delivered: $counts"
echo "15 requests, 3 kills, 15 replies"
