"""What functions of the package return: arrays under names."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

_Array = NDArray[np.float64]


def make_tree(text: str, parameters: dict[str, float]) -> _native.Tree:
    """Return the tree of a text: what pickles of trees are made of."""
    return _native.Tree(text, **parameters)


def _same(one: Any, other: Any) -> bool:
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        return bool(np.array_equal(one, other, equal_nan=True))
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(_same, one, other))
    return bool(one == other)


class Result:
    """Arrays and numbers under names: equal where all of them are."""

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        names = [own.name for own in fields(self)]  # type: ignore[arg-type]
        return all(_same(getattr(self, name), getattr(other, name)) for name in names)

    __hash__ = None  # type: ignore[assignment]


@dataclass(frozen=True, eq=False)
class Report(Result):
    """The account of a run; `str` of it says it in words."""

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

    t: _Array
    y: _Array
    t_events: list[_Array]
    y_events: list[_Array]
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

    def __call__(self, t: ArrayLike) -> _Array:
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

    factors: _Array
    factor_changes: _Array
    rates: _Array
    rate_changes: _Array
    frequencies: _Array
    horizons: _Array

    def __repr__(self) -> str:
        last = self.horizons[-1]
        return f"Growth along {len(self.rates)} motions up to {last:g} s"


@dataclass(frozen=True, eq=False, repr=False)
class ScaleBudget(Result):
    """Energies by scale, and what changes them.

    dE/dt of a scale is what it receives from the others and the powers on it. Scale 0 is what all
    copies do together, scale s what those of generation s do against each other; energies are
    those by Parseval, which sum to K + U. Arrays have the axes of the states, then those of scales.

    Attributes
    ----------
    energies : array, shape (..., s)
        Energies, J.
    transfers : array, shape (..., s, s)
        `transfers[..., a, b]` is what scale a gives to scale b, in W.
    friction, drag, drive : arrays, shape (..., s)
        Powers (W) of friction in the pivots, which may have either sign, of drag, of the drive.
    """

    energies: _Array
    transfers: _Array
    friction: _Array
    drag: _Array
    drive: _Array

    def __repr__(self) -> str:
        return f"ScaleBudget of {self.energies.shape[-1]} scales"


@dataclass(frozen=True, eq=False, repr=False)
class SectorBudget(Result):
    """Energies of sectors and what changes them: dE/dt = transfer + power.

    Attributes
    ----------
    energies : array, shape (..., s)
        Energies, J.
    transfers : array, shape (..., s)
        What the other sectors give, W.
    powers : array, shape (..., s)
        What friction, drag and drive give, W.
    sectors : list of str
        Names of the sectors.
    """

    energies: _Array
    transfers: _Array
    powers: _Array
    sectors: list[str]

    def __repr__(self) -> str:
        return f"SectorBudget of {', '.join(self.sectors[:8])}"


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
    residuals: _Array
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

    x: _Array
    y: _Array
    names: tuple[str, str]
    rates: _Array
    rate_changes: _Array
    factors: _Array
    factor_changes: _Array

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
