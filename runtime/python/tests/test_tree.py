"""The package as its users use it, against SciPy."""

import threading
import time

import branched_pendulum as bp
import numpy as np
import pytest
from scipy.integrate import solve_ivp

PAPER = """
gravity = 9.80665,
parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
    child(mass = m, com = 0.043, inertia = 0.516e-3) * 2
]
"""
START = np.array([0.83, 0.02, -0.01, 0.0, 0.1, 0.0])


@pytest.fixture
def tree():
    return bp.Tree(PAPER, m=0.10531)


def accelerations(theta, omega):
    """The equations of the paper's tree by hand: closed form, dense solve."""
    g, m1, d1, i1, l, m2, d2, i2 = 9.80665, 0.12880, 0.084, 1.88e-3, 0.27, 0.10531, 0.043, 0.516e-3
    big, small, mu = i1 + m1 * d1**2 + 2 * m2 * l**2, i2 + m2 * d2**2, m2 * d2 * l
    h = [m1 * d1 + 2 * m2 * l, m2 * d2, m2 * d2]
    mass, bias = np.diag([big, small, small]), g * np.array(h) * np.sin(theta)
    for j in (1, 2):
        c, s = np.cos(theta[0] - theta[j]), np.sin(theta[0] - theta[j])
        mass[0, j] = mass[j, 0] = mu * c
        bias[0] += mu * s * omega[j] ** 2
        bias[j] -= mu * s * omega[0] ** 2
    return mass, np.linalg.solve(mass, -bias)


def test_equations(tree):
    rng = np.random.default_rng(1)
    for _ in range(100):
        theta, omega = rng.uniform(-3, 3, 3), rng.uniform(-9, 9, 3)
        mass, alpha = accelerations(theta, omega)
        np.testing.assert_allclose(tree.accelerations(theta, omega), alpha, rtol=1e-10, atol=1e-10)
        np.testing.assert_allclose(tree.mass_matrix(theta), mass, atol=1e-16)
        np.testing.assert_allclose(tree.momenta(theta, omega), mass @ omega, atol=1e-15)
        np.testing.assert_allclose(tree.kinetic_energy(theta, omega), omega @ mass @ omega / 2)
    assert tree.names == ["parent", "child_1", "child_2"] and len(tree) == 3
    assert tree.parameters == {"m": 0.10531}


def test_motion_against_scipy(tree):
    t = np.linspace(0, 5, 501)
    begin = time.perf_counter()
    own = tree.integrate(START, t, rtol=1e-12, atol=1e-12)
    middle = time.perf_counter()
    other = solve_ivp(tree.rhs, (0, 5), START, "DOP853", t, rtol=1e-12, atol=1e-12)
    end = time.perf_counter()
    print(f"{middle - begin:.2e} s, SciPy with the same equations {end - middle:.2e} s")
    np.testing.assert_allclose(own.y, other.y.T, atol=1e-7)
    np.testing.assert_array_equal(own.t, t)
    assert own.steps > 10 and own.evaluations > 100 and own.report.startswith("end reached")
    energy = tree.energy(own.y)
    assert np.ptp(energy) < 1e-11 * energy[0]


@pytest.mark.parametrize("method", ["dop853", "dopri5", "verner98"])
def test_ensembles(tree, method):
    starts = START * np.linspace(0.9, 1.1, 13)[:, None]
    t = np.linspace(0, 1, 11)
    all_of_them = tree.ensemble(starts, t, method=method, rtol=1e-10, threads=2)
    assert all_of_them.shape == (13, 11, 6)
    for start, own in zip(starts, all_of_them):
        alone = tree.integrate(start, t, method=method, rtol=1e-10)
        np.testing.assert_allclose(own, alone.y, atol=1e-7)


def test_modes_and_points(tree):
    frequencies, shapes = tree.modes()
    assert frequencies.shape == (3,) and shapes.shape == (3, 3)
    theta = np.zeros(3)
    mass, stiffness = tree.mass_matrix(theta), tree.stiffness_matrix(theta)
    for frequency, shape in zip(frequencies, shapes):
        np.testing.assert_allclose(
            stiffness @ shape, (2 * np.pi * frequency) ** 2 * mass @ shape, atol=1e-12
        )
    np.testing.assert_allclose(tree.points(theta)[0], [0.0, -0.27], atol=1e-16)


def test_mistakes():
    with pytest.raises(bp.DescriptionError) as error:
        bp.Tree("gravity = 9.81,\nrod: rod(mas = 1, length = 1)")
    assert "--> 2:10" in str(error.value) and "did you mean `mass`?" in str(error.value)
    with pytest.raises(ValueError, match="no value for `m`"):
        bp.Tree(PAPER)
    with pytest.raises(ValueError, match="mass of `child` is -1, must be zero or positive"):
        bp.Tree(PAPER, m=-1)
    tree = bp.Tree(PAPER, m=0.1)
    assert tree.changed(m=0.2).parameters == {"m": 0.2}
    with pytest.raises(KeyError, match="no parameter `n`"):
        tree.changed(n=1)
    with pytest.raises(ValueError, match="y0 has 3 numbers, must have 6"):
        tree.integrate(np.zeros(3), np.linspace(0, 1, 3))
    with pytest.raises(ValueError, match="unknown method `euler`"):
        tree.integrate(START, np.linspace(0, 1, 3), method="euler")
    with pytest.raises(bp.IntegrationError):
        tree.integrate(START * np.nan, np.linspace(0, 1, 3))


def test_other_threads_run(tree):
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(1e-3)

    thread = threading.Thread(target=tick)
    thread.start()
    begin = time.perf_counter()
    tree.integrate(START, np.linspace(0, 300, 3), rtol=1e-13)
    end = time.perf_counter()
    done.set()
    thread.join()
    assert sum(begin < tick < end for tick in ticks) >= 3 or end - begin < 0.02
