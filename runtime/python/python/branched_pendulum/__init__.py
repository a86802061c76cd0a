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
    NormalForm,
    Pendulum,
    RequestError,
    Stepper,
    Tree,
    __version__,
)
from ._results import (
    AccelerationSlopes,
    Advice,
    Design,
    Equilibrium,
    Estimate,
    FittedFrequency,
    Growth,
    Identification,
    MeasuredRun,
    MotionGradient,
    Prediction,
    ReleaseMap,
    Report,
    ScaleAverages,
    ScaleBudget,
    SectorBudget,
    Solution,
    WorkPrecision,
)

__all__ = [
    "AccelerationSlopes",
    "Advice",
    "DescriptionError",
    "Design",
    "Equilibrium",
    "Estimate",
    "FailedMotions",
    "FittedFrequency",
    "Growth",
    "Identification",
    "IntegrationError",
    "MeasuredRun",
    "MotionGradient",
    "NormalForm",
    "Pendulum",
    "Prediction",
    "ReleaseMap",
    "Report",
    "RequestError",
    "ScaleAverages",
    "ScaleBudget",
    "SectorBudget",
    "Solution",
    "Stepper",
    "Tree",
    "WorkPrecision",
    "__version__",
    "analysis",
    "data",
    "examples",
    "models",
]
