# Sourced by ./run and ./check: installs what is missing and builds.
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

# Processor time of a build from scratch [s]; measured, GCC 12.
program_s=400
everything_s=630

# build PRESET [TARGET...]: the targets, or everything.
build() {
  local preset=$1 what="the program, its tests and benchmarks" seconds=$everything_s
  shift
  [ $# -eq 0 ] || { what=$*; seconds=$program_s; }
  install_missing
  [ -f "build/$preset/build.ninja" ] || cmake --preset "$preset" >&2
  echo "building $what: about $(( (seconds / $(nproc) + 59) / 60 )) min on $(nproc) processors from" \
       "scratch, less where something is built already" >&2
  cmake --build "build/$preset" ${1:+--target "$@"} >&2
}
