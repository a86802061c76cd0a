"""Motions, and what it took to compute them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from .. import _native
from ._common import Array, Result

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False)
class Report(Result):
    """The account of a run; `str` of it says it in words."""

    #: Name of the integration method.
    method: str
    #: Steps that were accepted, and tried in vain.
    accepted: int
    rejected: int
    #: Evaluations of the accelerations.
    evaluations: int
    #: Lengths of the shortest and of the longest step, s.
    shortest_step: float
    longest_step: float
    #: Why the run stopped: "end reached", "stopped at an event", ...
    stop: str
    words: str = field(repr=False)
    #: Error of angles (rad) up to which the motion was compared with a second run: the argument
    #: of `integrate`.
    precision: float | None = None
    #: First time (s), of those asked for and of the ends of steps, at which the second run differs
    #: by more; None if it does not, or was not asked for.
    differs_from: float | None = None

    def __str__(self) -> str:
        return self.words


@dataclass(frozen=True, eq=False, repr=False)
class Solution(Result):
    """A motion at the times asked for; between them, with `dense_output=True`, `solution(t)`.

    Attributes
    ----------
    t : array, shape (m,)
        Times (s): those asked for, up to that of a terminal event.
    y : array, shape (m, 2 n)
        States: angles (rad), angular velocities (rad/s).
    t_events, y_events : lists of arrays
        Times of each of the events, shape (k,), and the states at them, shape (k, 2 n).
    report : Report
        The account of the run.
    names : list of str
        Names of the links.
    """

    t: Array
    y: Array
    t_events: list[Array]
    y_events: list[Array]
    report: Report
    names: list[str]
    dense: _native.DenseOutput | None

    @property
    def steps(self) -> int:
        """Number of accepted steps."""
        return self.report.accepted

    @property
    def evaluations(self) -> int:
        """Number of evaluations of the accelerations."""
        return self.report.evaluations

    @property
    def status(self) -> int:
        """As SciPy's: 0 where the end was reached, 1 at an event, -1 after a failure."""
        return {"end reached": 0, "stopped at an event": 1}.get(self.report.stop, -1)

    @property
    def success(self) -> bool:
        """True where the end or a terminal event was reached."""
        return self.status >= 0

    @property
    def message(self) -> str:
        """The account of the run, in words."""
        return str(self.report)

    def __call__(self, t: ArrayLike) -> Array:
        """Return the states at times of any shape, by the dense output of the method.

        Parameters
        ----------
        t : array, shape (...)
            Times, s.

        Returns
        -------
        array, shape (..., 2 n)
            States, as exact as those in `y`.

        Examples
        --------
        >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
        >>> motion = rod.integrate([0.1, 0.0], (0, 2), dense_output=True)
        >>> motion([[0.5, 1.0]]).shape
        (1, 2, 2)
        """
        if self.dense is None:
            raise ValueError("no dense output was asked for: integrate(..., dense_output=True)")
        return self.dense(t)

    def frame(self) -> pd.DataFrame:
        """Return the states as a `pandas.DataFrame`.

        Returns
        -------
        pandas.DataFrame
            A row for each time (s): columns `theta_parent` (rad) to `omega_child_2` (rad/s).

        Examples
        --------
        >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
        >>> list(rod.integrate([0.1, 0.0], [0.0, 1.0]).frame().columns)
        ['theta_rod', 'omega_rod']
        """
        import pandas as pd

        columns = [f"{letter}_{name}" for letter in ("theta", "omega") for name in self.names]
        return pd.DataFrame(self.y, pd.Index(self.t, name="t"), columns)

    def plot(self) -> Figure:
        """Draw the angles against time, by matplotlib.

        Returns
        -------
        matplotlib.figure.Figure

        Examples
        --------
        >>> rod = bp.Tree("gravity = 9.81, rod: rod(mass = 1, length = 1)")
        >>> len(rod.integrate([0.1, 0.0], (0, 2)).plot().axes)
        1
        """
        from matplotlib.figure import Figure

        figure = Figure(figsize=(7, 3.5), layout="constrained")
        axes = figure.subplots()
        for name, angles in zip(self.names, self.y.T):
            axes.plot(self.t, np.degrees(angles), label=name)
        axes.set(xlabel="t (s)", ylabel="angle (°)")
        axes.legend()
        return figure

    def __repr__(self) -> str:
        return f"Solution({self.report})"
