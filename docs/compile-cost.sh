#!/usr/bin/env bash
# Prints what a model costs before it runs, as the table in performance.md: least
# processor time, of five, of an unoptimised `expand` and of `cargo build --release`
# for a program that evaluates the expanded file, its dependencies built; lines.
set -euo pipefail
cd "$(dirname "$0")/.."

export CARGO_TARGET_DIR="${CARGO_TARGET_DIR:-$PWD/target}"
cargo build --quiet --package branched-pendulum-codegen --bin expand
expand="$CARGO_TARGET_DIR/debug/expand"
folder="$(mktemp -d)"
trap 'rm -r "$folder"' EXIT
TIMEFORMAT=%U

# Name, generations, further statements.
package() {
    mkdir -p "$folder/$1/src"
    cat > "$folder/$1/Cargo.toml" <<TOML
[package]
name = "compile-cost-$1"
edition = "2024"
[dependencies]
branched-pendulum = { path = "$PWD/runtime", default-features = false, features = ["std"] }
TOML
    cat > "$folder/$1/scene.rs" <<SCENE
use branched_pendulum::prelude::*;
/// Rods.
#[branched_pendulum(
    gravity = 9.80665,
    arm: generations(count = $2, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7),
    emit(energies),
)]
pub struct Tree;
SCENE
    cat > "$folder/$1/src/main.rs" <<MAIN
#![allow(dead_code)]
mod scene;
use branched_pendulum::prelude::*;
use scene::Tree;
fn main() {
    let (model, n) = (Tree::<f64>::new(), <Tree as Pendulum<f64>>::LINKS);
    let (theta, omega, mut alpha) = (vec![0.3; n], vec![0.1; n], vec![0.0; n]);
    model.accelerations_into(0.0, &theta, &omega, &mut alpha);
    let energies = (model.kinetic_energy_of(&theta, &omega), model.potential_energy_of(&theta));
    println!("{} {energies:?}", alpha[0]);
    ${3:-}
}
MAIN
}

# The least user time of a command.
least() {
    for _ in 1 2 3 4 5; do
        [ -z "${touched:-}" ] || touch "$touched"
        { time "$@" > "$folder/output" 2>&1; } 2>&1
    done | sort -n | head -1
}

# What, name.
row() {
    local source="$folder/$2/src/scene.rs" derivation compilation
    derivation="$(least "$expand" "$folder/$2/scene.rs" --out "$source")"
    (cd "$folder/$2" && cargo build --release --quiet --offline)
    compilation="$(cd "$folder/$2" && touched=src/main.rs least cargo build --release --quiet --offline)"
    echo "| $1 | $derivation s | $compilation s | $(wc -l < "$source") |"
}

package small 3
package large 20
package batch 5 'let states = vec![vec![0.1; 64]; n];
    let mut batch = vec![vec![0.0; 64]; n];
    let mut evaluation = branched_pendulum::batch::Batch::new(&model);
    evaluation.accelerations(0.0, &states, &states, &mut batch).unwrap();
    println!("{}", batch[0][0]);'
cp Cargo.lock "$folder/small"
cp Cargo.lock "$folder/large"
cp Cargo.lock "$folder/batch"
echo "| tree | expand | rustc | lines |"
echo "|---|---|---|---|"
row "7 links, written out" small
row "2²⁰ − 1 links, loops" large
row "31 links, written out, and a batch" batch
