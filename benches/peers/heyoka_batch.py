"""Times of heyoka's compiled functions for the scenes of `evaluation-speed`: batches
in SIMD vectors, and one state after the other.

The same function runs up to twice as fast in one process as in the next. Each is
measured in several, and the least of their medians counts.
"""

import json
import statistics
import subprocess
import sys
import time

import heyoka as hy
import numpy as np

from program import emitted
from scenes import NUMBERS, dense, eliminated, paper, tree

REPEATS = 201
PROCESSES = 5
# Generations of the full binary trees; none for the paper's pendulum. Functions of
# the larger ones take minutes to compile unless heyoka's compact mode is on.
SCENES = [None, 3, 4, 5, 7, 10]
COMPACT = 10


class Symbolic:
    """What the formulation of `scenes` needs of a tool, in heyoka's terms."""

    variables = staticmethod(lambda name, n: [hy.make_vars(f"{name}{i}") for i in range(n)])
    number = staticmethod(hy.expression)
    sin = staticmethod(hy.sin)
    cos = staticmethod(hy.cos)


def median_ns(function, states):
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        function()
        times.append(time.perf_counter() - start)
    return statistics.median(times) * 1e9 / states


def formulations(generations):
    """Eliminated along the tree, and our recursion operation by operation; only the
    latter where the former has many times its operations."""
    links = paper() if generations is None else tree(generations)
    if len(links) <= 31:
        yield links, *eliminated(links, Symbolic)
    yield links, *emitted(generations, "recursion", Symbolic)


def measure(generations):
    """Least medians, ns a state: batch, one state, sines and cosines; largest error."""
    random = np.random.default_rng(1)
    compact = generations is not None and generations >= COMPACT
    found, worst = [], 0.0
    for links, variables, outputs in formulations(generations):
        n = len(links)
        states = (NUMBERS // n + 15) // 16 * 16
        inputs = np.concatenate(
            [random.uniform(-np.pi, np.pi, (n, states)), random.uniform(-9, 9, (n, states))]
        )
        results = np.empty((n, states))
        checked = range(8 if n < 1000 else 2)
        expected = np.array([dense(links, *np.split(inputs[:, i], 2)) for i in checked]).T
        times = []
        for options in [{}, {"batch_size": 1}]:
            function = hy.cfunc(outputs, variables, compact_mode=compact, **options)
            function(inputs=inputs, outputs=results)
            error = np.max(np.abs(results[:, checked] - expected)) / np.max(np.abs(expected))
            assert error < 1e-8, error
            worst = max(worst, error)
            times.append(median_ns(lambda: function(inputs=inputs, outputs=results), states))
        angles = variables[:n]
        both = hy.cfunc([f(t) for t in angles for f in (hy.sin, hy.cos)], angles, compact_mode=compact)
        turned, out = np.ascontiguousarray(inputs[:n]), np.empty((2 * n, states))
        times.append(median_ns(lambda: both(inputs=turned, outputs=out), states))
        found.append(times)
    return [min(column) for column in zip(*found)] + [worst]


def main():
    print(f"heyoka {hy.__version__}; ns for one state, least median of {PROCESSES} processes")
    print(f"{'links':>6} {'batch':>9} {'one state':>10} {'sines, cosines':>15} {'largest error':>14}")
    for generations in SCENES:
        command = [sys.executable, __file__, json.dumps(generations)]
        n = 3 if generations is None else 2**generations - 1
        runs = []
        for _ in range(PROCESSES):
            ended = subprocess.run(command, capture_output=True, text=True)
            if ended.returncode != 0:
                break
            runs.append(json.loads(ended.stdout))
        if ended.returncode != 0:
            # heyoka, or the check against a dense solve, cannot take the scene: the row says why.
            reason = ended.stderr.strip().splitlines()[-1:] or [f"exit code {ended.returncode}"]
            print(f"{n:6} not measured: {reason[0]}", flush=True)
            continue
        batch, one, sines, error = (
            choose(column) for choose, column in zip([min, min, min, max], zip(*runs))
        )
        print(f"{n:6} {batch:9.2f} {one:10.2f} {sines:15.2f} {error:14.1e}", flush=True)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        print(json.dumps(measure(json.loads(sys.argv[1]))))
    else:
        main()
