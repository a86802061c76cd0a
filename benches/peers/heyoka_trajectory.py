"""Times of heyoka's Taylor integrator for the motions of `work-precision`."""

import json
import pathlib
import time

import heyoka as hy
import numpy as np

from heyoka_batch import Symbolic
from scenes import eliminated, paper, tree

END = 10.0
ERRORS = [1e-3, 1e-6, 1e-9, 1e-12, 1e-14]
REPEATS = 25
REFERENCE = pathlib.Path(__file__).parents[2] / "tests/fixtures/reference/trajectories.json"


def committed(problem):
    state = json.loads(REFERENCE.read_text())["problems"][problem]["t"]["10"]
    return np.array([float(x) for x in state["theta"] + state["omega"]])


def time_for(points, error):
    """Time to an error, interpolated on logarithmic scales like that of `work-precision`."""
    before = None
    for found, micros in points:
        if found <= error:
            if before is None or found == 0:
                return micros
            part = np.log(before[0] / error) / np.log(before[0] / found)
            return before[1] * (micros / before[1]) ** part
        before = (found, micros)
    return None


def integrator(system, start, tolerance):
    return hy.taylor_adaptive(system, list(start) + [0.0] * len(start), tol=tolerance)


def measure(name, links, start, expected):
    variables, outputs = eliminated(links, Symbolic)
    n = len(links)
    rates = variables[n:] + outputs
    system = list(zip(variables, rates))
    if expected is None:
        # In extended precision, 18 digits.
        state = [np.longdouble(x) for x in start] + [np.longdouble(0)] * n
        exact = hy.taylor_adaptive(system, state, tol=np.longdouble(1e-19), fp_type=np.longdouble)
        exact.propagate_until(np.longdouble(END))
        expected = exact.state.astype(float)
    points = []
    for third in range(6, 47):
        integrate = integrator(system, start, 10.0 ** (-third / 3))
        initial = integrate.state.copy()
        best = np.inf
        for _ in range(REPEATS):
            integrate.time = 0.0
            integrate.state[:] = initial
            clock = time.perf_counter()
            integrate.propagate_until(END)
            best = min(best, time.perf_counter() - clock)
        points.append((np.max(np.abs(integrate.state - expected)), best * 1e6))
    cells = []
    for error in ERRORS:
        micros = time_for(points, error)
        cells.append(f"{'-':>9}" if micros is None else f"{micros:9.0f}")
    print(f"{name:28}" + "".join(cells))


def main():
    print(f"heyoka {hy.__version__}: microseconds for {END:.0f} s")
    print(f"{'error':28}" + "".join(f"{error:9.0e}" for error in ERRORS))
    measure("regular", paper(), [0.3, 1e-3, -1e-3], committed("regular"))
    start = [np.radians(47.8), 1e-3, -1e-3]
    measure("near threshold", paper(), start, committed("near-threshold"))
    rods = [0.08, 0.005, 0.002, -0.001, -0.005, 0.0015, -0.003]
    measure("seven rods", tree(3), rods, None)


if __name__ == "__main__":
    main()
