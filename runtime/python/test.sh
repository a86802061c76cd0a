#!/usr/bin/env bash
# Builds the wheel, tests it in a virtual environment under target/, and uses it in a second
# one that holds an older NumPy alone.
set -euo pipefail
cd "$(dirname "$0")"
# The versions of the workspace, where it has them.
[ -f Cargo.lock ] || cp ../../Cargo.lock .
[ -d target/venv ] || python3 -m venv target/venv
target/venv/bin/pip install --quiet --upgrade 'maturin>=1.8,<2'
rm -rf target/wheels
target/venv/bin/maturin build --release --quiet --out target/wheels
wheel=$(echo target/wheels/*.whl)
target/venv/bin/pip install --quiet --force-reinstall --no-deps "$wheel"
target/venv/bin/pip install --quiet "$wheel[test]"
target/venv/bin/python -m mypy.stubtest --concise branched_pendulum
target/venv/bin/python -m pytest --quiet tests "$@"

rm -rf target/clean
python3 -m venv target/clean
target/clean/bin/pip install --quiet "$wheel" 'numpy<2'
target/clean/bin/python - <<'PYTHON'
import branched_pendulum as bp

rod = bp.Tree("gravity = 9.81, rod: rod(mass = 0.2, length = 1)")
end = rod.integrate([0.1, 0.0], [0.0, 10.0])
print(f"{len(rod)} link, {end.report}; {bp.models.BranchedDouble().names}")
PYTHON
du -h "$wheel"
