# Sourced first by tests that need a network of their own, with the test's arguments: goes on in a
# network namespace of its own, or skips the test.
if [ "${GENIO_IN_NAMESPACE:-}" != yes ]; then
  enter=(unshare --net)
  [ "$(id -u)" -eq 0 ] || enter=(unshare --user --map-root-user --net)
  if ! "${enter[@]}" true 2>/dev/null; then
    echo "SKIPPED: this machine does not let us make a network namespace"
    exit 77
  fi
  GENIO_IN_NAMESPACE=yes exec "${enter[@]}" "$0" "$@"
fi
