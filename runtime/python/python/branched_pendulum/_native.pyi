"""Types of the compiled module; the docstrings are those of the module itself."""

from collections.abc import Callable, Sequence
from os import PathLike
from typing import ClassVar, Literal, final

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray
from typing_extensions import disjoint_base

__all__ = [
    "BranchedDouble",
    "DescriptionError",
    "FailedMotions",
    "Growth",
    "IntegrationError",
    "Lines",
    "Pendulum",
    "ReadError",
    "Recording",
    "RequestError",
    "ScaleBudget",
    "SmoothedMotion",
    "Solution",
    "Tree",
    "__version__",
    "lines",
    "read",
    "running_integral",
    "smooth",
    "spectrum",
]

__version__: str

_Array = NDArray[np.float64]
_Event = Callable[[float, _Array], float]

class DescriptionError(ValueError):
    mistakes: list[tuple[int, int, str]]

class IntegrationError(RuntimeError): ...
class RequestError(IntegrationError, ValueError): ...

class FailedMotions(RuntimeWarning):
    reasons: dict[int, str]

class ReadError(ValueError):
    file: str | None
    line: int | None
    column: int | None
    name: str | None

@final
class Solution:
    @property
    def t(self) -> _Array: ...
    @property
    def y(self) -> _Array: ...
    @property
    def t_events(self) -> list[_Array]: ...
    @property
    def y_events(self) -> list[_Array]: ...
    @property
    def report(self) -> str: ...
    @property
    def steps(self) -> int: ...
    @property
    def evaluations(self) -> int: ...
    def __call__(self, t: ArrayLike) -> _Array: ...
    def frame(self) -> pd.DataFrame: ...

@disjoint_base
class Pendulum:
    @property
    def names(self) -> list[str]: ...
    def __len__(self) -> int: ...
    def rhs(self, t: float, y: ArrayLike) -> _Array: ...
    def energy(self, y: ArrayLike) -> _Array: ...
    def integrate(
        self,
        y0: ArrayLike,
        t: ArrayLike,
        method: str = "dop853",
        rtol: float = 1e-9,
        atol: float | None = None,
        step: float | None = None,
        events: _Event | Sequence[_Event] | None = None,
        dense_output: bool = False,
        max_steps: int = 1_000_000,
    ) -> Solution: ...
    def ensemble(
        self,
        starts: ArrayLike,
        t: ArrayLike,
        method: str = "dop853",
        rtol: float = 1e-9,
        atol: float | None = None,
        threads: int | None = None,
        max_steps: int = 1_000_000,
    ) -> _Array: ...
    def lyapunov(
        self,
        y0: ArrayLike,
        count: int = 1,
        interval: float = 0.5,
        settling: int = 20,
        intervals: int = 200,
        t0: float = 0.0,
        rtol: float = 1e-9,
        within: Sequence[Sequence[str]] | None = None,
        transverse: Sequence[Sequence[str]] | None = None,
    ) -> tuple[_Array, _Array]: ...
    def growth(
        self,
        starts: ArrayLike,
        pair: Sequence[str],
        horizons: ArrayLike,
        frequency: float | None = None,
        rtol: float = 1e-9,
        threads: int | None = None,
    ) -> Growth: ...
    def smooth(
        self,
        t: ArrayLike,
        theta: ArrayLike,
        method: Literal["kinematic", "polynomials", "equations"] = "kinematic",
        noise: float | None = None,
        friction: bool = False,
    ) -> SmoothedMotion: ...

@final
class Growth:
    @property
    def factors(self) -> _Array: ...
    @property
    def factor_changes(self) -> _Array: ...
    @property
    def rates(self) -> _Array: ...
    @property
    def frequencies(self) -> _Array: ...
    @property
    def horizons(self) -> _Array: ...

@final
class Tree(Pendulum):
    def __new__(cls, text: str, /, **parameters: float) -> Tree: ...
    def changed(self, **parameters: float) -> Tree: ...
    @property
    def parameters(self) -> dict[str, float]: ...
    def accelerations(
        self,
        theta: ArrayLike,
        omega: ArrayLike,
        time: float = 0.0,
        torques: ArrayLike | None = None,
    ) -> _Array: ...
    def kinetic_energy(self, theta: ArrayLike, omega: ArrayLike) -> float: ...
    def potential_energy(self, theta: ArrayLike) -> float: ...
    def friction_power(self, y: ArrayLike) -> _Array: ...
    def budget(self, y: ArrayLike, t: ArrayLike | None = None) -> ScaleBudget: ...
    def momenta(self, theta: ArrayLike, omega: ArrayLike) -> _Array: ...
    def mass_matrix(self, theta: ArrayLike) -> _Array: ...
    def stiffness_matrix(self, theta: ArrayLike) -> _Array: ...
    def modes(self, theta: ArrayLike | None = None) -> tuple[_Array, _Array]: ...
    def equilibrium(self, theta: ArrayLike | None = None) -> _Array: ...
    def points(
        self, theta: ArrayLike, point: Literal["pivot", "centre", "end"] = "end"
    ) -> _Array: ...

@final
class ScaleBudget:
    @property
    def energies(self) -> _Array: ...
    @property
    def transfers(self) -> _Array: ...
    @property
    def friction(self) -> _Array: ...
    @property
    def drag(self) -> _Array: ...
    @property
    def drive(self) -> _Array: ...

@final
class BranchedDouble(Pendulum):
    FORMS: ClassVar[list[str]]
    def __new__(cls) -> BranchedDouble: ...
    def canonical_variables(self, y: ArrayLike) -> _Array: ...
    def antiphase_energy(self, y: ArrayLike) -> _Array: ...
    def transfer(self, y: ArrayLike, form: str = "exact") -> _Array: ...
    def transfer_parts(self, y: ArrayLike, form: str = "exact") -> _Array: ...

@final
class Recording:
    @property
    def t(self) -> _Array: ...
    @property
    def theta(self) -> _Array: ...
    @property
    def marked(self) -> NDArray[np.bool_]: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def findings(self) -> list[str]: ...
    @property
    def interval(self) -> float: ...
    @property
    def jitter(self) -> float: ...
    @property
    def gaps(self) -> list[tuple[float, float]]: ...
    @property
    def dot_distances(self) -> list[tuple[float, float]] | None: ...
    def __len__(self) -> int: ...
    def frame(self) -> pd.DataFrame: ...

def read(
    path: str | PathLike[str],
    *,
    columns: Sequence[str] | None = None,
    dots: Sequence[Sequence[str]] | None = None,
    unit: Literal["rad", "deg", "mrad", "arcmin", "arcsec", "gon", "turn"] | None = None,
    zero: Literal["down", "up"] | None = None,
    relative_to: Sequence[int | None] | None = None,
    mirrored: bool = False,
    time: str | None = None,
    frame_rate: float | None = None,
    outliers: float | None = ...,
    likelihood: float = 0.9,
    y_down: bool | None = None,
    gravity: Literal["axis", "first link"] | tuple[float, float] | None = None,
    delimiter: Literal[",", ";", "tab", "space"] | None = None,
    decimal: Literal[".", ","] | None = None,
    pivot: Literal["origin"] | tuple[float, float] | None = None,
    drop_repeated: Literal["first", "last"] | None = None,
) -> Recording: ...

@final
class SmoothedMotion:
    @property
    def t(self) -> _Array: ...
    @property
    def y(self) -> _Array: ...
    @property
    def y_error(self) -> _Array: ...
    @property
    def acceleration(self) -> _Array | None: ...
    @property
    def acceleration_error(self) -> _Array | None: ...
    @property
    def noise(self) -> _Array: ...
    @property
    def whiteness(self) -> float: ...
    @property
    def frictions(self) -> _Array: ...
    def draws(self, count: int = 200, seed: int = 0) -> _Array: ...
    def estimate(
        self, function: Callable[[_Array], ArrayLike], count: int = 200, seed: int = 0
    ) -> tuple[_Array, _Array]: ...
    def frame(self) -> pd.DataFrame: ...

def smooth(
    t: ArrayLike,
    x: ArrayLike,
    method: Literal["kinematic", "polynomials"] = "kinematic",
    noise: float | None = None,
) -> SmoothedMotion: ...

@final
class Lines:
    @property
    def frequencies(self) -> _Array: ...
    @property
    def frequency_errors(self) -> _Array: ...
    @property
    def amplitudes(self) -> _Array: ...
    @property
    def amplitude_errors(self) -> _Array: ...
    @property
    def phases(self) -> _Array: ...
    @property
    def mean(self) -> float: ...
    @property
    def residual(self) -> float: ...
    @property
    def resolution(self) -> float: ...
    def __len__(self) -> int: ...
    def __call__(self, t: ArrayLike) -> _Array: ...
    def named(
        self, fundamentals: dict[str, float], order: int = 5, tolerance: float = 0.01
    ) -> list[str | None]: ...

def lines(
    x: ArrayLike,
    sample_rate: float,
    most: int = 12,
    smallest: float = 1e-9,
    window: int = 1,
) -> Lines: ...
def spectrum(
    x: ArrayLike,
    sample_rate: float,
    frequencies: ArrayLike | None = None,
    window: int = 1,
    remove_mean: bool = True,
) -> tuple[_Array, _Array]: ...
def running_integral(t: ArrayLike, x: ArrayLike) -> _Array: ...
