#!/usr/bin/env bash
# Instructions of one evaluation of the accelerations, counted by valgrind: the table
# of docs/performance.md. valgrind knows AVX2 and no AVX-512, so the code is that of AVX2.
set -euo pipefail
source "$(dirname "$0")/../package.sh"
package instructions

modules=""
list=""
# Name, links, description.
scene() {
    local solve module
    for solve in factorization recursion; do
        module="${1}_$solve"
        printf '#[branched_pendulum(gravity = 9.80665, %s, solve = %s)]\npub struct Tree;\n' \
            "$3" "$solve" > "$folder/scene.rs"
        "$expand" "$folder/scene.rs" --output "$folder/src/$module.rs"
        modules+="#[path = \"$module.rs\"] #[allow(warnings)] mod $module;"$'\n'
        list+="(\"$module\", |kind, times| crate::run::<$2, _>($module::Tree::<f64>::new(), kind, times)),"$'\n'
    done
}
tree() {
    scene "tree$2" "$2" "arm: generations(count = $1, branching = 2, shape = rod, mass = 0.12,
        length = 0.3, mass_ratio = 0.5, length_ratio = 0.7, code = unrolled)"
}
scene tree3 3 "parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
    child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2]"
tree 3 7
tree 4 15
tree 5 31
tree 7 127

cat > "$folder/src/scenes.rs" <<RUST
$modules
pub(crate) const SCENES: &[(&str, crate::Run)] = &[$list];
RUST
CARGO_TARGET_DIR="$folder/target" \
    cargo build --quiet --release --manifest-path "$folder/Cargo.toml"

# Instructions of so many evaluations and of what is around them.
total() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null \
        "$folder/target/release/instructions" "$1" "$2" "$3" 2>&1 |
        sed -nE 's/.*Collected : ([0-9]+).*/\1/p'
}
# Instructions of one.
once() {
    echo $((($(total "$1" "$2" 2048) - $(total "$1" "$2" 1024)) / 1024))
}

echo "| links | sines of the system | one state: factorization | recursion | batch: factorization | recursion |"
echo "|---|---:|---:|---:|---:|---:|"
for links in 3 7 15 31 127; do
    f="tree${links}_factorization" r="tree${links}_recursion" label="$links"
    [ "$links" != 3 ] || label="3 (paper)"
    echo "| $label | $(once "$f" sines) | $(once "$f" one) | $(once "$r" one) | $(once "$f" batch) | $(once "$r" batch) |"
done
