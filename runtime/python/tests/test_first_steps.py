"""The listing of the tutorial, `docs/tutorials/python.md`."""

import runpy
from pathlib import Path


def test_first_steps(capsys):
    runpy.run_path(Path(__file__).parent.parent / "examples" / "first_steps.py")
    told = capsys.readouterr().out
    assert "modes: [0.8732 1.2581 1.5826] Hz" in told
    assert "tenfold from" in told
