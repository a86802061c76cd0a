"""Types of the package: of results, and of arguments that are refused before a program runs."""

import re
import subprocess
import sys
from pathlib import Path

import branched_pendulum as bp

RIGHT = """
from collections.abc import Mapping
from typing import assert_type

import numpy as np
from numpy.typing import NDArray
import branched_pendulum as bp

Array = NDArray[np.float64]
tree = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
motion = tree.integrate([0.1, 0.0], (0, 1))
assert_type(tree.energy([0.1, 0.0]), np.float64)
assert_type(tree.energy(motion.y), Array)
assert_type(tree.energy([[0.1, 0.0]]), Array)
assert_type(tree.kinetic_energy([0.1], [0.0]), np.float64)
assert_type(tree.transfer([0.1, 0.0]), Array)
assert_type(tree.transfer([0.1, 0.0], into="d"), np.float64)
assert_type(tree.transfer(motion.y, "angle order 1", into="d"), Array)
assert_type(tree.sector_energies(motion.y, "d"), Array)
assert_type(bp.analysis.average([1.0, 2.0])["mean"], float)
advice = tree.advise([1.0, 0.0], (0, 1))
tree.integrate([1.0, 0.0], (0, 1), **advice.arguments)
values: Mapping[str, Array] = {"l": np.ones(2)}
tree.ensemble([[0.1, 0.0]] * 2, [0.0], parameters=values)
tree.rhs(0.0, motion.y.T, axis=0)
"""

WRONG = [
    'tree.growth([[0.0, 0.0]], "child", [1.0])',
    'tree.identify([0.0], [[0.0]], "m")',
    'tree.identify([0.0], [[0.0]], ["m"], nonnegative="m")',
    'bp.data.read("swing.csv", columns="a")',
    'tree.integrate([0.1, 0.0], (0, 1), "tailor")',
    'tree.energy([0.1, 0.0])[0]',
    'tree.integrate([0.1, 0.0], (0, 1), rtol="1e-9")',
]


def test_types(tmp_path):
    file = tmp_path / "typed.py"
    file.write_text(RIGHT + "\n".join(WRONG) + "\n")
    command = ["mypy", "--strict", "--no-error-summary", "--cache-dir", tmp_path, file]
    done = subprocess.run([sys.executable, "-m", *command], capture_output=True, text=True)
    lines = {int(line) for line in re.findall(r"typed\.py:(\d+): error", done.stdout)}
    first = RIGHT.count("\n") + 1
    assert lines == set(range(first, first + len(WRONG))), done.stdout


# Arrays of packages that need not be installed have no type here.
OF_OTHERS = {"jax.py", "torch.py"}


def test_no_type_is_any():
    for file in Path(bp.__file__).parent.rglob("*.py*"):
        if file.suffix in (".py", ".pyi") and file.name not in OF_OTHERS:
            assert not re.search(r"\bAny\b", file.read_text()), file
