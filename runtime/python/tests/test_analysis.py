"""Measured data and analysis, on data whose truth is known."""

from pathlib import Path

import branched_pendulum as bp
import numpy as np
import pytest
from branched_pendulum import analysis
from scipy.integrate import solve_ivp

import camera
from test_tree import PAPER

MEASURED = Path(__file__).parents[2] / "measure/tests/measure/identification/double-pendulum.csv"


@pytest.fixture(scope="module")
def model():
    return bp.models.BranchedDouble()


@pytest.fixture(scope="module")
def film(model):
    return camera.film(model)


def test_columns_are_read_and_told(tmp_path):
    path = tmp_path / "swing.csv"
    path.write_text("time [s];upper [deg];lower [deg]\n0,00;10,0;-5,0\n0,01;10,1;\n0,02;10,2;-4,8\n")
    swing = bp.data.read(path)
    np.testing.assert_array_equal(swing.t, [0, 0.01, 0.02])
    np.testing.assert_allclose(
        swing.theta, np.radians([[10, -5], [10.1, np.nan], [10.2, -4.8]]), rtol=1e-15
    )
    assert swing.names == ["upper", "lower"] and len(swing) == 3
    assert "detected: semicolons between cells, decimal commas" in swing.findings
    assert "assumed: angles from the downward vertical" in swing.findings
    assert swing.interval == pytest.approx(0.01) and swing.gaps == [] and not swing.marked.any()
    assert swing.dot_distances is None
    frame = swing.frame()
    assert list(frame.columns) == ["upper", "lower"] and frame.index.name == "t"
    other = bp.data.read(path, columns=["lower", "upper"], relative_to=[None, 0], zero="up")
    assert other.theta[0] == pytest.approx([np.radians(-5) - np.pi, np.radians(5) - np.pi])


def test_tables_are_read_as_they_are(tmp_path):
    """Columns that are named win over points, a pivot is a place, a time is named, repeated rows go."""
    path = tmp_path / "swing.csv"
    path.write_text(
        "clock,theta1_deg,theta2_mrad,m1_x,m1_y,note\n"
        "0,9,20,0.3,-0.4,go\n0,9,20,0.3,-0.4,\n0.5,18,30,0.4,-0.3,\n1.5D+00,27,40,0.5,0,on\n"
    )
    options = {"time": "clock", "drop_repeated": "last"}
    named = bp.data.read(path, columns=["theta1_deg"], **options)
    np.testing.assert_array_equal(named.t, [0, 0.5, 1.5])
    np.testing.assert_allclose(named.theta[:, 0], np.radians([9, 18, 27]), rtol=1e-15)
    assert named.names == ["theta1"]
    of_point = np.arctan2([0.3, 0.4, 0.5], [0.4, 0.3, 0])
    for way in [{"pivot": "origin"}, {"pivot": (0, 0)}, {"dots": [("origin", "m1")]}]:
        read = bp.data.read(path, **way, **options)
        np.testing.assert_allclose(read.theta[:, 0], of_point, rtol=1e-15)
    with pytest.raises(bp.data.ReadError, match="columns of angles .* and points"):
        bp.data.read(path, **options)
    with pytest.raises(bp.data.ReadError, match="say which row of one time counts") as error:
        bp.data.read(path, columns=["theta1"], time="clock")
    assert error.value.line == 3
    with pytest.raises(bp.data.ReadError, match="asked for together"):
        bp.data.read(path, columns=["theta1"], pivot="origin", **options)
    path.write_text("t,x,y\n0.0,0.3,-0.4\n0.1,0.4,-0.3\n0.2,0.5,0\n")
    with pytest.raises(bp.data.ReadError, match="give the place of the pivot"):
        bp.data.read(path)
    path.write_text("t,a\n0.00,0.81\n0.01,0.82\n0.02,0.83\n")
    assert bp.data.read(path).findings[0].startswith("doubtful: angles in radians")


def test_errors_of_the_reader_name_its_arguments(tmp_path):
    """Recordings behind each other, encoder counts, whole times and repeated rows name what helps."""
    path = tmp_path / "swing.csv"
    rows = "".join(f"{0.01 * row:.2f},{0.5 + 0.01 * row * row:.4f}\n" for row in range(6))
    path.write_text("t (s),a (rad)\n" + rows + rows)
    with pytest.raises(bp.data.ReadError, match="recording=1 reads the first"):
        bp.data.read(path)
    np.testing.assert_allclose(bp.data.read(path, recording=2).t, 0.01 * np.arange(6))
    with pytest.raises(bp.data.ReadError, match="the table holds 2 recordings"):
        bp.data.read(path, recording=3)
    counts = "".join(f"{row}.5,{3000 + 7 * row * row}\n" for row in range(12))
    path.write_text("t,raw\n" + counts)
    with pytest.raises(bp.data.ReadError, match='unit="counts:4096"'):
        bp.data.read(path)
    read = bp.data.read(path, unit="counts:4096", zero="down")
    steps = 2 * np.pi / 4096 * 7 * np.arange(12) ** 2
    np.testing.assert_allclose(read.theta[:, 0] - read.theta[0, 0], steps, atol=1e-12)
    with pytest.raises(ValueError, match="counts:N"):
        bp.data.read(path, unit="counts:0")
    path.write_text("ticks,a (rad)\n0,0.1\n8,0.2\n16,0.4\n24,0.5\n")
    with pytest.raises(bp.data.ReadError, match="found no column of times"):
        bp.data.read(path)
    with pytest.raises(bp.data.ReadError, match=r'time="ticks \[ms\]"'):
        bp.data.read(path, time="ticks")
    np.testing.assert_allclose(bp.data.read(path, time="ticks [ms]").t, [0, 0.008, 0.016, 0.024])


def test_mistakes_in_files_have_places(tmp_path):
    path = tmp_path / "swing.csv"
    path.write_text("t;a;b\n0;0,1;0,2\n0,01;1.5;0,3\n0,02;0,2;0,4\n")
    with pytest.raises(bp.data.ReadError, match="decimal points in a file of decimal commas") as error:
        bp.data.read(path)
    assert isinstance(error.value, ValueError)
    assert error.value.file == str(path)
    assert (error.value.line, error.value.column, error.value.name) == (3, 2, "a")
    with pytest.raises(bp.data.ReadError, match="did you mean `a`|there is no column") as error:
        bp.data.read(MEASURED, columns=["phi3"])
    assert error.value.line is None
    with pytest.raises(FileNotFoundError, match="nothing.csv"):
        bp.data.read(tmp_path / "nothing.csv")
    with pytest.raises(ValueError, match='unit is "turns", must be "rad" or "deg"'):
        bp.data.read(MEASURED, unit="turns")
    with pytest.raises(ValueError, match="give time= or frame_rate="):
        bp.data.read(MEASURED, time="t", frame_rate=100)
    with pytest.raises(ValueError, match="give dots= or columns="):
        bp.data.read(MEASURED, dots=[("a", "b")], columns=["phi1"])


def test_dots_of_deep_lab_cut(tmp_path, film):
    path, places = tmp_path / "dots.csv", camera.dots(film.y[:, :3])
    likelihood = np.full((len(film.t), 6, 1), 0.99)
    likelihood[100, 2] = 0.2
    camera.deep_lab_cut(path, places, likelihood)
    read = bp.data.read(path, frame_rate=240)
    expected = camera.angles(places)
    expected[100, 1] = np.nan
    np.testing.assert_allclose(read.theta, expected, atol=1e-5)
    np.testing.assert_allclose(read.t, film.t, atol=1e-12)
    assert np.argwhere(read.marked).tolist() == [[100, 1]]
    assert read.dot_distances is not None
    for mean, deviation in read.dot_distances:
        assert abs(mean - 0.25) < 1e-4 and 1e-4 < deviation < 5e-4
    named = bp.data.read(
        path, frame_rate=240, dots=[("left-top", "left-end")], y_down=True, likelihood=0.1
    )
    np.testing.assert_allclose(named.theta[:, 0], camera.angles(places)[:, 1], atol=1e-5)
    with pytest.raises(bp.data.ReadError, match="frame rate"):
        bp.data.read(path)


def relative(error, size):
    return np.sqrt(np.mean(error**2) / np.mean(size**2))


@pytest.mark.parametrize(
    "method, worst", [("kinematic", 0.03), ("polynomials", 0.03), ("equations", 0.002)]
)
def test_transfer_from_a_film(model, film, method, worst):
    """H_d and W in every form, with bars that hold what they say."""
    theta = camera.angles(camera.dots(film.y[:, :3]))
    theta[50, 1] = np.nan
    motion = model.smooth(film.t, theta, method=method)
    assert motion.y.shape == motion.y_error.shape == film.y.shape
    assert np.all(np.abs(motion.noise[0] / (2e-4 * np.sqrt(2) / 0.25) - 1) < 0.2)
    assert (motion.acceleration is None) == (method == "equations")
    assert np.all(motion.y_error > 0)
    pull = (motion.y - film.y) / motion.y_error
    assert 0.7 < np.sqrt(np.mean(pull**2)) < 1.4
    # By the equations the errors of all times are those of one start: within the bars or not.
    times_within = 0.4 if method == "equations" else 0.85

    def both(y):
        return np.stack([model.antiphase_energy(y)] + [model.transfer(y, f) for f in model.FORMS])

    (energy, *transfers), (energy_error, *errors) = motion.estimate(both, count=50)
    truth = model.antiphase_energy(film.y)
    assert np.mean(np.abs(energy - truth) < 1.96 * energy_error) > times_within
    assert np.all(np.abs(energy - truth) < 5 * energy_error)
    assert np.all(energy_error[5:-5] < 0.1 * truth.max())
    for form, transfer, error in zip(model.FORMS, transfers, errors):
        truth = model.transfer(film.y, form)
        assert relative(transfer - truth, truth) < worst
        assert np.mean(np.abs(transfer - truth) < 1.96 * error) > times_within

    def closure(y):
        energy = model.antiphase_energy(y)
        return analysis.running_integral(film.t, model.transfer(y)) - (energy - energy[0])

    mean, error = motion.estimate(closure, count=50)
    of_the_rule = 1e-6 * energy.max()
    assert np.all(np.abs(mean) < 5 * error + of_the_rule)


def test_friction_that_the_equations_lack():
    friction = PAPER.replace("joint = 0.27", "joint = 0.27, friction = 3e-4")
    friction = friction.replace("inertia = 0.516e-3", "inertia = 0.516e-3, friction = 3e-4")
    assert friction.count("friction") == 2
    t = np.arange(0, 4, 1 / 60)
    film = bp.Tree(friction, m=0.10531).integrate([0.83, 0.02, -0.01, 0, 0, 0], t)
    noise = np.random.default_rng(1).normal(0, 1e-3, film.y[:, :3].shape)
    ideal = bp.models.BranchedDouble()
    plain, found = (
        ideal.smooth(t, film.y[:, :3] + noise, method="equations", friction=friction)
        for friction in (False, True)
    )
    assert plain.frictions.shape == (0,) and found.frictions.shape == (3,)
    np.testing.assert_allclose(found.frictions, 3e-4, rtol=0.05)
    size = [relative(motion.y - film.y, film.y) for motion in (plain, found)]
    assert size[1] < 0.8 * size[0]
    with pytest.raises(ValueError, match='needs method = "equations", not "kinematic"'):
        ideal.smooth(t, film.y[:, :3], friction=True)


def test_equations_of_a_chain_of_eight_links():
    """A motion by SciPy of equations in closed form; smoothed by those of the tree."""
    n, g, mass, com, inertia, joint = 8, 9.81, 0.1, 0.05, 1e-4, 0.1
    below = np.arange(n - 1, -1, -1)
    coupled = joint * mass * (com + joint * np.minimum.outer(below, below))
    np.fill_diagonal(coupled, inertia + mass * (com**2 + joint**2 * below))
    weight = g * mass * (com + joint * below)

    def rates(_, state):
        theta, omega = state[:n], state[n:]
        between = theta[:, None] - theta
        torques = -(coupled * np.sin(between)) @ omega**2 - weight * np.sin(theta)
        return np.concatenate([omega, np.linalg.solve(coupled * np.cos(between), torques)])

    t = np.arange(0, 1, 1 / 120)
    start = np.concatenate([np.linspace(0.5, 0.9, n), np.zeros(n)])
    truth = solve_ivp(rates, (0, 1), start, "DOP853", t, rtol=1e-11, atol=1e-12).y.T
    seen = truth[:, :n] + np.random.default_rng(5).normal(0, 1e-3, (len(t), n))
    seen[40, 3] = np.nan
    text = f"l{n}(mass = {mass}, com = {com}, inertia = {inertia})"
    for link in range(n - 1, 0, -1):
        text = f"l{link}(mass = {mass}, com = {com}, inertia = {inertia}, joint = {joint}) [{text}]"
    chain = bp.Tree(f"gravity = {g}, {text}")
    motion = chain.smooth(t, seen, method="equations")
    assert motion.y.shape == motion.y_error.shape == (len(t), 2 * n)
    assert motion.noise == pytest.approx(np.full(n, 1e-3), rel=0.1)
    # The errors of all times are those of one start: sixteen numbers.
    pull = (motion.y - truth) / motion.y_error
    assert 0.5 < np.sqrt(np.mean(pull**2)) < 1.5
    by_smoothness = chain.smooth(t, seen)
    error, rough = (np.abs(found.y - truth).mean() for found in (motion, by_smoothness))
    assert error < 0.4 * rough


def test_draws_are_those_of_the_estimate(model, film):
    motion = model.smooth(film.t, camera.angles(camera.dots(film.y[:, :3])))
    draws = motion.draws(20, seed=3)
    assert draws.shape == (20, *film.y.shape)
    energies = model.antiphase_energy(draws)
    mean, error = motion.estimate(model.antiphase_energy, count=20, seed=3)
    np.testing.assert_allclose(mean, energies.mean(axis=0), rtol=1e-12)
    np.testing.assert_allclose(error, energies.std(axis=0, ddof=1), rtol=1e-9)
    frame = motion.frame()
    assert list(frame.columns[[0, -1]]) == ["theta_parent", "omega_child_2"]
    with pytest.raises(ValueError, match="theta has 2 columns, must have 3"):
        model.smooth(film.t, film.y[:, :2])
    with pytest.raises(ValueError, match='"kinematic", "polynomials" or "equations"'):
        model.smooth(film.t, film.y[:, :3], method="magic")
    with pytest.raises(ValueError, match="finite and each later"):
        model.smooth(film.t[::-1], film.y[:, :3])
    with pytest.raises(ZeroDivisionError):
        motion.estimate(lambda y: 1 / 0)


CHAIN = """
gravity = 9.80858023,
upper(mass = 0.0938439748, com = 0.108565215, inertia = 4.37529430e-4, joint = 0.172719204,
    friction = 2.37142783e-4) [
    lower(mass = 0.137595970, com = 0.116779018, inertia = 1.26882939e-3, friction = 1.00000019e-5)
]
"""


def test_a_measured_chain_loses_its_energy():
    """Sixteen seconds of a double pendulum with encoders (K. Kaheman et al.), and the
    constants that its authors fitted."""
    measured, chain = bp.data.read(MEASURED), bp.Tree(CHAIN)
    assert "detected: angles from the upward vertical" in measured.findings
    first = measured.t < 16
    t, theta = measured.t[first], measured.theta[first]
    motion = chain.smooth(t, theta)
    assert motion.noise.max() < 2e-4
    energy, error = motion.estimate(chain.energy, count=20)
    assert 0.4 < energy[-1] / energy[0] < 0.7 and error.max() < 0.01 * energy[0]
    lost, _ = motion.estimate(lambda y: analysis.running_integral(t, chain.friction_power(y)), 20)
    closure = np.abs(lost - (energy - energy[0])).max() / energy[0]
    assert 0.02 < closure < 0.1


def test_series_that_are_given():
    t = np.linspace(0, 2, 481)
    noisy = np.sin(6 * t) + np.random.default_rng(4).normal(0, 1e-3, t.size)
    noisy[7] = np.nan
    motion = analysis.smooth(t, noisy)
    assert motion.y.shape == (481, 2) and motion.acceleration.shape == (481, 1)
    assert motion.noise == pytest.approx([1e-3], rel=0.2) and abs(motion.whiteness) < 4
    assert np.abs(motion.y[:, 1] - 6 * np.cos(6 * t)).max() < 0.1
    np.testing.assert_allclose(analysis.running_integral(t, 4 * t**3), t**4, atol=1e-13)
    with pytest.raises(ValueError, match="2 times for 3 values"):
        analysis.running_integral([0, 1], [1, 2, 3])


def test_spectrum_and_lines():
    t = np.arange(2000) / 100
    wave = 1 + 0.7 * np.cos(2 * np.pi * 0.8731 * t) + 0.2 * np.cos(2 * np.pi * 1.5826 * t + 0.3)
    wave += 0.05 * np.cos(2 * np.pi * (2 * 0.8731 + 1.5826) * t)
    found = analysis.lines(wave, 100)
    assert len(found) == 3
    np.testing.assert_allclose(found.frequencies[:2], [0.8731, 1.5826], atol=1e-8)
    np.testing.assert_allclose(found.amplitudes, [0.7, 0.2, 0.05], atol=1e-8)
    assert found.phases[1] == pytest.approx(0.3) and found.mean == pytest.approx(1)
    assert found.named({"a": 0.8731, "b": 1.5826}, tolerance=1e-6) == ["a", "b", "2a + b"]
    np.testing.assert_allclose(found(t), wave, atol=1e-8)
    frequencies, amplitudes = analysis.spectrum(wave, 100)
    assert frequencies[1] == pytest.approx(0.05) and frequencies.shape == amplitudes.shape
    _, amplitude = analysis.spectrum(wave, 100, frequencies=[0.8731])
    assert amplitude == pytest.approx([0.7], abs=0.01)
    with pytest.raises(ValueError, match="sample 3 is NaN"):
        analysis.lines([1, 2, 3, np.nan], 10)


@pytest.mark.parametrize("of", ["model", "tree"])
def test_growth_of_a_difference(model, of):
    """The numbers of the library's transverse equations (docs/growth.md), and of two motions
    side by side."""
    pendulum = model if of == "model" else bp.Tree(PAPER, m=0.10531)
    starts = np.zeros((4, 6))
    starts[:, 0] = np.radians([42, 44, 47.6, 47.8])
    children = ("child_1", "child_2")
    grown = pendulum.growth(starts, children, [4, 10])
    assert grown.factors.shape == (4, 2) and grown.rates.shape == grown.frequencies.shape == (4,)
    assert grown.factors[0, 1] < 10 and grown.factors[1, 1] > 16
    np.testing.assert_allclose(grown.factors[2:, 0], [81, 58], atol=0.5)
    np.testing.assert_allclose(grown.factors[2:, 1], [1860, 28000], rtol=0.02)
    assert np.all(grown.factor_changes < 1e-3)
    assert grown.rates[0] < 0.1 < 0.3 < grown.rates[2]
    small = 1e-7
    apart = starts + small * np.array([0, 1, -1, 0, 0, 0])
    motions = pendulum.ensemble(apart, np.linspace(0, 4, 4001), rtol=1e-13)
    largest = np.abs(motions[:, :, 1] - motions[:, :, 2]).max(axis=1) / (2 * small)
    np.testing.assert_allclose(grown.factors[:, 0], largest, rtol=1e-3)
    with pytest.raises(KeyError, match="there is no link `child`"):
        pendulum.growth(starts, ("child", "child_2"), [4])
    with pytest.raises(ValueError, match="horizons"):
        pendulum.growth(starts, children, [4, 2])
    for pair in [("parent", "child_1"), ("child_1", "child_1")]:
        with pytest.raises(ValueError, match="are not copies that start in phase"):
            pendulum.growth(starts, pair, [4])
    with pytest.raises(ValueError, match="are not copies that start in phase"):
        pendulum.growth(apart, children, [4])
    assert np.isnan(pendulum.growth(starts * np.nan, children, [1]).factors).all()


def test_growth_between_branches():
    """Two arms with a hand each: the difference has two links."""
    rods = "body: rod(mass = 0.3, length = 0.4) [arm: rod(mass = m, length = 0.3) [hand: rod(mass = 0.05, length = 0.2)]"
    same = bp.Tree(f"gravity = 9.81, {rods} * 2]", m=0.1)
    assert same.names[1::2] == ["arm_1", "arm_2"]
    start = np.zeros((1, 10))
    start[0, 0] = 1.2
    grown = same.growth(start, ("arm_1", "arm_2"), [2])
    apart = start.copy()
    apart[0, 1:5] = [1e-7, 1e-7, -1e-7, -1e-7]
    motion = same.ensemble(apart, np.linspace(0, 2, 2001), rtol=1e-13)[0]
    sizes = np.linalg.norm(motion[:, 1:3] - motion[:, 3:5], axis=1)
    largest = sizes.max() / sizes[0]
    assert grown.factors[0, 0] == pytest.approx(largest, rel=1e-3)
