"""The resonant normal form: predictions without a simulation."""

import branched_pendulum as bp
import numpy as np
import pytest

PAIR = ["child_1", "child_2"]


@pytest.fixture(scope="module")
def tree():
    return bp.Tree(bp.examples.PAPER, friction=0)


@pytest.fixture(scope="module")
def form(tree):
    return tree.normal_form(PAIR)


def at_rest(*degrees):
    return np.radians([*degrees, 0, 0, 0])


def test_linear_frequencies_are_those_of_the_modes(tree, form):
    frequencies, _ = tree.modes()
    np.testing.assert_allclose(np.sort(form.linear_frequencies), frequencies, rtol=1e-9)
    assert form.resonances == ["f_1 + f_2 = 2 d_1"]


def test_growth_is_predicted_where_a_motion_has_it(tree, form):
    start = at_rest(30, 19, 19)
    predicted = form.predict(start)
    grown = tree.growth([start], PAIR, [40.0, 80.0])
    simulated = np.log(grown.factors[0, 1] / grown.factors[0, 0]) / 40
    assert abs(predicted.growth_rate - simulated) < 0.05 * simulated
    assert predicted.resonance == "f_1 + f_2 = 2 d_1"
    assert 0 < predicted.growth_error < 0.1 * predicted.growth_rate


def test_frequencies_follow_from_actions(form):
    start = at_rest(15, 20, 20)
    frequencies = form.frequencies(form.actions(start))
    np.testing.assert_allclose(frequencies, form.predict(start).frequencies, rtol=1e-12)


def test_many_states_at_once(form):
    releases = [(10, 10), (30, 19), (30, 120)]
    starts = np.array([at_rest(parent, child, child) for parent, child in releases])
    rates = form.growth_rate(starts)
    assert rates.shape == (3,)
    assert rates[0] == 0 and rates[1] == form.predict(starts[1]).growth_rate
    assert np.isnan(rates[2])
    with pytest.raises(ValueError, match="does not converge"):
        form.predict(starts[2])


def test_wrong_requests_name_their_cause(tree):
    with pytest.raises(KeyError, match="cousin"):
        tree.normal_form(["child_1", "cousin"])
    with pytest.raises(ValueError, match="not copies"):
        tree.normal_form(["parent", "child_1"])
    with pytest.raises(ValueError, match="degree"):
        tree.normal_form(PAIR, degree=7)
