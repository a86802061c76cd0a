"""Parameters for given targets."""

import numpy as np
import pytest

import branched_pendulum as bp

TEXT = """
gravity = 9.80665,
parent(mass = 0.1288, com = 0.084, inertia = 1.88e-3, joint = joint) [
    child(mass = 0.10531, com = com, inertia = 0.516e-3) * 2
],
"""
PAIR = ("child_1", "child_2")


def tree() -> bp.Tree:
    return bp.Tree(TEXT, joint=0.27, com=0.043)


def test_frequency_of_a_difference_is_that_of_the_child_alone():
    found = tree().design({"com": (0.042, 0.06)}, {"f_d": 1.26}, PAIR)
    com = found.parameters["com"]
    moment = 0.516e-3 + 0.10531 * com**2
    expected = np.sqrt(9.80665 * 0.10531 * com / moment) / (2 * np.pi)
    assert expected == pytest.approx(1.26, rel=1e-6)
    assert found.reached
    assert found.tree.parameters == {"joint": 0.27, "com": com}
    assert found.errors == {"f_d": None}


def test_differences_grow_from_the_threshold_on():
    found = tree().design({"joint": (0.25, 0.32)}, {"threshold": 24.0}, PAIR, degree=10)
    assert found.reached and found.errors["threshold"] < 0.1
    starts = np.zeros((2, 6))
    starts[:, 0] = np.radians([23.5, 24.6])
    grown = found.tree.growth(starts, PAIR, [200.0]).factors[:, 0]
    assert grown[0] < 50 < grown[1]


def test_targets_out_of_reach_name_the_bound():
    found = tree().design({"com": (0.042, 0.05)}, {"f_d": (1.32, None)}, PAIR)
    assert not found.reached
    assert found.cause is not None and "`com` is held at" in found.cause


@pytest.mark.parametrize(
    ("vary", "targets", "message"),
    [
        ({"mass": (0.1, 0.2)}, {"f_d": 1.2}, "no parameter is called `mass`"),
        ({"com": (0.1, 0.05)}, {"f_d": 1.2}, "bounds must be finite and ascending"),
        ({"com": (0.04, 0.05)}, {"f_x": 1.2}, "no quantity is called `f_x`"),
        ({"com": (0.04, 0.05)}, {"f_d": "1.2"}, r"targets\[\"f_d\"\] must be a number"),
        ({"com": 0.04}, {"f_d": 1.2}, "2 numbers"),
        ({"com": (0.04, 0.05)}, ["f_d"], "targets must be a dict"),
        ({"com": (0.04, 0.05)}, {"f_d": (1.1, 1.3)}, "a number, or a limit"),
    ],
)
def test_wrong_requests_are_refused(vary, targets, message):
    with pytest.raises((TypeError, ValueError), match=message):
        tree().design(vary, targets, PAIR)


def test_a_release_out_of_phase_is_refused():
    release = [0.5, 0.1, 0.2, 0, 0, 0]
    with pytest.raises(ValueError, match="copies that start in phase"):
        tree().design({"com": (0.04, 0.05)}, {"growth": 0.05}, PAIR, y0=release)
