"""Derivatives in reverse mode."""

from __future__ import annotations

from dataclasses import dataclass

from ._common import Array, Result


@dataclass(frozen=True, eq=False)
class AccelerationSlopes(Result):
    """Derivatives of a weighted sum of angular accelerations."""

    #: By the angles, shape (..., n).
    theta: Array
    #: By the angular velocities, shape (..., n).
    omega: Array
    #: By torques on the links, shape (..., n).
    torques: Array
    #: By each parameter of the tree, shape (...).
    parameters: dict[str, Array]


@dataclass(frozen=True, eq=False)
class MotionGradient(Result):
    """Derivatives of a cost of a motion."""

    #: Value of the cost.
    cost: float
    #: Derivatives by the start state, shape (2 n,).
    y0: Array
    #: Derivatives by parameters of the tree.
    parameters: dict[str, float]
    #: Amplification of small changes by the motion. The derivatives say nothing about it if
    #: `growth` times the relative tolerance is not far below 1.
    growth: float
    #: Number of steps of the motion.
    steps: int
