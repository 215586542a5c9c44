"""Whether measured receptances are those of a passive structure, which shows what was exchanged.

With e^{+iωt} a force takes power from no structure that is passive: the imaginary part of a
receptance at its driving point is nowhere positive, nor is the matrix of imaginary parts of two
points. At rest, receptances are reciprocal.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

NOISE = 0.01  # of the energy of a response, as positive imaginary part: noise of 10 %
POSITIVE = 0.2  # of the energy of the imaginary part
EXCESS = 0.05  # of the energy between two points
APART = 0.1  # of the energy: what two responses that are one by reciprocity may differ by
CAUSES: tuple[tuple[Callable[[complex], complex], str], ...] = (
    (
        lambda value: value.conjugate(),
        "its imaginary part is positive: sign convention e^{−iωt}, a sensor against the force, or "
        "an inertance called receptance: change the sign of the imaginary column, or of both, or "
        "name the quantity",
    ),
    (
        lambda value: complex(value.imag, value.real),
        "its real and imaginary columns look exchanged: exchange them",
    ),
    (
        lambda value: -1j * value,
        "it has the phase of a mobility, or exchanged columns with sign convention e^{−iωt}: name "
        "the quantity, or exchange the columns and change the sign of the imaginary one",
    ),
    (
        lambda value: 1j * value,
        "it has the phase of a mobility with sign convention e^{−iωt}, or of an inertance called "
        "mobility: change the sign of the imaginary column, or name the quantity",
    ),
)
NO_DRIVING_POINT = (
    "its imaginary part is positive at times, as that of no driving point: look whether the files "
    "of other points or directions were exchanged"
)


def fault_at_driving_point(values: Sequence[complex]) -> str | None:
    """What a receptance (f,) at a driving point seems to be instead, or None where it is one.

    Sizes are best those of the mobility, by which stiff and inert ranges weigh the same; phases
    must be those of a receptance.
    """
    if _is_passive(values):
        return None
    for turned, sentence in CAUSES:
        if _is_passive([turned(value) for value in values]):
            return sentence
    return NO_DRIVING_POINT


def _is_passive(values: Sequence[complex]) -> bool:
    positive = sum(max(value.imag, 0.0) ** 2 for value in values)
    imaginary = sum(value.imag**2 for value in values)
    return positive <= max(POSITIVE * imaginary, NOISE * energy(values))


def energy(values: Sequence[complex]) -> float:
    """Sum of squares of a response (f,)."""
    return sum(abs(value) ** 2 for value in values)


def excess(one: Sequence[complex], across: Sequence[complex], other: Sequence[complex]) -> float:
    """Share of the energy between two driving points (f,) that no passive structure has: there
    |Im h₁₂|² is at most Im h₁₁ Im h₂₂."""
    beyond = sum(
        max(b.imag**2 - a.imag * c.imag, 0.0) for a, b, c in zip(one, across, other, strict=True)
    )
    return beyond / energy(across)


def apart(one: Sequence[complex], other: Sequence[complex]) -> float:
    """Share of the energy by which two responses (f,) differ."""
    return energy([a - b for a, b in zip(one, other, strict=True)]) / energy(one)
