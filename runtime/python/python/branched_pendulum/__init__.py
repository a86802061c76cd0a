"""Pendulum trees, described in text, and compiled models of them.

SI units; angles are absolute, in radians from the downward vertical (from the upward one where
gravity is written as negative and the tree stands; y is upwards in both). A state is the angles
followed by the angular velocities. The grammar of the text is in the docstring of `Tree`.
"""

from . import analysis, data, examples, models
from ._native import (
    DescriptionError,
    FailedMotions,
    IntegrationError,
    Pendulum,
    RequestError,
    Tree,
    __version__,
)
from ._results import (
    Estimate,
    Growth,
    Identification,
    ReleaseMap,
    Report,
    ScaleBudget,
    SectorBudget,
    Solution,
)

__all__ = [
    "DescriptionError",
    "Estimate",
    "FailedMotions",
    "Growth",
    "Identification",
    "IntegrationError",
    "Pendulum",
    "ReleaseMap",
    "Report",
    "RequestError",
    "ScaleBudget",
    "SectorBudget",
    "Solution",
    "Tree",
    "__version__",
    "analysis",
    "data",
    "examples",
    "models",
]
