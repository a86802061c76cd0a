#!/usr/bin/env bash
# What each pass over programs is worth in time: the tables of docs/pipeline.md.
# Builds one small crate in a temporary folder; takes some minutes.
set -euo pipefail
source "$(dirname "$0")/../package.sh"
package passes

tree="shape = rod, mass = 0.12, length = 0.3, mass_ratio = 0.5, length_ratio = 0.7"
counted="sharing folding signs angle-addition common-factors choice fusing"

# Prints `model.energy(x, y);` for every function but the accelerations; positions
# are x, motions y.
calls() {
    local name arguments
    "$expand" stage program "$1" | sed -nE 's/^([a-z_0-9]+)\(([a-z, ]*)\)    # .*/\1 \2/p' |
        while read -r name arguments; do
            [ "$name" != accelerations ] || continue
            arguments="$(sed -E 's/theta|coordinates|absolute|symmetric/x/; s/omega|rates|momenta/y/; s/time/0.3/' \
                <<< "$arguments")"
            echo "std::hint::black_box(model.$name($arguments));"
        done
}

modules=""
scenes=""
# Name, title, links, description, passes to leave out.
scene() {
    local source="$folder/$1.rs" variants="" variant option
    printf '#[branched_pendulum(gravity = 9.80665, %s)]\npub struct Tree;\n' "$4" > "$source"
    for variant in – again $5; do
        module="$1_${variant//-/_}"
        module="${module/–/all}"
        option=""
        [ "$variant" == – ] || [ "$variant" == again ] || option="--without $variant"
        # shellcheck disable=SC2086
        "$expand" expand $option "$source" --output "$folder/src/$module.rs"
        modules+="#[path = \"$module.rs\"] #[allow(warnings)] mod $module;"$'\n'
        variants+="crate::Variant { name: \"$variant\", passes: [
            crate::one_by_one::<$3>($module::Tree::new()),
            crate::batch::<$3>($module::Tree::new()),
            crate::others::<$3>({ let model = $module::Tree::<f64>::new(); move |x, y| {
                $(calls "$source")
            } }),
        ] },"$'\n'
    done
    scenes+="(\"$2\", vec![$variants]),"$'\n'
}

scene paper "The paper's pendulum" 3 "parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3,
    joint = 0.27) [child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2],
    emit(energies, momenta, symmetric, transfer(angle = 1, amplitude = 2, exact))" "$counted"
scene tree7 "7 links" 7 "arm: generations(count = 3, branching = 2, $tree),
    emit(energies, budget(canonical, velocity, matrix))" "$counted"
scene tree31 "31 links" 31 "arm: generations(count = 5, branching = 2, $tree), emit(energies)" \
    "$counted order"
scene driven "A driven tree of 3 links" 3 "trunk: rod(mass = 0.2, length = 0.3, friction = 2e-3) [
    twig: rod(mass = 0.1, length = 0.2, friction = 1e-3) * 2],
    drive(torque = 0.2 * cos(4 * t), x = 0.02 * cos(5 * t), y = 0.01 * sin(10 * t)),
    emit(energies)" "sharing folding signs common-factors fusing"
scene tree15 "15 links with long functions" 15 "arm: generations(count = 4, branching = 2, $tree),
    emit(budget(canonical, matrix))" "common-factors order splitting"

cat > "$folder/src/variants.rs" <<RUST
$modules
pub(crate) fn scenes() -> Vec<(&'static str, Vec<crate::Variant>)> {
    vec![$scenes]
}
RUST
export CARGO_TARGET_DIR="$folder/target"
cargo build --quiet --release --manifest-path "$folder/Cargo.toml"
"$folder/target/release/passes" "$@"
