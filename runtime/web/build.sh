#!/usr/bin/env bash
# Builds the page into target/page: files for any static server.
set -euo pipefail
cd "$(dirname "$0")"
target=wasm32-unknown-unknown
builds="${CARGO_TARGET_DIR:-target}"
# The versions of the workspace, where it has them.
[ -f Cargo.lock ] || cp ../../Cargo.lock .

if [ -d "$(rustc --print sysroot)/lib/rustlib/$target" ]; then
    echo "for $target with the installed standard library"
    cargo build --release --target "$target"
elif [ -x /usr/bin/rustc ] && [ -d /usr/lib/rustlib/src/rust/library ]; then
    # Debian's packages rustc-web, cargo-web and rust-web-src have no such standard library
    # either, but its source, which is built small: without the texts of panics, which end
    # the program with no word. The linker is that of the other compiler.
    echo "for $target with a standard library built from Debian's source"
    linker="$(find "$(rustc --print sysroot)/lib/rustlib" -name rust-lld | head -n 1)"
    RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1 CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER="$linker" \
        /usr/bin/cargo build --release --target "$target" \
        -Z build-std=std,panic_abort -Z build-std-features=optimize_for_size \
        -Z panic-immediate-abort --config 'profile.release.panic="immediate-abort"'
else
    echo "$target is not installed: rustup target add $target" >&2
    exit 1
fi

rm -rf target/page
mkdir -p target
cp -r page target/page
cargo run --quiet --package bindings --target-dir "$builds/host" -- \
    "$builds/$target/release/branched_pendulum_web.wasm" target/page/wasm
# Packed: page/start.js unpacks it. No name ending that a server takes for an encoding.
gzip -9 --no-name --to-stdout target/page/wasm/branched_pendulum_web_bg.wasm \
    > target/page/wasm/branched_pendulum_web.packed
rm target/page/wasm/branched_pendulum_web_bg.wasm
du --apparent-size --bytes --all target/page | sort -n
all="$(find target/page -type f -exec cat {} + | wc -c)"
echo "all of the page: $all bytes"
if [ "$all" -ge 600000 ]; then
    echo "they must stay below 600000" >&2
    exit 1
fi
