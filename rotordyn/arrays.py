"""Names of types of arrays, and of several words."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Matrix = NDArray[np.inexact[Any]]  # real or complex
Flags = NDArray[np.bool_]
Indices = NDArray[np.intp]
Words = tuple[str, ...]
