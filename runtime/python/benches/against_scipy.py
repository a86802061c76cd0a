"""How many times faster than SciPy's DOP853 `Tree.integrate` is, with the same equations.

`target/venv/bin/python benches/against_scipy.py [rounds]`, after `./test.sh`. Times are the
processor's, without what else the machine computes; both go in turn, so that this slows both
alike, and every round has a ratio of its own.
"""

import statistics
import sys
import time

import branched_pendulum as bp
import numpy as np
from scipy.integrate import solve_ivp

TREE = """
gravity = 9.80665,
parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
    child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
]
"""
START = np.array([0.83, 0.02, -0.01, 0.0, 0.1, 0.0])
TIMES = np.linspace(0, 10, 1001)
TOLERANCES = {"rtol": 1e-10, "atol": 1e-10}
# Runs of ours in one round, which take as long as one or two of SciPy's.
REPETITIONS = 50


def seconds(run):
    begin = time.process_time()
    run()
    return time.process_time() - begin


def main():
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    tree = bp.Tree(TREE)

    def ours():
        return tree.integrate(START, TIMES, **TOLERANCES)

    def theirs():
        return solve_ivp(tree.rhs, (0, 10), START, "DOP853", TIMES, **TOLERANCES)

    spans = [(min(seconds(ours) for _ in range(REPETITIONS)), seconds(theirs)) for _ in range(rounds)]
    ratios = [other / own for own, other in spans]
    own, other = (min(column) for column in zip(*spans))
    print(f"least of {rounds} rounds: {own * 1e3:.3f} ms, SciPy {other * 1e3:.1f} ms: {other / own:.0f} times")
    print(f"round by round: median {statistics.median(ratios):.0f} times, least {min(ratios):.0f}")


if __name__ == "__main__":
    main()
