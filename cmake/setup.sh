# Sourced by ./run and ./check: installs what is missing and builds the preset named in $1.
set -eu
cd "$(dirname "${BASH_SOURCE[0]}")/.."

install_missing() {
  local missing=() package
  while read -r package; do
    case $package in '#'*|'') continue ;; esac
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
  done < cmake/packages.txt
  [ ${#missing[@]} -eq 0 ] && return
  local sudo=
  [ "$(id -u)" -eq 0 ] || sudo=sudo
  echo "installing: ${missing[*]}" >&2
  $sudo apt-get update -qq
  DEBIAN_FRONTEND=noninteractive $sudo apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

build() {
  local preset=$1; shift
  install_missing
  [ -f "build/$preset/build.ninja" ] || cmake --preset "$preset" "$@" >&2
  cmake --build "build/$preset" >&2
}
