#!/usr/bin/env bash
# Every command of the README works as printed. Usage: readme_test.sh GENIO SOURCE_DIR
# Commands are the lines of code blocks that start with `genio`; one that ends in \ goes on in the
# next line. They run in a copy of the folder
# that the README names, one after another; one that ends in & runs until the others are done.
set -u
genio=$1 source=$2
work=$(mktemp -d)
mkdir "$work/bin"
ln -s "$genio" "$work/bin/genio"
ln -s "$source/data" "$work/data"
export PATH=$work/bin:$PATH
export LCM_DEFAULT_URL=tcpq://127.0.0.1:$((20000 + $$ % 20000))  # of no other test
trap 'kill $(jobs -p) 2>/dev/null; wait 2>/dev/null; rm -rf "$work"' EXIT
cd "$work"
failed=0 count=0
while read -r line; do
  count=$((count + 1))
  if [ "${line% &}" != "$line" ]; then
    ${line% &} >>server.log 2>&1 &
    genio request status --timeout-s 20 >/dev/null 2>&1
    continue
  fi
  $line >log 2>&1 </dev/null || { echo "FAILED with status $?: $line"; tail -20 log; failed=1; }
done < <(awk '/^```/ { code = !code }
  code && (held != "" || /^genio /) {
    command = held $0
    held = sub(/\\$/, "", command) ? command : ""
    if (held == "") print command
  }' "$source/README.md")
for file in shape/frame00001.png recording/summary.png smooth/summary.csv moving/commands.csv corpus/results.csv \
            forward/shape.vtu motion/motion.pvd found/discovery.html found/model/model.toml; do
  [ -s "out/$file" ] || { echo "FAILED: no out/$file"; failed=1; }
done
grep -q '"name": "airway_pressure"' out/found/discovery.json || { echo "FAILED: airway_pressure is not named"; failed=1; }
[ $count -ge 12 ] || { echo "FAILED: $count commands in the README; expected at least 12"; failed=1; }
exit $failed
