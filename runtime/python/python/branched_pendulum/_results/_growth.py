"""Growth of small differences."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ._common import Array, Result

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False, repr=False)
class Growth(Result):
    """Growth of a small difference along k motions; NaN where one could not be followed.

    Everything is computed at two tolerances: where motions are chaotic, growth over a long time
    is a number that no tolerance finds, and the changes say so.

    Attributes
    ----------
    factors : array, shape (k, h)
        Growth up to each horizon: the largest difference over its amplitude at the start.
    factor_changes : array, shape (k, h)
        Relative changes of the factors between the tolerances: beyond a hundredth they are not
        determined.
    rates, rate_changes : arrays, shape (k,)
        Growth rates (1/s) over the last horizon, near zero where differences keep their size
        though they beat, and their changes between the tolerances.
    frequencies : array, shape (k,)
        Frequencies (Hz) of the differences: turns of the difference and its rate about zero.
    horizons : array, shape (h,)
        Times after the start (s) up to which growth was asked for.
    """

    factors: Array
    factor_changes: Array
    rates: Array
    rate_changes: Array
    frequencies: Array
    horizons: Array

    def __repr__(self) -> str:
        last = self.horizons[-1]
        return f"Growth along {len(self.rates)} motions up to {last:g} s"


@dataclass(frozen=True, eq=False, repr=False)
class ReleaseMap(Result):
    """Growth of a small difference over a plane of releases.

    Attributes
    ----------
    x, y : arrays, shapes (k,) and (l,)
        Angles of the axes (rad), or values of parameters.
    names : tuple of str
        What the axes are of.
    rates, rate_changes : arrays, shape (l, k)
        Growth rates (1/s), and their changes between two tolerances; NaN where a motion could not
        be followed.
    factors, factor_changes : arrays, shape (l, k)
        Growth factors up to the horizon, and their relative changes.
    """

    x: Array
    y: Array
    names: tuple[str, str]
    rates: Array
    rate_changes: Array
    factors: Array
    factor_changes: Array

    def plot(self) -> Figure:
        """Draw the rates over the plane, by matplotlib: white where they are not determined.

        Returns
        -------
        matplotlib.figure.Figure
        """
        from matplotlib.figure import Figure

        figure = Figure(figsize=(6, 4.5), layout="constrained")
        axes = figure.subplots()
        determined = np.abs(self.rate_changes) <= 0.01 * np.maximum(np.abs(self.rates), 0.1)
        rates = np.where(determined, self.rates, np.nan)
        mesh = axes.pcolormesh(self.x, self.y, rates, cmap="viridis", vmin=0.0)
        figure.colorbar(mesh, label="growth rate (1/s)")
        axes.set(xlabel=self.names[0], ylabel=self.names[1])
        return figure

    def __repr__(self) -> str:
        return f"ReleaseMap of {' and '.join(self.names)}: {self.rates.size} points"
