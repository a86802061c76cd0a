"""Types of the compiled module; the docstrings are those of the module itself."""

from collections.abc import Callable, Sequence
from typing import ClassVar, Literal, final

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray
from typing_extensions import disjoint_base

__all__ = [
    "BranchedDouble",
    "DescriptionError",
    "IntegrationError",
    "Pendulum",
    "Solution",
    "Tree",
    "__version__",
]

__version__: str

_Array = NDArray[np.float64]
_Event = Callable[[float, _Array], float]

class DescriptionError(ValueError): ...
class IntegrationError(RuntimeError): ...

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
        events: Sequence[_Event] | None = None,
        dense_output: bool = False,
    ) -> Solution: ...
    def ensemble(
        self,
        starts: ArrayLike,
        t: ArrayLike,
        method: str = "dop853",
        rtol: float = 1e-9,
        atol: float | None = None,
        threads: int | None = None,
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
    ) -> tuple[_Array, _Array]: ...

@final
class Tree(Pendulum):
    def __new__(cls, text: str, **parameters: float) -> Tree: ...
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
    def momenta(self, theta: ArrayLike, omega: ArrayLike) -> _Array: ...
    def mass_matrix(self, theta: ArrayLike) -> _Array: ...
    def stiffness_matrix(self, theta: ArrayLike) -> _Array: ...
    def modes(self, theta: ArrayLike | None = None) -> tuple[_Array, _Array]: ...
    def points(
        self, theta: ArrayLike, point: Literal["pivot", "centre", "end"] = "end"
    ) -> _Array: ...

@final
class BranchedDouble(Pendulum):
    FORMS: ClassVar[list[str]]
    def __new__(cls) -> BranchedDouble: ...
    def canonical_variables(self, y: ArrayLike) -> _Array: ...
    def antiphase_energy(self, y: ArrayLike) -> _Array: ...
    def transfer(self, y: ArrayLike, form: str = "exact") -> _Array: ...
    def transfer_parts(self, y: ArrayLike, form: str = "exact") -> _Array: ...
