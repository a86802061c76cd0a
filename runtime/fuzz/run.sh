#!/usr/bin/env bash
# Fuzzes each reader of foreign bytes for so many seconds, 60 without an argument, guided by what code an input
# reaches: descriptions of trees at run time, and tables of measured data. Needs a nightly toolchain, a C++
# compiler, Python and `cargo install cargo-fuzz`. What was found to be of use is kept in `corpus`, what breaks
# something in `artifacts`.
set -euo pipefail
cd "$(dirname "$0")"
seconds="${1:-60}"
cargo +nightly fuzz --version > /dev/null 2>&1 || { echo "not checked: cargo-fuzz is not installed"; exit 1; }
python3 seeds.py
# The versions of the workspace.
[ -e Cargo.lock ] || cp ../../Cargo.lock .
for target in descriptions tables; do
    mkdir -p "corpus/$target"
    # Without `cfg(fuzzing)`, with which `proc-macro2` forgets the places of tokens.
    cargo +nightly fuzz run --fuzz-dir . --no-cfg-fuzzing "$target" "corpus/$target" "seeds/$target" -- \
        -max_total_time="$seconds" -max_len=3000 -timeout=60 -rss_limit_mb=2048 \
        -dict="seeds/$target.dict" -print_final_stats=1
done
rm -f "${TMPDIR:-/tmp}"/branched-pendulum-fuzz-*.csv
