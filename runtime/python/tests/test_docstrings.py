"""Docstrings in NumPy's form, whose examples run."""

import doctest
import inspect

import branched_pendulum as bp
import numpy as np
import pytest

OWNERS = [bp.Pendulum, bp.Tree, bp.models.BranchedDouble, bp.Solution, bp.Stepper, bp.Advice, bp.ScaleBudget,
          bp.analysis.SmoothedMotion, bp.analysis.Lines, bp.analysis, bp.data]


def functions():
    found = {"Tree": bp.Tree}
    for owner in OWNERS:
        for name, member in vars(owner).items():
            if not name.startswith("_") or name == "__call__":
                if inspect.isroutine(member) or inspect.isfunction(member):
                    found[f"{owner.__name__}.{name}"] = member
    return found


@pytest.mark.parametrize("name", functions())
def test_examples(name):
    doc = inspect.getdoc(functions()[name])
    globs = {"bp": bp, "np": np}
    test = doctest.DocTestParser().get_doctest(doc, globs, name, None, 0)
    results = []
    runner = doctest.DocTestRunner(verbose=False, optionflags=doctest.NORMALIZE_WHITESPACE)
    runner.run(test, out=results.append)
    assert not results, "".join(results)
    if name not in {"Lines.__call__", "SmoothedMotion.frame", "branched_pendulum.data.read"}:
        assert test.examples, name
        words = inspect.signature(functions()[name]).parameters if name != "Tree" else {"text": 0}
        assert "Returns\n-------" in doc or name == "Tree", name
        assert set(words) <= {"self", "slf"} or "Parameters\n----------" in doc, name
