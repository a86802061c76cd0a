"""Manners of a Python package: signals, memory, pickles, shapes, what failures carry."""

import concurrent.futures
import copy
import functools
import multiprocessing
import os
import pickle
import subprocess
import sys
import textwrap
import warnings

import branched_pendulum as bp
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from test_tree import PAPER, START

T = np.linspace(0, 1, 11)


@pytest.fixture(scope="module")
def tree():
    return bp.Tree(PAPER, m=0.10531)


LONG = {
    "integrate": "tree.integrate(y, [0, 1e7], rtol=1e-12, max_steps=10**12)",
    "a span": "tree.integrate(y, (0, 1e7), rtol=1e-12, max_steps=10**12)",
    "dense output": "tree.integrate(y, [0, 1e7], dense_output=True, max_steps=10**12)",
    "series": "tree.integrate(y, [0, 1e7], method='taylor', max_steps=10**12)",
    "steps of one length": "tree.integrate(y, [0, 1e7], method='gauss8', step=4e-3, max_steps=10**12)",
    "events": "tree.integrate(y, [0, 1e7], events=lambda t, y: y[0], max_steps=10**12)",
    "a large tree": "big.integrate(np.ones(2 * len(big)), [0, 1e3])",
    "ensemble": "tree.ensemble(np.tile(y, (2000, 1)), [0, 1e6], max_steps=10**12)",
    "one motion of an ensemble": "tree.ensemble([y, 0 * y], [0, 1e7], max_steps=10**12)",
    "lyapunov": "tree.lyapunov(y, intervals=10**8)",
    "growth": "tree.growth(np.tile(y * [1, 0, 0, 0, 0, 0], (200, 1)), ('child_1', 'child_2'), [2e4])",
    "advice": "tree.advise(y, np.linspace(0, 1e5, 2001))",
    "a budget": "big.budget(np.ones((5000, 2 * len(big))))",
    "a stepper": "tree.stepper(y, max_steps=10**12).advance(1e7)",
    "a stepper under torques": "tree.stepper(y, torques=lambda t, y: -1e-3 * y[3:], max_steps=10**12).advance(1e7)",
    "smooth": "tree.smooth(np.arange(0, 900, 1 / 240), noisy[:216000], method='equations')",
    "draws": "tree.smooth(T, np.zeros((200, 3)) + T[:, None]).draws(3 * 10**5)",
    "lines": "[bp.analysis.lines(noisy.ravel(), 240., most=60, smallest=1e-12) for _ in range(10**6)]",
    "rates": "[tree.energy(np.ones((1000, 1000, 6))) for _ in range(10**6)]",
    "modes": "middle.modes()",
}


@pytest.mark.parametrize("name", LONG)
def test_signals_end_native_calls(name):
    code = f"""
        import os, signal, sys, threading, time
        import numpy as np
        import branched_pendulum as bp

        tree = bp.Tree(sys.argv[1], m=0.10531)
        rule = "gravity = 9.81, a: generations(count = {{}}, branching = 2, shape = rod, mass = 0.1, length = 0.3)"
        big, middle = bp.Tree(rule.format(11)), bp.Tree(rule.format(11))
        y, T = np.array([2.0, 0.02, -0.01, 0, 0.1, 0]), np.arange(200) / 100
        noisy = np.random.default_rng(1).normal(0, 0.1, (400000, 3))
        sent = []
        # Where tests go in the background, shells have it ignored.
        signal.signal(signal.SIGINT, signal.default_int_handler)

        def send():
            sent.append(time.perf_counter())
            os.kill(os.getpid(), signal.SIGINT)

        threading.Timer(0.5, send).start()
        try:
            {LONG[name]}
            print("not interrupted")
        except KeyboardInterrupt:
            late = time.perf_counter() - sent[0]
            # The interpreter is alive.
            print(late if tree.energy(y) > 0 else "dead", flush=True)
            # What was left alone does not keep the program from its end.
            os._exit(0)
    """
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(code), PAPER], capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0 and not done.stderr, done.stderr
    # On a machine that does nothing else 0.02 to 0.2 s.
    assert float(done.stdout) < 0.5, (name, done.stdout)


HUGE = {
    "times": "tree.integrate(np.zeros(6), np.broadcast_to(0.0, 10**10))",
    "states": "tree.integrate(np.zeros(6), np.linspace(0, 1e-3, 2 * 10**8))",
    "ensemble": "tree.ensemble(np.zeros((10**5, 6)), np.linspace(0, 1, 10**5))",
    "mass matrices": "tree.mass_matrix(np.broadcast_to(0.0, (2 * 10**8, 3)))",
        "modes": "large().modes()",
    "equilibrium": "large().equilibrium()",
    "draws": "tree.smooth(np.arange(1000) / 100, np.zeros((1000, 3))).draws(10**9)",
    "advice": "tree.advise(np.zeros((10**4, 6)), np.linspace(0, 1, 10**5))",
    "a budget": "tree.budget(np.broadcast_to(0.0, (10**9, 6)))",
    "growth": "tree.growth(np.zeros((1, 6)), ('child_1', 'child_2'), [1e9])",
    "energies": "tree.energy(np.broadcast_to(0.0, (10**9, 6)))",
}


@pytest.mark.parametrize("name", HUGE)
def test_no_request_is_beyond_memory(name):
    code = f"""
        import resource, sys
        resource.setrlimit(resource.RLIMIT_AS, (3 * 10**9,) * 2)
        import numpy as np, branched_pendulum as bp
        tree = bp.Tree(sys.argv[1], m=0.10531)
        def large():
            rule = "count = 13, branching = 2, shape = rod, mass = 0.1, length = 0.3"
            return bp.Tree("gravity = 9.81, a: generations(" + rule + ")")

        try:
            {HUGE[name]}
        except MemoryError as error:
            print("refused", error)
    """
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(code), PAPER], capture_output=True, text=True, timeout=60
    )
    assert done.stdout.startswith("refused"), (done.returncode, done.stdout, done.stderr)


def test_pickles_and_copies(tree):
    motion = tree.integrate(START, T, dense_output=True, events=lambda t, y: y[0])
    alike = np.array([[0.8, 0, 0, 0, 0, 0]])
    smooth = tree.smooth(T, motion.y[:, :3])
    rod = bp.Tree("gravity = 9.81, rod: rod(mass = 0.2, length = l, friction = c)", l=0.5, c=1e-3)
    swing = rod.integrate([1.0, 0.0], np.linspace(0, 4, 201)).y[:, :1]
    things = [
        rod.identify(np.linspace(0, 4, 201), swing, ["l", "c"]),
        tree,
        bp.models.BranchedDouble(),
        motion,
        motion.report,
        motion.dense,
        tree.growth(alike, ("child_1", "child_2"), [1.0]),
        bp.Tree(
            bp.examples.CASCADE,
            gravity=9.81, mass_ratio=0.5, length_ratio=0.7,
            friction=0, friction_ratio=1, sibling_friction=0,
        ).budget(np.ones(62)),
        tree.sector_budget(START),
        smooth,
        bp.analysis.smooth(T, motion.y),
        bp.analysis.lines(np.sin(np.arange(100.0)), 10),
        tree.draw(),
    ]
    for thing in things:
        for other in [pickle.loads(pickle.dumps(thing)), copy.copy(thing), copy.deepcopy(thing)]:
            assert other == thing and type(other) is type(thing), thing
            assert not other == 1 and other != "far"
        assert len(repr(thing)) < 300
    again = pickle.loads(pickle.dumps(motion))
    np.testing.assert_array_equal(again(0.33), motion(0.33))
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(smooth)).draws(2), smooth.draws(2))
    assert tree != tree.changed(m=0.2) and tree == tree.changed(m=0.2).changed(m=0.10531)
    assert len({tree, bp.Tree(PAPER, m=0.10531), tree.changed(m=1)}) == 2
    assert tree.text == PAPER


def _end(pair):
    tree, start = pair
    return tree.integrate(start, [0, 1]).y[-1]


def test_trees_go_to_other_processes(tree):
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        ends = pool.map(_end, [(tree, START)] * 2)
    np.testing.assert_array_equal(ends[0], _end((tree, START)))


def _failing(case):
    """One failure of each kind, in the process that is asked for it."""
    tree = bp.Tree(PAPER, m=0.10531)
    if case == "read":
        bp.data.read(os.environ["BROKEN_FILE"])
    elif case == "integrate":
        tree.integrate(START, [0, 100], max_steps=50)
    elif case == "request":
        tree.integrate(START * np.nan, T)
    elif case == "description":
        bp.Tree("gravity = 1, a: rod(mas = 1, length = 1)")
    elif case == "motions":
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            tree.ensemble([START * np.nan], T)


FAILURES = {
    "read": (bp.data.ReadError, ["file", "line", "column", "name"]),
    "integrate": (bp.IntegrationError, ["solution"]),
    "request": (bp.RequestError, ["solution"]),
    "description": (bp.DescriptionError, ["mistakes"]),
    "motions": (bp.FailedMotions, ["reasons"]),
}


def test_failures_come_back_from_other_processes(tmp_path, monkeypatch):
    broken = tmp_path / "broken.csv"
    broken.write_text("time,a\n0,1\n0.1,oops\n")
    monkeypatch.setenv("BROKEN_FILE", str(broken))
    context = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(1, context) as pool:
        for case, (kind, attributes) in FAILURES.items():
            with pytest.raises(kind) as here:
                _failing(case)
            with pytest.raises(kind) as there:
                pool.submit(_failing, case).result()
            assert type(here.value) is kind and type(there.value) is kind
            for again in [there.value, *(pickle.loads(pickle.dumps(here.value, p)) for p in range(6))]:
                assert type(again) is kind and str(again) == str(here.value)
                for name in attributes:
                    assert getattr(again, name) == getattr(here.value, name), (case, name)
            assert copy.copy(here.value).args == here.value.args
    assert there.value.reasons.keys() == {0}


def test_recordings_are_pickled(tmp_path):
    file = tmp_path / "swing.csv"
    rows = "".join(f"{k / 100},{np.cos(k / 20):.6f}\n" for k in range(200))
    file.write_text("time (s),theta (rad)\n" + rows)
    recording = bp.data.read(file)
    again = pickle.loads(pickle.dumps(recording))
    assert again == recording and again.findings == recording.findings
    np.testing.assert_array_equal(again.theta, recording.theta)


def test_short_words_of_large_trees():
    rule = "gravity = 9.81, a: generations(count = 10, branching = 2, shape = rod, mass = 1, length = 1)"
    big = bp.Tree(rule)
    assert repr(big) == f"Tree of 1023 links: a_1, a_2_1, …, {big.names[-1]}"
    assert big.draw().links == 1023


def test_states_of_any_shape(tree):
    y = np.random.default_rng(2).normal(size=(2, 1, 5, 6))
    theta, omega = y[..., :3], y[..., 3:]
    each = y.reshape(-1, 6)

    def alone(function, *shape):
        return np.array([function(state) for state in each]).reshape(2, 1, 5, *shape)

    for values, function, shape in [
        (tree.rhs(0.3, y), lambda s: tree.rhs(0.3, s), (6,)),
        (tree.energy(y), tree.energy, ()),
        (tree.kinetic_energy(theta, omega), lambda s: tree.kinetic_energy(s[:3], s[3:]), ()),
        (tree.potential_energy(theta), lambda s: tree.potential_energy(s[:3]), ()),
        (tree.momenta(theta, omega), lambda s: tree.momenta(s[:3], s[3:]), (3,)),
        (tree.accelerations(theta, omega), lambda s: tree.accelerations(s[:3], s[3:]), (3,)),
        (tree.mass_matrix(theta), lambda s: tree.mass_matrix(s[:3]), (3, 3)),
        (tree.stiffness_matrix(theta), lambda s: tree.stiffness_matrix(s[:3]), (3, 3)),
        (tree.points(theta), lambda s: tree.points(s[:3]), (3, 2)),
        (tree.friction_power(y), tree.friction_power, ()),
        (tree.transfer(y), tree.transfer, (2,)),
        (tree.sector_energies(y), tree.sector_energies, (2,)),
    ]:
        assert values.shape == (2, 1, 5, *shape)
        np.testing.assert_array_equal(values, alone(function, *shape))
    # NumPy's rules for several arrays.
    np.testing.assert_array_equal(
        tree.momenta(theta[:, :, :1], omega)[1, 0, 3], tree.momenta(theta[1, 0, 0], omega[1, 0, 3])
    )
    times = np.array([0.0, 1.0])[:, None, None]
    assert tree.rhs(times, y).shape == y.shape
    assert isinstance(tree.energy(START), float) and tree.energy(np.empty((0, 6))).shape == (0,)
    # Above what is done at once.
    many = np.tile(each, (2000, 1))
    np.testing.assert_array_equal(tree.energy(many)[:10], tree.energy(each))


@pytest.mark.parametrize("method", ["RK45", "Radau", "BDF", "LSODA"])
def test_rates_along_the_first_axis_as_scipy_asks_for_them(tree, method):
    """SciPy's implicit methods ask for a square of states, of which both axes have their length."""
    rates = functools.partial(tree.rhs, axis=0)
    one = solve_ivp(tree.rhs, (0, 1), START, method, rtol=1e-8, atol=1e-8)
    many = solve_ivp(rates, (0, 1), START, method, vectorized=True, rtol=1e-8, atol=1e-8)
    np.testing.assert_allclose(many.y, one.y, atol=1e-9)
    # Versions of SciPy differ in whether a square of states counts as one evaluation.
    assert many.t.size == one.t.size and many.nfev <= one.nfev or method in ("RK45", "LSODA")
    y = np.random.default_rng(4).normal(size=(6, 4, 5))
    expected = np.moveaxis(tree.rhs(0.2, np.moveaxis(y, 0, -1)), -1, 0)
    np.testing.assert_array_equal(tree.rhs(0.2, y, axis=0), expected)
    np.testing.assert_array_equal(tree.rhs(0.2, y, axis=-3), expected)


def test_a_span_has_all_steps(tree):
    own = tree.integrate(START, (0, 10), rtol=1e-10)
    assert len(own.t) == own.steps + 1 and own.t[0] == 0 and own.t[-1] == 10
    np.testing.assert_allclose(own.y, tree.integrate(START, own.t, rtol=1e-12).y, atol=1e-4)
    two = tree.integrate(START, [0, 10], rtol=1e-10)
    assert two.t.tolist() == [0, 10]
    np.testing.assert_array_equal(two.y[-1], own.y[-1])
    dense = tree.integrate(START, (0, 10), rtol=1e-10, dense_output=True)
    np.testing.assert_array_equal(dense.y, own.y)
    np.testing.assert_array_equal(dense(own.t), own.y)
    back = tree.integrate(own.y[-1], (10, 0), rtol=1e-13)
    assert back.t[-1] == 0 and (np.diff(back.t) < 0).all()

    def late(t, y):
        return t - 3.3

    late.terminal = True
    cut = tree.integrate(START, (0, 10), rtol=1e-10, events=late)
    assert cut.t[-1] == cut.t_events[0][0] == pytest.approx(3.3)
    assert cut.success and cut.status == 1 and own.status == 0 and "event" in cut.message


def test_steps_and_tolerances(tree):
    short = tree.integrate(START, (0, 1), max_step=1e-2)
    assert np.diff(short.t).max() < 1.011e-2 and short.report.longest_step < 1.011e-2
    first = tree.integrate(START, (0, 1), first_step=1e-5)
    assert first.t[1] == pytest.approx(1e-5)
    assert tree.integrate(START, (0, 1), max_step=np.inf).steps < 99
    even = tree.integrate(START, T, rtol=1e-8, atol=1e-10)
    listed = tree.integrate(START, T, rtol=1e-8, atol=np.full(6, 1e-10))
    np.testing.assert_array_equal(even.y, listed.y)
    loose = tree.integrate(START, T, rtol=1e-8, atol=[1, 1e-10, 1e-10, 1, 1e-10, 1e-10])
    assert loose.steps <= even.steps and not np.array_equal(loose.y, even.y)
    lanes = tree.ensemble([START], T, rtol=1e-8, atol=np.full(6, 1e-10), max_step=1e-2)
    np.testing.assert_allclose(lanes[0], even.y, atol=1e-6)


@pytest.mark.parametrize("dense_output", [False, True])
@pytest.mark.parametrize("events", [None, lambda t, y: y[0]])
def test_failures_carry_what_was_computed(tree, dense_output, events):
    t = np.linspace(0, 100, 1001)
    with pytest.raises(bp.IntegrationError, match="limit of 99 steps") as failed:
        tree.integrate(START, t, max_steps=99, dense_output=dense_output, events=events)
    kept = failed.value.solution
    whole = tree.integrate(START, t)
    assert 10 < len(kept.t) < 1000 and kept.report.accepted + kept.report.rejected == 99
    np.testing.assert_allclose(kept.y[:-1], whole.y[: len(kept.y) - 1], atol=1e-3)
    assert kept.t[-1] > kept.t[-2] and not kept.success
    on = tree.integrate(kept.y[-1], [kept.t[-1], kept.t[-1] + 1])
    assert on.success
    if dense_output:
        np.testing.assert_array_equal(kept(kept.t), kept.y)
    if events:
        assert len(kept.t_events[0]) > 1
    with pytest.raises(bp.RequestError) as refused:
        tree.integrate(START * np.nan, t)
    assert refused.value.solution is None


MISTAKES = [
    (ValueError, r"y0 must have shape \(6,\), got \(7,\)", lambda t: t.integrate(np.zeros(7), T)),
    (ValueError, r"atol must be one number or have shape \(6,\), got \(3,\)", lambda t: t.integrate(START, T, atol=[1e-9] * 3)),
    (ValueError, "step= belongs to a method with steps of one length", lambda t: t.integrate(START, T, step=0.1)),
    (ValueError, "`rk4` goes by steps of one length, step=: it has no max_step=", lambda t: t.integrate(START, T, "rk4", step=0.1, max_step=1)),
    (ValueError, "`gauss4` goes by steps of one length, step=: it has no atol=", lambda t: t.integrate(START, T, "gauss4", step=0.1, atol=1)),
    (bp.RequestError, "initial step is -1", lambda t: t.integrate(START, T, first_step=-1)),
    (bp.RequestError, "longest step is 0", lambda t: t.integrate(START, T, max_step=0)),
    (ValueError, "method: there is no method `tailor`; did you mean `taylor`", lambda t: t.integrate(START, T, "tailor")),
    (TypeError, "method", lambda t: t.integrate(START, T, 5)),
    (ValueError, r"y must have 6 numbers along its last axis, got \(6, 2\); help: pass axis=0", lambda t: t.rhs(0, np.zeros((6, 2)))),
    (ValueError, "axis must be one of the 1 axes of y, got 1", lambda t: t.rhs(0, START, axis=1)),
    (ValueError, r"y must have 6 numbers along its last axis.*got \(5,\)", lambda t: t.energy(np.zeros(5))),
    (ValueError, r"theta has shape \(2, 3\), omega has shape \(4, 3\): these do not go", lambda t: t.momenta(np.zeros((2, 3)), np.zeros((4, 3)))),
    (ValueError, r"omega must have 3 numbers along its last axis", lambda t: t.kinetic_energy(np.zeros(3), np.zeros(4))),
    (ValueError, 'point is "middle", must be "pivot", "centre" or "end"', lambda t: t.points(np.zeros(3), "middle")),
    (ValueError, 'form is "order 2", must be "exact"', lambda t: t.transfer(START, "order 2")),
    (ValueError, "amplitude order k", lambda t: t.transfer(START, "amplitude order 16")),
    (KeyError, "there is no sector `q`: there are in_phase, d", lambda t: t.transfer(START, into="q")),
    (ValueError, "nothing in the tree is a copy|no copies", lambda t: bp.Tree("gravity = 1, a: rod(mass = 1, length = 1)").transfer([0, 0])),
    (ValueError, 'definition is "total"', lambda t: t.sector_budget(START, definition="total")),
    (ValueError, "there is no observable|observable", lambda t: t.observable("height", START)),
    (ValueError, "ensembles go by", lambda t: t.ensemble([START], T, "rk4")),
    (ValueError, r"starts must have shape \(n, 6\), got \(3, 2\)", lambda t: t.ensemble(np.zeros((3, 2)), T)),
    (bp.RequestError, "method: a compiled model has no Taylor series", lambda t: bp.models.BranchedDouble().integrate(START, T, "taylor")),
    (TypeError, "t.*complex", lambda t: t.integrate(START, T + 1j)),
    (ValueError, "t has no times", lambda t: t.integrate(START, [])),
    (TypeError, "events must be a function", lambda t: t.integrate(START, T, events=3)),
    (ValueError, "terminal must be", lambda t: t.integrate(START, T, events=_ending(-1))),
    (TypeError, r"the value of events must be one real number, got an array of shape \(6,\)", lambda t: t.integrate(START, T, events=lambda t, y: y)),
    (KeyError, "no parameter `n`", lambda t: t.changed(n=1)),
    (TypeError, "parameter `m`", lambda t: t.changed(m="heavy")),
    (KeyError, "there is no link `uncle`", lambda t: t.growth([START * 0], ("uncle", "child_1"), [1])),
    (ValueError, "not copies that start in phase", lambda t: t.growth([START], ("child_1", "child_2"), [1])),
    (ValueError, r"theta must have 3 numbers", lambda t: t.draw(np.zeros(4))),
    (ValueError, "t is outside|outside", lambda t: t.integrate(START, T, dense_output=True)(2.0)),
    (bp.DescriptionError, "did you mean `mass`", lambda t: bp.Tree("gravity = 1, a: rod(mas = 1, length = 1)")),
]


def _ending(terminal):
    def event(t, y):
        return y[0]

    event.terminal = terminal
    return event


@pytest.mark.parametrize("index", range(len(MISTAKES)))
def test_mistakes_are_told(tree, index):
    kind, message, call = MISTAKES[index]
    with pytest.raises(kind, match=message) as raised:
        call(tree)
    for word in ["Rust", "rust", "emit", "attribute", "dimensionality", "usize"]:
        assert word not in str(raised.value)
