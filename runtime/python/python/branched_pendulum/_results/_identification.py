"""Parameters from a measured motion and from frequencies."""

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


@dataclass(frozen=True, eq=False)
class FittedFrequency(Result):
    """A measured frequency beside that of the tree that was found.

    Attributes
    ----------
    mode : int
        Number of its mode, 1 for the slowest of those that oscillate.
    hertz, deviation : float
        The measured frequency and its standard error, Hz.
    fitted : float
        The tree's frequency, Hz.
    """

    mode: int
    hertz: float
    deviation: float
    fitted: float


@dataclass(frozen=True, eq=False, repr=False)
class Identification(Result):
    """Parameters of a tree from its measured motion or frequencies; `str` of it is a table.

    Attributes
    ----------
    estimates : dict of Estimate
        Unknowns by name, offsets of angles among them.
    values : dict of float
        All parameters: `tree.changed(**found.values)` is the tree that was found.
    rms : float
        Root mean square of angles less data in the last stage, rad; NaN without a motion.
    rms_fitted, rms_predicted : float
        Of one motion over the part that was fitted and over the rest (rad), which a `failure` may
        say to be another one; NaN where there are windows alone.
    residuals : array, shape (m, n)
        Angles of that motion less data, rad.
    stages : list of (int, float, float)
        Number of windows, their length (s) and rms (rad), from the first to the last stage.
    frequencies : list of FittedFrequency
        The frequencies that were given, beside those of the tree that was found.
    alternatives : list of dict of float
        Other values of the unknowns by which frequencies alone are met as well, if some were found.
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
    frequencies: list[FittedFrequency]
    alternatives: list[dict[str, float]]
    convergence: str
    failure: str | None

    def __str__(self) -> str:
        width = max(map(len, self.estimates), default=0)
        lines = []
        for name, own in self.estimates.items():
            error = "" if own.deviation is None else f" ± {own.deviation:.1e}"
            note = "" if own.standing == "determined" else f"  ({own.standing})"
            lines.append(f"{name:{width}}  {own.value:.6g}{error}{note}")
        for datum in self.frequencies:
            above = (datum.fitted - datum.hertz) / datum.deviation
            measured = f"{datum.hertz:.6g} ± {datum.deviation:.1e} Hz"
            lines.append(f"mode {datum.mode}: {measured}, {above:+.2f} deviations to the tree's")
        for values in self.alternatives:
            each = ", ".join(f"{name} = {value:.6g}" for name, value in values.items())
            lines.append(f"met as well by {each}")
        motion = f"rms {1e3 * self.rms:.3g} mrad; " if self.stages[-1][0] else ""
        lines.append(motion + self.convergence)
        if self.failure is not None:
            lines.append(self.failure)
        return "\n".join(lines)

    def __repr__(self) -> str:
        names = ", ".join(list(self.estimates)[:8])
        data = f"rms {1e3 * self.rms:.3g} mrad" if self.stages[-1][0] else "by frequencies alone"
        return f"Identification of {names}: {data}"
