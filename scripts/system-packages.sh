#!/bin/sh
# Installs the Debian packages that pyrod needs and this machine lacks: to be built, and to draw with
# VTK where there is no display. With the argument "test" also the browser in which the tests open
# pages. (They go without, where there is none.)
# Each need is checked by itself, so that anything provided otherwise is left alone.
set -eu

python=${PYTHON:-python3}

program() { command -v "$1"; }

module() { "$python" -c "import $1"; }

python_header() {
  test -e "$("$python" -c 'import sysconfig; print(sysconfig.get_path("include"))')/Python.h"
}

header() { # looks where CMake would look
  (
    name=$1
    set --
    IFS=:
    for prefix in /usr /usr/local ${Eigen3_ROOT:-} ${CHOLMOD_ROOT:-} ${CMAKE_PREFIX_PATH:-}; do
      set -- "$@" "-I$prefix/include" "-I$prefix/include/eigen3" "-I$prefix/include/suitesparse"
    done
    echo "#include <$name>" | "${CXX:-c++}" "$@" -x c++ -E -
  )
}

library() { /sbin/ldconfig -p | grep -q "$1"; }

mesa_driver() { ls /usr/lib/*/dri/swrast_dri.so /usr/lib/*/libgallium-*.so | grep -q so; }

missing=
need() { # need PACKAGE CHECK...
  package=$1
  shift
  "$@" >/dev/null 2>&1 || missing="$missing $package"
}

check() {
  missing=
  need g++ program "${CXX:-c++}"
  need cmake program cmake
  need ninja-build program ninja
  need python3 program "$python"
  need python3-venv module ensurepip
  need python3-dev python_header
  need libeigen3-dev header Eigen/Core
  need libsuitesparse-dev header cholmod.h
  need doctest-dev header doctest/doctest.h
  need libegl1 library libEGL.so.1
  need libgl1-mesa-dri mesa_driver
  if [ "${1:-}" = test ] && grep -qs '^ID=debian' /etc/os-release; then # Ubuntu's is a snap
    need chromium program chromium
    need chromium-driver program chromedriver
  fi
}

give_up() {
  echo "pyrod needs these Debian packages, or their likes:$missing" >&2
  echo "$1" >&2
  exit 1
}

check "$@"
test -n "$missing" || exit 0

command -v apt-get >/dev/null || give_up "There is no apt-get here: please install them your way."
if [ "$(id -u)" = 0 ]; then
  root=
elif command -v sudo >/dev/null; then
  root=sudo
else
  give_up "Please run as root: apt-get install$missing"
fi

echo "Installing system packages:$missing"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt() { $root env DEBIAN_FRONTEND=noninteractive apt-get -q -y "$@" >"$log" 2>&1; }
apt update || cat "$log" >&2 # the lists at hand may do
# shellcheck disable=SC2086 # one word per package
apt install --no-install-recommends $missing || { cat "$log" >&2; give_up "apt-get failed."; }

check "$@"
test -z "$missing" || give_up "They are installed now, but are still not found."
