#!/bin/bash -eu
# Builds the targets of fuzz/ for ClusterFuzzLite, with the texts from which `cargo xtask fuzz` starts, too.
cd "$SRC/rocking-wall"

for target in fuzz/fuzz_targets/*.rs; do
  name=$(basename "$target" .rs)
  cargo fuzz build -O "$name"
  cp "fuzz/target/x86_64-unknown-linux-gnu/release/$name" "$OUT/"
done

seeds() {
  name=$1
  shift
  zip --quiet --recurse-paths "$OUT/${name}_seed_corpus.zip" "$@"
}
seeds records crates/ground-motion/tests/it
seeds scenes scenes tests/data/cases
seeds studies studies scenes/building
seeds descriptions modelDescription crates/floor/modelDescription
