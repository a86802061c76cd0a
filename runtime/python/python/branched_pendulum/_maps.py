"""Maps of the growth of small differences over planes of releases."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._native import Tree
from ._results import ReleaseMap


def _links(tree: Tree, name: str) -> list[int]:
    """Return the links of a name: one, or all copies."""

    def is_copy(own: str) -> bool:
        numbers = own.removeprefix(name + "_")
        return own == name or (numbers != own and numbers.replace("_", "").isdigit())

    found = [link for link, own in enumerate(tree.names) if is_copy(own)]
    if not found:
        names = ", ".join([*tree.names[:8], *tree.parameters])
        raise KeyError(f"`{name}` is neither a link nor a parameter: there are {names}")
    return found


def release_map(
    tree: Tree,
    pair: tuple[str, str] | list[str],
    axes: Mapping[str, ArrayLike],
    *,
    horizon: float = 15.0,
    rtol: float = 1e-8,
    release: Mapping[str, float] | None = None,
    threads: int | None = None,
) -> ReleaseMap:
    """Return the growth of a small difference between two copies over a plane of releases.

    Parameters
    ----------
    tree : Tree
        The pendulum, released at rest.
    pair : two names
        The links between which the difference is.
    axes : dict of two arrays
        Names of the horizontal and of the vertical axis with their values: angles (rad) of a link
        or of all copies of that name, or values of a parameter.
    horizon : float
        Time up to which differences grow, s.
    rtol : float
        The coarser of the two tolerances.
    release : dict of float
        Angles (rad) of other links, by name; 0 without it.
    threads : int
        Number of threads, by default as many as there are cores.

    Returns
    -------
    ReleaseMap
        `map.plot()` draws it.

    Examples
    --------
    >>> tree = bp.Tree(bp.examples.PAPER, friction=0)
    >>> angles = {"child": np.radians([0.0, 20.0]), "parent": np.radians([39.5, 47.8])}
    >>> found = bp.analysis.release_map(tree, ("child_1", "child_2"), angles, horizon=10.0)
    >>> found.rates.shape, bool(found.factors[1, 0] > 1e3 > found.factors[0, 0])
    ((2, 2), True)
    """
    if len(axes) != 2:
        raise ValueError(f"axes must have two names with their values, got {len(axes)}")
    names = tuple(axes)
    values: list[NDArray[np.float64]] = [np.asarray(axes[name], float) for name in names]
    for name, own in zip(names, values):
        if own.ndim != 1:
            raise ValueError(f"axes[{name!r}] must have one axis, got shape {own.shape}")
    x, y = values
    start = np.zeros(2 * len(tree))
    for name, angle in (release or {}).items():
        start[_links(tree, name)] = angle
    places = [None if name in tree.parameters else _links(tree, name) for name in names]
    grid = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    starts = np.tile(start, (len(grid), 1))
    for column, links in enumerate(places):
        if links is not None:
            starts[:, links] = grid[:, column : column + 1]
    parameters = [column for column, links in enumerate(places) if links is None]
    results = np.full((4, len(grid)), np.nan)
    # One tree for each set of parameters.
    sets, which = np.unique(grid[:, parameters], axis=0, return_inverse=True)
    for index, row in enumerate(sets):
        own_tree = tree.changed(**{names[column]: float(v) for column, v in zip(parameters, row)})
        chosen = which.reshape(-1) == index
        grown = own_tree.growth(starts[chosen], pair, [horizon], rtol=rtol, threads=threads)
        results[:, chosen] = [
            grown.rates,
            grown.rate_changes,
            grown.factors[:, 0],
            grown.factor_changes[:, 0],
        ]
    shape = (len(y), len(x))
    rates, rate_changes, factors, factor_changes = (own.reshape(shape) for own in results)
    return ReleaseMap(
        x, y, (names[0], names[1]), rates, rate_changes, factors, factor_changes
    )
