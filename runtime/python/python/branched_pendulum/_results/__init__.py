"""What functions of the package return: arrays under names."""

from .. import _native
from ._advice import Advice, MeasuredRun
from ._budgets import ScaleAverages, ScaleBudget, SectorBudget
from ._common import Result
from ._design import Design
from ._gradients import AccelerationSlopes, MotionGradient
from ._growth import Growth, ReleaseMap
from ._identification import Estimate, FittedFrequency, Identification
from ._motion import Report, Solution
from ._rest import Equilibrium
from ._theory import Prediction
from ._work_precision import WorkPrecision

__all__ = [
    "AccelerationSlopes",
    "Advice",
    "Design",
    "Equilibrium",
    "Estimate",
    "FittedFrequency",
    "Growth",
    "Identification",
    "MeasuredRun",
    "MotionGradient",
    "Prediction",
    "ReleaseMap",
    "Report",
    "Result",
    "ScaleAverages",
    "ScaleBudget",
    "SectorBudget",
    "Solution",
    "WorkPrecision",
    "make_tree",
]


def make_tree(text: str, parameters: dict[str, float]) -> _native.Tree:
    """Return the tree of a text: what pickles of trees are made of."""
    return _native.Tree(text, **parameters)
