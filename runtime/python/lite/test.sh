#!/usr/bin/env bash
# Builds the site, serves it and opens every notebook in Chromium. `./test.sh WHEEL` executes all
# cells too, for which Chromium loads Pyodide from its usual address. Pictures of the notebooks are
# left in target/pictures.
set -euo pipefail
wheel="${1:+$(realpath "$1")}"
cd "$(dirname "$0")"
./build.sh ${wheel:+"$wheel"}

[ -d target/node/node_modules/playwright-core ] || npm install --silent --prefix target/node playwright-core@1
chromium="${CHROMIUM:-$(command -v chromium || command -v chromium-browser || command -v google-chrome)}" || {
    echo "no Chromium: install it, or give its path as CHROMIUM" >&2
    exit 1
}
# Not the port of the run before.
: > target/server.log
python3 -u -m http.server --bind 127.0.0.1 --directory target/site 0 > target/server.log 2>&1 &
server=$!
trap 'kill "$server"' EXIT
until port="$(grep -oP 'port \K[0-9]+' target/server.log)"; do sleep 0.1; done
NODE_PATH=target/node/node_modules node browser.cjs "http://127.0.0.1:$port/" target/site "$chromium" target/pictures
