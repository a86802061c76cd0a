"""The cheapest method that is right."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypedDict

from ._common import Result

if TYPE_CHECKING:
    import pandas as pd


class Arguments(TypedDict, total=False):
    """Arguments of `tree.integrate` and `tree.ensemble` that make a run."""

    method: Literal[
        "dop853", "dopri5", "verner98", "taylor", "rk4", "gauss2", "gauss4", "gauss6", "gauss8"
    ]
    rtol: float
    step: float


class Output(TypedDict):
    """An output of which errors are measured."""

    unit: str
    tolerance: float
    reference_error: float
    known_until: float | None


@dataclass(frozen=True, eq=False, repr=False)
class MeasuredRun(Result):
    """One model by one method at one setting, with its error and its cost.

    Attributes
    ----------
    model, method, scalar : str
        "full" or "linear"; the method; "f64" or "f32", double or single precision.
    in_lanes : bool
        True if several starts go at once, in vector registers.
    setting_name, setting : str and float, or None
        "rtol" or "step" (s), and its value; None of what has no setting.
    ratio : float
        Largest error over the one allowed: at most 1 where all is right, infinite after a failure.
    output, error, unit, time : str, float, str, float
        Where it is worst: the output, its error in that unit, and when (s).
    criterion : str
        What that error is of: "values" at a time; "conserved", the drift of the energy; "statistics",
        means from that time on.
    seconds, seconds_per_sample : float
        Time for one start, and for one sample of it, s.
    steps : float
        Steps for one start.
    failure : str or None
        Why the run failed, if it did.
    arguments : dict or None
        What `tree.integrate`, or in lanes `tree.ensemble`, takes for it; None of models and
        numbers that the package has not.
    words, evidence : str
        The run and its error in words.
    """

    model: str
    method: str
    scalar: str
    in_lanes: bool
    setting_name: str | None
    setting: float | None
    ratio: float
    output: str | None
    criterion: str | None
    error: float
    unit: str | None
    time: float
    seconds: float
    seconds_per_sample: float
    steps: float
    failure: str | None
    arguments: Arguments | None
    words: str
    evidence: str

    @property
    def is_right(self) -> bool:
        """True if all that must be right is."""
        return self.ratio <= 1.0

    def __repr__(self) -> str:
        return f"MeasuredRun({self.words}: {1e3 * self.seconds:.3g} ms, {self.evidence})"


@dataclass(frozen=True, eq=False, repr=False)
class Advice(Result):
    """Which model, method and setting to take, with the evidence; `str` of it is a report.

    Attributes
    ----------
    choice : MeasuredRun or None
        The cheapest of those that are right and within the limit of time.
    runner_up : MeasuredRun or None
        The cheapest right one of another candidate; without a choice the cheapest that is right
        and too slow.
    next_cheaper : MeasuredRun or None
        Of those that cost less than the choice and are wrong the dearest.
    closest : MeasuredRun or None
        Without a choice the one that is least wrong.
    ranking : list of MeasuredRun
        Of each candidate its best run: those that are right, the cheapest first, then the others,
        the least wrong first.
    runs : list of MeasuredRun
        All that was measured.
    outputs : dict of dict
        Of each output its "unit", its "tolerance", the "reference_error", and the time (s)
        "known_until" which double precision tells its values; None where that is the end.
    reference : str
        How the reference was computed.
    growth : float or None
        Rate (1/s) at which small deviations grow, where they were looked at.
    """

    choice: MeasuredRun | None
    runner_up: MeasuredRun | None
    next_cheaper: MeasuredRun | None
    closest: MeasuredRun | None
    ranking: list[MeasuredRun]
    runs: list[MeasuredRun]
    outputs: dict[str, Output]
    reference: str
    growth: float | None
    words: str

    @property
    def arguments(self) -> Arguments:
        """Arguments of `tree.integrate` for the cheapest right run that it makes.

        The choice itself may be one that the package has not: the linear model, single precision,
        or of several starts `tree.ensemble`.
        """
        if self.choice is not None:
            for run in self.ranking:
                if run.is_right and run.arguments is not None and not run.in_lanes:
                    return run.arguments.copy()
        raise ValueError("no method of `integrate` is right within the limits")

    def frame(self) -> pd.DataFrame:
        """Return the ranking as a `pandas.DataFrame`.

        Returns
        -------
        pandas.DataFrame
            A row for each candidate, the best first.

        Examples
        --------
        >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
        >>> bool(rod.advise([1.0, 0.0], (0, 1)).frame()["ratio"].iloc[0] <= 1.0)
        True
        """
        import pandas as pd

        names = ["model", "method", "scalar", "in_lanes", "setting_name", "setting", "ratio"]
        names += ["output", "error", "unit", "criterion", "time", "seconds", "steps"]
        return pd.DataFrame([{name: getattr(run, name) for name in names} for run in self.ranking])

    def __str__(self) -> str:
        return self.words

    def __repr__(self) -> str:
        count = f"{len(self.runs)} runs of {len(self.ranking)} candidates"
        if self.choice is None:
            return f"Advice: nothing is right ({count})"
        return f"Advice: {self.choice.words} ({count})"
