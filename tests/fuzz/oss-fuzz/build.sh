#!/bin/bash -eu
# Builds the fuzz targets with the compiler, flags and engine that OSS-Fuzz gives, and copies them with their seeds,
# dictionaries and libraries: what runs them has no packages.

# The libraries of the distribution are compiled against its own C++ standard library, not against LLVM's.
export CXXFLAGS="${CXXFLAGS//-stdlib=libc++/} -DHWY_COMPILE_ONLY_STATIC -D_GLIBCXX_ASSERTIONS"
build=$WORK/kaustik
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=None -DKAUSTIK_FUZZ=ON -DKAUSTIK_MPI=OFF -DKAUSTIK_BUILD_TESTS=OFF \
  -DKAUSTIK_BUILD_BENCHMARKS=OFF "-DKAUSTIK_FUZZ_ENGINE=$LIB_FUZZING_ENGINE"
cmake --build "$build" --target kaustik_fuzz

mkdir -p "$OUT/lib"
cp "$build/kaustik-images.so" "$OUT/lib/"
patchelf --force-rpath --set-rpath '$ORIGIN' "$OUT/lib/kaustik-images.so"
# All libraries but those that every system has.
copy_libraries() {
  ldd "$1" | awk '$2 == "=>" && $3 ~ /^\// { print $3 }' | grep -vE '/(libc|libm|libdl|libpthread|librt|ld-linux[^/]*)\.so' |
    xargs -r cp -Lnt "$OUT/lib"
}
copy_libraries "$OUT/lib/kaustik-images.so"

for program in "$build"/tests/fuzz/fuzz_*; do
  [ -x "$program" ] && [ -f "$program" ] || continue
  name=$(basename "$program")
  copy_libraries "$program"
  cp "$program" "$OUT/"
  # As DT_RPATH, which libraries that are loaded later are looked for by, too.
  patchelf --force-rpath --set-rpath '$ORIGIN/lib' "$OUT/$name"
  zip -qj "$OUT/${name}_seed_corpus.zip" tests/fuzz/corpus/"${name#fuzz_}"/*
  dictionary=tests/fuzz/dictionaries/${name#fuzz_}.dict
  [ ! -e "$dictionary" ] || cp "$dictionary" "$OUT/$name.dict"
done
