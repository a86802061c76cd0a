"""Parameters from a measured motion."""

from __future__ import annotations

from dataclasses import dataclass

from ._common import Array, Result


@dataclass(frozen=True, eq=False)
class Estimate(Result):
    """A parameter that was looked for.

    Attributes
    ----------
    value : float
        The value, in SI units.
    deviation : float or None
        Standard deviation; None of what is held.
    standing : str
        What the value stands on: "determined", "held", "at its bound", "goes with ...".
    """

    value: float
    deviation: float | None
    standing: str


@dataclass(frozen=True, eq=False, repr=False)
class Identification(Result):
    """Parameters of a tree from its measured motion; `str` of it is a table.

    Attributes
    ----------
    estimates : dict of Estimate
        Unknowns by name, offsets of angles among them.
    values : dict of float
        All parameters: `tree.changed(**found.values)` is the tree that was found.
    rms : float
        Root mean square of angles less data in the last stage, rad.
    rms_fitted, rms_predicted : float
        Of one motion over the part that was fitted and over the rest (rad), which a `failure` may
        say to be another one; NaN where there are windows alone.
    residuals : array, shape (m, n)
        Angles of that motion less data, rad.
    stages : list of (int, float, float)
        Number of windows, their length (s) and rms (rad), from the first to the last stage.
    convergence : str
        How the search ended.
    failure : str or None
        Why one motion was not found, or nothing at all.
    """

    estimates: dict[str, Estimate]
    values: dict[str, float]
    rms: float
    rms_fitted: float
    rms_predicted: float
    residuals: Array
    stages: list[tuple[int, float, float]]
    convergence: str
    failure: str | None

    def __str__(self) -> str:
        width = max(map(len, self.estimates), default=0)
        lines = []
        for name, own in self.estimates.items():
            error = "" if own.deviation is None else f" ± {own.deviation:.1e}"
            note = "" if own.standing == "determined" else f"  ({own.standing})"
            lines.append(f"{name:{width}}  {own.value:.6g}{error}{note}")
        lines.append(f"rms {1e3 * self.rms:.3g} mrad; {self.convergence}")
        if self.failure is not None:
            lines.append(self.failure)
        return "\n".join(lines)

    def __repr__(self) -> str:
        names = ", ".join(list(self.estimates)[:8])
        return f"Identification of {names}: rms {1e3 * self.rms:.3g} mrad"
