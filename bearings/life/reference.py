"""Reference life from the ball loads of a state (ISO/TS 16281, now ISO 16281) [M].

At speed, beyond the standard, the balls press the inner race with Qi and the outer race with Qo,
by the centrifugal force and the angles of each ball; the ratings of the races stay nominal. A ring
with two arcs has two raceways, each with its own ball loads: like the rings of the standard, they
fail independently.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bearings.arguments import checked, finite
from bearings.arrays import Array, Words
from bearings.errors import InvalidBearing, shown
from bearings.life.rating import (
    EXPONENT,
    REFERENCE_FACTOR,
    STATIC_PRESSURE,
    WEIBULL_SLOPE,
    Insides,
    dynamic_rating,
    is_thrust,
    nominal_angle,
)

if TYPE_CHECKING:
    from bearings.bearing import BallBearing
    from bearings.grooves import Grooves
    from bearings.ring.state import BearingState

ROTATING = ("inner", "outer", "both")
_INNER, _OUTER = 0.407, 0.389  # of Qci and Qce of radial bearings, ISO/TS 16281


@dataclass(frozen=True, eq=False)
class ReferenceLife:
    """Life of a state, leading shape (…); 90 % of identical bearings reach it.

    ``revolutions`` (…): L10r of the ring that turns against the load, infinite without load;
    ``equivalent_load`` (…): Pref = C/L10r^(1/3) [N], the steady load of the same life;
    ``race_load`` (…, raceways): equivalent ball load Qe [N] of every raceway, one a groove: i, o,
    or ir, il, or, ol; ``race_rating`` (raceways,): the ball load Qc [N] of one million revolutions;
    ``race_life`` (…, raceways) [revolutions]; ``limiting`` (…): name of the raceway that fails
    first, ``""`` without load. ``dynamic_rating``: C [N].
    """

    revolutions: Array
    equivalent_load: Array
    race_load: Array
    race_rating: Array
    race_life: Array
    limiting: Words
    dynamic_rating: float


@checked
def ball_ratings(
    bearing: BallBearing | Grooves, rating: float | None = None
) -> tuple[float, float]:
    """Qci and Qce, ball loads of one million revolutions of inner and outer race [N].

    ``rating``: C of a catalogue, of one row [N]; None: from the grooves. Raises InvalidBearing for
    a rating that is not positive.
    """
    from bearings.grooves import Grooves

    grooves = bearing if isinstance(bearing, Grooves) else bearing.grooves
    c = _rating(grooves, rating)
    ratio, alpha = Insides.of(grooves).strength_ratio, nominal_angle(grooves)
    if is_thrust(grooves):
        inner = outer = c / (grooves.balls * np.sin(alpha))
    else:
        per_ball = c / (grooves.balls * np.cos(alpha) ** 0.7)
        inner, outer = per_ball / _INNER, per_ball / _OUTER
        ratio *= REFERENCE_FACTOR
    return (
        float(inner * (1.0 + ratio**EXPONENT) ** 0.3),
        float(outer * (1.0 + ratio**-EXPONENT) ** 0.3),
    )


@checked
def life_of(
    state: BearingState, dynamic_rating: float | None = None, *, rotating: str = "inner"
) -> ReferenceLife:
    """Compute the reference life of a state, with the loads and lives of its raceways.

    Parameters
    ----------
    state : of leading shape (…)
    dynamic_rating : C of one bearing after a catalogue [N]; None: from the grooves
    rotating : "inner", "outer" or "both": the ring that turns against the load. Under an unbalance
        the inner ring is at rest relative to it and the outer one turns

    Raises
    ------
    InvalidBearing : a rating that is not positive, an unknown word
    """
    if rotating not in ROTATING:
        raise InvalidBearing(
            f"rotating must be one of {', '.join(ROTATING)}, got {shown(rotating)}"
        )
    grooves = state.operation.grooves
    rating = _rating(grooves, dynamic_rating)
    g = state.operation.geometry
    first = np.unique(g.groove_of, return_index=True)[1]  # contact of each raceway
    turns = g.by_contact(rotating != "outer", rotating != "inner")[first]
    load = np.add.reduceat(np.asarray(state.contact_load), first, axis=-1)
    # a point of a ring that turns against the load carries all ball loads, averaged by L ~ Q⁻³;
    # one of the other ring carries one of them, and probabilities of survival multiply
    equivalent = np.where(turns, _mean(load, 3.0), _mean(load, EXPONENT))
    capacity = g.by_contact(*ball_ratings(grooves, rating))[first]
    damage = (equivalent / capacity) ** EXPONENT
    with np.errstate(divide="ignore"):
        millions = damage.sum(axis=-1) ** (-1.0 / WEIBULL_SLOPE)
        race = 1e6 * damage ** (-1.0 / WEIBULL_SLOPE)
    worst = np.array(grooves.raceways)[np.argmax(np.nan_to_num(damage), axis=-1)]
    loaded = np.nan_to_num(damage).sum(axis=-1) > 0.0
    return ReferenceLife(
        revolutions=np.asarray(1e6 * millions),
        equivalent_load=np.asarray(rating * millions ** (-1.0 / 3.0)),
        race_load=equivalent,
        race_rating=capacity,
        race_life=race,
        limiting=np.where(loaded, worst, ""),
        dynamic_rating=rating,
    )


@checked
def reference_life(
    state: BearingState, dynamic_rating: float | None = None, *, rotating: str = "inner"
) -> Array:
    """L10r in revolutions, ISO/TS 16281 from the ball loads of a state, shape (…); arguments and
    errors of ``life_of``."""
    return life_of(state, dynamic_rating, rotating=rotating).revolutions


@checked
def static_safety(state: BearingState, pressure: float = STATIC_PRESSURE) -> Array:
    """S0 = (``pressure`` [Pa] over the largest contact pressure)³ of a state (…); infinite without
    load."""
    peak = np.asarray(state.contact_pressure).max(axis=(-2, -1))
    with np.errstate(divide="ignore"):
        return np.asarray((pressure / peak) ** 3)


def _mean(load: Array, power: float) -> Array:
    """Power mean over all balls of a bearing, unloaded ones included (…, raceways)."""
    return np.asarray(((load**power).mean(axis=-2)) ** (1.0 / power))


def _rating(grooves: Grooves, given: float | None) -> float:
    """C [N]: the given one, else that of the grooves; InvalidBearing unless it is positive."""
    if given is None:
        return dynamic_rating(grooves)
    if not (finite(given) and given > 0.0):
        raise InvalidBearing(f"dynamic_rating must be positive, got {shown(given)}")
    return float(given)
