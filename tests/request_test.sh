#!/bin/bash
# What `genio request` gets from a server is what `genio invert` finds by itself: with a prior, of a
# recording with its palate, and where the server registers.
# usage: request_test.sh GENIO SOURCE
set -u
genio=$1
cd "$2/data/examples" || exit 1
folder=$(mktemp -d)
url=tcpq://127.0.0.1:$((20000 + RANDOM % 20000))
server=0
finish() {
  kill "$server" 2>/dev/null
  wait 2>/dev/null
  rm -rf "$folder"
}
trap finish EXIT
fail() {
  echo "FAILED: $*"
  cat "$folder"/*.err
  exit 1
}
"$genio" serve --lcm $url 2>"$folder/serve.err" &
server=$!

# both NAME OPTION...: asks both ways
both() {
  local name=$1
  shift
  "$genio" invert "$@" --json >"$folder/$name.invert" 2>"$folder/$name.err" ||
    fail "invert $*: $?"
  "$genio" request --lcm $url --timeout-s 300 "$@" --json >"$folder/$name.request" \
    2>>"$folder/$name.err" || fail "request $*: $?"
}
both beliefs --target example_shape.csv --prior prior/beliefs.toml
both emg --target example_shape.csv --prior prior/emg.csv
both palate --target recording/contours.tsv --palate recording/palate.tsv --frames 2
both alone --target recording/contours.tsv --frames 4 --starts 2
# The server registers each frame by itself: as a recording of one.
head -n 2 recording/contours.tsv >"$folder/one.tsv"
"$genio" invert --target "$folder/one.tsv" --palate recording/palate.tsv --facing right --json \
  >"$folder/there.invert" 2>"$folder/there.err" || fail "invert of one frame: $?"
"$genio" request --lcm $url --timeout-s 300 --target recording/contours.tsv --frames 1 \
  --palate recording/palate.tsv --unregistered --json --out "$folder/out" \
  >"$folder/there.request" 2>>"$folder/there.err" || fail "request of one frame: $?"
grep -q 'registered by the palate' "$folder/there.err" || fail "the registration is not told"
[ -s "$folder/out/frame00001.png" ] || fail "no picture"

python3 - "$folder" <<'CHECK' || fail "they differ"
import json, math, sys

def near(a, b, tolerance, what):
    assert abs(a - b) <= tolerance, (what, a, b)

for name in ("beliefs", "emg", "palate", "alone", "there"):
    own, got = (json.load(open(f"{sys.argv[1]}/{name}.{kind}")) for kind in ("invert", "request"))
    for key in ("status", "verdict", "frame", "label"):
        assert own[key] == got[key], (name, key, own[key], got[key])
    assert own["forces_N"].keys() == got["forces_N"].keys()
    for muscle, most in own["max_force_N"].items():
        near(own["forces_N"][muscle], got["forces_N"][muscle], 1e-4 * most, (name, muscle))
        for k in (0, 1):
            near(own["interval90_N"][muscle][k], got["interval90_N"][muscle][k], 2e-3 * most,
                 (name, muscle, "interval"))
    assert own["estimated"].keys() == got["estimated"].keys(), (name, got["estimated"])
    for key, value in own["estimated"].items():
        other = got["estimated"][key]
        assert value["unit"] == other["unit"], (name, key)
        near(value["value"], other["value"], 0.02 * value["sd"], (name, key))
    near(own["rms_mm"], got["rms_mm"], 1e-3, (name, "rms"))
    ours, theirs = own["registration"], got["registration"]
    assert ours.keys() == theirs.keys(), name
    for key in ("scale", "tilt_deg", "by", "doubtful", "forced"):
        same = ours[key] == theirs[key] or math.isclose(ours[key], theirs[key], rel_tol=1e-6)
        assert same, (name, key, ours[key], theirs[key])
assert json.load(open(f"{sys.argv[1]}/beliefs.request"))["forces_N"]["MH"] == 0
print("5 shapes, the same answers")
CHECK

# What is wrong is told before anything is sent, or by the server.
expect() {
  local word=$1
  shift
  "$genio" request --lcm $url --timeout-s 60 "$@" >"$folder/out.txt" 2>"$folder/expect.err"
  local status=$?
  [ $status -ne 0 ] && grep -qF -- "$word" "$folder/out.txt" "$folder/expect.err" ||
    fail "request $*: $status without '$word'"
}
printf 'effort = 1\n' >"$folder/wrong.toml"
expect 'wrong.toml:1: unknown key' --target example_shape.csv --prior "$folder/wrong.toml"
printf '[fixed_N]\nMX = 1\n' >"$folder/wrong.toml"
expect 'prior: fixed MX: no such muscle' --target example_shape.csv --prior "$folder/wrong.toml"
expect "in the model's frame already" --target example_shape.csv --unregistered
expect 'not together with --registered' --target recording/contours.tsv --unregistered --registered
expect 'cannot be laid beside the model' --target recording/contours.tsv --frames 1 \
  --palate recording/palate.tsv --facing left --unregistered
echo "5 faults, told"
