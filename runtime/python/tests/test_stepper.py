"""Motion step by step, under torques that are functions of the state."""

import gc
import weakref

import branched_pendulum as bp
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from test_tree import PAPER, START

ROD = "gravity = 9.81, rod: rod(mass = 1, length = 1, drag = c)"


@pytest.fixture(scope="module")
def tree():
    return bp.Tree(PAPER, m=0.10531)


def test_torques_of_the_state_are_drag():
    free, dragged = bp.Tree(ROD, c=0.0), bp.Tree(ROD, c=0.3)
    stepper = free.stepper([2.0, 1.0], torques=lambda t, y: [-0.3 * y[1]], rtol=1e-12)
    expected = dragged.integrate([2.0, 1.0], np.linspace(0, 3, 4), rtol=1e-12).y
    for y in expected[1:]:
        np.testing.assert_allclose(stepper.advance(1.0), y, atol=1e-10)
    assert stepper.t == 3.0 and stepper.report.accepted > 10


def test_torques_of_time_and_state_against_scipy(tree):
    def torques(t, y):
        return [0.02 * np.cos(3 * t), -0.01 * y[4] * abs(y[4]), 0.05 * np.sin(y[0])]

    def rates(t, y):
        omega = y[3:]
        return np.concatenate([omega, tree.accelerations(y[:3], omega, torques=torques(t, y))])

    expected = solve_ivp(rates, (0.5, 3), START, "DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
    for method, step in [("dop853", None), ("verner98", None), ("gauss8", 1e-3)]:
        stepper = tree.stepper(START, 0.5, torques=torques, method=method, rtol=1e-12, step=step)
        while stepper.step(until=3.0):
            pass
        assert stepper.t == 3.0
        np.testing.assert_allclose(stepper.y, expected, atol=1e-9)


def test_without_torques_it_is_the_motion_itself(tree):
    stepper = tree.stepper(START, rtol=1e-11)
    while stepper.step(until=2.0):
        pass
    np.testing.assert_allclose(stepper.y, tree.integrate(START, [0, 2], rtol=1e-11).y[-1], atol=1e-9)
    # And back.
    stepper.advance(-2.0)
    np.testing.assert_allclose(stepper.y, START, atol=1e-8)


def test_torques_and_states_change_between_steps():
    rod = bp.Tree(ROD, c=0.0)
    stepper = rod.stepper([0.0, 0.0])
    assert not stepper.advance(1.0).any() and (stepper.torques == 0).all()
    stepper.torques = [0.5]
    assert stepper.torques == 0.5 and stepper.advance(0.1)[0] > 0
    stepper.torques = lambda t, y: -0.5 * np.ones(1)
    stepper.set_state(0.0, [0.0, 0.0])
    # θ = -½ Q/I t² at first, I = 1/3.
    assert stepper.advance(0.01)[0] == pytest.approx(-0.5 * 1.5 * 0.01**2, rel=1e-3)
    stepper.torques = None
    assert stepper.torques == 0
    assert repr(stepper).startswith("Stepper at t = 0.01 s after ")


def test_what_a_function_raises_is_raised():
    rod = bp.Tree(ROD, c=0.0)

    def late(t, y):
        if t > 0.5:
            raise LookupError("no wind")
        return [0.0]

    stepper = rod.stepper([0.1, 0.0], torques=late)
    with pytest.raises(LookupError, match="no wind"):
        stepper.advance(1.0)
    # It goes on from the last good state.
    assert 0 <= stepper.t <= 0.5 and np.isfinite(stepper.y).all()
    stepper.torques = None
    stepper.advance(0.1)
    for torques, error, words in [
        (lambda t, y: [1.0, 2.0], ValueError, r"the value of torques must have shape \(1,\), got \(2,\)"),
        (lambda t, y: "x", TypeError, "the value of torques must be real numbers, got 'x'"),
        (lambda t, y: [np.nan], bp.IntegrationError, "not finite"),
    ]:
        with pytest.raises(error, match=words):
            rod.stepper([0.1, 0.0], torques=torques).advance(1.0)


@pytest.mark.parametrize("named, error, words", [
    ({"torques": [1, 2]}, ValueError, r"torques must have shape \(1,\), got \(2,\)"),
    ({"torques": "x"}, TypeError, r"torques must be a function f\(t, y\) or real numbers, got 'x'"),
    ({"method": "taylor"}, ValueError, "method: torques from outside have no Taylor series"),
    ({"method": "rk4"}, ValueError, "give step="),
    ({"max_steps": 0}, ValueError, "max_steps must be at least 1"),
    ({"t": np.nan}, bp.RequestError, "starting time is NaN"),
    ({"y0": [0.1]}, ValueError, r"y0 must have shape \(2,\), got \(1,\)"),
])
def test_what_is_refused_is_told(named, error, words):
    rod = bp.Tree(ROD, c=0.0)
    with pytest.raises(error, match=words):
        rod.stepper(**{"y0": [0.1, 0.0], **named})


def test_requests_are_checked():
    stepper = bp.Tree(ROD, c=0.0).stepper([0.1, 0.0])
    for call, error, words in [
        (lambda: stepper.advance(np.nan), ValueError, "duration must be a finite time"),
        (lambda: stepper.step(until=np.inf), bp.RequestError, "end time is inf"),
        (lambda: stepper.set_state(0, [1]), ValueError, r"y must have shape \(2,\), got \(1,\)"),
        (lambda: setattr(stepper, "torques", [1, 2]), ValueError, "torques must have shape"),
    ]:
        with pytest.raises(error, match=words):
            call()
    assert stepper.t == 0 and stepper.y[0] == 0.1


class Controller:
    """Holds the stepper whose torques it is."""

    def __init__(self):
        self.stepper = bp.Tree(ROD, c=0.0).stepper([0.1, 0.0], torques=self.law)

    def law(self, t, y):
        return [-0.1 * y[1]]


def _closed_over():
    stepper = bp.Tree(ROD, c=0.0).stepper([0.1, 0.0])
    marker = Marker()
    stepper.torques = lambda t, y: [0.0 * len(repr(marker)) if stepper else 0.0]
    stepper.advance(0.1)
    return marker


def _raised():
    marker = Marker()

    def law(t, y):
        raise LookupError(marker)

    stepper = bp.Tree(ROD, c=0.0).stepper([0.1, 0.0])
    law.stepper = stepper
    stepper.torques = law
    with pytest.raises(LookupError):
        stepper.advance(0.1)
    return marker


def _bound():
    controller = Controller()
    controller.stepper.advance(0.1)
    return controller


class Marker:
    pass


@pytest.mark.parametrize("make", [_bound, _closed_over, _raised])
def test_torques_that_hold_their_stepper_are_freed(make):
    gone = weakref.ref(make())
    gc.collect()
    assert gone() is None


def test_a_stepper_is_freed_with_what_it_holds():
    """Without a look of the collector, and after torques were replaced."""
    gc.disable()
    try:
        for torques in [None, [0.1], lambda t, y: [0.0]]:
            marker = Marker()
            stepper = bp.Tree(ROD, c=0.0).stepper([0.1, 0.0], torques=lambda t, y, kept=marker: [0.0 if kept else 1.0])
            gone = weakref.ref(marker)
            del marker
            stepper.advance(0.1)
            assert gone() is not None
            stepper.torques = torques
            assert gone() is None
    finally:
        gc.enable()


def test_the_collector_runs_while_a_step_is_made():
    stepper = bp.Tree(ROD, c=0.0).stepper([0.1, 0.0])

    def law(t, y):
        gc.collect()
        return [0.0]

    law.stepper = stepper
    stepper.torques = law
    free = bp.Tree(ROD, c=0.0).stepper([0.1, 0.0])
    np.testing.assert_array_equal(stepper.advance(0.5), free.advance(0.5))


def test_torques_that_use_their_stepper_are_told_what_they_have():
    rod = bp.Tree(ROD, c=0.0)
    for use in [
        lambda stepper: stepper.y,
        lambda stepper: stepper.t,
        lambda stepper: stepper.report,
        lambda stepper: stepper.torques,
        lambda stepper: stepper.advance(0.1),
        lambda stepper: stepper.step(),
        lambda stepper: stepper.set_state(0.0, [0.0, 0.0]),
        lambda stepper: setattr(stepper, "torques", None),
        repr,
    ]:
        stepper = rod.stepper([0.1, 0.0])
        stepper.torques = lambda t, y: [0.0 if use(stepper) else 1.0]
        with pytest.raises(RuntimeError, match=r"middle of a step.*torques f\(t, y\) have its time and state"):
            stepper.advance(0.1)
        # It goes on.
        stepper.torques = None
        assert np.isfinite(stepper.advance(0.1)).all()
