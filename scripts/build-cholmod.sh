#!/bin/sh
# Builds the CHOLMOD that wheels bundle: scripts/build-cholmod.sh PREFIX
#
# Shared, so that whoever has a wheel may replace it (LGPL 2.1, section 6). Of its modules, only
# those under the LGPL: pyrod calls no others, and the rest (GPL) would change the licence of a
# wheel. No BLAS, no OpenMP and no METIS: the simplicial factorisation in a given order has no use
# for them.
set -eu

prefix=${1:?"usage: $0 PREFIX"}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

version=7.10.1
release=https://github.com/DrTimothyAldenDavis/SuiteSparse/archive/v$version.tar.gz
debian=http://deb.debian.org/debian/pool/main/s/suitesparse/suitesparse_$version+dfsg.orig.tar.xz

fetch() { # fetch URL SHA256: what is not the expected file counts as not there
  curl -fsSL --retry 2 --connect-timeout 20 -o "$work/source" "$1" &&
    echo "$2  $work/source" | sha256sum -c - >/dev/null
}

fetch "$release" 9e2974e22dba26a3cffe269731339ae8e01365cfe921b06be6359902bd05862c ||
  fetch "$debian" f33dc4dbbaa16711861bb986604ac7ea15d949276951c706c6997d5567cebfcc || {
  echo "Neither $release nor $debian could be fetched." >&2
  exit 1
}
mkdir "$work/tree"
tar -xf "$work/source" -C "$work/tree" --strip-components=1

# BLAS_LIBRARIES is set, if to nothing: else a BLAS would be searched for, and missed.
cmake -S "$work/tree" -B "$work/build" --log-level=WARNING \
  -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_INSTALL_PREFIX="$prefix" \
  -DCMAKE_INSTALL_LIBDIR=lib \
  -DSUITESPARSE_ENABLE_PROJECTS="suitesparse_config;amd;colamd;cholmod" \
  -DBUILD_SHARED_LIBS=ON \
  -DBUILD_STATIC_LIBS=OFF \
  -DBUILD_TESTING=OFF \
  -DBLAS_LIBRARIES= \
  -DSUITESPARSE_USE_CUDA=OFF \
  -DSUITESPARSE_USE_FORTRAN=OFF \
  -DSUITESPARSE_USE_OPENMP=OFF \
  -DCHOLMOD_GPL=OFF \
  -DCHOLMOD_PARTITION=OFF \
  -DCHOLMOD_CAMD=OFF
cmake --build "$work/build" --parallel "${JOBS:-2}"
cmake --install "$work/build" --strip >/dev/null
