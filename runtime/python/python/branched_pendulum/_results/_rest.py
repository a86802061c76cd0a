"""Angles at which trees stay at rest."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ._common import Array, Result


@dataclass(frozen=True, eq=False)
class Equilibrium(Result):
    """Angles at which a tree stays at rest."""

    #: Angles, rad.
    theta: Array
    #: Potential energy, J.
    energy: float
    #: By the second derivatives of the energy: a minimum; falling in some direction; falling in
    #: none, and to second order not rising in some.
    stability: Literal["stable", "unstable", "neutral"]
