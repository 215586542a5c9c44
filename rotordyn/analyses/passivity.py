"""Test of measured receptances for passivity, which reveals exchanged columns, signs or files.

With e^{+iωt} a force takes no power from a passive structure: the imaginary part of a
receptance at its driving point is nowhere positive, nor is the matrix of imaginary parts of two
points. At rest, receptances are reciprocal.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

NOISE = 0.01  # of the energy of a response, as positive imaginary part: noise of 10 %
POSITIVE = 0.2  # of the energy of the imaginary part
EXCESS = 0.05  # of the energy between two points
APART = 0.1  # of the energy: tolerance between two responses that are reciprocal
CAUSES: tuple[tuple[Callable[[complex], complex], str], ...] = (
    (
        lambda value: value.conjugate(),
        "its imaginary part is positive: sign convention e^{−iωt}, a sensor opposite to the force, "
        "or an inertance declared as receptance: change the sign of the imaginary column, or of "
        "both, or name the quantity",
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
        "it has the phase of a mobility with sign convention e^{−iωt}, or of an inertance declared "
        "as mobility: change the sign of the imaginary column, or name the quantity",
    ),
)
NO_DRIVING_POINT = (
    "a force would extract power from the structure there: check whether the files of other "
    "points or directions are exchanged"
)
FACTORS = {"receptance": 1.0, "mobility": -1j, "inertance": -1.0}  # to the phase of a receptance
POWERS = {"receptance": 1, "mobility": 0, "inertance": -1}  # of ω, to the size of a mobility


def fault_at_driving_point(
    values: Sequence[complex], omega: Sequence[float], quantity: str
) -> str | None:
    """Sentence on what a response (f,) at a driving point, declared as ``quantity``, seems to be
    instead, or None where it is consistent; ``omega`` (f,) [rad/s].

    Responses are scaled to mobilities, in which ranges ruled by stiffness and by mass weigh the
    same.
    """
    factor, power = FACTORS[quantity], POWERS[quantity]
    samples = zip(values, omega, strict=True)
    scaled = [factor * value * w**power for value, w in samples if w > 0.0]
    if _is_passive(scaled):
        return None
    for corrected, sentence in CAUSES:
        if _is_passive([corrected(value) for value in scaled]):
            return sentence if quantity == "receptance" else misnamed(quantity)
    return NO_DRIVING_POINT


def misnamed(quantity: str) -> str:
    """Sentence on a response declared as another quantity: several mistakes have one symptom."""
    return (
        f"as {quantity} it extracts power from the structure: check whether it is another "
        "quantity, a sensor is opposite to the force, the sign convention is e^{−iωt}, or real and "
        "imaginary columns are exchanged"
    )


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
