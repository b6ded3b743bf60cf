# Sourced by tests of the command line, in a folder of theirs. `failed` is 1 after a failure. Where
# errors=one_line, also what the library of options complains of is held to one line.
failed=0
# expect STATUS WORD COMMAND...: exit status, and WORD somewhere in what it prints
expect() {
  local status=$1 word=$2; shift 2
  "$@" >out 2>err; local got=$?
  if [ $got -ne "$status" ] || ! grep -qF -- "$word" out err; then
    echo "FAILED: $* -> $got, expected $status and '$word'"; cat out err; failed=1
  fi
  # An error of ours is one line.
  if [ "$status" -eq 2 ] && { [ "${errors:-}" = one_line ] || grep -q '^genio:' err; } && [ "$(grep -c . err)" -ne 1 ]; then
    echo "FAILED: $* prints more than one line"; cat err; failed=1
  fi
}
