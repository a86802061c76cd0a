"""From measured or computed series to motions, integrals, spectra and lines; maps of growth."""

from ._maps import release_map
from ._native import Lines, SmoothedMotion, lines, running_integral, smooth, spectrum

__all__ = [
    "Lines",
    "SmoothedMotion",
    "lines",
    "release_map",
    "running_integral",
    "smooth",
    "spectrum",
]
