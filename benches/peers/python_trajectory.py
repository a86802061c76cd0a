"""The Python package beside heyoka.py in one run: one motion at equal error, 10,000 starts, and
growth beside its own ensemble.

Needs `branched_pendulum` and `heyoka` in one environment. Ten seconds of the paper's pendulum
from 47.8 degrees; errors are those of the state at the end against heyoka's own solution in
extended precision. The least of many repeats counts; errors grow some 1e6 times on this motion.
Of the ensembles processor time counts, which other programs change less than wall time.
"""

import time

import branched_pendulum as bp
import heyoka as hy
import numpy as np

from heyoka_batch import Symbolic
from heyoka_trajectory import integrator
from scenes import eliminated, paper

END = 10.0
START = [np.radians(47.8), 1e-3, -1e-3, 0.0, 0.0, 0.0]
ERRORS = [1e-4, 1e-6, 1e-8]
REPEATS = 15
TOLERANCES = 10.0 ** (-np.arange(15, 49) / 3)


def system():
    variables, outputs = eliminated(paper(), Symbolic)
    return list(zip(variables, variables[3:] + outputs))


def least(function):
    best = np.inf
    for _ in range(REPEATS):
        clock = time.perf_counter()
        result = function()
        best = min(best, time.perf_counter() - clock)
    return best, result


def with_heyoka(equations, tolerance):
    taylor = integrator(equations, START[:3], tolerance)

    def run():
        taylor.time = 0.0
        taylor.state[:] = START
        taylor.propagate_until(END)
        return taylor.state.copy()

    return run


def exact(equations):
    state = [np.longdouble(x) for x in START]
    taylor = hy.taylor_adaptive(equations, state, tol=np.longdouble(1e-19), fp_type=np.longdouble)
    taylor.propagate_until(np.longdouble(END))
    return taylor.state.astype(float)


def one_motion(equations, tree):
    expected = exact(equations)
    ways = {
        "heyoka": lambda tolerance: with_heyoka(equations, tolerance),
        "Tree, taylor": lambda tolerance: lambda: tree.integrate(
            START, [0.0, END], "taylor", rtol=tolerance
        ).y[-1],
        "Tree, dop853": lambda tolerance: lambda: tree.integrate(
            START, [0.0, END], "dop853", rtol=tolerance
        ).y[-1],
    }
    print(f"{'microseconds to an error of':30}" + "".join(f"{error:9.0e}" for error in ERRORS))
    for name, way in ways.items():
        points = []
        for tolerance in TOLERANCES:
            try:
                seconds, state = least(way(tolerance))
            except bp.RequestError:
                # Below the rounding of its numbers.
                break
            points.append((np.abs(state - expected).max(), 1e6 * seconds))
        reached = [min((t for e, t in points if e <= error), default=np.nan) for error in ERRORS]
        print(f"{name:30}" + "".join(f"{micros:9.0f}" for micros in reached))


def many_motions(equations, tree, threads):
    """The median error is that against the same tool far below it."""
    starts = np.zeros((10_000, 6))
    starts[:, 0] = np.radians(np.linspace(40, 50, len(starts)))
    starts[:, 1:3] = [1e-3, -1e-3]
    t = [0.0, END]
    best = tree.ensemble(starts, t, "taylor", rtol=1e-16)[:, -1]
    print(f"10,000 starts, {threads} threads{'':10} processor s    wall s   median error")
    for method, rtol in [("taylor", 1e-10), ("taylor", 1e-11), ("dop853", 1e-11), ("verner98", 1e-11)]:
        clock, work = time.perf_counter(), time.process_time()
        ends = tree.ensemble(starts, t, method, rtol=rtol, threads=threads)[:, -1]
        seconds, work = time.perf_counter() - clock, time.process_time() - work
        error = np.median(np.abs(ends - best).max(axis=1))
        print(f"{f'Tree, {method} at {rtol:.0e}':30}{work:14.3f}{seconds:10.3f}{error:15.1e}")
    lanes = 8
    for tolerance in [1e-9, 1e-10]:
        taylor = hy.taylor_adaptive_batch(equations, np.zeros((6, lanes)), tol=tolerance)

        def begin(batch, index):
            batch.set_time(0.0)
            batch.state[:] = starts[index * lanes : (index + 1) * lanes].T
            return batch

        clock, work = time.perf_counter(), time.process_time()
        done = hy.ensemble_propagate_until_batch(taylor, END, len(starts) // lanes, begin)
        seconds, work = time.perf_counter() - clock, time.process_time() - work
        ends = np.concatenate([batch.state.T for batch, *_ in done])
        error = np.median(np.abs(ends - best).max(axis=1))
        print(f"{f'heyoka, batch at {tolerance:.0e}':30}{work:14.3f}{seconds:10.3f}{error:15.1e}")


def growth(tree):
    """Growth is computed at two tolerances, the ensemble at the coarser one. Medians of five."""
    starts = np.zeros((851, 6))
    starts[:, 0] = np.radians(np.linspace(5, 90, len(starts)))
    times = np.linspace(0, END, 404)

    def seconds(function):
        clock = time.process_time()
        function()
        return time.process_time() - clock

    pairs = [
        (
            seconds(lambda: tree.growth(starts, ("child_1", "child_2"), [END], rtol=1e-9)),
            seconds(lambda: tree.ensemble(starts, times, rtol=1e-9)),
        )
        for _ in range(5)
    ]
    ratio = np.median([grown / sampled for grown, sampled in pairs])
    print(f"growth of {len(starts)} releases over their ensemble at one tolerance: {ratio:.2f}")


def main():
    equations, tree = system(), bp.Tree(bp.examples.PAPER, friction=0)
    print(f"heyoka {hy.__version__}, branched_pendulum {bp.__version__}")
    one_motion(equations, tree)
    many_motions(equations, tree, 2)
    growth(tree)


if __name__ == "__main__":
    main()
