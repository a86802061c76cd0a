"""Times of CasADi's and MuJoCo's accelerations for the scenes of
`evaluation-speed`, one thread, each checked against a dense solve first."""

import ctypes
import glob
import os
import statistics
import tempfile
import time

import casadi as ca
import mujoco
import numpy as np

from native import build, pointer
from scenes import GRAVITY, NUMBERS, absolute, dense, eliminated, paper, relative, tree

REPEATS = 51

# Loops without Python in them.
DRIVER = r"""
typedef long long integer;
typedef int (*Casadi)(const double **, double **, integer *, double *, int);
void run_casadi(Casadi f, long states, long n, const double *theta, const double *omega,
                double *alpha, integer *iw, double *w) {
    for (long s = 0; s < states; s++) {
        const double *arg[64] = {theta + s * n, omega + s * n};
        double *res[64] = {alpha + s * n};
        f(arg, res, iw, w, 0);
    }
}
typedef void (*Forward)(const void *, void *);
void run_mujoco(Forward f, const void *model, void *data, long states, long n,
                const double *theta, const double *omega, double *alpha,
                double *qpos, double *qvel, const double *qacc) {
    for (long s = 0; s < states; s++) {
        for (long i = 0; i < n; i++) {
            qpos[i] = theta[s * n + i];
            qvel[i] = omega[s * n + i];
        }
        f(model, data);
        for (long i = 0; i < n; i++) alpha[s * n + i] = qacc[i];
    }
}
"""


def median_ns(function, states, repeats=REPEATS):
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        function()
        times.append(time.perf_counter() - start)
    return statistics.median(times) * 1e9 / states


class Symbolic:
    """What the formulation of `scenes` needs of a tool, in CasADi's terms."""

    variables = staticmethod(lambda name, n: [ca.SX.sym(f"{name}{i}") for i in range(n)])
    number = staticmethod(ca.SX)
    sin = staticmethod(ca.sin)
    cos = staticmethod(ca.cos)


def from_model(links):
    """The textbook's way: the Lagrangian, differentiated by CasADi, and its
    solver for dense systems of symbols."""
    n = len(links)
    theta, omega = ca.SX.sym("theta", n), ca.SX.sym("omega", n)
    pivots, kinetic, potential = [], 0, 0
    for i, (parent, mass, com, inertia, lever) in enumerate(links):
        down = lambda k: ca.vertcat(ca.sin(theta[k]), -ca.cos(theta[k]))
        pivot = ca.SX.zeros(2) if parent is None else pivots[parent] + lever * down(parent)
        pivots.append(pivot)
        centre = pivot + com * down(i)
        velocity = ca.jtimes(centre, theta, omega)
        kinetic += mass / 2 * ca.dot(velocity, velocity) + inertia / 2 * omega[i] ** 2
        potential += mass * GRAVITY * centre[1]
    momentum = ca.gradient(kinetic, omega)
    mass_matrix = ca.jacobian(momentum, omega)
    force = ca.gradient(kinetic - potential, theta) - ca.jtimes(momentum, theta, omega)
    solution = ca.solve(mass_matrix, force)
    return ca.Function("f", [theta, omega], [solution], {"cse": True})


def fed(links):
    """The expert's formulation, as heyoka is given it."""
    variables, outputs = eliminated(links, Symbolic)
    n = len(links)
    theta, omega = ca.vertcat(*variables[:n]), ca.vertcat(*variables[n:])
    return ca.Function("f", [theta, omega], [ca.vertcat(*outputs)], {"cse": True})


def casadi_ns(function, theta, omega, expected, folder, driver):
    """Its virtual machine, and its generated C by the system's compiler."""
    n, states = theta.shape
    mapped = function.map(states)
    check(np.array(mapped(theta, omega)), expected)
    machine = median_ns(lambda: mapped(theta, omega), states, 11)
    name = f"f{n}_{len(os.listdir(folder))}"
    here = os.getcwd()
    os.chdir(folder)
    function.generate(f"{name}.c")
    os.chdir(here)
    compiled = build(folder, f"{name}.c").f
    iw = np.zeros(max(1, function.sz_iw()), dtype=np.int64)
    w = np.zeros(max(1, function.sz_w()))
    angles, rates = np.ascontiguousarray(theta.T), np.ascontiguousarray(omega.T)
    found = np.empty_like(angles)
    arguments = [pointer(x) for x in (angles, rates, found, iw, w)]
    count = (ctypes.c_long(states), ctypes.c_long(n))
    run = lambda: driver.run_casadi(compiled, *count, *arguments)
    run()
    check(found.T, expected)
    return machine, median_ns(run, states)


def mujoco_model(links):
    """Hinges in one plane; angles against the parent, no contacts."""
    children = {i: [] for i in range(-1, len(links))}
    for i, link in enumerate(links):
        children[-1 if link[0] is None else link[0]].append(i)

    def body(i):
        _, mass, com, inertia, lever = links[i]
        inside = "".join(body(child) for child in children[i])
        return (
            f'<body pos="0 0 {-lever!r}"><joint type="hinge" axis="0 -1 0"/>'
            f'<inertial pos="0 0 {-com!r}" mass="{mass!r}" '
            f'diaginertia="{inertia!r} {inertia!r} {inertia!r}"/>{inside}</body>'
        )

    return mujoco.MjModel.from_xml_string(
        f'<mujoco><compiler boundmass="0" boundinertia="0"/>'
        f'<option gravity="0 0 {-GRAVITY}" integrator="Euler" timestep="1e-6">'
        f'<flag contact="disable" constraint="disable" eulerdamp="disable"/></option>'
        f"<worldbody>{body(0)}</worldbody></mujoco>"
    )


def mujoco_ns(links, theta, omega, expected, driver):
    """`mj_forward`, contacts and constraints off."""
    model = mujoco_model(links)
    data = mujoco.MjData(model)
    n, states = theta.shape
    library = glob.glob(os.path.join(os.path.dirname(mujoco.__file__), "libmujoco.*"))[0]
    forward = ctypes.CDLL(library).mj_forward
    angles = np.ascontiguousarray(relative(links, theta).T)
    rates = np.ascontiguousarray(relative(links, omega).T)
    found = np.empty_like(angles)
    arguments = [pointer(x) for x in (angles, rates, found, data.qpos, data.qvel, data.qacc)]
    addresses = (ctypes.c_void_p(model._address), ctypes.c_void_p(data._address))
    count = (ctypes.c_long(states), ctypes.c_long(n))
    run = lambda: driver.run_mujoco(forward, *addresses, *count, *arguments)
    run()
    check(absolute(links, found.T), expected)
    return median_ns(run, states)


def check(found, expected):
    found = found[:, : expected.shape[1]]
    error = np.max(np.abs(found - expected)) / np.max(np.abs(expected))
    assert error < 1e-9, error


def main():
    print(f"CasADi {ca.__version__}, MuJoCo {mujoco.__version__}; median ns for one state")
    columns = ["fed, VM", "fed, C", "model, VM", "model, C", "MuJoCo"]
    print(f"{'links':>6}" + "".join(f"{column:>12}" for column in columns))
    random = np.random.default_rng(1)
    scenes = [(paper(), True), (tree(3), False), (tree(4), False), (tree(5), False)]
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "driver.c"), "w") as file:
            file.write(DRIVER)
        driver = build(folder, "driver.c")
        for links, in_symbols in scenes:
            n = len(links)
            states = (NUMBERS // n + 15) // 16 * 16
            theta = random.uniform(-np.pi, np.pi, (n, states))
            omega = random.uniform(-9, 9, (n, states))
            expected = np.array([dense(links, theta[:, i], omega[:, i]) for i in range(32)]).T
            times = list(casadi_ns(fed(links), theta, omega, expected, folder, driver))
            # Written out, the solution of a dense system grows with n!.
            model = from_model(links) if in_symbols else None
            times += (
                list(casadi_ns(model, theta, omega, expected, folder, driver))
                if model
                else [float("nan")] * 2
            )
            times.append(mujoco_ns(links, theta, omega, expected, driver))
            cells = ("-" if np.isnan(t) else f"{t:.1f}" for t in times)
            print(f"{n:6}" + "".join(f"{cell:>12}" for cell in cells), flush=True)


if __name__ == "__main__":
    main()
