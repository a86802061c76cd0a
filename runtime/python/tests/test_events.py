"""Events: at one time, counted, one or several, and what a motion from an event tells."""

import branched_pendulum as bp
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from test_tree import PAPER, START


@pytest.fixture
def tree():
    return bp.Tree(PAPER, m=0.10531)


def angle(link):
    return lambda t, y: y[link]


def stopping(link, terminal=True, direction=0):
    function = angle(link)
    function.terminal, function.direction = terminal, direction
    return function


IN_PHASE = [0.5, 0.3, 0.3, 0, 0, 0]


@pytest.mark.parametrize("end", [10.0, -10.0])
@pytest.mark.parametrize("last", [1, 2])
@pytest.mark.parametrize("method", ["dop853", "dopri5", "verner98"])
def test_events_at_the_time_of_the_last_are_told_once(tree, method, last, end):
    events = [stopping(1, last == 1), stopping(2, last == 2)]
    whole = tree.integrate(IN_PHASE, [0, end], rtol=1e-11, events=[angle(1), angle(2)]).t_events
    time, state, seen = 0.0, IN_PHASE, [[], []]
    for _ in range(100):
        run = tree.integrate(state, [time, end], method, rtol=1e-11, events=events)
        for times, found in zip(seen, run.t_events):
            times.extend(found)
        if run.message.startswith("end reached"):
            break
        assert run.t_events[0].tolist() == run.t_events[1].tolist() and len(run.t_events[0]) == 1
        time, state = run.t_events[last - 1][-1], run.y_events[last - 1][-1]
    assert len(whole[0]) > 10 and seen[0] == seen[1]
    np.testing.assert_allclose(seen, whole, atol=1e-6)


@pytest.mark.parametrize("terminal", [1, 2, 3, 5, True, np.int64(2), 2.0])
@pytest.mark.parametrize("direction", [-1, 0, 1])
def test_terminal_counts_as_scipy_does(tree, terminal, direction):
    events = [stopping(0, terminal, direction), angle(1)]
    tolerances = {"rtol": 1e-11, "atol": 1e-11}
    own = tree.integrate(START, [0, 20], events=events, **tolerances)
    other = solve_ivp(tree.rhs, (0, 20), START, "DOP853", events=events, **tolerances)
    assert own.message.startswith("stopped at an event")
    assert len(own.t_events[0]) == int(terminal)
    for mine, theirs in zip(own.t_events, other.t_events):
        np.testing.assert_allclose(mine, theirs, atol=1e-6)


def test_what_is_no_count_is_refused(tree):
    for terminal in [0, False, None]:
        run = tree.integrate(START, [0, 5], events=stopping(0, terminal))
        assert run.message.startswith("end reached") and len(run.t_events[0]) > 3
    for terminal in [-1, 2.5, np.nan]:
        with pytest.raises(ValueError, match=r"events\[1\]\.terminal must be True, False or a positive"):
            tree.integrate(START, [0, 5], events=[angle(0), stopping(0, terminal)])


def test_one_function_or_several(tree):
    one = tree.integrate(START, [0, 5], events=angle(0))
    several = tree.integrate(START, [0, 5], events=(angle(0), angle(1)))
    assert len(one.t_events) == 1 and len(several.t_events) == 2
    np.testing.assert_array_equal(one.t_events[0], several.t_events[0])
    assert tree.integrate(START, [0, 5], events=[]).t_events == []
    for events, match in [
        (3, "events must be a function f"),
        ([angle(0), "y[0]"], r"events\[1\] must be a function f"),
    ]:
        with pytest.raises(TypeError, match=match):
            tree.integrate(START, [0, 5], events=events)
    for value in [1 + 2j, np.ones(2), "far", np.ma.masked]:
        with pytest.raises(TypeError, match=r"the value of events\[0\]"):
            tree.integrate(START, [0, 5], events=[lambda t, y: value])
    assert tree.integrate(START, [0, 5], events=lambda t, y: y[:1]).t_events[0].size > 0


def test_a_start_on_a_zero_has_the_side_to_which_it_leaves(tree):
    """From rest the velocity leaves zero at once; its next zeros are half a swing away."""
    tree = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
    speed = lambda t, y: y[1]
    period = tree.integrate([0.8, 0], [0, 9], rtol=1e-12, events=speed).t_events[0][1]
    for end in [9.0, -9.0]:
        for angle, direction in [(0.8, 1), (0.8, -1), (-0.8, 1), (-0.8, -1)]:
            speed.direction = direction
            found = tree.integrate([angle, 0], [0, end], rtol=1e-12, events=speed).t_events[0]
            # Along the motion the velocity of a rod let go at positive angles falls first.
            first = 0.5 if (direction > 0) == (angle * end > 0) else 1.0
            expected = np.sign(end) * period * (first + np.arange(20))
            expected = expected[np.abs(expected) < abs(end)]
            np.testing.assert_allclose(found, expected, atol=1e-8)


@pytest.mark.parametrize("end", [5.0, -5.0])
@pytest.mark.parametrize("method, step", [("dop853", None), ("taylor", None), ("verner98", None), ("rk4", 1e-3)])
def test_dense_output_reaches_the_event_that_ends_the_motion(tree, method, step, end):
    """However the times are given: a pair in parentheses, a list of two, or many."""
    events = [stopping(0, 2), angle(1)]
    for times in [(0, end), [0, end], np.linspace(0, end, 501), [0, 1e-3 * end, end]]:
        motion = tree.integrate(START, times, method, 1e-11, step=step, events=events, dense_output=True)
        assert motion.status == 1 and len(motion.t_events[0]) == 2
        for own, found, states in zip([0, 1], motion.t_events, motion.y_events):
            assert np.abs(motion(found)[:, own]).max() < 1e-8
            np.testing.assert_allclose(motion(found), states, atol=1e-7)
        stop = motion.t_events[0][-1]
        assert abs(motion.t[-1]) <= abs(stop) < abs(end)
        np.testing.assert_array_equal(motion(motion.t), motion.y)
        with pytest.raises(ValueError, match="outside"):
            motion(1.01 * stop)
