#!/usr/bin/env python3
"""Adds a wheel to the packages that Pyodide knows in a JupyterLite site.

    lock.py WHEEL SITE

Pyodide has a list of its packages, the lock file, and loads those that a cell imports. The site
gets its own list: the packages of Pyodide at their usual address, and the wheel, from the site.
"""

import hashlib
import json
import shutil
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

from jupyterlite_pyodide_kernel.constants import (
    PYODIDE_CDN_URL,
    PYODIDE_KERNEL_PLUGIN_ID,
    PYODIDE_VERSION,
)


def published_lock():
    """Returns the lock file in the npm package of the Pyodide version that the kernel uses."""
    with tempfile.TemporaryDirectory() as folder:
        package = f"pyodide@{PYODIDE_VERSION}"
        subprocess.run(["npm", "pack", "--silent", package], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        with tarfile.open(next(Path(folder).glob("*.tgz"))) as archive:
            return json.load(archive.extractfile("package/pyodide-lock.json"))


def main():
    wheel, site = map(Path, sys.argv[1:])
    lock = published_lock()
    platform = f"pyemscripten_{lock['info']['abi_version']}_wasm32"
    if not wheel.stem.endswith(f"-{platform}"):
        sys.exit(f"{wheel.name}: Pyodide {PYODIDE_VERSION} needs a wheel for {platform}")
    for package in lock["packages"].values():
        package["file_name"] = f"{PYODIDE_CDN_URL}/{package['file_name']}"
    name, version, *_ = wheel.name.split("-")
    lock["packages"][name.replace("_", "-")] = {
        "name": name.replace("_", "-"),
        "version": version,
        "file_name": wheel.name,
        "install_dir": "site",
        "sha256": hashlib.sha256(wheel.read_bytes()).hexdigest(),
        "package_type": "package",
        "imports": [name],
        "depends": ["numpy"],
        "unvendored_tests": False,
    }
    # Pyodide resolves names of files by the address of the lock file.
    folder = site / "pyodide"
    folder.mkdir()
    shutil.copy(wheel, folder)
    (folder / "pyodide-lock.json").write_text(json.dumps(lock))

    settings = site / "jupyter-lite.json"
    content = json.loads(settings.read_text())
    kernel = content["jupyter-config-data"]["litePluginSettings"][PYODIDE_KERNEL_PLUGIN_ID]
    kernel["loadPyodideOptions"] = {"lockFileURL": "./pyodide/pyodide-lock.json"}
    settings.write_text(json.dumps(content, indent=2))


if __name__ == "__main__":
    main()
