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


def _with_error(value: float, error: float) -> str:
    """Two digits of the error, and those of the value that it leaves."""
    if not 0 < error < np.inf:
        return f"{value:.4g}" if error == 0 else f"{value:.4g} ± ?"
    decimals = max(0, 1 - int(np.floor(np.log10(error))))
    return f"{value:.{decimals}f} ± {error:.{decimals}f}"


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
    friction, drag, drive, outside : arrays, shape (..., s)
        Powers (W) of friction in the pivots, which may have either sign, of drag, of the drive and
        of torques from outside.
    freedoms : array of int, shape (s,)
        Degrees of freedom of each scale.
    """

    energies: _Array
    transfers: _Array
    friction: _Array
    drag: _Array
    drive: _Array
    outside: _Array
    freedoms: NDArray[np.int64]

    @property
    def received(self) -> _Array:
        """What each scale receives from all others, W, shape (..., s)."""
        return self.transfers.sum(axis=-2)

    @property
    def power(self) -> _Array:
        """Power of friction, drag, drive and torques from outside, W, shape (..., s).

        The rate of the energies is `received + power`.
        """
        return self.friction + self.drag + self.drive + self.outside

    @property
    def flux(self) -> _Array:
        """Power (W) that passes into each scale and all finer ones, shape (..., s).

        What scales before s give to scale s and those behind it; of the first nothing, but for
        rounding.
        """
        # Transfers among scale s and those behind it cancel.
        return np.flip(np.cumsum(np.flip(self.received, -1), axis=-1), -1)

    @property
    def losses(self) -> _Array:
        """Power (W) that friction and drag take from each scale, shape (..., s)."""
        return -(self.friction + self.drag)

    def averages(self, discard: int | None = None) -> ScaleAverages:
        """Return means over time with their standard errors, of one motion or of many.

        Transfers change sign many times a second: samples some hundredths of a second apart keep
        the errors of the flux small.

        Parameters
        ----------
        discard : int
            Number of first samples that are left out; without it as many as MSER-5 finds
            (`analysis.transient`) in the energy, averaged over all motions.

        Returns
        -------
        ScaleAverages

        Raises
        ------
        ValueError
            The states are not those of motions, or there are too few to find the transient.

        Examples
        --------
        >>> tree = bp.Tree('''gravity = 9.81,
        ...     arm: generations(count = 2, branching = 2, shape = rod, mass = 0.1, length = 0.3,
        ...         friction = 1e-3),
        ...     drive(torque = 0.05 * cos(5 * t))''')
        >>> t = np.arange(0, 100, 0.2)
        >>> starts = np.random.default_rng(1).normal(0, 0.1, (4, 6))
        >>> found = tree.budget(tree.ensemble(starts, t), t).averages(discard=100)
        >>> found.energies.shape, bool(found.input > 0)
        ((2,), True)
        """
        axes = self.energies.shape[:-1]
        if len(axes) not in (1, 2):
            raise ValueError(
                "means are those of budgets along one motion, y of shape (m, 2 n), or along many, "
                f"(k, m, 2 n); the axes of these states are {axes}"
            )
        scales = self.energies.shape[-1]

        def series(values: _Array) -> _Array:
            """Scales, motions, times."""
            return np.moveaxis(values.reshape(-1, *values.shape[-2:]), -1, 0)

        energies = series(self.energies)
        if discard is None:
            discard = _native.transient(energies.sum(axis=0).mean(axis=0))
        if not 0 <= discard < energies.shape[-1]:
            count = energies.shape[-1]
            raise ValueError(f"discard must be from 0 to {count - 1}, got {discard}")

        notes: list[str] = []

        def mean(name: str, own: _Array) -> tuple[float, float]:
            own = own[:, discard:]
            try:
                found = _native.average(own)
            except ValueError as error:
                notes.append(f"no error of {name}: {str(error).removeprefix('x: ')}")
                return float(own.mean()), float("nan")
            return found["mean"], found["error"]

        def means(name: str, values: _Array) -> tuple[_Array, _Array]:
            found = [mean(f"{name}[{scale}]", own) for scale, own in enumerate(values)]
            return np.array([own[0] for own in found]), np.array([own[1] for own in found])

        own, own_errors = means("energies", energies)
        given, losses = series(self.drive + self.outside), series(self.losses)
        flux = series(self.flux)
        # Nothing passes into all scales from others.
        flux[0] = 0.0
        flux_means, flux_errors = means("flux", flux)
        behind = np.flip(np.cumsum(np.flip(losses - given, 0), axis=0), 0)
        lost, lost_errors = means("lost", behind)
        entered, entered_error = mean("input", given.sum(axis=0))
        taken, taken_error = mean("losses", losses.sum(axis=0))
        return ScaleAverages(
            energies=own,
            energy_errors=own_errors,
            flux=flux_means,
            flux_errors=flux_errors,
            lost=lost,
            lost_errors=lost_errors,
            input=entered,
            input_error=entered_error,
            losses=taken,
            losses_error=taken_error,
            freedoms=self.freedoms,
            discarded=discard,
            notes=notes,
        )

    def __repr__(self) -> str:
        return f"ScaleBudget of {self.energies.shape[-1]} scales"


@dataclass(frozen=True, eq=False, repr=False)
class ScaleAverages(Result):
    """Means over time, and over motions, of a budget by scale; `str` of it is a table.

    In a steady state what passes into a scale and all finer ones is lost there: `flux` and `lost`
    are equal within their errors. The errors know that neighbouring samples are correlated, and are
    on the safe side where the samples swing.

    Attributes
    ----------
    energies, energy_errors : arrays, shape (s,)
        Energies and their standard errors, J.
    flux, flux_errors : arrays, shape (s,)
        Power that passes into each scale and all finer ones, by what the scales give each other, W.
    lost, lost_errors : arrays, shape (s,)
        Power of friction and drag there less what drives those scales directly, W.
    input, input_error : float
        Power of the drive and of torques from outside on all scales, W.
    losses, losses_error : float
        Power that friction and drag take from all scales, W.
    freedoms : array of int, shape (s,)
        Degrees of freedom of each scale.
    discarded : int
        Number of first samples that are left out.
    notes : list of str
        Why errors are NaN, where they are: samples that are correlated for too long.
    """

    energies: _Array
    energy_errors: _Array
    flux: _Array
    flux_errors: _Array
    lost: _Array
    lost_errors: _Array
    input: float
    input_error: float
    losses: float
    losses_error: float
    freedoms: NDArray[np.int64]
    discarded: int
    notes: list[str]

    def __str__(self) -> str:
        lines = ["scale  freedoms  energy (mJ)         flux into it (mW)   losses − input from there on (mW)"]
        pairs = [
            (self.energies, self.energy_errors),
            (self.flux, self.flux_errors),
            (self.lost, self.lost_errors),
        ]
        for scale, freedoms in enumerate(self.freedoms):
            cells = [_with_error(1e3 * mean[scale], 1e3 * error[scale]) for mean, error in pairs]
            lines.append(f"{scale:<5}  {freedoms:<8}  {cells[0]:<18}  {cells[1]:<18}  {cells[2]}")
        entered = _with_error(1e3 * self.input, 1e3 * self.input_error)
        taken = _with_error(1e3 * self.losses, 1e3 * self.losses_error)
        lines.append(f"input {entered} mW, losses {taken} mW")
        lines.append(f"the first {self.discarded} samples are left out")
        return "\n".join([*lines, *self.notes])

    def __repr__(self) -> str:
        return f"ScaleAverages of {len(self.energies)} scales"


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
    arguments: dict[str, Any] | None
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
    outputs: dict[str, dict[str, Any]]
    reference: str
    growth: float | None
    words: str

    @property
    def arguments(self) -> dict[str, Any]:
        """Arguments of `tree.integrate` for the cheapest right run that it makes.

        The choice itself may be one that the package has not: the linear model, single precision,
        or of several starts `tree.ensemble`.
        """
        if self.choice is not None:
            for run in self.ranking:
                if run.is_right and run.arguments is not None and not run.in_lanes:
                    return dict(run.arguments)
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
