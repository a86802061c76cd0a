"""Budgets by scale along motions, and their means."""

import branched_pendulum as bp
import numpy as np
import pytest

RULE = """gravity = 9.81,
    arm: generations(count = COUNT, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7, friction = 1e-3, friction_ratio = 0.3),
    drive(torque = 0.3 * cos(3.77 * t))"""


@pytest.fixture(scope="module")
def tree():
    return bp.Tree(RULE.replace("COUNT", "3"))


@pytest.fixture(scope="module")
def driven():
    """Motions of a larger tree, whose scales are all awake."""
    tree = bp.Tree(RULE.replace("COUNT", "4"))
    angles = np.random.default_rng(1).uniform(-0.5, 0.5, (16, 15))
    t = np.arange(0, 120, 0.02)
    return tree, t, tree.ensemble(np.concatenate([angles, 0 * angles], axis=1), t, rtol=1e-8)


def test_rates_of_energies_are_what_is_received_and_given(tree):
    start = np.random.default_rng(2).normal(0, 1.0, 14)
    t = np.linspace(0, 0.2, 401)
    budget = tree.budget(tree.integrate(start, t, rtol=1e-13).y, t)
    # Differences of the fourth order.
    e, h = budget.energies, t[1] - t[0]
    rates = (8 * (e[3:-1] - e[1:-3]) - (e[4:] - e[:-4])) / (12 * h)
    np.testing.assert_allclose(
        rates, (budget.received + budget.power)[2:-2], atol=1e-6 * np.abs(rates).max()
    )
    np.testing.assert_allclose(e.sum(-1), tree.energy(tree.integrate(start, t, rtol=1e-13).y), rtol=1e-12)


def test_fluxes_are_sums_of_transfers(tree):
    budget = tree.budget(np.random.default_rng(3).normal(0, 1.0, (2, 3, 14)))
    for scale in range(3):
        across = budget.transfers[..., :scale, scale:].sum(axis=(-1, -2))
        np.testing.assert_allclose(budget.flux[..., scale], across, atol=1e-12)
    assert budget.flux.shape == (2, 3, 3) and budget.freedoms.tolist() == [3, 2, 2]
    np.testing.assert_array_equal(budget.losses, -(budget.friction + budget.drag))


def test_axes_go_together(tree):
    y = np.random.default_rng(4).normal(0, 1.0, (2, 4, 14))
    t = np.linspace(0, 1, 4)
    together = tree.budget(y, t)
    assert together.transfers.shape == (2, 4, 3, 3)
    one = tree.budget(y[1, 2], t[2])
    for name in ["energies", "transfers", "friction", "drive"]:
        np.testing.assert_array_equal(getattr(together, name)[1, 2], getattr(one, name))
    torques = np.random.default_rng(5).normal(0, 1.0, 7)
    pushed = tree.budget(y, t, torques)
    np.testing.assert_allclose(pushed.outside.sum(-1), y[..., 7:] @ torques, rtol=1e-12)
    assert not together.outside.any() and (pushed.power - together.power != 0).all()
    for given, words in [
        ((y[..., :13],), r"y must have 14 numbers .* got \(2, 4, 13\)"),
        ((y, t[:3]), r"y has shape \(2, 4, 14\), t has shape \(3,\)"),
        ((y, t, torques[:3]), r"torques must have 7 numbers .* got \(3,\)"),
    ]:
        with pytest.raises(ValueError, match=words):
            tree.budget(*given)


def test_means_along_driven_motions(driven):
    tree, t, y = driven
    budget = tree.budget(y, t)
    found = budget.averages(discard=1000)
    kept = budget.energies[:, 1000:]
    np.testing.assert_allclose(found.energies, kept.mean(axis=(0, 1)), rtol=1e-12)
    np.testing.assert_allclose(found.flux[1:], budget.flux[:, 1000:].mean(axis=(0, 1))[1:], rtol=1e-9)
    assert found.flux[0] == found.flux_errors[0] == 0 and (found.energy_errors > 0).all()
    assert not found.notes and found.freedoms.tolist() == [4, 3, 4, 4]
    # The spread of the means of single motions is another route to the errors: samples swing, and
    # the sum of their correlations ends before these are negative.
    spread = kept.mean(axis=1).std(axis=0, ddof=1) / np.sqrt(len(y))
    assert (0.7 * spread < found.energy_errors).all() and (found.energy_errors < 3 * spread).all()
    # In the steady state what passes by is lost behind, and what enters is lost.
    assert (found.flux > 10 * found.flux_errors)[1:].all()
    bars = np.hypot(found.flux_errors, found.lost_errors)
    assert (np.abs(found.flux - found.lost) < 3 * bars)[1:].all()
    assert abs(found.lost[0]) < 3 * found.lost_errors[0]
    assert abs(found.input - found.losses) < 3 * np.hypot(found.input_error, found.losses_error)
    assert budget.averages().discarded > 0
    assert "flux into it" in str(found) and repr(found) == "ScaleAverages of 4 scales"


def test_the_energy_changes_by_what_enters_less_what_is_lost(driven):
    tree, t, y = driven
    times = t[-1] + np.arange(0, 2, 5e-4)
    budget = tree.budget(tree.integrate(y[0, -1], times, rtol=1e-12).y, times)
    energy = budget.energies.sum(-1)
    gained = bp.analysis.running_integral(times, budget.power.sum(-1))
    assert np.abs(gained - (energy - energy[0])).max() < 1e-6 * np.ptp(energy)
    into = bp.analysis.running_integral(times, budget.flux[:, 2] + budget.power[:, 2:].sum(-1))
    behind = budget.energies[:, 2:].sum(-1)
    assert np.abs(into - (behind - behind[0])).max() < 1e-5 * np.ptp(behind)


def test_means_without_errors_say_why(driven):
    tree, t, y = driven
    found = tree.budget(y[0, ::5][:40], t[::5][:40]).averages(discard=0)
    assert np.isnan(found.energy_errors).any() and np.isfinite(found.energies).all()
    assert "too few" in found.notes[0] and found.notes[0] in str(found)


def test_means_of_what_is_no_motion_are_refused(driven):
    tree, t, y = driven
    with pytest.raises(ValueError, match=r"the axes of these states are \(\)"):
        tree.budget(y[0, 0]).averages()
    with pytest.raises(ValueError, match="discard must be from 0 to 19, got 20"):
        tree.budget(y[0, :20], t[:20]).averages(discard=20)
    with pytest.raises(ValueError, match="samples"):
        tree.budget(y[0, :3], t[:3]).averages()


def test_means_of_correlated_samples():
    # x' = φ x + noise: τ = (1 + φ) / (1 - φ).
    random, phi = np.random.default_rng(6), 0.8
    x = np.zeros((8, 20000))
    noise = random.normal(0, 1, x.shape)
    for i in range(1, x.shape[1]):
        x[:, i] = phi * x[:, i - 1] + noise[:, i]
    found = bp.analysis.average(x)
    assert found["correlation_time"] == pytest.approx(9, rel=0.1) and found["samples"] == x.size
    assert abs(found["mean"]) < 4 * found["error"]
    assert found["error"] == pytest.approx(np.sqrt(9 * x.var() / x.size), rel=0.1)
    with pytest.raises(ValueError, match=r"x must have shape \(m,\) or \(k, m\), got \(1, 2, 3\)"):
        bp.analysis.average(np.zeros((1, 2, 3)))
    with pytest.raises(ValueError, match="x must have one axis"):
        bp.analysis.transient(x)
