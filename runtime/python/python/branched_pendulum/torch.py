"""Motions of trees as differentiable functions of PyTorch."""

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
    """Return the states of a tree at times as a function that PyTorch can differentiate.

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
        returns a tensor of shape (m, 2 n) with the type of `y0`.
    """
    torch: Any = import_module("torch")
    times = np.asarray(t, float)

    def forward(ctx: Any, names: list[str], y0: Any, *values: Any) -> Any:
        ctx.tree = tree.changed(**dict(zip(names, map(float, values), strict=True)))
        ctx.names = names
        ctx.save_for_backward(y0, *values)
        start = y0.detach().double().numpy()
        found = ctx.tree.integrate(start, times, method=method, rtol=rtol)
        return torch.from_numpy(found.y).to(y0)

    def backward(ctx: Any, *weights: Any) -> Any:
        y0, *values = ctx.saved_tensors
        slopes = ctx.tree.gradient(
            lambda y: (0.0, weights[0].double().numpy()),
            y0.detach().double().numpy(),
            times,
            parameters=ctx.names,
            method=method,
            rtol=rtol,
        )
        by = [
            value.new_tensor(slopes.parameters[name])
            for name, value in zip(ctx.names, values, strict=True)
        ]
        return (None, torch.from_numpy(slopes.y0).to(y0), *by)

    functions = {"forward": staticmethod(forward), "backward": staticmethod(backward)}
    differentiable: Any = type("Motion", (torch.autograd.Function,), functions)

    def states(y0: Any, parameters: Mapping[str, Any]) -> Any:
        values = [torch.as_tensor(value) for value in parameters.values()]
        return differentiable.apply(list(parameters), y0, *values)

    return states
