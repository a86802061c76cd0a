#!/usr/bin/env bash
# Prints what expansion costs, as the table in pipeline.md: processor time of an
# unoptimised `branched-pendulum` and lines that it writes, for binary trees of rods.
set -euo pipefail
cd "$(dirname "$0")/.."

cargo build --quiet --package cargo-branched-pendulum
expand="${CARGO_TARGET_DIR:-target}/debug/cargo-branched-pendulum"
folder="$(mktemp -d)"
trap 'rm -r "$folder"' EXIT
TIMEFORMAT=%U

# Five observables in symmetric coordinates.
observables="observe(
    swing = sin(theta_arm_2_d)^2 + omega_arm_2_d^2,
    push = p_arm_3_d * theta_arm_3_d,
    lag = omega_arm_3_m - omega_arm_2_m,
    spread = theta_arm_3_1_d^2 + theta_arm_3_2_d^2,
    share = kinetic_energy + potential_energy - p_arm_2_d^2 / (4 * inertia_arm_2),
),"

# Requests, generations.
row() {
    local emit seconds lines longest
    case "$1" in
        "") emit="" ;;
        "five symmetric observables") emit="$observables" ;;
        *) emit="emit($1)," ;;
    esac
    cat > "$folder/scene.rs" <<SCENE
use branched_pendulum::prelude::*;
/// Rods.
#[branched_pendulum(
    gravity = 9.80665,
    arm: generations(count = $2, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7, friction = 1e-4),
    $emit
)]
pub struct Tree;
SCENE
    seconds="$({ time "$expand" expand "$folder/scene.rs" --output "$folder/expanded.rs"; } 2>&1)"
    lines="$(wc -l < "$folder/expanded.rs")"
    longest="$(awk '/^    (pub )?fn /{start = NR} /^    }$/{if (start && NR - start + 1 > most) most = NR - start + 1; start = 0} END{print most}' "$folder/expanded.rs")"
    echo "| $((2 ** $2 - 1)) | \`${1:-–}\` | $seconds | $lines | $longest |"
}

echo "| links | asked for | user time (s) | lines | longest function |"
echo "|---:|---|---:|---:|---:|"
for generations in 2 3 4 5; do
    row "" "$generations"
    row "budget(canonical)" "$generations"
    row "budget(canonical, parseval, velocity, rest, matrix)" "$generations"
    [ "$generations" == 2 ] || row "five symmetric observables" "$generations"
    [ "$generations" != 3 ] || row "budget(canonical, amplitude = 2, amplitude = 4)" 3
done
