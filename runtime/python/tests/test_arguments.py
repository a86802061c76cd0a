"""Arguments that are refused, each by its name, and motions that fail, each with its reason."""

import re
import warnings

import branched_pendulum as bp
import numpy as np
import pytest
from branched_pendulum import analysis

from test_tree import PAPER, START

T = np.linspace(0, 1, 11)
RNG = np.random.default_rng(3)


@pytest.fixture(scope="module")
def tree():
    return bp.Tree(PAPER, m=0.10531)


@pytest.fixture(scope="module")
def model():
    return bp.models.BranchedDouble()


@pytest.fixture(scope="module")
def motion(tree):
    return tree.integrate(START, T, dense_output=True)


def calls(tree, model, motion):
    """Every argument that is an array: its name, and a call with another one in its place."""
    three, pair = np.zeros(3), ("child_1", "child_2")
    alike = np.zeros((2, 6))
    smooth = tree.smooth(T, motion.y[:, :3])
    wave = np.sin(6 * np.arange(100) / 10)
    lines = analysis.lines(wave, 10)
    budgets = bp.Tree("gravity = 9.81, a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2]")
    return [
        ("y", START, lambda x: tree.rhs(0.0, x)),
        ("y", motion.y, tree.energy),
        ("y0", START, lambda x: tree.integrate(x, T)),
        ("t", T, lambda x: tree.integrate(START, x)),
        ("starts", alike, lambda x: tree.ensemble(x, T)),
        ("t", T, lambda x: tree.ensemble(alike, x)),
        ("y0", START, lambda x: tree.lyapunov(x, intervals=2, settling=0)),
        ("starts", alike, lambda x: tree.growth(x, pair, [1.0])),
        ("horizons", np.ones(1), lambda x: tree.growth(alike, pair, x)),
        ("t", T, lambda x: tree.smooth(x, motion.y[:, :3])),
        ("theta", motion.y[:, :3], lambda x: tree.smooth(T, x)),
        ("theta", three, lambda x: tree.accelerations(x, three)),
        ("omega", three, lambda x: tree.accelerations(three, x)),
        ("torques", three, lambda x: tree.accelerations(three, three, torques=x)),
        ("theta", three, lambda x: tree.kinetic_energy(x, three)),
        ("omega", three, lambda x: tree.kinetic_energy(three, x)),
        ("theta", three, tree.potential_energy),
        ("y", motion.y, tree.friction_power),
        ("y", motion.y, budgets.budget),
        ("t", T, lambda x: budgets.budget(motion.y, x)),
        ("torques", three, lambda x: budgets.budget(motion.y, torques=x)),
        ("starts", START, lambda x: tree.advise(x, (0, 0.1))),
        ("t", T, lambda x: tree.advise(START, x, {"angles": 1e-3})),
        ("y0", START, tree.stepper),
        ("torques", three, lambda x: tree.stepper(START, torques=x)),
        ("x", motion.y.T, analysis.average),
        ("theta", three, lambda x: tree.momenta(x, three)),
        ("omega", three, lambda x: tree.momenta(three, x)),
        ("theta", three, tree.mass_matrix),
        ("theta", three, tree.stiffness_matrix),
        ("theta", three, tree.modes),
        ("theta", three, tree.points),
        ("y", motion.y, model.canonical_variables),
        ("y", motion.y, model.antiphase_energy),
        ("y", motion.y, model.transfer),
        ("y", motion.y, model.transfer_parts),
        ("t", T, motion),
        ("function", motion.y, lambda x: smooth.estimate(lambda y: x, count=2)),
        ("t", T, lambda x: analysis.smooth(x, motion.y)),
        ("x", motion.y, lambda x: analysis.smooth(T, x)),
        ("x", wave, lambda x: analysis.spectrum(x, 10)),
        ("frequencies", np.ones(1), lambda x: analysis.spectrum(wave, 10, frequencies=x)),
        ("x", wave, lambda x: analysis.lines(x, 10)),
        ("t", T, lines),
        ("t", T, lambda x: analysis.running_integral(x, np.ones(T.size))),
        ("x", T, lambda x: analysis.running_integral(T, x)),
    ]


def test_nothing_is_lost_of_an_array(tree, model, motion):
    for name, good, call in calls(tree, model, motion):
        call(good.tolist())
        call(good.astype(object))
        call(np.ma.masked_array(good))
        masked = np.ma.masked_array(good, np.zeros(good.shape, bool))
        masked.mask[(0,) * good.ndim] = True
        for bad, match in [
            (good + 1j, "complex"),
            ((good + 0j).tolist(), "complex"),
            ((good + 0j).astype(np.complex64), "complex"),
            (masked, "masked"),
            (list(masked), "masked"),
            (good.astype(str), "must be .*real numbers"),
            (good.astype("m8[s]"), "must be .*real numbers"),
            ("far", "must be .*real numbers, got 'far'"),
            ([[1.0], [1.0, 2.0]], "."),
            (None if name not in ("torques", "frequencies", "theta", "t") else {}, "."),
        ]:
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                with pytest.raises(TypeError, match=match) as refused:
                    call(bad)
            # By its name, without a look at the note behind the message.
            assert re.match(rf"(the value of )?{name}\b", str(refused.value)), refused.value


def test_shapes_are_named(tree, model, motion):
    for name, good, call in calls(tree, model, motion):
        # An axis more, one less, a number too many.
        wrong = [good[None, None], good[0], np.concatenate([good, good[:1]])]
        if good.ndim == 2:
            wrong.append(good[:, :-1])
        refused = 0
        for bad in wrong:
            try:
                call(bad)
            except ValueError as error:
                refused += 1
                assert re.search(rf"\b({name}|requested time)\b", str(error)), error
                assert "dimensionality" not in str(error)
            except bp.IntegrationError as error:
                assert "time" in str(error)
        # Functions of each state or time take any shape before it.
        assert refused >= 1 or name in ("t", "function"), (name, good.shape)


@pytest.mark.parametrize(
    "message, call",
    [
        (r"y0 must have shape \(6,\), got \(6, 1\)", lambda tree: tree.integrate(START[:, None], T)),
        (r"y0 must have shape \(6,\), got \(\)", lambda tree: tree.integrate(1.0, T)),
        (r"y0 must have shape \(6,\), got \(5,\)", lambda tree: tree.lyapunov(START[1:])),
        (r"t must have one axis, got shape \(\)", lambda tree: tree.integrate(START, 10)),
        (r"t must have one axis, got shape \(1, 11\)", lambda tree: tree.ensemble([START], [T])),
        (r"starts must have shape \(n, 6\), got \(6,\)", lambda tree: tree.ensemble(START, T)),
        (r"starts must have shape \(n, 6\), got \(6, 1\)", lambda tree: tree.ensemble(START[:, None], T)),
        ("threads must be at least 1, got 0", lambda tree: tree.ensemble([START], T, threads=0)),
        ("threads must be at least 1, got -1", lambda tree: tree.ensemble([START], T, threads=-1)),
        ("threads must be at least 1, got -3", lambda tree: tree.growth([[0] * 6], ("child_1", "child_2"), [1], threads=-3)),
        ("max_steps must be at least 1, got 0", lambda tree: tree.integrate(START, T, max_steps=0)),
        ("max_steps must be at least 1, got -7", lambda tree: tree.ensemble([START], T, max_steps=-7)),
        (r"max_steps must be less than 2\^64, got 18446744073709551616", lambda tree: tree.integrate(START, T, max_steps=2**64)),
        ("count must be at least 1, got 0", lambda tree: tree.lyapunov(START, count=0)),
        ("count must be at least 1, got -1", lambda tree: tree.lyapunov(START, count=-1)),
        ("settling must be at least 0, got -1", lambda tree: tree.lyapunov(START, settling=-1)),
        ("intervals must be at least 1, got 0", lambda tree: tree.lyapunov(START, intervals=0)),
        ("pair must be two names of links, got 3", lambda tree: tree.growth([[0] * 6], ["a", "b", "c"], [1])),
        (r"y has shape \(3, 2\), t has shape \(2,\): these do not go together", lambda tree: bp.Tree("gravity = 1, a: rod(mass = 1, length = 1)").budget(np.zeros((3, 2)), [1, 2])),
        ("t has 2 times for 3 values in x", lambda tree: analysis.running_integral([0, 1], [1, 2, 3])),
        (r"theta must have a row for each time.*\(10, 3\), that of t is \(11,\)", lambda tree: tree.smooth(T, np.zeros((10, 3)))),
        ("window must be at least 0, got -1", lambda tree: analysis.spectrum(T, 10, window=-1)),
        (r"window must be less than 2\^8, got 256", lambda tree: analysis.lines(T, 10, window=256)),
        ("most must be at least 1, got -1", lambda tree: analysis.lines(T, 10, most=-1)),
        ("order must be at least 1, got -1", lambda tree: analysis.lines(np.sin(T), 10).named({"f": 1.0}, order=-1)),
    ],
)
def test_messages(tree, message, call):
    with pytest.raises(ValueError, match=message):
        call(tree)


def test_counts_of_draws(tree, motion):
    smooth = tree.smooth(T, motion.y[:, :3])
    for message, call in [
        ("count must be at least 0, got -1", lambda: smooth.draws(-1)),
        ("seed must be at least 0, got -1", lambda: smooth.draws(1, seed=-1)),
        (r"seed must be less than 2\^64", lambda: smooth.draws(1, seed=2**64)),
        ("count must be at least 2, got 1", lambda: smooth.estimate(tree.energy, count=1)),
    ]:
        with pytest.raises(ValueError, match=message):
            call()
    assert smooth.draws(1, seed=2**64 - 1).shape == (1, 11, 6)


def test_a_parameter_of_any_name():
    for name in ["text", "tree", "parameters", "py"]:
        tree = bp.Tree(f"gravity = 9.81, a: rod(mass = {name}, length = 1)", **{name: 1.5})
        assert tree.parameters == {name: 1.5}
        assert tree.changed(**{name: np.float32(2)}).parameters == {name: 2.0}
        assert tree.changed(**{name: np.array(3)}).parameters == {name: 3.0}
    for value in [1 + 2j, np.complex128(1), np.ones(2), "heavy", np.ma.masked, None]:
        with pytest.raises(TypeError, match="parameter `m` must be "):
            bp.Tree(PAPER, m=value)
    with pytest.raises(TypeError, match="text"):
        bp.Tree(text=PAPER, m=0.1)


@pytest.mark.parametrize("method", ["dop853", "dopri5", "verner98"])
@pytest.mark.parametrize("rtol", [1e-17, 1e-20, 1e-30, 5e-324])
def test_a_tolerance_below_rounding_is_refused_at_once(tree, method, rtol):
    message = r"below the rounding .* smallest relative tolerance of use is 5.55\d*e-17 \(rtol, atol\)"
    for call in [
        lambda: tree.integrate(START, [0, 1e6], method, rtol=rtol),
        lambda: tree.integrate(START, [0, 1e6], method, rtol=rtol, dense_output=True),
        lambda: tree.integrate(START, [0, 1e6], method, rtol=rtol, events=lambda t, y: y[0]),
        lambda: tree.integrate(START, [0, 1e6], method, rtol=0, atol=rtol),
        lambda: tree.ensemble([START, START], [0, 1e6], method, rtol=rtol),
    ]:
        with pytest.raises(bp.RequestError, match=message) as error:
            call()
        assert isinstance(error.value, ValueError) and isinstance(error.value, bp.IntegrationError)
    tight = tree.integrate(START, [0, 0.1], method, rtol=1e-16, atol=1e-16)
    np.testing.assert_allclose(tight.y[-1], tree.integrate(START, [0, 0.1], rtol=1e-13).y[-1], atol=1e-11)
    if method == "dop853":
        for call in [
            lambda: tree.lyapunov(START, rtol=rtol),
            lambda: tree.growth(np.ones((1, 6)), ("child_1", "child_2"), [1], rtol=rtol),
        ]:
            with pytest.raises(bp.RequestError, match="below the rounding"):
                call()


def test_requests_that_no_method_can_answer(tree):
    for call, message in [
        (lambda: tree.integrate(START * np.nan, T), "component 0 of the starting state is NaN"),
        (lambda: tree.integrate(START, [0, np.nan]), "requested time 1 is NaN"),
        (lambda: tree.integrate(START, [0, np.nan], dense_output=True), "the end time is NaN"),
        (lambda: tree.integrate(START, [np.nan, 1]), "the starting time is NaN"),
        (lambda: tree.integrate(START, [0, 5, 3]), "times must run one way"),
        (lambda: tree.ensemble([START], [0, 5, 3]), "times must run one way"),
        (lambda: tree.ensemble([START], [0, np.inf]), "requested time 1 is inf"),
        (lambda: tree.ensemble([START], T, rtol=-1), "relative tolerance .* must be finite and not"),
    ]:
        with pytest.raises(bp.RequestError, match=message):
            call()


def test_more_steps(tree):
    for events in [None, lambda t, y: y[0]]:
        for dense_output in [False, True]:
            with pytest.raises(bp.IntegrationError, match=r"limit of 9 steps .*: more are made with max_steps="):
                tree.integrate(START, T, max_steps=9, events=events, dense_output=dense_output)
            run = tree.integrate(START, T, max_steps=900, events=events, dense_output=dense_output)
            assert 9 < run.steps < 900
    with pytest.raises(bp.IntegrationError, match="limit of 99 steps"):
        tree.integrate(START, T, method="rk4", step=1e-3, max_steps=99)
    # More than a million.
    rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
    with pytest.raises(bp.IntegrationError, match="limit of 1000000 steps"):
        rod.integrate([0.1, 0.0], [0, 1100], method="rk4", step=1e-3)
    end = rod.integrate([0.1, 0.0], [0, 1100], method="rk4", step=1e-3, max_steps=1_100_001)
    assert end.steps == 1_100_000


def test_an_ensemble_tells_the_reason_of_each_failure(tree):
    starts = np.array([START, START * np.nan, START, START * 1e200, START * np.inf])
    with pytest.warns(bp.FailedMotions, match=r"3 of 5 motions .* starts\[1\]: component 0") as seen:
        states = tree.ensemble(starts, T)
    reasons = seen[0].message.reasons
    assert sorted(reasons) == [1, 3, 4]
    assert "is NaN" in reasons[1] and "is inf" in reasons[4] and reasons[3]
    assert np.isfinite(states[[0, 2]]).all() and np.isnan(states[[1, 3, 4], -1]).all()
    assert issubclass(bp.FailedMotions, RuntimeWarning) and bp.FailedMotions.reasons == {}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tree.ensemble(starts[[0, 2]], T)
        with pytest.raises(bp.FailedMotions, match="5 of 5 motions") as failed:
            tree.ensemble(np.tile(START, (5, 1)), [0, 100], max_steps=50)
    assert all("limit of 50 steps" in reason for reason in failed.value.reasons.values())
    assert sorted(failed.value.reasons) == [0, 1, 2, 3, 4]


def test_growth_tells_the_reason_of_each_failure(tree):
    starts = np.zeros((3, 6))
    starts[:, 0] = [0.5, np.nan, 0.6]
    with pytest.warns(bp.FailedMotions, match=r"1 of 3 motions .* starts\[1\]") as seen:
        grown = tree.growth(starts, ["child_1", "child_2"], [1])
    assert list(seen[0].message.reasons) == [1]
    assert np.isnan(grown.factors[1]).all() and np.isfinite(grown.factors[[0, 2]]).all()


#: Calls with one wrong argument each, and the whole message.
WRONG_TYPES = [
    (lambda t: t.integrate(START, T, rtol="1e-9"), "rtol must be a real number, got '1e-9'"),
    (lambda t: t.integrate(START, T, rtol=None), "rtol must be a real number, got None"),
    (lambda t: t.integrate(START, T, step=[1, 2]), "step must be one real number, got an array of shape (2,)"),
    (lambda t: t.integrate(START, T, method=5), "method must be a str, got 5"),
    (lambda t: t.integrate(START, T, max_steps=1e6), "max_steps must be a whole number, got 1000000.0"),
    (lambda t: t.integrate(START, T, dense_output="yes"), "dense_output must be True or False, got 'yes'"),
    (lambda t: t.integrate(START, T, max_step="long"), "max_step must be a real number, got 'long'"),
    (lambda t: t.ensemble([START], T, threads="all"), "threads must be a whole number, got 'all'"),
    (lambda t: t.ensemble([START], T, parameters=[1]), "parameters must be a dict, got [1]"),
    (lambda t: t.ensemble([START], T, parameters={"m": "heavy"}), "parameters[\"m\"] must be real numbers, got 'heavy'"),
    (lambda t: t.ensemble([START], T, parameters={1: [1]}), "each key of parameters must be a str, got 1"),
    (lambda t: t.identify(T, np.zeros((11, 3)), "m"), "unknown must be a list, got one str; write ['m']"),
    (lambda t: t.identify(T, np.zeros((11, 3)), {"m": "big"}), "unknown[\"m\"] must be a real number, got 'big'"),
    (lambda t: t.identify(T, np.zeros((11, 3)), 3), "unknown must be a list, got 3"),
    (lambda t: t.identify(T, np.zeros((11, 3)), ["m"], nonnegative="m"), "nonnegative must be a list, got one str; write ['m']"),
    (lambda t: t.growth([[0] * 6], "child", [1]), "pair must be a list, got one str; write ['child']"),
    (lambda t: t.growth([[0] * 6], (1, 2), [1]), "pair[0] must be a str, got 1"),
    (lambda t: t.lyapunov(START, transverse=[("child_1", 2)]), "transverse[0][1] must be a str, got 2"),
    (lambda t: t.lyapunov(START, within="child"), "within must be a list, got one str; write ['child']"),
    (lambda t: t.advise(START, (0, 1), {"angles": "small"}), "right[\"angles\"] must be a real number, got 'small'"),
    (lambda t: t.work_precision(START, 5), "t must be 2 numbers, got 5"),
    (lambda t: t.work_precision(START, (0, 1, 2)), "t must be 2 numbers, got (0, 1, 2)"),
    (lambda t: t.points(np.zeros(3), 1), "point must be a str, got 1"),
    (lambda t: t.stepper(START, torques="x"), "torques must be a function f(t, y) or real numbers, got 'x'"),
    (lambda t: t.stepper(START, "late"), "t must be a real number, got 'late'"),
    (lambda t: analysis.lines(np.sin(T), "fast"), "sample_rate must be a real number, got 'fast'"),
    (lambda t: analysis.lines(np.sin(T), 10).named("f"), "fundamentals must be a dict, got 'f'"),
    (lambda t: bp.data.read(7), "path must be a path: a str or a pathlib.Path, got 7"),
    (lambda t: bp.data.read("x.csv", columns="a"), "columns must be a list, got one str; write ['a']"),
    (lambda t: bp.data.read("x.csv", pivot=3), 'pivot must be "origin" or two numbers (x, y), got 3'),
    (lambda t: bp.data.read("x.csv", gravity=[1]), 'gravity must be "axis", "first link" or the two numbers of a direction (x, y), got [1]'),
    (lambda t: bp.Tree(3), "text must be a str, got 3"),
]


@pytest.mark.parametrize("index", range(len(WRONG_TYPES)))
def test_wrong_types_are_named_in_one_sentence(tree, index):
    call, message = WRONG_TYPES[index]
    with pytest.raises(TypeError) as refused:
        call(tree)
    assert str(refused.value) == message


def test_a_direction_that_is_no_number(tree):
    def up(t, y):
        return y[0]

    for attribute in ["direction", "terminal"]:
        function = lambda t, y: y[0]
        setattr(function, attribute, "up")
        message = rf"events\[1\]\.{attribute} must be a real number, got 'up'"
        with pytest.raises(TypeError, match=message):
            tree.integrate(START, [0, 1], events=[up, function])


def test_no_tolerance_beside_a_zero_is_named(tree):
    """A component that is 0, and may have no error, lets no step be made."""
    rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
    for model, y0 in [(rod, [0.0, 2.0]), (rod, [0.3, 0.0]), (tree, [1, 2, 0, 0, 0, 0])]:
        for method in ["dop853", "dopri5", "verner98"]:
            zeros = np.zeros(len(y0))
            with pytest.raises(bp.IntegrationError, match="give atol above 0"):
                model.integrate(y0, [0, 1], method, atol=zeros)
            with pytest.warns(bp.FailedMotions, match="give atol above 0"):
                model.ensemble([y0], [0, 1], method, atol=zeros)


def test_mappings_of_any_kind(tree):
    from types import MappingProxyType

    values = MappingProxyType({"m": [0.1, 0.2]})
    states = tree.ensemble([START, START], T, parameters=values)
    np.testing.assert_array_equal(states[0], tree.ensemble([START], T, parameters={"m": [0.1]})[0])
