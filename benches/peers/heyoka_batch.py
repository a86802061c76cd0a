"""Times of heyoka's compiled functions for the scenes of `evaluation-speed`."""

import statistics
import time

import heyoka as hy
import numpy as np

GRAVITY = 9.80665
NUMBERS = 6144
REPEATS = 301


def paper():
    """Links as (parent, mass, com, inertia, lever)."""
    child = (0, 0.10531, 0.043, 0.516e-3, 0.27)
    return [(None, 0.12880, 0.084, 1.88e-3, 0.0), child, child]


def tree(generations):
    links = []

    def grow(parent, left, mass, length, lever):
        if left == 0:
            return
        index = len(links)
        links.append((parent, mass, length / 2, mass * length**2 / 12, lever))
        for _ in range(2):
            grow(index, left - 1, mass * 0.5, length * 0.7, length)

    grow(None, generations, 0.12, 0.3, 0.0)
    return links


def constants(links):
    """Couplings A_ij and weights G_i: docs/physics.md, section 1."""
    n = len(links)
    subtree = [link[1] for link in links]
    moment = [link[1] * link[2] for link in links]
    coupling = {(i, i): link[3] + link[1] * link[2] ** 2 for i, link in enumerate(links)}
    for i in reversed(range(n)):
        parent, lever = links[i][0], links[i][4]
        if parent is not None:
            subtree[parent] += subtree[i]
            moment[parent] += lever * subtree[i]
            coupling[parent, parent] += lever**2 * subtree[i]
    for j in range(n):
        below = j
        while (above := links[below][0]) is not None:
            coupling[j, above] = links[below][4] * moment[j]
            below = above
    return coupling, [GRAVITY * m for m in moment]


def accelerations(links):
    """Expressions of the accelerations, eliminated from the leaves up."""
    n = len(links)
    coupling, weight = constants(links)
    theta = [hy.make_vars(f"t{i}") for i in range(n)]
    omega = [hy.make_vars(f"w{i}") for i in range(n)]
    sine, cosine = [hy.sin(t) for t in theta], [hy.cos(t) for t in theta]
    matrix, right = {}, [-(weight[i] * sine[i]) for i in range(n)]
    for (j, i), a in coupling.items():
        if i == j:
            matrix[j, j] = hy.expression(a)
            continue
        matrix[j, i] = a * (cosine[j] * cosine[i] + sine[j] * sine[i])
        turned = a * (sine[j] * cosine[i] - cosine[j] * sine[i])
        right[j] = right[j] - turned * (omega[i] * omega[i])
        right[i] = right[i] + turned * (omega[j] * omega[j])
    ratio = {}
    for k in reversed(range(n)):
        inverse = 1.0 / matrix[k, k]
        row = [i for i in range(k) if (k, i) in matrix]
        for i in row:
            ratio[k, i] = matrix[k, i] * inverse
            for j in row:
                if j <= i:
                    matrix[i, j] = matrix[i, j] - ratio[k, i] * matrix[k, j]
            right[i] = right[i] - ratio[k, i] * right[k]
        right[k] = right[k] * inverse
    for k in range(n):
        for i in range(k):
            if (k, i) in ratio:
                right[k] = right[k] - ratio[k, i] * right[i]
    return theta + omega, right


def dense(links, theta, omega):
    n = len(links)
    coupling, weight = constants(links)
    a = np.zeros((n, n))
    for (j, i), value in coupling.items():
        a[i, j] = a[j, i] = value
    difference = theta[:, None] - theta[None, :]
    bias = (a * np.sin(difference)) @ omega**2 + np.array(weight) * np.sin(theta)
    return np.linalg.solve(a * np.cos(difference), -bias)


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
        variables, outputs = accelerations(links)
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
