"""Pictures of trees."""

from __future__ import annotations

from dataclasses import dataclass, field
from html import escape
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    from ._native import Tree

#: Colours of generations, after Okabe and Ito.
_COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"]
#: Size of a picture and of its margin, pixels.
_SIZE, _MARGIN = 420.0, 40.0
#: Angle (rad) over which the children of one link are spread out.
_SPREAD = 1.0
#: Links up to which names are written.
_MOST_NAMES = 10


@dataclass(frozen=True)
class Picture:
    """A drawing, as SVG: notebooks show it.

    Attributes
    ----------
    svg : str
        The text of the picture.
    links : int
        Number of links on it.
    """

    svg: str = field(repr=False)
    links: int

    def _repr_svg_(self) -> str:
        return self.svg

    def __repr__(self) -> str:
        return f"Picture of {self.links} links"

    def save(self, path: str | PathLike[str]) -> None:
        """Write the picture to a file.

        Parameters
        ----------
        path : str or path
            Name of the file, `tree.svg`.
        """
        Path(path).write_text(self.svg, encoding="utf-8")


def _spread(parents: list[int | None]) -> tuple[NDArray[np.float64], list[int]]:
    """Return angles at which children stand apart, and the generation of each link."""
    theta = np.zeros(len(parents))
    depth = [0] * len(parents)
    children: dict[int | None, list[int]] = {}
    for link, parent in enumerate(parents):
        children.setdefault(parent, []).append(link)
        if parent is not None:
            depth[link] = depth[parent] + 1
    for parent, own in children.items():
        if parent is None:
            continue
        width = _SPREAD / (1 + depth[parent])
        places = np.linspace(-width, width, len(own)) if len(own) > 1 else np.zeros(1)
        for link, place in zip(own, places):
            theta[link] = theta[parent] + place
    return theta, depth


def draw(tree: Tree, theta: ArrayLike | None = None) -> Picture:
    """Return the picture of a tree at angles, or with its children spread out."""
    spread, depth = _spread(tree.parents)
    angles = spread if theta is None else np.asarray(theta, float)
    # What has the wrong shape is refused here.
    ends = tree.points(angles)
    pivots, centres = tree.points(angles, "pivot"), tree.points(angles, "centre")
    # Where nothing hangs from a link its end may be its pivot.
    tips = np.where(np.ptp([pivots, ends], axis=0).any(axis=1)[:, None], ends, centres)
    points = np.concatenate([pivots, tips, centres, np.zeros((1, 2))])
    low, high = points.min(axis=0), points.max(axis=0)
    size = max(float((high - low).max()), 1e-9)
    scale = (_SIZE - 2 * _MARGIN) / size
    middle = (low + high) / 2

    def place(point: NDArray[np.float64]) -> tuple[float, float]:
        x, y = (point - middle) * scale
        return round(_SIZE / 2 + float(x), 2), round(_SIZE / 2 - float(y), 2)

    thick = max(1.5, 9.0 / (1 + max(depth)))
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_SIZE:g} {_SIZE:g}" '
        f'width="{_SIZE:g}" height="{_SIZE:g}" role="img" '
        f'aria-label="{escape(repr(tree))}" font-family="sans-serif" font-size="12">',
        '<rect width="100%" height="100%" fill="white"/>',
    ]
    x, y = place(np.zeros(2))
    lines.append(f'<path d="M{x - 24} {y}h48" stroke="#555" stroke-width="3"/>')
    for link in reversed(range(len(depth))):
        (x1, y1), (x2, y2) = place(pivots[link]), place(tips[link])
        colour = _COLOURS[depth[link] % len(_COLOURS)]
        width = max(thick * (1 - 0.12 * depth[link]), 1.0)
        lines.append(
            f'<path d="M{x1} {y1}L{x2} {y2}" stroke="{colour}" stroke-width="{width:.2f}" '
            'stroke-linecap="round" fill="none"/>'
        )
        x, y = place(centres[link])
        lines.append(f'<circle cx="{x}" cy="{y}" r="{0.7 * width:.2f}" fill="{colour}"/>')
    for x, y in sorted({place(pivot) for pivot in pivots}):
        lines.append(f'<circle cx="{x}" cy="{y}" r="2.2" fill="white" stroke="#333"/>')
    if len(depth) <= _MOST_NAMES:
        for name, one, other in zip(tree.names, pivots, tips):
            x, y = place((one + other) / 2)
            lines.append(
                f'<text x="{x + 9}" y="{y + 4}" fill="#222" stroke="white" stroke-width="3" '
                f'paint-order="stroke">{escape(name)}</text>'
            )
    lines.append("</svg>")
    return Picture("\n".join(lines), len(depth))
