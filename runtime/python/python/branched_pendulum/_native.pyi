"""Types of the compiled module; the docstrings are those of the module itself."""

from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import ClassVar, Literal, TypedDict, final, overload

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray
from typing_extensions import disjoint_base

from ._drawing import Picture
from ._results import (
    AccelerationSlopes,
    Advice,
    Design,
    Equilibrium,
    Growth,
    Identification,
    MotionGradient,
    Prediction,
    Report,
    ScaleBudget,
    SectorBudget,
    Solution,
    WorkPrecision,
)

__all__ = [
    "BranchedDouble",
    "DenseOutput",
    "DescriptionError",
    "FailedMotions",
    "IntegrationError",
    "Lines",
    "NormalForm",
    "Pendulum",
    "ReadError",
    "Recording",
    "RequestError",
    "SmoothedMotion",
    "Stepper",
    "Tree",
    "__version__",
    "average",
    "example_texts",
    "lines",
    "read",
    "running_integral",
    "smooth",
    "spectrum",
    "transient",
]

__version__: str

_Array = NDArray[np.float64]
# The numbers of one state, or its angles.
_One = Sequence[float]
# States in an array. One state in an array has a float64 too, which has no type of its own here:
# the number of axes is part of few arrays' types.
_Many = NDArray[np.number] | Sequence[Sequence[float]] | Sequence[NDArray[np.number]]
# A number of one state, an array of several.
_Values = np.float64 | _Array
# Methods that need the rates alone.
_OfRates = Literal[
    "dop853", "dopri5", "verner98", "rk4", "gauss2", "gauss4", "gauss6", "gauss8", "animation"
]
_Named = Literal["taylor"] | _OfRates
_Method = Literal["auto"] | _Named
_Form = Literal[
    "exact",
    "angle order 1",
    "amplitude order 2",
]
_TreeForm = Literal[
    "exact",
    "growth",
    "forcing",
    "angle order 1",
    "angle order 2",
    "angle order 3",
    "angle order 4",
    "angle order 5",
    "angle order 6",
    "angle order 7",
    "angle order 8",
    "angle order 9",
    "angle order 10",
    "angle order 11",
    "angle order 12",
    "angle order 13",
    "angle order 14",
    "angle order 15",
    "amplitude order 1",
    "amplitude order 2",
    "amplitude order 3",
    "amplitude order 4",
    "amplitude order 5",
    "amplitude order 6",
    "amplitude order 7",
    "amplitude order 8",
    "amplitude order 9",
    "amplitude order 10",
    "amplitude order 11",
    "amplitude order 12",
    "amplitude order 13",
    "amplitude order 14",
    "amplitude order 15",
]
# Names in a list: a str alone is a sequence of str too.
_Names = list[str] | tuple[str, ...]
_Event = Callable[[float, _Array], float]
_Torques = Callable[[float, _Array], ArrayLike]

class DescriptionError(ValueError):
    mistakes: list[tuple[int, int, str]]

class IntegrationError(RuntimeError):
    solution: Solution | None

class RequestError(IntegrationError, ValueError): ...

class FailedMotions(RuntimeWarning):
    reasons: dict[int, str]

class ReadError(ValueError):
    file: str | None
    line: int | None
    column: int | None
    name: str | None

@final
class DenseOutput:
    def __call__(self, t: ArrayLike) -> _Array: ...
    @staticmethod
    def _read(bytes: bytes, dimension: int) -> DenseOutput: ...

@disjoint_base
class Pendulum:
    @property
    def names(self) -> list[str]: ...
    def __len__(self) -> int: ...
    def rhs(self, t: ArrayLike, y: ArrayLike, axis: int = ...) -> _Array: ...
    @overload
    def energy(self, y: _One) -> np.float64: ...
    @overload
    def energy(self, y: _Many) -> _Array: ...
    @overload
    def energy(self, y: ArrayLike) -> _Values: ...
    def integrate(
        self,
        y0: ArrayLike,
        t: ArrayLike,
        method: _Method = "auto",
        rtol: float = 1e-9,
        atol: ArrayLike | None = None,
        step: float | None = None,
        events: _Event | Sequence[_Event] | None = None,
        dense_output: bool = False,
        max_steps: int = 1_000_000,
        *,
        first_step: float | None = None,
        max_step: float | None = None,
        precision: float | None = None,
    ) -> Solution: ...
    def ensemble(
        self,
        starts: ArrayLike,
        t: ArrayLike,
        method: Literal["auto", "dop853", "dopri5", "verner98", "taylor"] = "auto",
        rtol: float = 1e-9,
        atol: ArrayLike | None = None,
        threads: int | None = None,
        max_steps: int = 1_000_000,
        *,
        first_step: float | None = None,
        max_step: float | None = None,
        parameters: Mapping[str, ArrayLike] | None = None,
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
        within: Sequence[_Names] | None = None,
        transverse: Sequence[_Names] | None = None,
    ) -> tuple[_Array, _Array]: ...
    def growth(
        self,
        starts: ArrayLike,
        pair: tuple[str, str] | list[str],
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
class NormalForm:
    @property
    def linear_frequencies(self) -> _Array: ...
    @property
    def resonances(self) -> list[str]: ...
    def actions(self, y: ArrayLike) -> _Array: ...
    def frequencies(self, actions: ArrayLike) -> _Array: ...
    def predict(self, y: ArrayLike) -> Prediction: ...
    def growth_rate(self, y: ArrayLike) -> _Values: ...

@final
class Stepper:
    @property
    def t(self) -> float: ...
    @property
    def y(self) -> _Array: ...
    @property
    def report(self) -> Report: ...
    @property
    def torques(self) -> _Torques | _Array: ...
    @torques.setter
    def torques(self, value: _Torques | ArrayLike | None, /) -> None: ...
    def set_state(self, t: float, y: ArrayLike) -> None: ...
    def step(self, until: float | None = None) -> bool: ...
    def advance(self, duration: float) -> _Array: ...

@final
class Tree(Pendulum):
    def __new__(cls, text: str, /, **parameters: float) -> Tree: ...
    def changed(self, **parameters: float) -> Tree: ...
    @property
    def text(self) -> str: ...
    @property
    def parameters(self) -> dict[str, float]: ...
    @property
    def parents(self) -> list[int | None]: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def accelerations(
        self,
        theta: ArrayLike,
        omega: ArrayLike,
        time: float = 0.0,
        torques: ArrayLike | None = None,
    ) -> _Array: ...
    def inverse_dynamics(
        self, theta: ArrayLike, omega: ArrayLike, alpha: ArrayLike, time: float = 0.0
    ) -> _Array: ...
    def design(
        self,
        vary: Mapping[str, tuple[float, float]],
        targets: Mapping[str, float | tuple[float | None, float | None]],
        pair: tuple[str, str] | Sequence[str] | None = None,
        *,
        y0: ArrayLike | None = None,
        degree: int = 8,
        least: float = 0.02,
    ) -> Design: ...
    def pullback(
        self,
        theta: ArrayLike,
        omega: ArrayLike,
        weights: ArrayLike,
        time: float = 0.0,
        torques: ArrayLike | None = None,
    ) -> AccelerationSlopes: ...
    def gradient(
        self,
        cost: Callable[[_Array], tuple[float, ArrayLike]],
        y0: ArrayLike,
        t: ArrayLike,
        *,
        parameters: Sequence[str] | None = None,
        method: _Method = "auto",
        rtol: float = 1e-9,
        atol: ArrayLike | None = None,
        step: float | None = None,
        max_steps: int = 1_000_000,
    ) -> MotionGradient: ...
    @overload
    def kinetic_energy(self, theta: _One, omega: _One) -> np.float64: ...
    @overload
    def kinetic_energy(self, theta: _Many, omega: _Many) -> _Array: ...
    @overload
    def kinetic_energy(self, theta: ArrayLike, omega: ArrayLike) -> _Values: ...
    @overload
    def potential_energy(self, theta: _One) -> np.float64: ...
    @overload
    def potential_energy(self, theta: _Many) -> _Array: ...
    @overload
    def potential_energy(self, theta: ArrayLike) -> _Values: ...
    @overload
    def friction_power(self, y: _One) -> np.float64: ...
    @overload
    def friction_power(self, y: _Many) -> _Array: ...
    @overload
    def friction_power(self, y: ArrayLike) -> _Values: ...
    def budget(
        self, y: ArrayLike, t: ArrayLike | None = None, torques: ArrayLike | None = None
    ) -> ScaleBudget: ...
    def momenta(self, theta: ArrayLike, omega: ArrayLike) -> _Array: ...
    def mass_matrix(self, theta: ArrayLike) -> _Array: ...
    def stiffness_matrix(self, theta: ArrayLike) -> _Array: ...
    def modes(self, theta: ArrayLike | None = None) -> tuple[_Array, _Array]: ...
    def equilibrium(self, theta: ArrayLike | None = None, *, stable: bool = True) -> _Array: ...
    def equilibria(self) -> list[Equilibrium]: ...
    def normal_form(
        self, pair: tuple[str, str] | list[str], degree: int = 8, bound: float = 0.15
    ) -> NormalForm: ...
    def points(
        self, theta: ArrayLike, point: Literal["pivot", "centre", "end"] = "end"
    ) -> _Array: ...
    @property
    def sectors(self) -> list[str]: ...
    @overload
    def sector_energies(self, y: ArrayLike, sector: None = None) -> _Array: ...
    @overload
    def sector_energies(self, y: _One, sector: str) -> np.float64: ...
    @overload
    def sector_energies(self, y: _Many, sector: str) -> _Array: ...
    @overload
    def sector_energies(self, y: ArrayLike, sector: str) -> _Values: ...
    @overload
    def transfer(self, y: ArrayLike, form: _TreeForm = "exact", into: None = None) -> _Array: ...
    @overload
    def transfer(self, y: _One, form: _TreeForm = "exact", *, into: str) -> np.float64: ...
    @overload
    def transfer(self, y: _Many, form: _TreeForm = "exact", *, into: str) -> _Array: ...
    @overload
    def transfer(self, y: ArrayLike, form: _TreeForm = "exact", *, into: str) -> _Values: ...
    @overload
    def transfer(self, y: ArrayLike, form: _TreeForm, into: str) -> _Values: ...
    def transfer_parts(
        self, y: ArrayLike, form: _TreeForm = "exact", into: str | None = None
    ) -> _Array: ...
    def sector_budget(
        self,
        y: ArrayLike,
        t: ArrayLike | None = None,
        definition: Literal["canonical", "rest", "parseval", "velocity"] = "canonical",
    ) -> SectorBudget: ...
    @property
    def observables(self) -> list[str]: ...
    @overload
    def observable(self, name: str, y: _One) -> np.float64: ...
    @overload
    def observable(self, name: str, y: _Many) -> _Array: ...
    @overload
    def observable(self, name: str, y: ArrayLike) -> _Values: ...
    def observable_rate(self, name: str, y: ArrayLike, t: float = 0.0) -> _Array: ...
    def advise(
        self,
        starts: ArrayLike,
        t: ArrayLike,
        right: Mapping[Literal["angles", "energy", "pixels", "transfer"], float] | None = None,
        *,
        step_limit: float | None = None,
        sample_limit: float | None = None,
    ) -> Advice: ...
    def work_precision(
        self,
        y0: ArrayLike,
        t: tuple[float, float],
        methods: list[_Named] | tuple[_Named, ...] | None = None,
    ) -> WorkPrecision: ...
    def identify(
        self,
        t: ArrayLike | None = None,
        theta: ArrayLike | None = None,
        unknown: _Names | Mapping[str, float] | None = None,
        *,
        frequencies: Sequence[tuple[float, float] | tuple[float, float, int]] = ...,
        until: float | None = None,
        offsets: bool = True,
        nonnegative: _Names = ...,
        window: float = 1.0,
    ) -> Identification: ...
    def stepper(
        self,
        y0: ArrayLike,
        t: float = 0.0,
        *,
        torques: _Torques | ArrayLike | None = None,
        method: Literal["auto"] | _OfRates = "auto",
        rtol: float = 1e-9,
        atol: ArrayLike | None = None,
        step: float | None = None,
        first_step: float | None = None,
        max_step: float | None = None,
        max_steps: int = 1_000_000,
    ) -> Stepper: ...
    def draw(self, theta: ArrayLike | None = None) -> Picture: ...

@final
class BranchedDouble(Pendulum):
    FORMS: ClassVar[list[_Form]]
    def __new__(cls) -> BranchedDouble: ...
    def canonical_variables(self, y: ArrayLike) -> _Array: ...
    @overload
    def antiphase_energy(self, y: _One) -> np.float64: ...
    @overload
    def antiphase_energy(self, y: _Many) -> _Array: ...
    @overload
    def antiphase_energy(self, y: ArrayLike) -> _Values: ...
    @overload
    def transfer(self, y: _One, form: _Form = "exact") -> np.float64: ...
    @overload
    def transfer(self, y: _Many, form: _Form = "exact") -> _Array: ...
    @overload
    def transfer(self, y: ArrayLike, form: _Form = "exact") -> _Values: ...
    def transfer_parts(self, y: ArrayLike, form: _Form = "exact") -> _Array: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...

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
    columns: _Names | None = None,
    dots: Sequence[_Names] | None = None,
    unit: Literal["rad", "deg", "mrad", "arcmin", "arcsec", "gon", "turn"] | str | None = None,
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
    recording: int | None = None,
    sheet: str | None = None,
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
    def trend(self) -> _Array: ...
    @property
    def slow(self) -> float: ...
    @property
    def residual(self) -> float: ...
    @property
    def resolution(self) -> float: ...
    def __len__(self) -> int: ...
    def __call__(self, t: ArrayLike) -> _Array: ...
    def named(
        self, fundamentals: Mapping[str, float], order: int = 5, tolerance: float = 0.01
    ) -> list[str | None]: ...

def lines(
    x: ArrayLike,
    sample_rate: float,
    most: int = 12,
    smallest: float = 1e-9,
    window: int = 1,
    trend: int = 3,
) -> Lines: ...
def spectrum(
    x: ArrayLike,
    sample_rate: float,
    frequencies: ArrayLike | None = None,
    window: int = 1,
    remove_mean: bool = True,
) -> tuple[_Array, _Array]: ...
class _Average(TypedDict):
    mean: float
    error: float
    deviation: float
    correlation_time: float
    samples: int

def average(x: ArrayLike) -> _Average: ...
def transient(x: ArrayLike) -> int: ...
def running_integral(t: ArrayLike, x: ArrayLike) -> _Array: ...

def example_texts() -> list[tuple[str, str]]: ...
