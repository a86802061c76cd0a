"""The operations that our emitted code consists of, for another tool to compile."""

import operator
import pathlib
import re
import subprocess
import tempfile
from fractions import Fraction

ROOT = pathlib.Path(__file__).parents[2]

OPERATIONS = {
    "+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv,
}

PAPER = """
parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
    child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
],
"""
TREE = """
tree: generations(count = {}, branching = 2, shape = rod, mass = 0.12, length = 0.3,
    mass_ratio = 0.5, length_ratio = 0.7{}),
"""


def emitted(generations, solve, tool):
    """Symbols and accelerations as expressions of a tool, operation by operation as
    `cargo branched-pendulum stage program` lists them; the paper's pendulum for no generations."""
    tree = PAPER
    if generations is not None:
        # Smaller trees are written out anyway.
        tree = TREE.format(generations, ", code = unrolled" if generations > 6 else "")
    scene = f"#[branched_pendulum(gravity = 9.80665, {tree} solve = {solve})] pub struct Tree;"
    with tempfile.NamedTemporaryFile("w", suffix=".rs") as source:
        source.write(scene)
        source.flush()
        command = [ROOT / "target/release/cargo-branched-pendulum", "stage", "program", source.name]
        ended = subprocess.run(command, capture_output=True, text=True)
    if ended.returncode != 0:
        raise RuntimeError(ended.stderr.strip().splitlines()[0])
    return translate(ended.stdout, tool)


def translate(text, tool):
    body = text[text.index("accelerations(theta, omega)"):].splitlines()[1:]
    values = {}
    for line in text[: text.index("accelerations(theta, omega)")].splitlines():
        if found := re.fullmatch(r"  (k\d+) = .* = (\S+)", line):
            values[found[1]] = float(Fraction(found[2]))
    n = 1 + max(int(i) for i in re.findall(r"theta\[(\d+)\]", text))
    theta, omega = tool.variables("t", n), tool.variables("w", n)
    for line in body:
        line = line.split("    #")[0].strip()
        if found := re.fullmatch(r"(v\d+) = (theta|omega)\[(\d+)\]", line):
            values[found[1]] = (theta if found[2] == "theta" else omega)[int(found[3])]
        elif found := re.fullmatch(r"(v\d+) = (sin|cos) (v\d+)", line):
            turn = tool.sin if found[2] == "sin" else tool.cos
            values[found[1]] = turn(values[found[3]])
        elif found := re.fullmatch(r"(v\d+) = (\S+) ([-+*/]) (\S+)", line):
            values[found[1]] = OPERATIONS[found[3]](values[found[2]], values[found[4]])
        elif found := re.fullmatch(r"(v\d+) = -(v\d+)", line):
            values[found[1]] = -values[found[2]]
        elif found := re.fullmatch(r"(v\d+) = (k\d+) \(.*\)", line):
            values[found[1]] = values[found[2]]
        elif found := re.fullmatch(r"(v\d+) = (-?[\d./]+)", line):
            values[found[1]] = float(Fraction(found[2]))
        elif line.startswith("-> "):
            return theta + omega, [values[name] for name in line.split()[1:]]
        elif line:
            raise ValueError(f"an operation that is not known here: {line}")
    raise ValueError("no line of results")
