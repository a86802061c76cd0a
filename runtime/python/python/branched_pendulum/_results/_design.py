"""Parameters that were searched for."""

from __future__ import annotations

from dataclasses import dataclass

from .. import _native
from ._common import Array, Result


@dataclass(frozen=True, eq=False)
class Design(Result):
    """Parameters at which a tree reaches its targets, or the nearest ones."""

    #: The tree with these parameters.
    tree: _native.Tree
    #: Values of the parameters that varied.
    parameters: dict[str, float]
    #: Value of each quantity.
    values: dict[str, float]
    #: Error of each value by the normal form; None for those without.
    errors: dict[str, float | None]
    #: Derivatives of the quantities by the parameters, a row for each quantity.
    slopes: Array
    #: Other solutions that were found.
    others: list[dict[str, float]]
    #: Why the targets are not reached, with what to change; None if they are.
    cause: str | None

    @property
    def reached(self) -> bool:
        """True if all targets are reached."""
        return self.cause is None
