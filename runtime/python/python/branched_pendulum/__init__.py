"""Pendulum trees, described in text, and compiled models of them.

SI units; angles are absolute, in radians from the downward vertical (from the upward one where
gravity is written as negative and the tree stands; y is upwards in both). A state is the angles
followed by the angular velocities.
"""

from . import analysis, data, models
from ._native import (
    DescriptionError,
    FailedMotions,
    Growth,
    IntegrationError,
    Pendulum,
    RequestError,
    ScaleBudget,
    Solution,
    Tree,
    __version__,
)

__all__ = [
    "DescriptionError",
    "FailedMotions",
    "Growth",
    "IntegrationError",
    "Pendulum",
    "RequestError",
    "ScaleBudget",
    "Solution",
    "Tree",
    "__version__",
    "analysis",
    "data",
    "models",
]
