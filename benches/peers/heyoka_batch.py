"""Times of heyoka's compiled functions for the scenes of `evaluation-speed`."""

import statistics
import time

import heyoka as hy
import numpy as np

from scenes import NUMBERS, dense, eliminated, paper, tree

REPEATS = 301


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


def main():
    print(f"heyoka {hy.__version__}; median ns for one state in a batch")
    print(f"{'links':>6} {'accelerations':>14} {'sines, cosines':>15} {'largest error':>14}")
    random = np.random.default_rng(1)
    for links in (paper(), tree(3), tree(4), tree(5)):
        n = len(links)
        states = (NUMBERS // n + 15) // 16 * 16
        variables, outputs = eliminated(links, Symbolic)
        function = hy.cfunc(outputs, variables, compact_mode=False)
        theta = random.uniform(-np.pi, np.pi, (n, states))
        omega = random.uniform(-9, 9, (n, states))
        inputs = np.ascontiguousarray(np.concatenate([theta, omega]))
        found = np.empty((n, states))
        function(inputs=inputs, outputs=found)
        expected = np.array([dense(links, theta[:, i], omega[:, i]) for i in range(32)]).T
        error = np.max(np.abs(found[:, :32] - expected)) / np.max(np.abs(expected))
        assert error < 1e-10, error
        ours = median_ns(lambda: function(inputs=inputs, outputs=found), states)
        angles = variables[:n]
        both = hy.cfunc([f(t) for t in angles for f in (hy.sin, hy.cos)], angles)
        turned, out = np.ascontiguousarray(theta), np.empty((2 * n, states))
        sines = median_ns(lambda: both(inputs=turned, outputs=out), states)
        print(f"{n:6} {ours:14.2f} {sines:15.2f} {error:14.1e}", flush=True)


if __name__ == "__main__":
    main()
