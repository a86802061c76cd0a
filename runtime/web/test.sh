#!/usr/bin/env bash
# Tests the crate on this machine, builds the page, serves it and drives Chromium through it.
# Pictures of the page are left in target/pictures.
set -euo pipefail
cd "$(dirname "$0")"
cargo test --quiet --target-dir "${CARGO_TARGET_DIR:-target}/host"
./build.sh

[ -d target/node/node_modules/axe-core ] ||
    npm install --silent --prefix target/node playwright-core@1 axe-core@4
chromium="${CHROMIUM:-$(command -v chromium || command -v chromium-browser || command -v google-chrome)}" || {
    echo "no Chromium: install it, or give its path as CHROMIUM" >&2
    exit 1
}
# Not the port of the run before.
: > target/server.log
python3 -u -m http.server --bind 127.0.0.1 --directory target/page 0 > target/server.log 2>&1 &
server=$!
trap 'kill "$server"' EXIT
until port="$(grep -oP 'port \K[0-9]+' target/server.log)"; do sleep 0.1; done
NODE_PATH=target/node/node_modules node tests/browser.cjs "http://127.0.0.1:$port/" "$chromium" target/pictures
