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
    """The same equations and tolerances."""
    t = np.linspace(0, 10, 1001)
    tolerances = {"rtol": 1e-10, "atol": 1e-10}
    own = tree.integrate(START, t, **tolerances)
    other = solve_ivp(tree.rhs, (0, 10), START, "DOP853", t, **tolerances)
    np.testing.assert_allclose(own.y, other.y.T, atol=1e-5)
    np.testing.assert_array_equal(own.t, t)
    assert own.steps > 10 and own.evaluations > 100 and own.message.startswith("end reached")
    energy = tree.energy(own.y)
    assert energy.shape == t.shape and np.ptp(energy) < 1e-8 * energy[0]
    assert tree.energy(own.y[0]).shape == () and tree.energy(list(START)) == energy[0]


def test_dense_output(tree):
    t = np.linspace(0, 5, 51)
    kept = tree.integrate(START, t, rtol=1e-13, dense_output=True)
    plain = tree.integrate(START, t, rtol=1e-13)
    np.testing.assert_array_equal(kept.y, plain.y)
    np.testing.assert_array_equal(kept(t), plain.y)
    np.testing.assert_array_equal(kept(t[7]), plain.y[7])
    assert kept(t.reshape(3, 17)).shape == (3, 17, 6)
    slope = (kept(2.0 + 1e-5) - kept(2.0 - 1e-5)) / 2e-5
    np.testing.assert_allclose(slope, tree.rhs(2.0, kept(2.0)), rtol=1e-6, atol=1e-6)
    with pytest.raises(ValueError, match="outside"):
        kept(5.1)
    with pytest.raises(ValueError, match="dense_output=True"):
        plain(1.0)


def test_events_are_those_of_scipy(tree):
    def turns(t, y):
        return y[3]

    def far(t, y):
        return t - 3.3

    turns.direction, far.terminal = -1, True
    t, start = np.linspace(0, 5, 501), START + [0, 0, 0, 0.1, 0, 0]
    own = tree.integrate(start, t, rtol=1e-12, atol=1e-12, events=[turns, far])
    other = solve_ivp(
        tree.rhs, (0, 5), start, "DOP853", t, events=[turns, far], rtol=1e-12, atol=1e-12
    )
    assert own.message.startswith("stopped at an event")
    np.testing.assert_array_equal(own.t, t[t < 3.3])
    assert len(own.t_events[0]) > 1 and len(own.t_events[1]) == 1
    for mine, theirs in zip(own.t_events, other.t_events):
        np.testing.assert_allclose(mine, theirs, atol=1e-8)
    for mine, theirs in zip(own.y_events, other.y_events):
        np.testing.assert_allclose(mine, theirs, atol=1e-6)

    def wrong(t, y):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        tree.integrate(START, t, events=[wrong])


@pytest.mark.parametrize("method", ["rk4", "gauss8", "animation"])
def test_methods_with_steps(tree, method):
    t = np.linspace(0, 0.5, 6)
    right = tree.integrate(START, t, rtol=1e-12).y
    own = tree.integrate(START, t, method=method, step=1e-4)
    np.testing.assert_allclose(own.y, right, atol=1e-4)
    with pytest.raises(ValueError, match="give step="):
        tree.integrate(START, t, method=method)


def test_lyapunov_exponents(tree):
    wild = np.array([2.5, 2.0, 1.0, 0.0, 0.0, 0.0])
    exponents, errors = tree.lyapunov(wild, count=6, intervals=100)
    assert exponents.shape == errors.shape == (6,)
    # Nothing is lost to friction: volumes in phase space keep their size.
    assert exponents[0] > 0.5 and abs(exponents.sum()) < 0.05
    with pytest.raises(ValueError, match="7 exponents"):
        tree.lyapunov(wild, count=7)
    with pytest.raises(ValueError, match="positive length"):
        tree.lyapunov(wild, interval=-0.5)


def test_exponents_in_phase(tree):
    """In phase, where a difference grows: the largest exponent is that of the difference."""
    start = np.array([np.radians(44), 0, 0, 0, 0, 0])
    children = [("child_1", "child_2")]
    (largest,), _ = tree.lyapunov(start, settling=40, intervals=300)
    (within,), _ = tree.lyapunov(start, settling=40, intervals=300, within=children)
    (transverse,), _ = tree.lyapunov(start, settling=40, intervals=300, transverse=children)
    assert abs(largest - transverse) < 0.01 and transverse > 0.2 and within < 0.05
    growth = tree.growth(start[None], children[0], [170.0])
    assert abs(growth.rates[0] - transverse) < 0.02
    wheel = bp.Tree("""gravity = 9.81,
        wheel(mass = 1, com = 0, inertia = 1, joint = 0) [rod: rod(mass = 1, length = 1)]""")
    for count in (1, 2):
        exponents, _ = wheel.lyapunov([0, np.pi, 0, 0], count=count, interval=0.1, intervals=40)
        assert exponents[0] == pytest.approx(np.sqrt(1.5 * 9.81), rel=1e-4)
    apart = start + [0, 0.1, 0, 0, 0, 0]
    with pytest.raises(ValueError, match="not copies that start in phase"):
        tree.lyapunov(apart, within=children)
    with pytest.raises(KeyError):
        tree.lyapunov(start, within=[("child_1", "child")])


def test_frames(tree):
    frame = tree.integrate(START, np.linspace(0, 1, 3)).frame()
    assert list(frame.columns[:2]) == ["theta_parent", "theta_child_1"]
    assert frame.index.name == "t" and frame.shape == (3, 6)


def test_docstrings_have_units():
    for owner in [bp.Tree, bp.models.BranchedDouble]:
        for name in dir(owner):
            if not name.startswith("_") and callable(getattr(owner, name)):
                assert getattr(owner, name).__doc__, name
    assert "rad/s²" in bp.Tree.accelerations.__doc__


@pytest.mark.parametrize("method", ["dop853", "dopri5", "verner98", "taylor"])
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
    with pytest.raises(ValueError, match="not an equilibrium.*`equilibrium`"):
        tree.modes([1.0, 0.0, 0.0])
    np.testing.assert_allclose(tree.equilibrium([1.0, 0.0, 0.0]), theta, atol=1e-15)


def test_budget_by_scale():
    """Along a motion energies by scale sum up, and change as transfers and powers tell."""
    tree = bp.Tree("""
        gravity = 9.81,
        trunk: rod(mass = 0.3, length = 0.4, friction = 1e-3) [
            bough: rod(mass = 0.1, length = 0.3, drag = 1e-3) [
                twig: rod(mass = 0.05, length = 0.2) * 2
            ] * 3
        ],
        drive(torque = 0.1 * cos(3 * t))
    """)
    start = np.concatenate([np.sin(np.arange(10.0)), np.zeros(10)])
    motion = tree.integrate(start, np.linspace(0, 1, 2001), rtol=1e-12)
    budget = tree.budget(motion.y, motion.t)
    assert budget.energies.shape == (2001, 3) and budget.transfers.shape == (2001, 3, 3)
    np.testing.assert_allclose(budget.energies.sum(axis=1), tree.energy(motion.y), rtol=1e-12)
    np.testing.assert_array_equal(budget.transfers, -budget.transfers.swapaxes(1, 2))
    powers = budget.friction + budget.drag + budget.drive
    np.testing.assert_allclose(
        (budget.friction + budget.drag).sum(axis=1), tree.friction_power(motion.y), atol=1e-14
    )
    for scale in range(3):
        power = budget.transfers[:, :, scale].sum(axis=1) + powers[:, scale]
        grown = bp.analysis.running_integral(motion.t, power)
        change = budget.energies[:, scale] - budget.energies[0, scale]
        np.testing.assert_allclose(grown, change, atol=1e-7 * np.abs(power).max())
    assert tree.budget(start).energies.shape == (3,)
    with pytest.raises(ValueError, match="t has shape \\(2,\\)"):
        tree.budget(motion.y, [0, 1])
    unlike = bp.Tree("gravity = 9.81, a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1), c: rod(mass = 2, length = 1)]")
    with pytest.raises(ValueError, match="links of one generation differ"):
        unlike.budget(np.zeros(6))
    chain = "gravity = 9.81, tree: generations(count = {}, branching = 1, shape = rod, mass = 1, length = 1)"
    assert np.isfinite(bp.Tree(chain.format(34)).budget(np.ones(68)).energies).all()
    with pytest.raises(ValueError, match="35 generations, scales are known of at most 34"):
        bp.Tree(chain.format(35)).budget(np.ones(70))


def test_mistakes():
    with pytest.raises(bp.DescriptionError) as error:
        bp.Tree("gravity = 9.81,\nrod: rod(mas = 1, length = 1)")
    assert "--> 2:10" in str(error.value) and "did you mean `mass`?" in str(error.value)
    assert error.value.mistakes[0][:2] == (2, 10) and "`mas`" in error.value.mistakes[0][2]
    with pytest.raises(ValueError, match="no value for `m`"):
        bp.Tree(PAPER)
    with pytest.raises(ValueError, match="mass of `child` is -1, must be finite and not negative"):
        bp.Tree(PAPER, m=-1)
    tree = bp.Tree(PAPER, m=0.1)
    assert tree.changed(m=0.2).parameters == {"m": 0.2}
    with pytest.raises(KeyError, match="no parameter `n`"):
        tree.changed(n=1)
    with pytest.raises(ValueError, match=r"y0 must have shape \(6,\), got \(3,\)"):
        tree.integrate(np.zeros(3), np.linspace(0, 1, 3))
    with pytest.raises(ValueError, match="there is no method `euler`"):
        tree.integrate(START, np.linspace(0, 1, 3), method="euler")
    with pytest.raises(bp.IntegrationError):
        tree.integrate(START * np.nan, np.linspace(0, 1, 3))
    with pytest.raises(bp.IntegrationError, match="Taylor"):
        bp.models.BranchedDouble().integrate(START, np.linspace(0, 1, 3), method="taylor")
    with pytest.raises(ValueError, match="ensembles go by"):
        bp.models.BranchedDouble().ensemble([START], [0, 1], method="taylor")
    for dense_output in [False, True]:
        with pytest.raises(bp.IntegrationError):
            tree.integrate(START, [0, 5, 3], dense_output=dense_output)
    failed = tree.ensemble([START, START * np.nan], [0, 1])
    assert np.isnan(failed[1]).all() and not np.isnan(failed[0]).any()


def test_taylor_series_meet_other_methods(tree):
    times = np.linspace(0, 3, 7)
    series = tree.integrate(START, times, method="taylor", rtol=1e-12)
    other = tree.integrate(START, times, method="dop853", rtol=1e-12)
    assert np.abs(series.y - other.y).max() < 1e-8
    assert series.steps < other.steps


def test_auto_takes_a_fast_method_and_names_it(tree):
    times = np.linspace(0, 1, 3)
    chosen = tree.integrate(START, times)
    assert chosen.report.method == "taylor"
    right = tree.integrate(START, times, method="dop853", rtol=1e-12)
    np.testing.assert_allclose(chosen.y, right.y, atol=1e-6)
    compiled = bp.models.BranchedDouble()
    assert compiled.integrate(START, times).report.method == "verner98"
    assert compiled.integrate(START, times, rtol=1e-3).report.method == "dop853"
    assert tree.stepper(START, torques=[0, 0, 0]).report.method == "verner98"
    with pytest.raises(ValueError, match="rk4"):
        tree.integrate(START, times, step=1e-3)


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


BUCKLED = "gravity = -9.81, r: rod(mass = 0.4, length = 0.5, spring = 0.9)"
VEE = """gravity = 9.80665, stem: rod(mass = 0.25, length = 0.28) [
    left: rod(mass = 0.09, length = 0.22), right: rod(mass = 0.11, length = 0.25)
], between(left, right, at = each(0.22, 0.25), spring = 2, rest = 0.2)"""


@pytest.mark.parametrize(
    "text, rest, kinds",
    [
        (BUCKLED, [0.71286], ["stable", "stable", "unstable"]),
        (BUCKLED.replace("0.9", "1.2"), [0.0], ["stable"]),
        (VEE, None, None),
        ("gravity = 0, r: rod(mass = 0.4, length = 0.5)", [0.0], ["neutral"]),
    ],
)
def test_equilibria_are_stable_unless_others_are_asked_for(text, rest, kinds):
    tree = bp.Tree(text)
    theta = tree.equilibrium()
    if rest is not None:
        np.testing.assert_allclose(np.abs(theta), rest, atol=1e-5)
    n = len(theta)
    np.testing.assert_allclose(tree.rhs(0.0, np.concatenate([theta, np.zeros(n)])), 0, atol=1e-9)
    found = tree.equilibria()
    np.testing.assert_allclose(found[0].theta, theta, atol=1e-9)
    if kinds is not None:
        assert [own.stability for own in found] == kinds
    for own in found:
        stiffness = np.linalg.eigvalsh(tree.stiffness_matrix(own.theta))
        expected = {"stable": 1, "unstable": -1, "neutral": 0}[own.stability]
        assert np.sign(np.round(stiffness[0], 12)) == expected
    if found[0].stability == "stable":
        np.testing.assert_allclose(tree.modes()[0], tree.modes(theta)[0])


def test_descent_goes_to_the_side_of_its_start():
    rod = bp.Tree(BUCKLED)
    for start in (0.3, -0.3, 0.01, -2.0):
        assert np.sign(rod.equilibrium([start])[0]) == np.sign(start)
    assert abs(rod.equilibrium([0.3], stable=False)[0]) < 1e-12
    hanging = bp.Tree("gravity = 10, rod: rod(mass = 1, length = 1)")
    np.testing.assert_allclose(hanging.equilibrium([3.0], stable=False), [np.pi])
    np.testing.assert_allclose(hanging.equilibrium([3.0]), [0.0], atol=1e-12)


@pytest.mark.parametrize("method", ["dop853", "taylor", "verner98"])
def test_chaos_is_reported_where_a_precision_is_asked_for(method):
    text = """gravity = 9.80665,
        upper: rod(mass = 0.24, length = 0.31) [lower: rod(mass = 0.17, length = 0.26)]"""
    tree = bp.Tree(text)
    t = np.linspace(0, 40, 401)
    y = np.concatenate([np.radians([120, -120]), np.zeros(2)])
    plain = tree.integrate(y, t, method=method)
    assert plain.report.precision is None and plain.report.differs_from is None
    chaotic = tree.integrate(y, t, method=method, precision=1e-6)
    np.testing.assert_array_equal(chaotic.y, plain.y)
    assert 2 < chaotic.report.differs_from < 35
    assert "differs by more than" in str(chaotic.report)
    coarse = tree.integrate(y, t, method=method, precision=0.1)
    assert chaotic.report.differs_from <= coarse.report.differs_from
    # Two times, a span and a grid: chaos begins where it does, whichever states are kept.
    for times in ([0, 40], (0, 40), [0, 10, 40]):
        other = tree.integrate(y, times, method=method, precision=1e-6).report.differs_from
        assert abs(other - chaotic.report.differs_from) < 0.5, (times, other)
    quiet = tree.integrate(0.05 * y, (0, 10), method=method, precision=1e-6)
    assert quiet.report.differs_from is None and "agrees" in str(quiet.report)
    for wrong in (0.0, -1.0, np.nan, np.inf):
        with pytest.raises(ValueError, match="precision is .*, must be positive and finite"):
            tree.integrate(y, t, precision=wrong)


def test_names_of_physicists_and_of_files():
    tree = bp.Tree("gravity = g, Bob: rod(mass = M, length = .5)", g=9.81, M=0.2)
    assert tree.names == ["Bob"] and tree.parameters == {"M": 0.2, "g": 9.81}
    for name in ("swing.txt", "trees/swing", "../a.txt"):
        with pytest.raises(bp.DescriptionError, match="looks like the name of a file"):
            bp.Tree(name)


def test_static_friction_falls_to_coulomb_friction():
    tree = bp.Tree(
        "gravity = 0, rod: rod(mass = 0.2, length = 0.3, "
        "friction(coulomb = 0.02, static = 0.05, stribeck = 1.5, width = 0.1))"
    )
    inertia = 0.2 * 0.3**2 / 3
    for rate in (-3.0, 0.05, 1.5, 20.0):
        strength = 0.02 + 0.03 / (1 + (rate / 1.5) ** 2)
        torque = -strength * rate / np.hypot(rate, 0.1)
        (found,) = tree.accelerations([0.0], [rate])
        assert found == pytest.approx(torque / inertia, rel=1e-13)
    with pytest.raises(ValueError, match="no Stribeck rate"):
        bp.Tree("gravity = 1, rod: rod(mass = 1, length = 1, friction(static = 1))")
