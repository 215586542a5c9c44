"""Internal geometries that fit into rings of a given size, with their prior probabilities.

The shares below are those of 252 spindle bearings of one maker (GMN, catalogue 4000 0813 EN) and 59
of another (SNFA, general catalogue), whose balls are printed.
"""

from __future__ import annotations

import math

import numpy as np

from bearings.arrays import Array
from bearings.bearing import ring_limits
from bearings.catalogue.printed import Catalogue
from bearings.errors import InvalidBearing
from bearings.life.rating import Insides

BALL_SHARE = (0.265, 0.035)  # D/(outside diameter − bore): mean and standard deviation
FILL = (0.77, 0.08)  # Z D/(π dm) likewise
INNER = (0.545, 0.02)  # fi likewise; grooves are never printed, but C0 and rigidity show them
OUTER = (0.53, 0.012)  # fo likewise
_BALL_RANGE = (0.19, 0.345)
_FILL_RANGE = (0.55, 0.95)
TIGHTEST = 0.504  # conformity
_CONFORMITIES = np.arange(0.508, 0.602, 0.004)
_STEP = 0.0254 / 64.0  # balls come in 64ths of an inch, larger ones in 32nds and 16ths


def plausible(catalogue: Catalogue) -> tuple[Insides, Array]:
    """Return all combinations as a grid, and the logarithm of the prior probability of each up to
    a constant.

    The grid has axes of balls (diameter and number), inner and outer conformity; each value has
    the length 1 along axes on which it does not depend, so that a race is computed once for all
    conformities of the other one.
    """
    pitch = catalogue.pitch_diameter or 0.5 * (catalogue.bore + catalogue.outside_diameter)
    section = catalogue.outside_diameter - catalogue.bore
    candidates = (
        _diameters(section) if catalogue.ball_diameter is None else [catalogue.ball_diameter]
    )
    diameters = [value for value in candidates if _within(catalogue, pitch, value)]
    if not diameters:
        largest, least = (
            1e3 * value for value in ring_limits(pitch, candidates[0], catalogue.contact_angle)
        )
        raise InvalidBearing(
            f"no ring left beside balls of {candidates[0] * 1e3:.4g} mm on a pitch circle of "
            f"{pitch * 1e3:.4g} mm: given bore {catalogue.bore * 1e3:g} mm, outside_diameter "
            f"{catalogue.outside_diameter * 1e3:g} mm; allowed: a bore below {largest:.4g} mm, an "
            f"outside diameter above {least:.4g} mm"
        )
    pairs = [
        (diameter, count)
        for diameter in diameters
        for count in (_counts(diameter, pitch) if catalogue.balls is None else [catalogue.balls])
        if diameter < 0.98 * pitch * math.sin(math.pi / count)
    ] or [(float(diameters[0]), catalogue.balls or 3)]  # they overlap: the bearing refuses them
    inner, outer = (
        _CONFORMITIES if f is None else np.array([f])
        for f in (catalogue.inner_conformity, catalogue.outer_conformity)
    )
    ball, count = np.array(pairs, dtype=float).T[:, :, None, None]
    fi, fo = inner[None, :, None], outer[None, None, :]
    x = Insides(ball, count, np.full_like(ball, pitch), fi, fo, float(catalogue.contact_angle))
    return x, usual(x, section)


def usual(x: Insides, section: float) -> Array:
    """Logarithm of the prior probability, up to a constant, of internal geometries in rings of a
    ``section`` (outside diameter − bore) [m]."""
    measures = (
        (x.ball_diameter / section, BALL_SHARE),
        (x.balls * x.ball_diameter / (math.pi * x.pitch_diameter), FILL),
        (x.inner_conformity, INNER),
        (x.outer_conformity, OUTER),
    )
    total: Array = np.zeros(())
    for value, (mean, deviation) in measures:
        total = total - 0.5 * ((value - mean) / deviation) ** 2
    return total


def _diameters(section: float) -> list[float]:
    """Usual ball diameters for a section [m]."""
    low, high = (share * section for share in _BALL_RANGE)
    step = _STEP * (1 if high < 0.007 else 2 if high < 0.0254 else 4)
    steps = range(math.ceil(low / step), math.floor(high / step) + 1)
    return [step * k for k in steps] or [BALL_SHARE[0] * section]


def _within(catalogue: Catalogue, pitch: float, diameter: float) -> bool:
    """Whether balls of a diameter leave both rings a wall of the least thickness."""
    largest, least = ring_limits(pitch, diameter, catalogue.contact_angle)
    return catalogue.bore < largest and catalogue.outside_diameter > least


def _counts(diameter: float, pitch: float) -> range:
    """Numbers of balls that leave room for a cage."""
    low, high = (share * math.pi * pitch / diameter for share in _FILL_RANGE)
    return range(max(math.ceil(low), 3), max(math.floor(high), 3) + 1)
