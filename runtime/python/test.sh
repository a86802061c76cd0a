#!/usr/bin/env bash
# Builds the wheel and tests it, in a virtual environment under target/.
set -euo pipefail
cd "$(dirname "$0")"
# The versions of the workspace, where it has them.
[ -f Cargo.lock ] || cp ../../Cargo.lock .
[ -d target/venv ] || python3 -m venv target/venv
target/venv/bin/pip install --quiet --upgrade 'maturin>=1.16,<2' numpy scipy pytest
target/venv/bin/maturin build --release --quiet --out target/wheels
target/venv/bin/pip install --quiet --force-reinstall --no-deps target/wheels/*.whl
target/venv/bin/python -m pytest --quiet tests
