#!/usr/bin/env bash
# The service over LCM's UDP multicast, in a network namespace of its own.
set -eu
genio=$1 source=$2
. "$(dirname "$0")/own_network.sh"
ip link set lo up multicast on
ip route add 224.0.0.0/4 dev lo
url='udpm://239.255.76.67:7667?ttl=0'
work=$(mktemp -d)
"$genio" serve --lcm "$url" 2>"$work/log" & server=$!
trap 'kill $server 2>/dev/null; wait $server 2>/dev/null || true; rm -rf "$work"' EXIT
"$genio" request status --lcm "$url" --timeout-s 30 >/dev/null
"$genio" request --lcm "$url" --target "$source/data/examples/example_shape.csv" --timeout-s 120 \
  --json 2>/dev/null >"$work/answer"
grep -q '"status":"converged"' "$work/answer" || { cat "$work/answer" "$work/log"; exit 1; }
