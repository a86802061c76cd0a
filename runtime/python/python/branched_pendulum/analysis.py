"""From measured or computed series to motions, integrals, spectra and lines."""

from ._native import Lines, SmoothedMotion, lines, running_integral, smooth, spectrum

__all__ = ["Lines", "SmoothedMotion", "lines", "running_integral", "smooth", "spectrum"]
