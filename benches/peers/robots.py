"""Times and errors of Pinocchio's forward dynamics beside our emitted accelerations, in turn, one thread.

Pinocchio's articulated-body recursion (`aba`) is compiled from its own headers for this machine, as our code is. Each
tool is called in a loop without Python, one state after the other. Errors are those against our accelerations in
numbers of 31 digits, which a dense solve checks first.
"""

import ctypes
import os
import pathlib
import statistics
import sys
import tempfile
import time

import numpy as np
import pinocchio

from native import build, pointer
from scenes import GRAVITY, NUMBERS, absolute, dense, paper, relative, tree

HERE = pathlib.Path(__file__).parent
ROUNDS = 101

DRIVER = r"""
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/multibody.hpp>
using namespace pinocchio;
struct Tree {
    Model model;
    Data data;
    explicit Tree(const Model &model) : model(model), data(model) {}
};
extern "C" void *make(long links, const long *parent, const double *mass, const double *com,
                      const double *inertia, const double *lever, double gravity) {
    Model model;
    model.gravity.linear() << 0, 0, -gravity;
    for (long i = 0; i < links; i++) {
        SE3 place(Eigen::Matrix3d::Identity(), Eigen::Vector3d(0, 0, -lever[i]));
        JointIndex joint = model.addJoint(parent[i] + 1, JointModelRY(), place, std::to_string(i));
        Inertia body(mass[i], Eigen::Vector3d(0, 0, -com[i]), inertia[i] * Eigen::Matrix3d::Identity());
        model.appendBodyToJoint(joint, body, SE3::Identity());
    }
    return new Tree(model);
}
extern "C" void forward(void *made, long states, const double *q, const double *v, double *a, bool in_world) {
    Tree &tree = *static_cast<Tree *>(made);
    const long n = tree.model.nv;
    const Eigen::VectorXd torques = Eigen::VectorXd::Zero(n);
    Eigen::VectorXd angles(n), rates(n);
    for (long s = 0; s < states; s++) {
        angles = Eigen::Map<const Eigen::VectorXd>(q + s * n, n);
        rates = Eigen::Map<const Eigen::VectorXd>(v + s * n, n);
        Eigen::Map<Eigen::VectorXd>(a + s * n, n) =
            aba(tree.model, tree.data, angles, rates, torques, in_world ? Convention::WORLD : Convention::LOCAL);
    }
}
"""


def driver(folder):
    """Pinocchio's templates, instantiated for this machine; nothing of its library is linked."""
    with open(os.path.join(folder, "driver.cpp"), "w") as file:
        file.write(DRIVER)
    prefix = pathlib.Path(pinocchio.__file__).parents[4] / "include"
    flags = ["-DNDEBUG", "-std=c++17", "-w", f"-I{prefix}", f"-I{prefix}/eigen3"]
    # As many kinds of joints as Pinocchio has.
    flags += ["-DBOOST_MPL_LIMIT_LIST_SIZE=30", "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS"]
    loaded = build(folder, "driver.cpp", flags, "c++")
    loaded.make.restype = ctypes.c_void_p
    return loaded


def ours():
    library = HERE / "rust/target/release/libbranched_pendulum_peers.so"
    if not library.exists():
        sys.exit(f"{library} is missing: README.md says how it is built")
    return ctypes.CDLL(str(library)).accelerations


def in_c(array):
    return np.ascontiguousarray(array.T)


def measure(links, loaded, accelerations, random):
    n = len(links)
    states = (NUMBERS // n + 15) // 16 * 16
    theta, omega = random.uniform(-np.pi, np.pi, (n, states)), random.uniform(-9, 9, (n, states))
    columns = [np.array([-1 if link[0] is None else link[0] for link in links], dtype=np.int64)]
    columns += [np.array([link[k] for link in links], dtype=float) for k in range(1, 5)]
    made = loaded.make(ctypes.c_long(n), *(pointer(x) for x in columns), ctypes.c_double(GRAVITY))
    given = [in_c(theta), in_c(omega)]
    hinges = [in_c(relative(links, theta)), in_c(relative(links, omega))]
    found = {name: np.empty((states, n)) for name in ("exact", "ours", "local", "world")}
    count, long = ctypes.c_size_t(states), ctypes.c_long(states)

    def own(name, is_exact):
        arrays = (pointer(x) for x in (*given, found[name]))
        status = accelerations(ctypes.c_size_t(n), count, *arrays, ctypes.c_bool(is_exact))
        assert status == 0

    def theirs(name, in_world):
        arrays = (pointer(x) for x in (*hinges, found[name]))
        loaded.forward(ctypes.c_void_p(made), long, *arrays, ctypes.c_bool(in_world))

    own("exact", True)
    expected = np.array([dense(links, theta[:, i], omega[:, i]) for i in range(32)])
    worst = np.max(np.abs(found["exact"][:32] - expected)) / np.max(np.abs(expected))
    assert worst < 1e-9, worst
    ways = {
        "ours": lambda: own("ours", False),
        "local": lambda: theirs("local", False),
        "world": lambda: theirs("world", True),
    }
    times = {name: [] for name in ways}
    for _ in range(ROUNDS):
        for name, way in ways.items():
            clock = time.perf_counter()
            way()
            times[name].append((time.perf_counter() - clock) * 1e9 / states)
    for name in ("local", "world"):
        found[name] = absolute(links, found[name].T).T
    scale = np.max(np.abs(found["exact"]), axis=1)
    errors = {name: np.max(np.abs(found[name] - found["exact"]), axis=1) / scale for name in ways}
    ratios = {name: statistics.median(t / o for t, o in zip(times[name], times["ours"])) for name in ways}
    for name in ways:
        median = statistics.median(times[name])
        print(
            f"{n:6} {name:8}{median:10.1f}{ratios[name]:8.1f}"
            f"{np.median(errors[name]):12.1e}{np.max(errors[name]):12.1e}",
            flush=True,
        )


def main():
    print(f"Pinocchio {pinocchio.__version__}; ns for one state, medians; the ratio is to ours of the same turn")
    print(f"{'links':>6} {'':8}{'ns':>10}{'ratio':>8}{'median err':>12}{'worst err':>12}")
    random, accelerations = np.random.default_rng(1), ours()
    with tempfile.TemporaryDirectory() as folder:
        loaded = driver(folder)
        for links in (paper(), tree(3), tree(5)):
            measure(links, loaded, accelerations, random)


if __name__ == "__main__":
    main()
