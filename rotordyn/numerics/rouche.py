"""A count of eigenvalues that carries over from a reduced problem to the whole one.

Let a problem T(s), analytic in s, have the blocks Z (reduced), E, F and Y, with poles λ_k of Z⁻¹:

    Z⁻¹ = Σ v_k w_k / (s − λ_k)

Where Y has no eigenvalue in a region of the disc |s| ≤ R and ‖Y⁻¹ F Z⁻¹ E‖ < 1 on its edge, T has
as many eigenvalues in it as Z, since det(Y − t F Z⁻¹ E) meets no zero there for any t from 0 to 1
(Rouché; for matrices Gohberg & Sigal, Math. USSR-Sb. 13 (1971) 603). With ‖Y⁻¹‖ ≤ 1/(1 − q) that is
so if

    Σ ‖F v_k‖ ‖w_k E‖ / d_k < 1 − q,

d_k being the distance of λ_k to the edge: ||λ_k| − R| for the whole disc.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
FEWEST = 1e-12  # of R: a pole nearer than that lies on the edge


def same_count(apart: Array, right: Array, left: Array, radius: Array, own: Array) -> Array:
    """Σ ‖F v‖ ‖w E‖ / d / (1 − q) (…): below 1 the counts are the same; infinite, q ≥ 1.

    ``apart`` d, ``right`` ‖F v‖ and ``left`` ‖w E‖ (…, k); ``radius`` R and ``own`` q (…).
    """
    apart = np.maximum(apart, FEWEST * radius[..., None])
    with np.errstate(invalid="ignore", over="ignore"):
        reach = (right * left / apart).sum(axis=-1) / np.maximum(1.0 - own, 1e-300)
    return np.where((own < 1.0) & np.isfinite(reach), reach, np.inf)


def to_circle(pole: Complex, radius: Array) -> Array:
    """Distance of poles (…, k) to the circle of ``radius`` (…)."""
    return np.asarray(np.abs(np.abs(pole) - radius[..., None]))


def to_segment(pole: Complex, radius: Array, low: Array, high: Array) -> Array:
    """Distance of poles (…, k) to the edge of the disc of ``radius`` (…) between Im s = ``low`` and
    ``high`` (…), or less: to the circle and to both chords."""
    beyond = np.maximum(np.abs(pole.real) - radius[..., None], 0.0)
    chords = [np.hypot(pole.imag - end[..., None], beyond) for end in (low, high)]
    return np.minimum(to_circle(pole, radius), np.minimum(*chords))


def wide_gap(size: Array, low: Array, high: float) -> Array:
    """Middle of the widest gap that ``size`` (…, k) leaves between ``low`` (…) and
    ``high``·``low``."""
    ends = np.stack([low, high * low], axis=-1)
    edges = np.sort(np.concatenate([np.clip(size, ends[..., :1], ends[..., 1:]), ends], axis=-1))
    widest = np.diff(edges).argmax(axis=-1)[..., None]
    return np.asarray(np.take_along_axis(edges[..., :-1] + edges[..., 1:], widest, -1)[..., 0] / 2)
