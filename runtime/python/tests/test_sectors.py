"""W of run-time trees against the compiled model, against differences along motions, by orders."""

import pickle

import branched_pendulum as bp
import numpy as np
import pytest

RNG = np.random.default_rng(5)
STATES = np.concatenate([RNG.uniform(-2, 2, (200, 3)), RNG.uniform(-8, 8, (200, 3))], axis=1)


@pytest.fixture(scope="module")
def paper():
    return bp.Tree(bp.examples.PAPER, friction=0)


@pytest.fixture(scope="module")
def model():
    return bp.models.BranchedDouble()


def test_every_form_is_that_of_the_compiled_model(paper, model):
    assert paper.sectors == ["in_phase", "d"]
    for form in model.FORMS:
        size = np.sqrt(np.mean(model.transfer(STATES, form) ** 2))
        parts = paper.transfer_parts(STATES, form, "d")
        np.testing.assert_allclose(parts, model.transfer_parts(STATES, form), atol=1e-13 * size)
        np.testing.assert_allclose(parts.sum(axis=-1), paper.transfer(STATES, form, "d"), atol=1e-14 * size)
    np.testing.assert_allclose(
        paper.sector_energies(STATES, "d"), model.antiphase_energy(STATES), rtol=1e-12
    )
    alone = paper.transfer_parts(STATES[7])
    np.testing.assert_array_equal(alone[1], paper.transfer_parts(STATES[7], into="d"))


TREES = {
    "paper": bp.Tree(bp.examples.PAPER, friction=0),
    "cascade": bp.Tree(
        bp.examples.CASCADE.replace("count = 5", "count = 4").replace("arm_5", "arm_4"),
        gravity=9.80665, mass_ratio=0.5, length_ratio=0.7,
        friction=0, friction_ratio=1, sibling_friction=0,
    ),
    "standing": bp.Tree(bp.examples.Y),
    "unlike": bp.Tree("""gravity = 9.81, arm: rod(mass = 0.2, length = 0.4) [
        hand: rod(mass = each(0.1, 0.11), length = 0.3) * 2]"""),
    "tied": bp.Tree("""gravity = 9.81, arm: rod(mass = 0.2, length = 0.4) [
        hand: rod(mass = 0.1, length = 0.3) [finger: rod(mass = 0.02, length = 0.1) * 3] * 2],
        siblings(hand, at = 0.2, spring = 4), siblings(finger, at = 0.08, spring = 3)"""),
}


@pytest.mark.parametrize("name", TREES)
def test_w_is_the_rate_of_the_energy(name):
    """Differences of fourth order along the motion, without friction."""
    tree = TREES[name].changed() if name != "standing" else bp.Tree(
        bp.examples.Y.replace("friction = 0.05", "drag = 0").replace("friction = 0.01", "drag = 0"))
    n = len(tree)
    start = np.concatenate([0.5 * np.sin(1.7 * np.arange(n)), np.zeros(n)])
    h = 2e-4
    t = np.arange(0, 0.1, h)
    y = tree.integrate(start, t, rtol=1e-13).y
    energies = tree.sector_energies(y)
    slopes = (8 * (energies[3:-1] - energies[1:-3]) - (energies[4:] - energies[:-4])) / (12 * h)
    w = tree.transfer(y)
    assert w.shape == (len(t), len(tree.sectors)) and np.abs(w).max() > 1e-4
    np.testing.assert_allclose(w[2:-2], slopes, atol=1e-7 * np.abs(w).max())
    total = tree.transfer(y, "growth") + tree.transfer(y, "forcing")
    np.testing.assert_allclose(total, w, atol=1e-12 * np.abs(w).max())
    forced = np.abs(tree.transfer(y, "forcing")).max()
    assert forced > 1e-3 * np.abs(w).max() if name == "unlike" else forced == 0


def test_orders_come_near_the_exact_form():
    tree = TREES["cascade"]
    n = len(tree)
    # In phase but for small differences.
    depth = np.zeros(n, int)
    for link, parent in enumerate(tree.parents):
        depth[link] = 0 if parent is None else depth[parent] + 1
    y = np.concatenate([np.array([0.9, 0.5, -0.3, 0.4])[depth], np.array([1.0, -2.0, 3.0, 1.5])[depth]])
    y += 1e-2 * np.sin(np.arange(2 * n))
    exact = tree.transfer(y)
    errors = [np.abs(tree.transfer(y, f"amplitude order {k}") - exact).max() for k in (2, 4, 6, 8)]
    assert errors[0] < 0.1 * np.abs(exact).max() and errors[1] < 0.1 * errors[0]
    assert errors[2] < 0.1 * errors[1] and errors[3] <= errors[2]


def test_budgets_of_sectors_close():
    tree = bp.Tree(bp.examples.PAPER.rstrip() + ",\ndrive(y = 0.01 * cos(20 * t))", friction=2e-4)
    t = np.linspace(0, 1, 2001)
    y = tree.integrate([0.8, 0.3, -0.1, 0, 0, 0], t, rtol=1e-12).y
    for definition in ["canonical", "rest", "parseval", "velocity"]:
        budget = tree.sector_budget(y, t, definition)
        rates = budget.transfers + budget.powers
        for sector in range(2):
            grown = bp.analysis.running_integral(t, rates[:, sector])
            change = budget.energies[:, sector] - budget.energies[0, sector]
            np.testing.assert_allclose(grown, change, atol=1e-7 * np.abs(rates).max())
    np.testing.assert_allclose(tree.sector_budget(y, t, "parseval").energies.sum(axis=1), tree.energy(y), rtol=1e-12)
    np.testing.assert_array_equal(
        tree.sector_budget(y, t).energies, tree.sector_energies(y)
    )


def test_observables_and_their_rates():
    tree = bp.Tree("""gravity = 9.81,
        arm: rod(mass = 0.2, length = 0.4, friction = 1e-3) [hand: rod(mass = 0.1, length = 0.3) * 2],
        observe(spread = theta_d^2, height = 1 - cos(theta_arm), energy = kinetic_energy + potential_energy)""")
    assert tree.observables == ["spread", "height", "energy"]
    h = 1e-3
    y = tree.integrate([0.8, 0.3, -0.1, 0, 0, 0], np.arange(0, 0.5, h), rtol=1e-13).y
    for name in tree.observables:
        values = tree.observable(name, y)
        slopes = (8 * (values[3:-1] - values[1:-3]) - (values[4:] - values[:-4])) / (12 * h)
        rates = tree.observable_rate(name, y)
        np.testing.assert_allclose(rates[2:-2, 0], slopes, atol=1e-7 * np.abs(rates).max())
    np.testing.assert_allclose(tree.observable_rate("energy", y)[:, 1], tree.friction_power(y), atol=1e-12)


def test_ensembles_of_parameters():
    tree = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = l, friction = c)", l=1, c=0)
    lengths = np.linspace(0.5, 2, 700)
    starts = np.tile([1.0, 0.0], (700, 1))
    t = np.linspace(0, 2, 5)
    for method in ["auto", "taylor", "verner98"]:
        all_of_them = tree.ensemble(starts, t, method=method, rtol=1e-11, parameters={"l": lengths})
        for index in (0, 1, 333, 699):
            alone = tree.changed(l=lengths[index]).integrate(starts[index], t, rtol=1e-11)
            np.testing.assert_allclose(all_of_them[index], alone.y, atol=1e-8)
    for error, message, given in [
        (ValueError, r'parameters\["l"\] must have shape \(700,\), got \(3,\)', {"l": [1, 2, 3]}),
        (ValueError, "no parameter `q`", {"q": lengths}),
        (ValueError, "length .* must be", {"l": -lengths}),
    ]:
        with pytest.raises(error, match=message):
            tree.ensemble(starts, t, parameters=given)
    with pytest.raises(ValueError, match="a compiled model has none"):
        bp.models.BranchedDouble().ensemble(np.ones((1, 6)), t, parameters={"l": [1]})


def test_maps_of_growth(paper):
    angles = np.radians([39.5, 47.8])
    found = bp.analysis.release_map(paper, ("child_1", "child_2"), {"child": [0.0], "parent": angles}, horizon=4.0)
    starts = np.zeros((2, 6))
    starts[:, 0] = angles
    grown = paper.growth(starts, ("child_1", "child_2"), [4.0], rtol=1e-8)
    np.testing.assert_array_equal(found.factors[:, 0], grown.factors[:, 0])
    assert found.factors[1, 0] == pytest.approx(58.2, abs=0.1)
    friction = bp.analysis.release_map(
        paper, ("child_1", "child_2"), {"friction": [0.0, 1e-3], "parent": angles}, horizon=4.0)
    np.testing.assert_array_equal(friction.rates[:, 0], found.rates[:, 0])
    assert friction.factors[1, 1] < friction.factors[1, 0]
    assert friction.plot().axes and repr(friction) == "ReleaseMap of friction and parent: 4 points"
    with pytest.raises(KeyError, match="`uncle` is neither a link nor a parameter"):
        bp.analysis.release_map(paper, ("child_1", "child_2"), {"uncle": [0.0], "parent": angles})


def test_parameters_from_a_motion():
    text = """gravity = 9.81, upper(mass = 0.2, com = a, inertia = 1e-3, joint = l, friction = c) [
        lower(mass = 0.1, com = 0.12, inertia = 5e-4)]"""
    truth = {"a": 0.1, "c": 2e-4, "l": 0.2}
    tree = bp.Tree(text, **truth)
    t = np.arange(0, 12, 0.01)
    noise = np.random.default_rng(2).normal(0, 1e-3, (len(t), 2))
    seen = tree.integrate([0.9, 0.5, 0, 0], t, rtol=1e-11).y[:, :2] + noise + [0.02, -0.01]
    begun = tree.changed(a=0.12, l=0.17, c=0)
    found = begun.identify(t, seen, ["a", "l", "c"], until=8.0)
    assert found.failure is None and set(found.values) == set(truth)
    for name, value in truth.items():
        own = found.estimates[name]
        assert own.standing == "determined" and own.deviation is not None
        assert abs(own.value - value) < 5 * own.deviation < 0.05 * value
    assert found.estimates["offset of upper"].value == pytest.approx(0.02, abs=1e-3)
    assert found.rms_fitted < 1.1e-3 and found.rms_predicted < 2e-3
    assert found.residuals.shape == (len(t), 2) and "mrad" in str(found)
    with pytest.raises(KeyError, match="no parameter `q`"):
        tree.identify(t, seen, ["q"])
    with pytest.raises(ValueError, match="theta has 1 columns, must have 2"):
        tree.identify(t, seen[:, :1], ["a"])


def test_parameters_from_frequencies():
    text = bp.examples.PAPER.replace("1.88e-3", "i1").replace("0.516e-3", "i2")
    truth = {"i1": 1.88e-3, "i2": 0.516e-3}
    tree = bp.Tree(text, friction=0, **truth)
    hertz = tree.modes()[0]
    begun = tree.changed(i1=1.5e-3, i2=0.4e-3)
    numbered = [(hertz[2], 2e-3, 3), [hertz[0], 1e-3, 1], np.array([hertz[1], 2e-3, 2])]
    found = begun.identify(unknown=["i1", "i2"], frequencies=numbered)
    # The errors of the data, through the slopes of the frequencies by differences.
    slopes = np.empty((3, 2))
    for column, (name, value) in enumerate(truth.items()):
        above, below = [tree.changed(**{name: value * side}).modes()[0] for side in (1 + 1e-5, 1 - 1e-5)]
        slopes[:, column] = (above - below) / (2e-5 * value)
    weighed = slopes / np.array([[1e-3], [2e-3], [2e-3]])
    deviations = np.sqrt(np.diag(np.linalg.inv(weighed.T @ weighed)))
    for (name, value), deviation in zip(truth.items(), deviations, strict=True):
        own = found.estimates[name]
        assert own.value == pytest.approx(value, rel=1e-6) and own.standing == "determined"
        assert own.deviation == pytest.approx(deviation, rel=1e-4)
    assert [own.mode for own in found.frequencies] == [3, 1, 2]
    assert found.frequencies[0].fitted == pytest.approx(hertz[2], abs=1e-8)
    assert found.failure is None and found.alternatives == [] and found.residuals.size == 0
    assert "mode 3: 1.58256 ± 2.0e-03 Hz" in str(found) and "mrad" not in str(found)
    assert repr(found) == "Identification of i1, i2: by frequencies alone"
    # Beside a motion.
    t = np.arange(0, 3, 0.02)
    seen = tree.integrate([0.3, -0.2, 0.1, 0, 0, 0], t, rtol=1e-11).y[:, :3]
    seen = seen + np.random.default_rng(3).normal(0, 2e-2, seen.shape)
    alone, both = [begun.identify(t, seen, ["i1", "i2"], frequencies=own) for own in ([], numbered)]
    for name, value in truth.items():
        own = both.estimates[name]
        assert own.deviation < alone.estimates[name].deviation
        assert own.deviation < 1.1 * found.estimates[name].deviation
        assert abs(own.value - value) < 4 * own.deviation
    assert "mrad" in str(both) and len(both.frequencies) == 3
    unknown = ["i1", "i2"]
    for error, message, given in [
        (ValueError, "neither a motion nor frequencies", {}),
        (ValueError, "t and theta are one motion", {"t": t, "frequencies": numbered}),
        (ValueError, "until is of a motion", {"until": 1.0, "frequencies": numbered}),
        (ValueError, "1 data for 2 unknown numbers", {"frequencies": numbered[:1]}),
        (ValueError, "mode 4, but 3 modes oscillate", {"frequencies": [(1, 0.1, 4), (1, 0.1, 1)]}),
        (ValueError, "2 frequencies without the numbers", {"frequencies": [(1, 0.1), (2, 0.1)]}),
        (ValueError, "both have to be positive", {"frequencies": [(-1, 0.1, 1), (1, 0.1, 2)]}),
        (ValueError, "both have to be positive", {"frequencies": [(1, 0, 1), (1, 0.1, 2)]}),
        (TypeError, r"\(hertz, deviation, mode\).*got 0.88", {"frequencies": [0.88, 1.26]}),
        (TypeError, r"\(hertz, deviation, mode\).*got \(0.88", {"frequencies": [(0.88, 0.1, 1.5)]}),
    ]:
        with pytest.raises(error, match=message):
            tree.identify(unknown=unknown, **given)
    with pytest.raises(TypeError, match="unknown is missing"):
        tree.identify(t, seen)


def test_identify_refuses_angles_in_degrees_and_turns_that_are_not_counted():
    tree = bp.Tree("gravity = 9.81, a: rod(mass = 0.2, length = l) [b: rod(mass = m, length = 0.2)]", l=0.3, m=0.1)
    t = np.arange(0, 4, 1 / 50)
    seen = tree.integrate([1.9, -1.0, 0, 0], t).y[:, :2]
    whirl = tree.integrate([2.5, -1.0, 14, 0], t).y[:, :2]
    for wrong in (np.degrees(seen), np.degrees(seen) + 30, np.angle(np.exp(1j * whirl))):
        with pytest.raises(ValueError, match=r"np\.radians.*np\.unwrap"):
            tree.identify(t, wrong, ["l"])
    one = np.array(seen)
    one[20, 1] = np.nan
    found = tree.identify(t, one, ["l"])
    assert found.failure is None and abs(found.values["l"] - 0.3) < 1e-4


def test_identify_has_no_deviations_for_constants_of_no_pendulum():
    tree = bp.Tree("""gravity = 9.81,
        a(mass = 0.2, com = c, inertia = i, friction = f) []""".replace(" []", ""), c=0.2, i=1e-3, f=1e-4)
    t = np.arange(0, 6, 1 / 50)
    rng = np.random.default_rng(3)
    for com in (0.3, 0.35, 0.4):
        seen = tree.integrate([0.6, 0.0], t).y[:, :1] + rng.normal(0, 1e-3, (len(t), 1))
        found = tree.changed(c=com).identify(t, seen, ["i", "f"])
        assert "inertia" in found.failure and found.values["i"] < 0
        assert all(own.deviation is None for own in found.estimates.values())


def test_lines_beside_a_drift():
    t = np.arange(0, 40, 1 / 50)
    wave = 0.1 * np.cos(2 * np.pi * 1.1 * t)
    for drift in (0 * t, 0.002 * t, 0.05 * t, 3 * t, 0.004 * t**2, 2 * np.exp(-t / 60)):
        found = bp.analysis.lines(drift + wave, 50)
        nearest = np.abs(found.frequencies - 1.1).argmin()
        assert abs(found.frequencies[nearest] - 1.1) < 1e-3
        assert abs(found.amplitudes[nearest] - 0.1) < 1e-3
        # A cubic leaves less than 1e-4 of the exponential.
        assert found.slow == 0 or drift[0] == 2 and found.slow < 1e-4
    assert abs(bp.analysis.lines(3 * t + wave, 50).trend[1] - 3) < 1e-9
    assert bp.analysis.lines(3 * t + wave, 50, trend=0).slow > 1
    with pytest.raises(ValueError, match="trend"):
        bp.analysis.lines(wave, 50, trend=100)
    kept = pickle.loads(pickle.dumps(bp.analysis.lines(3 * t + wave, 50, trend=2)))
    assert kept == bp.analysis.lines(3 * t + wave, 50, trend=2)
