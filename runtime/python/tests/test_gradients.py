"""Derivatives in reverse mode, against differences."""

import numpy as np
import pytest

import branched_pendulum as bp

TEXT = """
gravity = g,
parent(mass = 0.1288, com = 0.084, inertia = 1.88e-3, joint = reach, friction = f) [
    child(mass = m, com = 0.043, inertia = 0.516e-3, friction = f / 10) * 2
],
drive(torque = push * cos(3 * t)),
"""
VALUES = {"g": 9.80665, "reach": 0.27, "f": 1e-3, "m": 0.10531, "push": 0.01}
START = np.array([0.4, -0.3, 0.5, 0.2, 1.0, -0.7])
TIMES = np.linspace(0.0, 3.0, 7)


def tree() -> bp.Tree:
    return bp.Tree(TEXT, **VALUES)


def difference(cost, value: float) -> float:
    """Derivative of order 6."""
    step = 2e-3 * max(abs(value), 1e-3)
    at = [cost(value + k * step) - cost(value - k * step) for k in (1, 2, 3)]
    return (45 * at[0] - 9 * at[1] + at[2]) / (60 * step)


def squares(y):
    """The sum of the squares of all angles, and its derivatives."""
    slopes = np.zeros_like(y)
    slopes[:, :3] = 2 * y[:, :3]
    return (y[:, :3] ** 2).sum(), slopes


def run(values: dict[str, float], start=START) -> float:
    motion = bp.Tree(TEXT, **values).integrate(start, TIMES, method="dop853", rtol=1e-13)
    return squares(motion.y)[0]


def test_accelerations_have_slopes():
    rng = np.random.default_rng(3)
    theta, omega, weights, torques = rng.normal(size=(4, 2, 3))
    found = tree().pullback(theta, omega, weights, time=0.7, torques=torques)
    assert found.theta.shape == found.torques.shape == (2, 3)

    def total(angle: float) -> float:
        changed = theta.copy()
        changed[1, 2] = angle
        alpha = tree().accelerations(changed, omega, time=0.7, torques=torques)
        return float((weights * alpha).sum())

    assert found.theta[1, 2] == pytest.approx(difference(total, theta[1, 2]), rel=1e-7)

    def by_mass(mass: float) -> float:
        alpha = tree().changed(m=mass).accelerations(theta, omega, time=0.7, torques=torques)
        return float((weights * alpha).sum())

    assert found.parameters["m"].shape == (2,)
    expected = difference(by_mass, VALUES["m"])
    assert found.parameters["m"].sum() == pytest.approx(expected, rel=1e-7)


@pytest.mark.parametrize("name", VALUES)
def test_gradients_by_parameters_agree_with_differences(name):
    found = tree().gradient(squares, START, TIMES, rtol=1e-13)
    assert found.cost == pytest.approx(run(VALUES), rel=1e-9)
    expected = difference(lambda value: run({**VALUES, name: value}), VALUES[name])
    assert found.parameters[name] == pytest.approx(expected, rel=1e-6)


def test_gradients_by_the_start_agree_with_differences():
    found = tree().gradient(squares, START, TIMES, parameters=[], rtol=1e-13, method="verner98")
    assert found.parameters == {}
    for index in range(6):

        def moved(value: float, index: int = index) -> float:
            start = START.copy()
            start[index] = value
            return run(VALUES, start)

        assert found.y0[index] == pytest.approx(difference(moved, START[index]), rel=1e-6)


def test_gradients_of_symplectic_steps_agree_with_the_others():
    expected = tree().gradient(squares, START, TIMES, rtol=1e-13)
    found = tree().gradient(squares, START, TIMES, method="gauss8", step=0.01)
    assert np.allclose(found.y0, expected.y0, rtol=1e-7)
    assert found.parameters == pytest.approx(expected.parameters, rel=1e-7)


def test_gradients_of_chaotic_motions_are_doubted():
    released = [2.8, 2.0, 1.0, 0.0, 0.0, 0.0]
    with pytest.warns(UserWarning, match="amplifies small changes"):
        tree().gradient(squares, released, [0.0, 60.0])


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"cost": 3}, "cost must be a callable"),
        ({"cost": lambda y: 3.0}, "a number and an array"),
        ({"cost": lambda y: (1.0, np.zeros((2, 6)))}, r"must have shape \(7, 6\)"),
        ({"parameters": ["mass"]}, "no parameter `mass`; it has g, reach, f, m, push"),
        ({"method": "taylor"}, "`taylor` has no derivatives of motions"),
        ({"y0": [0.0]}, "y0 must have shape"),
        ({"t": []}, "t must have at least one time"),
    ],
)
def test_wrong_requests_are_refused(change, message):
    given = {"cost": squares, "y0": START, "t": TIMES, **change}
    with pytest.raises((KeyError, TypeError, ValueError), match=message):
        tree().gradient(**given)


def test_errors_of_a_cost_are_the_callers():
    def broken(y):
        raise ZeroDivisionError("of the cost")

    with pytest.raises(ZeroDivisionError, match="of the cost"):
        tree().gradient(broken, START, TIMES)


def test_jax_differentiates_motions():
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)
    from branched_pendulum.jax import motion

    states = motion(tree(), TIMES, rtol=1e-12)

    def cost(y0, parameters):
        return (states(y0, parameters)[:, :3] ** 2).sum()

    by_y0, by_name = jax.jit(jax.grad(cost, argnums=(0, 1)))(START, {"m": VALUES["m"]})
    expected = tree().gradient(squares, START, TIMES, rtol=1e-12)
    assert np.allclose(by_y0, expected.y0, rtol=1e-7)
    assert float(by_name["m"]) == pytest.approx(expected.parameters["m"], rel=1e-7)


def test_torch_differentiates_motions():
    torch = pytest.importorskip("torch")
    from branched_pendulum.torch import motion

    y0 = torch.tensor(START, requires_grad=True)
    mass = torch.tensor(VALUES["m"], dtype=torch.float64, requires_grad=True)
    states = motion(tree(), TIMES, rtol=1e-12)
    (states(y0, {"m": mass})[:, :3] ** 2).sum().backward()
    expected = tree().gradient(squares, START, TIMES, rtol=1e-12)
    assert np.allclose(y0.grad, expected.y0, rtol=1e-7)
    assert float(mass.grad) == pytest.approx(expected.parameters["m"], rel=1e-7)
