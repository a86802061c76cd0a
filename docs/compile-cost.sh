#!/usr/bin/env bash
# Prints what a model costs before it runs, as the table in performance.md: least
# processor time, of five, of an unoptimised `branched-pendulum` and of `cargo build --release`
# for a program that evaluates the expanded file, its dependencies built; lines of
# the expanded file; and by how many bytes of machine code that program is longer
# than one without a model. Rows can be chosen by their names, as in
# `docs/compile-cost.sh loops20 links7`.
set -euo pipefail
cd "$(dirname "$0")/.."

export CARGO_TARGET_DIR="${CARGO_TARGET_DIR:-$PWD/target}"
cargo build --quiet --package cargo-branched-pendulum
expand="$CARGO_TARGET_DIR/debug/cargo-branched-pendulum"
folder="$(mktemp -d)"
trap 'rm -r "$folder"' EXIT
TIMEFORMAT=%U
names=("$@")

# Name, what is used of the model.
package() {
    mkdir -p "$folder/$1/src"
    cp Cargo.lock "$folder/$1"
    cat > "$folder/$1/Cargo.toml" <<TOML
[package]
name = "compile-cost-$1"
edition = "2024"
[dependencies]
branched-pendulum = { path = "$PWD/runtime", default-features = false, features = ["std"] }
TOML
    cat > "$folder/$1/src/main.rs" <<MAIN
#![allow(dead_code)]
$2
    let (theta, omega, mut alpha) = (vec![0.3; n], vec![0.1; n], vec![0.0; n]);
    let energies = evaluate(&theta, &omega, &mut alpha);
    println!("{} {energies:?}", alpha[0]);
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

# Bytes of machine code of a program.
code() {
    (cd "$folder/$1" && cargo build --release --quiet --offline)
    size --format=sysv "$CARGO_TARGET_DIR/release/compile-cost-$1" | awk '$1 == ".text" {print $2}'
}

thousands() {
    sed -E ':a; s/([0-9])([0-9]{3})($|,)/\1,\2\3/; ta' <<< "$1"
}

# Name, what it is, the tree, more statements of the program.
row() {
    local derivation compilation lines bytes
    [ ${#names[@]} == 0 ] || [[ " ${names[*]} " == *" $1 "* ]] || return 0
    package "$1" "mod scene;
use branched_pendulum::prelude::*;
fn evaluate(theta: &[f64], omega: &[f64], alpha: &mut [f64]) -> (f64, f64) {
    let model = scene::Tree::<f64>::new();
    model.accelerations_into(0.0, theta, omega, alpha);
    (model.kinetic_energy_of(theta, omega), model.potential_energy_of(theta))
}
fn main() {
    let n = <scene::Tree as Pendulum<f64>>::LINKS;
    ${4:-}"
    cat > "$folder/$1/scene.rs" <<SCENE
use branched_pendulum::prelude::*;
/// A tree.
#[branched_pendulum(gravity = 9.80665, $3, emit(energies))]
pub struct Tree;
SCENE
    derivation="$(least "$expand" expand "$folder/$1/scene.rs" --output "$folder/$1/src/scene.rs")"
    bytes=$(($(code "$1") - bare))
    compilation="$(cd "$folder/$1" && touched=src/main.rs least cargo build --release --quiet --offline)"
    lines="$(wc -l < "$folder/$1/src/scene.rs")"
    echo "| $2 | $derivation s | $compilation s | $(thousands "$lines") | $(thousands "$bytes") |"
}

# Generations, how the code is written.
binary() {
    echo "arm: generations(count = $1, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7${2:+, code = $2})"
}

# A trunk with so many teeth, from whose end a chain of as many links hangs.
comb() {
    echo "trunk: rod(mass = 0.3, length = 0.4) [
        tooth: rod(mass = 0.1, length = 0.2) * $1,
        chain: generations(count = $1, branching = 1, shape = rod, mass = 0.1, length = 0.1)]"
}

package bare 'fn evaluate(theta: &[f64], omega: &[f64], alpha: &mut [f64]) -> (f64, f64) {
    alpha.copy_from_slice(theta);
    (theta[0], omega[0])
}
fn main() {
    let n = std::env::args().count();'
bare="$(code bare)"

echo "| tree | expand | rustc | lines | code, bytes |"
echo "|---|---:|---:|---:|---:|"
row paper "3 links, the paper's, written out" "parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3,
    joint = 0.27) [child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2]"
row links7 "7 links, written out" "$(binary 3)"
row links15 "15 links, written out" "$(binary 4)"
row links31 "31 links, written out" "$(binary 5)"
row batch "31 links, written out, and a batch" "$(binary 5)" 'let states = vec![vec![0.1; 64]; n];
    let mut batch = vec![vec![0.0; 64]; n];
    let model = scene::Tree::<f64>::new();
    let mut evaluation = branched_pendulum::batch::Batch::new(&model);
    evaluation.accelerations(0.0, &states, &states, &mut batch).unwrap();
    println!("{}", batch[0][0]);'
row links127 "127 links, written out" "$(binary 7 unrolled)"
row loops7 "127 links, loops" "$(binary 7)"
row loops10 "1,023 links, loops" "$(binary 10)"
row loops20 "2²⁰ − 1 links, loops" "$(binary 20)"
row table "127 links, irregular, loops" "$(comb 63)"
row table500 "1,001 links, irregular, loops" "$(comb 500)"
