"""From series to motions, integrals, spectra, lines and means with errors; maps of growth."""

from ._maps import release_map
from ._native import (
    Lines,
    SmoothedMotion,
    average,
    lines,
    running_integral,
    smooth,
    spectrum,
    transient,
)

__all__ = [
    "Lines",
    "SmoothedMotion",
    "average",
    "lines",
    "release_map",
    "running_integral",
    "smooth",
    "spectrum",
    "transient",
]
