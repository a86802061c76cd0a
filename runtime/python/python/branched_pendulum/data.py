"""Measured angles, read from files."""

from ._native import ReadError, Recording, read

__all__ = ["ReadError", "Recording", "read"]
