#!/bin/bash -eu
# SPDX-FileCopyrightText: The plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What OSS-Fuzz calls (docs/fuzzing.md): builds the fuzz targets with the compiler, the flags and the engine of the
# environment ($CXX, $CXXFLAGS, $LIB_FUZZING_ENGINE) in $WORK, and puts into $OUT each target with its seeds, its
# dictionary, its options, and the libraries that the image it runs in will not have. TARGETS: these alone ("ply obj").

root=$(cd "$(dirname "$0")/../.." && pwd)
build=${WORK:-$root/build}/oss-fuzz
: "${OUT:?where to put the targets}" "${LIB_FUZZING_ENGINE:?what brings main}"

# -w: a newer compiler than ours warns of more, and here warnings are errors.
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_C_COMPILER="${CC:-clang}" -DCMAKE_CXX_COMPILER="${CXX:-clang++}" \
  -DCMAKE_CXX_FLAGS="${CXXFLAGS:-} -w" -DCMAKE_EXE_LINKER_FLAGS="-Wl,-rpath,'\$ORIGIN/lib'" \
  -DPLUMBLINE_FUZZ_ENGINE="$LIB_FUZZING_ENGINE" -DPLUMBLINE_PRECOMPILE=OFF -DPLUMBLINE_HAS_GOLD=OFF
mkdir -p "$OUT/lib"
for list in "$build"/tests/fuzz/*.seeds; do
  target=$(basename "$list" .seeds)
  case " ${TARGETS:-$target} " in *" $target "*) ;; *) continue ;; esac
  name=${target}_fuzz
  cmake --build "$build" --target "$name"
  cp "$build/tests/fuzz/$name" "$OUT/"
  seeds=()
  while read -r folder; do seeds+=("$folder"); done <"$list"
  rm -f "$OUT/${name}_seed_corpus.zip"
  find "${seeds[@]}" -type f -print0 | sort -z | xargs -0 zip -q -j "$OUT/${name}_seed_corpus.zip"
  if [ -e "$root/tests/fuzz/$target.dict" ]; then cp "$root/tests/fuzz/$target.dict" "$OUT/$name.dict"; fi
  printf '[libfuzzer]\nmax_len = 65536\ntimeout = 60\n' >"$OUT/$name.options"
  ldd "$build/tests/fuzz/$name" | awk '$3 ~ /^\// {print $3}' | grep -v -E '/(libc|libm|libdl|librt|libpthread|libresolv)\.so' |
    xargs -r cp -L -n -t "$OUT/lib"
done
