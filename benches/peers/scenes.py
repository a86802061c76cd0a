"""The scenes of `evaluation-speed`, and the formulation that tools are fed."""

import numpy as np

GRAVITY = 9.80665
NUMBERS = 6000


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


def relative(links, absolute):
    """Angles of links against their parents, of absolute ones; link by link."""
    parents = [link[0] for link in links]
    return np.array(
        [x if p is None else x - absolute[p] for x, p in zip(absolute, parents)]
    )


def absolute(links, relative):
    """Absolute angles of links, of those against their parents; link by link."""
    found = relative.copy()
    for i, link in enumerate(links):
        if link[0] is not None:
            found[i] += found[link[0]]
    return found


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


def eliminated(links, tool):
    """Symbols and accelerations as expressions of a tool, eliminated from the
    leaves up."""
    n = len(links)
    coupling, weight = constants(links)
    theta, omega = tool.variables("t", n), tool.variables("w", n)
    sine, cosine = [tool.sin(t) for t in theta], [tool.cos(t) for t in theta]
    matrix, right = {}, [-(weight[i] * sine[i]) for i in range(n)]
    for (j, i), a in coupling.items():
        if i == j:
            matrix[j, j] = tool.number(a)
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
