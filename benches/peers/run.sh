#!/usr/bin/env bash
# Measures our code and other tools one after the other on this machine: every figure about other tools in
# docs/performance.md and docs/integrators.md, from one version in one run. The parts `evaluation`, `ensemble`
# and `trajectories` take four minutes after a release build; `games`, `robots` and `python` build more.
#
#     benches/peers/run.sh FOLDER [PART…]
#
# writes FOLDER/PART.txt. FOLDER also gets the Python environment of the other tools, unless PEERS names
# one. The parts are the functions below.
set -euo pipefail

evaluation() { # One state and batches: the tables of docs/performance.md.
    ours evaluation-speed
    cargo build --quiet --release -p cargo-branched-pendulum # `program.py` asks it for our operations.
    theirs heyoka_batch.py
    theirs tools.py
}
trajectories() { # Time for one motion to a given error: docs/integrators.md.
    ours work-precision
    theirs heyoka_trajectory.py
}
ensemble() { # 10,000 releases on one thread: docs/integrators.md.
    echo "# cargo bench -- ensembles"
    cargo bench --quiet -p branched-pendulum-studies -- ensembles
    theirs heyoka_ensemble.py
}
solvers() { # Solvers of other crates, and a stiff tree by one of them.
    rust --features solvers --bin solvers
    rust --features solvers --bin stiff
}
games() { # The physics of a game engine, next to our frames.
    rust --features games --bin games
}
robots() { # Forward dynamics of Pinocchio, next to our emitted accelerations.
    expanded
    (cd benches/peers/rust && cargo build --release)
    "$PEERS/bin/pip" install --quiet pin cmeel-eigen
    theirs robots.py
}
python() { # The Python package next to heyoka.py.
    "$PEERS/bin/pip" install --quiet ./runtime/python
    theirs python_trajectory.py
}

ours() {
    echo "# $*"
    cargo run --quiet --release --bin "$@"
}
theirs() {
    echo "# $1"
    "$PEERS/bin/python" "benches/peers/$1"
}
expanded() {
    cargo build --quiet --release -p cargo-branched-pendulum
    (cd benches/peers/rust &&
        ../../../target/release/cargo-branched-pendulum expand scenes.rs --output expanded.rs)
}
rust() {
    expanded
    echo "# $*"
    (cd benches/peers/rust && cargo run --quiet --release "$@")
}

all=(evaluation trajectories ensemble solvers games robots python)
if [ $# -eq 0 ]; then
    echo "usage: benches/peers/run.sh FOLDER [PART…], parts: ${all[*]}" >&2
    exit 2
fi
folder="$(realpath -m "$1")"
shift
parts=("${@:-${all[@]}}")
for part in "${parts[@]}"; do
    if [[ " ${all[*]} " != *" $part "* ]]; then
        echo "no part \`$part\`; parts are ${all[*]}" >&2
        exit 2
    fi
done
mkdir -p "$folder"
PEERS="${PEERS:+$(realpath -m "$PEERS")}"
PEERS="${PEERS:-$folder/python}"
cd "$(dirname "$0")/../.."
if [ ! -x "$PEERS/bin/python" ]; then
    python3 -m venv "$PEERS"
    "$PEERS/bin/pip" install --quiet heyoka casadi mujoco numpy
fi
for part in "${parts[@]}"; do
    {
        echo "# $(git rev-parse --short HEAD), $(rustc --version), $(sed -n 's/^model name.*: //p' /proc/cpuinfo | head -n 1)"
        "$part"
    } 2>&1 | tee "$folder/$part.txt"
done
