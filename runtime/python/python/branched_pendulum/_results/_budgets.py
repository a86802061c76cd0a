"""Energies of sectors and scales, and the powers between them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .. import _native
from ._common import Array, Result, with_error


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

    energies: Array
    transfers: Array
    friction: Array
    drag: Array
    drive: Array
    outside: Array
    freedoms: NDArray[np.int64]

    @property
    def received(self) -> Array:
        """What each scale receives from all others, W, shape (..., s)."""
        received: Array = self.transfers.sum(axis=-2)
        return received

    @property
    def power(self) -> Array:
        """Power of friction, drag, drive and torques from outside, W, shape (..., s).

        The rate of the energies is `received + power`.
        """
        return self.friction + self.drag + self.drive + self.outside

    @property
    def flux(self) -> Array:
        """Power (W) that passes into each scale and all finer ones, shape (..., s).

        What scales before s give to scale s and those behind it; of the first nothing, but for
        rounding.
        """
        # Transfers among scale s and those behind it cancel.
        return np.flip(np.cumsum(np.flip(self.received, -1), axis=-1), -1)

    @property
    def losses(self) -> Array:
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

        def series(values: Array) -> Array:
            """Scales, motions, times."""
            return np.moveaxis(values.reshape(-1, *values.shape[-2:]), -1, 0)

        energies = series(self.energies)
        if discard is None:
            discard = _native.transient(energies.sum(axis=0).mean(axis=0))
        if not 0 <= discard < energies.shape[-1]:
            count = energies.shape[-1]
            raise ValueError(f"discard must be from 0 to {count - 1}, got {discard}")

        notes: list[str] = []

        def mean(name: str, own: Array) -> tuple[float, float]:
            own = own[:, discard:]
            try:
                found = _native.average(own)
            except ValueError as error:
                notes.append(f"no error of {name}: {str(error).removeprefix('x: ')}")
                return float(own.mean()), float("nan")
            return found["mean"], found["error"]

        def means(name: str, values: Array) -> tuple[Array, Array]:
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

    energies: Array
    energy_errors: Array
    flux: Array
    flux_errors: Array
    lost: Array
    lost_errors: Array
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
            cells = [with_error(1e3 * mean[scale], 1e3 * error[scale]) for mean, error in pairs]
            lines.append(f"{scale:<5}  {freedoms:<8}  {cells[0]:<18}  {cells[1]:<18}  {cells[2]}")
        entered = with_error(1e3 * self.input, 1e3 * self.input_error)
        taken = with_error(1e3 * self.losses, 1e3 * self.losses_error)
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

    energies: Array
    transfers: Array
    powers: Array
    sectors: list[str]

    def __repr__(self) -> str:
        return f"SectorBudget of {', '.join(self.sectors[:8])}"
