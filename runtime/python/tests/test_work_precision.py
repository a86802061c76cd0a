"""Error against time of methods, against the errors of their motions."""

import branched_pendulum as bp
import numpy as np
import pytest

from test_tree import PAPER, START


@pytest.fixture(scope="module")
def tree():
    return bp.Tree(PAPER, m=0.10531)


@pytest.fixture(scope="module")
def measured(tree):
    return tree.work_precision(START, (0, 2), ["dop853", "taylor", "gauss6"])


def test_errors_are_those_of_motions(tree, measured):
    assert measured.uncertainty < 1e-14
    assert set(measured.methods) == {"dop853", "taylor", "gauss6"}
    runs = list(zip(measured.methods, measured.settings, measured.errors))
    for method, setting, error in runs[:: len(runs) // 12]:
        if method == "gauss6":
            continue
        end = tree.integrate(START, (0, 2), method, rtol=setting).y[-1]
        found = np.abs(end - measured.end).max()
        # Both are rounded, each in its own way.
        assert error == pytest.approx(found, rel=0.2, abs=1e-13)
    assert measured.errors.min() < 1e-13 and measured.errors.max() > 1e-6
    assert (measured.seconds > 0).all() and (measured.evaluations > 0).all()


def test_words_and_picture(measured):
    rows = str(measured).splitlines()
    assert len(rows) == 5 and "Taylor" in str(measured)
    assert rows[-1] == f"the end is known to {measured.uncertainty:.0e}".replace("e-0", "e-")
    assert sum(row.count("*") for row in rows) == 5
    assert "taylor" in repr(measured)
    assert len(measured.plot().axes[0].lines) == 3


def test_a_chaotic_end_is_not_known(tree):
    chaotic = tree.work_precision([2.0, 0.02, -0.01, 0, 0.1, 0], (0, 60), ["taylor"])
    regular = tree.work_precision(START, (0, 2), ["taylor"])
    assert chaotic.uncertainty > 1e4 * regular.uncertainty


def test_what_makes_no_sense_is_refused(tree):
    with pytest.raises(ValueError, match="euler"):
        tree.work_precision(START, (0, 1), ["euler"])
    with pytest.raises(ValueError, match="y0"):
        tree.work_precision(START[:3], (0, 1))
    with pytest.raises(ValueError, match="t must be finite"):
        tree.work_precision(START, (0, np.inf))
