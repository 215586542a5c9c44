"""Steps of a sweep from lists of vectors and values, step by step."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rotordyn.numerics.follow import Steps


def steps_of(vectors: Sequence[np.ndarray], values: Sequence[np.ndarray]) -> Steps:
    """Vectors (n, k) and values (k,) of every step, k of its own: frequencies without damping, or
    poles."""
    most = max(map(len, values))
    whole = np.zeros((len(vectors), len(vectors[0]), most), dtype=complex)
    every = np.full((len(vectors), most), complex(np.nan, np.nan))
    for k, (vector, value) in enumerate(zip(vectors, values, strict=True)):
        whole[k, :, : len(value)] = vector
        every[k, : len(value)] = value if np.iscomplexobj(value) else 1j * value
    return Steps(whole, every)
