"""Motions of trees as differentiable functions of JAX.

JAX computes in 32 bits unless `jax.config.update("jax_enable_x64", True)` is called first.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ._native import Tree

if TYPE_CHECKING:
    from ._native import _Method

__all__ = ["motion"]


def motion(
    tree: Tree, t: ArrayLike, *, method: _Method = "dop853", rtol: float = 1e-9
) -> Callable[[Any, Mapping[str, Any]], Any]:
    """Return the states of a tree at times as a function that JAX can differentiate.

    Parameters
    ----------
    tree : Tree
        The tree; its values of parameters hold where none are given.
    t : array, shape (m,)
        Times, s.
    method, rtol
        As those of `Tree.gradient`.

    Returns
    -------
    callable
        `states(y0, parameters)` with a start of shape (2 n,) and a dict of parameters by name
        returns an array of shape (m, 2 n). It has derivatives in reverse mode, as `jax.grad` takes
        them, and can be called in functions that `jax.jit` compiles.
    """
    jax: Any = import_module("jax")
    times = np.asarray(t, float)
    shape = (times.size, 2 * len(tree))

    def changed(parameters: Mapping[str, Any]) -> Tree:
        return tree.changed(**{name: float(value) for name, value in parameters.items()})

    def run(y0: Any, parameters: Mapping[str, Any]) -> Any:
        y0 = np.asarray(y0)
        found = changed(parameters).integrate(y0.astype(float), times, method=method, rtol=rtol)
        return found.y.astype(y0.dtype)

    def back(y0: Any, parameters: Mapping[str, Any], weights: Any) -> tuple[Any, dict[str, Any]]:
        y0, names = np.asarray(y0), list(parameters)
        slopes = changed(parameters).gradient(
            lambda y: (0.0, np.asarray(weights, float)),
            y0.astype(float),
            times,
            parameters=names,
            method=method,
            rtol=rtol,
        )
        by_name = {
            name: np.asarray(slopes.parameters[name], np.asarray(parameters[name]).dtype)
            for name in names
        }
        return slopes.y0.astype(y0.dtype), by_name

    @jax.custom_vjp
    def states(y0: Any, parameters: Mapping[str, Any]) -> Any:
        result = jax.ShapeDtypeStruct(shape, y0.dtype)
        return jax.pure_callback(run, result, y0, parameters)

    def forward(y0: Any, parameters: Mapping[str, Any]) -> tuple[Any, Any]:
        return states(y0, parameters), (y0, parameters)

    def reverse(kept: Any, weights: Any) -> Any:
        y0, parameters = kept
        like = jax.tree.map(lambda own: jax.ShapeDtypeStruct(own.shape, own.dtype), kept)
        return jax.pure_callback(back, like, y0, parameters, weights)

    states.defvjp(forward, reverse)

    def as_arrays(y0: Any, parameters: Mapping[str, Any]) -> Any:
        real = jax.numpy.result_type(float)
        named = {name: jax.numpy.asarray(own, real) for name, own in parameters.items()}
        return states(jax.numpy.asarray(y0, real), named)

    return as_arrays
