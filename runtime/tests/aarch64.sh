#!/usr/bin/env bash
# The runtime's own tests on AArch64, whose registers are NEON's, by emulation: needs
# `rustup target add aarch64-unknown-linux-gnu`, a linker for it (Debian's gcc-aarch64-linux-gnu) and qemu-aarch64
# (Debian's qemu-user). Arguments go to the tests.
set -euo pipefail
cd "$(dirname "$0")/../.."
target=aarch64-unknown-linux-gnu
for needed in aarch64-linux-gnu-gcc qemu-aarch64; do
    command -v "$needed" > /dev/null || { echo "not checked: $needed is not installed"; exit 1; }
done
export CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER=aarch64-linux-gnu-gcc
export CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_RUNNER="qemu-aarch64 -L /usr/aarch64-linux-gnu"
cargo test --target "$target" -p branched-pendulum --no-default-features --features std --lib -- "$@"
