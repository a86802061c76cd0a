"""Error against time of methods."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ._common import Array, Result

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False, repr=False)
class WorkPrecision(Result):
    """Error against time of methods on one motion: all runs, each method's from loose to tight.

    Attributes
    ----------
    methods : list of str
        Method of each run.
    settings : array, shape (m,)
        Relative tolerance, or step (s) of a method with steps of one length.
    errors : array, shape (m,)
        Largest error of the state at the end, rad or rad/s.
    seconds : array, shape (m,)
        Shortest time of several runs, s.
    evaluations : array, shape (m,)
        Evaluations of the accelerations; of Taylor series the orders of their coefficients.
    end : array, shape (2 n,)
        State at the end, from numbers of 31 digits.
    uncertainty : float
        How well that state is known, rad or rad/s.
    words : str
        Time (µs) to given errors: a row a method, the shortest of each error marked; and how well the
        end is known.
    """

    methods: list[str]
    settings: Array
    errors: Array
    seconds: Array
    evaluations: Array
    end: Array
    uncertainty: float
    words: str

    def plot(self) -> Figure:
        """Draw the errors against time, by matplotlib.

        Returns
        -------
        matplotlib.figure.Figure
        """
        from matplotlib.figure import Figure

        figure = Figure(figsize=(6, 4.5), layout="constrained")
        axes = figure.subplots()
        for method in dict.fromkeys(self.methods):
            own = np.array([other == method for other in self.methods])
            axes.loglog(1e6 * self.seconds[own], self.errors[own], "o-", markersize=3, label=method)
        axes.set(xlabel="time (µs)", ylabel="error at the end (rad or rad/s)")
        axes.legend()
        return figure

    def __str__(self) -> str:
        return self.words

    def __repr__(self) -> str:
        names = ", ".join(dict.fromkeys(self.methods))
        return f"WorkPrecision({len(self.methods)} runs of {names})"
