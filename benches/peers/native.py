"""Compiled functions that loop over states without Python."""

import ctypes
import os
import subprocess


def build(folder, name, flags=(), compiler="cc"):
    """A shared library from the file `name`, compiled for this machine."""
    source = os.path.join(folder, name)
    library = os.path.splitext(source)[0] + ".so"
    general = ["-O3", "-march=native", "-shared", "-fPIC"]
    subprocess.run([compiler, *general, *flags, source, "-o", library, "-lm"], check=True)
    return ctypes.CDLL(library)


def pointer(array):
    return ctypes.c_void_p(array.ctypes.data)
