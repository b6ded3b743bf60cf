#!/usr/bin/env bash
# The service over UDP multicast between two hosts (network namespaces) whose network loses 1 % and
# 5 % of the packets each way. Every request must end in a whole reply.
set -eu
genio=$1 source=$2 requests=${3:-20}
. "$(dirname "$0")/own_network.sh"
fail() { echo "FAILED: $*"; cat "$work/log" "$work/error" 2>/dev/null; exit 1; }
work=$(mktemp -d)
unshare --net sleep 600 & other=$!
server=
trap 'kill $server $other 2>/dev/null; wait 2>/dev/null || true; rm -rf "$work"' EXIT
until [ "$(readlink /proc/$other/ns/net)" != "$(readlink /proc/self/ns/net)" ]; do sleep 0.01; done
there=(nsenter "--net=/proc/$other/ns/net")
ip link add here type veth peer name there netns "$other"
ip addr add 10.0.0.1/24 dev here
"${there[@]}" ip addr add 10.0.0.2/24 dev there
ip link set here up
"${there[@]}" ip link set there up
ip route add 224.0.0.0/4 dev here
"${there[@]}" ip route add 224.0.0.0/4 dev there

# lose PERCENT DEVICE [WHERE...]: what arrives at the device is lost by chance. The program of the
# filter says: random number, modulo 100, at least PERCENT? take it (0), else drop it (2).
lose() {
  local percent=$1 device=$2
  shift 2
  "$@" tc qdisc del dev "$device" ingress 2>/dev/null || true
  "$@" tc qdisc add dev "$device" ingress &&
    "$@" tc filter add dev "$device" ingress bpf direct-action bytecode \
      "5,32 0 0 4294963256,148 0 0 100,53 1 0 $percent,6 0 0 2,6 0 0 0"
}
# lost DEVICE [WHERE...]: how many were.
lost() {
  local device=$1
  shift
  "$@" tc -s qdisc show dev "$device" ingress | sed -n 's/.*dropped \([0-9]*\).*/\1/p'
}
if ! lose 1 here 2>"$work/error"; then
  echo "SKIPPED: this machine's kernel has no filter of arriving packets: $(cat "$work/error")"
  exit 77
fi

url='udpm://239.255.76.67:7667?ttl=1'
"$genio" serve --lcm "$url" 2>"$work/log" & server=$!
"${there[@]}" "$genio" request status --lcm "$url" --timeout-s 60 >/dev/null
# As many frames as requests, each the shape of the example, sent one after another.
awk -F, -v frames="$requests" 'NR == 1 { header = $0; next } { shape[NR] = $0 } END {
  print header
  for (k = 1; k <= frames; ++k)
    for (n = 2; n <= NR; ++n) { sub(/^[0-9]+/, k, shape[n]); print shape[n] } }' \
  "$source/data/examples/example_shape.csv" >"$work/frames.csv"
ask() { "${there[@]}" "$genio" request --lcm "$url" --json "$@" 2>"$work/error"; }
for percent in 1 5; do
  lose "$percent" here
  lose "$percent" there "${there[@]}"
  ask --target "$work/frames.csv" --starts 1 --timeout-s 60 | {
    began=
    while read -r answer; do
      now=${EPOCHREALTIME/[.,]/}
      echo "$answer" >>"$work/answers$percent"
      [ -z "$began" ] || echo "$(((now - began) / 1000))" >>"$work/ms$percent"
      began=$now
    done
  }
  whole=$(grep -c '"status":"converged"' "$work/answers$percent" || true)
  [ "$whole" -eq "$requests" ] || fail "$whole of $requests requests were answered at $percent %"
  echo "$percent %: $whole of $requests answered, packets lost: $(lost here) and" \
    "$(lost there "${there[@]}"), usual and slowest ms: $(sort -n "$work/ms$percent" |
      awk '{ ms[NR] = $1 } END { print ms[int((NR + 1) / 2)], "and", ms[NR] }')"
done

# Twenty thousand points, 0.8 MB: whatever comes of it, the client is told.
awk -F, 'NR == 1 { print; next } { x[NR] = $3; z[NR] = $4 } END {
  for (k = 0; k < 20000; ++k) { at = 2 + k / 20000 * (NR - 2); n = int(at); r = at - n
    printf "1,%d,%.5f,%.5f,20,many points\n", k + 1, x[n] + r * (x[n + 1] - x[n]),
      z[n] + r * (z[n + 1] - z[n]) } }' "$source/data/examples/example_shape.csv" >"$work/many.csv"
ask --target "$work/many.csv" --deadline-s 5 --timeout-s 60 >"$work/answer" || true
grep -q '"status":' "$work/answer" || fail "the large request was not answered"
[ "$(lost here)" -gt 0 ] || fail "nothing was lost on the way to the server"
echo "the large request: $(lost here) packets lost, $(grep -o '"status":"[a-z]*"' "$work/answer")"
