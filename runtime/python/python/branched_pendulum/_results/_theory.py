"""Predictions of the resonant normal form."""

from __future__ import annotations

from dataclasses import dataclass

from ._common import Array, Result


@dataclass(frozen=True, eq=False)
class Prediction(Result):
    """Frequencies and growth of a difference along one motion, by the normal form."""

    #: Frequencies of the modes in phase, Hz.
    frequencies: Array
    #: Their errors, Hz: the change from the degree below.
    frequency_errors: Array
    #: Frequencies of the differences, Hz.
    difference_frequencies: Array
    #: Their errors, Hz.
    difference_errors: Array
    #: Growth rate of the difference without friction, 1/s; 0 if it does not grow.
    growth_rate: float
    #: Its error, 1/s.
    growth_error: float
    #: The resonance that acts most, such as "f_1 + f_2 = 2 d_1".
    resonance: str | None
