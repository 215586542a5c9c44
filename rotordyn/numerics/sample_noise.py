"""Standard deviation of samples of responses, estimated from what a fit leaves of them.

    σ² = a |H|² + b |H|² (1 − γ²)/γ² + c₀ + c₂/ω² + c₄/ω⁴

H is the fitted response; a: gain that varies from test to test; b: by the coherence γ², where there
is one; c: floors of a sensor of displacement, velocity or acceleration, in receptances. None is
negative. A few weighted least squares of the squares of the remainders, each with the standard
deviation σ² of its own, lead to them.

Sources: Bendat and Piersol (2010), of the noise by coherence.
"""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array, Complex

ROUNDS = 20  # of weights
WINDOW = 21  # samples over which the first weights are averaged
LEAST_COHERENCE = 1e-6  # least γ²
LEAST = 1e-12  # of the largest response: least standard deviation, that of rounding


def sample_noise(
    omega: Array, fitted: Complex, remainder: Complex, coherence: Array | None = None
) -> Array:
    """Return the standard deviation (f, e), root mean square of the modulus, of receptances at
    ``omega`` (f,) > 0.

    fitted, remainder : fitted receptances, and samples less these (f, e)
    coherence : γ² of every sample (f, e)
    """
    floors = (omega[:, None] / omega[-1]) ** np.array([0.0, -2.0, -4.0])
    deviation = np.empty(fitted.shape)
    for k, size in enumerate(np.abs(fitted).T):
        causes = [size[:, None] ** 2, floors]
        if coherence is not None:
            gamma = np.clip(coherence[:, k], LEAST_COHERENCE, 1.0)
            causes.append((size**2 * (1.0 - gamma) / gamma)[:, None])
        variance = _variance(np.concatenate(causes, axis=1), np.abs(remainder[:, k]) ** 2)
        least = max((LEAST * float(size.max())) ** 2, 1e-300)
        deviation[:, k] = np.sqrt(np.maximum(variance, least))
    return deviation


def _variance(causes: Array, square: Array) -> Array:
    """Return the sum (f,) of ``causes`` (f, c), none of them negative, through squares of noise."""
    from scipy.optimize import nnls

    largest = float(square.max())
    if not largest > 0.0:
        return square
    square = square / largest
    causes = causes / np.maximum(causes.max(axis=0), 1e-300)
    half = min(WINDOW, len(square)) // 2
    padded = np.pad(square, half, mode="edge")
    variance = np.convolve(padded, np.full(2 * half + 1, 1.0 / (2 * half + 1)), mode="valid")
    for _ in range(ROUNDS):
        weight = 1.0 / np.maximum(variance, LEAST * variance.max())
        variance = causes @ nnls(causes * weight[:, None], square * weight)[0]
    return np.asarray(largest * variance)
