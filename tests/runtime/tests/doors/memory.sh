#!/usr/bin/env bash
# The attacks of this folder in optimised code, natively and under valgrind, which finds what is
# read or written beside memory, and knows no AVX-512. Needs valgrind.
set -euo pipefail
cd "$(dirname "$0")/../../../.."

if ! command -v valgrind > /dev/null; then
    echo "tests/runtime/tests/doors/memory.sh needs valgrind, which is not installed"
    exit 1
fi
# Without the macro, and so without Symbolica.
build() {
    cargo test --release -p branched-pendulum-runtime-tests --test doors "$@"
}
build
program="$(build --no-run --message-format=json | grep -o '"executable":"[^"]*doors[^"]*"' | cut -d '"' -f 4)"
# The compiler is no part of it.
valgrind --quiet --error-exitcode=1 "$program" --test-threads=1 --skip attacks_are_not_compiled
