#!/usr/bin/env bash
# Builds a JupyterLite site with the notebooks into target/site: files for any static server.
# `./build.sh WHEEL` adds a wheel of this package for Pyodide, which the notebooks then import.
set -euo pipefail
wheel="${1:+$(realpath "$1")}"
cd "$(dirname "$0")"
[ -d target/venv ] || python3 -m venv target/venv
target/venv/bin/pip install --quiet --requirement requirements.txt

# The notebooks without outputs, which the kernel fills in, and the files that they read, in the
# same folders as in `runtime`.
rm -rf target/files target/site target/wheels
mkdir -p target/files/python/notebooks
python3 - ../notebooks/*.ipynb << 'PYTHON'
import json
import sys
from pathlib import Path

for path in map(Path, sys.argv[1:]):
    notebook = json.loads(path.read_text())
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            cell |= {"outputs": [], "execution_count": None}
    Path("target/files/python/notebooks", path.name).write_text(json.dumps(notebook))
PYTHON
grep -ohP '"\K\.\./\.\./[^"\\]+' ../notebooks/*.ipynb | sort -u | sed 's,^\.\./\.\./,,' | while read -r file; do
    install -D -m 644 "../../$file" "target/files/$file"
done

# Pyodide does not have this package, and the kernel needs it.
target/venv/bin/pip download --quiet --no-deps --dest target/wheels "$(grep ^comm= requirements.txt)"
(
    cd target
    venv/bin/jupyter lite build --contents files --output-dir site --apps lab --apps notebooks \
        --piplite-wheels wheels --no-sourcemaps --no-unused-shared-packages > build.log 2>&1 || {
        cat build.log
        exit 1
    }
)
if [ -n "$wheel" ]; then
    target/venv/bin/python lock.py "$wheel" target/site
fi
du --apparent-size --summarize --human-readable target/site
