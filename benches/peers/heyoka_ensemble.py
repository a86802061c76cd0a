"""Trajectories a second of heyoka's batch integrator, on the starts of
`cargo bench -- ensembles`: the lanes of one register at a time, refilled in
blocks, on one thread."""

import time

import heyoka as hy
import numpy as np

from heyoka_batch import Symbolic
from scenes import eliminated, paper

COUNT = 10_000
END = 10.0
TOLERANCE = 1e-9
REPEATS = 3


def main():
    variables, outputs = eliminated(paper(), Symbolic)
    n = len(outputs)
    system = list(zip(variables, variables[n:] + outputs))
    starts = np.zeros((2 * n, COUNT))
    starts[0] = np.radians(np.linspace(40.0, 55.0, COUNT))
    starts[1], starts[2] = 1e-3, -1e-3
    print(f"heyoka {hy.__version__}: {COUNT} starts, {END:.0f} s, tolerance {TOLERANCE:g}")
    for size in sorted({2, 4, hy.recommended_simd_size()}):
        integrate = hy.taylor_adaptive_batch(system, starts[:, :size].copy(), tol=TOLERANCE)
        best = np.inf
        for _ in range(REPEATS):
            clock = time.perf_counter()
            for first in range(0, COUNT, size):
                integrate.set_time(0.0)
                integrate.state[:] = starts[:, first : first + size]
                integrate.propagate_until(END)
            best = min(best, time.perf_counter() - clock)
        print(f"{size} lanes {COUNT / best:9.0f} trajectories/s")


if __name__ == "__main__":
    main()
