#!/bin/sh
# What each pass over programs is worth: the tables of docs/pipeline.md.
set -eu
cd "$(dirname "$0")/.."
cargo build --quiet -p cargo-branched-pendulum
expand=${CARGO_TARGET_DIR:-target}/debug/cargo-branched-pendulum
for scene in paper triplet nested; do
    printf '%s\n\n' "$scene"
    "$expand" stage passes "tests/fixtures/scenes/$scene.rs"
    printf '\n'
done
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
printf 'binary tree of 5 generations\n\n'
cat > "$folder/tree.rs" <<'RUST'
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 5, branching = 2, shape = rod, mass = 0.12,
        length = 0.3, mass_ratio = 0.5, length_ratio = 0.7),
)]
pub struct Tree;
RUST
"$expand" stage passes "$folder/tree.rs"
