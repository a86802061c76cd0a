"""Models whose code was derived and written out for one tree."""

from ._native import BranchedDouble

__all__ = ["BranchedDouble"]
