"""Advice, against motions that are followed by its words."""

import branched_pendulum as bp
import numpy as np
import pytest

from test_tree import PAPER, START


@pytest.fixture(scope="module")
def tree():
    return bp.Tree(PAPER, m=0.10531)


def test_what_is_chosen_is_right_and_what_is_cheaper_is_not(tree):
    t = np.linspace(0, 5, 51)
    advice = tree.advise(START, t, {"angles": 1e-7})
    chosen = advice.choice
    assert chosen.is_right and chosen.model == "full" and chosen.ratio <= 1 and chosen.unit == "rad"
    # By another method, far below the tolerance.
    exact = tree.integrate(START, t, "verner98", rtol=1e-14).y[:, :3]
    followed = tree.integrate(START, t, **advice.arguments).y[:, :3]
    assert 0 < np.abs(followed - exact).max() < 1e-7
    if chosen.scalar == "f64":
        assert advice.arguments == chosen.arguments
        error = np.abs(followed - exact)[np.searchsorted(t, chosen.time)].max()
        assert chosen.error == pytest.approx(error, rel=0.05)
    if advice.next_cheaper is not None:
        assert not advice.next_cheaper.is_right and advice.next_cheaper.seconds < chosen.seconds
    # As the words say.
    assert f"take: {chosen.words}" in str(advice) and chosen.words in repr(advice)
    assert f"{advice.arguments['method']}" in str(advice).split("write:")[1]
    assert advice.outputs["angles"]["tolerance"] == 1e-7
    assert advice.outputs["angles"]["reference_error"] < 1e-9
    assert advice.outputs["angles"]["known_until"] is None


def test_the_ranking_has_each_candidate_once(tree):
    advice = tree.advise(START, (0, 2), {"energy": 1e-6, "transfer": 1e-5})
    names = [(run.model, run.method, run.scalar, run.in_lanes) for run in advice.ranking]
    assert len(set(names)) == len(names) == len({name for name in names})
    right = [run.is_right for run in advice.ranking]
    assert right == sorted(right, reverse=True) and right[0]
    costs = [run.seconds for run in advice.ranking if run.is_right]
    errors = [run.ratio for run in advice.ranking if not run.is_right]
    assert costs == sorted(costs) and errors == sorted(errors)
    assert advice.ranking[0] == advice.choice
    frame = advice.frame()
    assert len(frame) == len(names) and frame["ratio"].iloc[0] == advice.choice.ratio


def test_a_small_swing_is_linear_and_a_large_one_is_not():
    rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
    frames = np.arange(601) / 60
    small = rod.advise([1e-5, 0.0], frames, {"angles": 1e-9})
    linear = [run for run in small.ranking if run.model == "linear" and run.scalar == "f64"]
    # The period grows by θ²/16.
    assert linear[0].is_right and 0 < linear[0].error < 1e-9 and linear[0].arguments is None
    large = rod.advise([1.0, 0.0], frames, {"angles": 1e-3})
    assert not any(run.is_right for run in large.ranking if run.model == "linear")
    # Uneven times have no frames.
    uneven = rod.advise([1e-5, 0.0], [0.0, 0.1, 0.3])
    assert all(run.model == "full" for run in uneven.ranking)


def test_several_starts_go_in_lanes(tree):
    starts = np.tile(START, (2, 4, 1))
    advice = tree.advise(starts, (0, 1), {"angles": 1e-6})
    assert any(run.in_lanes for run in advice.ranking)
    assert not any(run.in_lanes for run in tree.advise(START, (0, 1)).ranking)


def test_chaos_is_told(tree):
    advice = tree.advise([2.5, 1.0, 1.01, 0, 0, 0], np.linspace(0, 60, 241), {"angles": 1e-6})
    assert 0 < advice.outputs["angles"]["known_until"] < 60 and advice.growth > 0
    assert advice.choice is None or advice.choice.criterion in {"values", "conserved"}


def test_limits_of_time_leave_nothing(tree):
    advice = tree.advise(START, (0, 1), sample_limit=1e-12)
    assert advice.choice is None and advice.runner_up.is_right and "too slow" in str(advice)
    with pytest.raises(ValueError, match="no method of `integrate` is right within the limits"):
        advice.arguments


REFUSED = [
    (([0.1] * 5, (0, 1)), {}, ValueError, r"starts must have 6 numbers .* got \(5,\)"),
    ((START, [0.0]), {}, ValueError, "t must have the time of the starts and at least one more, got 1"),
    ((START, [0, np.inf]), {}, ValueError, "t must be finite, got inf"),
    ((START, [0, 1, 0.5]), {}, ValueError, "t must ascend or descend"),
    ((np.nan * np.ones(6), (0, 1)), {}, ValueError, "starts must be finite, got NaN"),
    ((np.zeros((0, 6)), (0, 1)), {}, ValueError, "advice needs a start"),
    ((START, (0, 1), {}), {}, ValueError, "advice needs an output"),
    ((START, (0, 1), {"angle": 1e-6}), {}, KeyError, "there is no output `angle`"),
    ((START, (0, 1), {"angles": 0}), {}, ValueError, r'right\["angles"\] must be above 0, got 0'),
    ((START, (0, 1), {"angles": "x"}), {}, TypeError, r'right\["angles"\] must be a real number'),
    ((START, (0, 1)), {"step_limit": -1}, ValueError, "step_limit must be a time above 0 s, got -1"),
    ((START, (0, 1)), {"step_limit": 1, "sample_limit": 1}, ValueError, "not both"),
]


@pytest.mark.parametrize("given, named, error, words", REFUSED, ids=lambda value: str(value)[:40])
def test_what_is_refused_is_told(tree, given, named, error, words):
    with pytest.raises(error, match=words):
        tree.advise(*given, **named)


def test_a_tree_without_copies_has_no_transfer():
    rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
    with pytest.raises(ValueError, match="the tree has no copies"):
        rod.advise([1.0, 0.0], (0, 1), {"transfer": 1e-6})
