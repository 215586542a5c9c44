"""A bearing whose balls ride on their oil films: growth of the balls, and films as springs.

A film of thickness h between ball and race shortens the distance of the groove centres by h along
the contact line, as a larger ball would. A state with films hence is the state without them whose
inner groove is shifted by Σ h (cos α, sin α): both have the same ball loads. Films differ little
from ball to ball (h ~ Q^−0.067); their mean over each race, weighted by the loads on it, moves
the ring, which is exact where all balls are loaded equally.

At constant speed a film is a spring of dQ/dh = Q/(0.067 h) in series with its contact.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from bearings.arguments import checked
from bearings.arrays import Array
from bearings.ball.law import STANDARD, Law
from bearings.ball.race import facing_radius
from bearings.film import Film, film
from bearings.geometry import Groove
from bearings.ring.assembly import alike, full_assembly
from bearings.ring.linearised import linearise
from bearings.ring.problem import Problem, turns

if TYPE_CHECKING:
    from bearings.bearing import BallBearing
    from bearings.lubricant import Lubricant
    from bearings.ring.state import BearingState

CLOSE = 1e-13  # m, change of the films at which the iteration ends
MOST = 20  # iterations of state and films; 3 or 4 are usual, since h ~ Q^−0.067


@dataclass(frozen=True, eq=False)
class OnFilm:
    """States of a bearing on its films, of leading shape (…).

    ``state``: with the true contact loads; its displacement and growth are those of grooves
    without films. ``films``; ``growth``, ``axial`` (…) [m]: apparent growth and axial shift of the
    inner groove by films; ``displacement`` (…, 5): of the ring itself; ``stiffness`` (…, 5, 5):
    with films in series with the contacts.
    """

    state: BearingState
    films: Film
    growth: Array
    axial: Array
    displacement: Array
    stiffness: Array


@checked
def on_film(  # noqa: PLR0913 - all of it describes one question
    bearing: BallBearing,
    lubricant: Lubricant,
    temperature: ArrayLike,
    *,
    load: ArrayLike | None = None,
    displacement: ArrayLike | None = None,
    speed: ArrayLike = 0.0,
    static_growth: ArrayLike = 0.0,
    growth: ArrayLike | None = None,
    law: Law = STANDARD,
    starvation: float = 1.0,
    heating: bool = True,
) -> OnFilm:
    """Solve the state under a load or a displacement of the inner ring, balls on their films.

    Arguments of ``BallBearing.equilibrium`` and of ``film``, with their errors; the axial
    displacement is counted as without films.
    """
    static = np.asarray(static_growth, float)
    total = static if growth is None else np.asarray(growth, float)
    common: dict[str, Any] = {
        "speed": speed,
        "static_growth": static,
        "load": load,
        **asdict(law),
    }
    apparent, axial = np.zeros(()), np.zeros(())
    for _ in range(MOST):
        shifted = None if displacement is None else _axially_shifted(displacement, axial)
        state = bearing.equilibrium(**common, displacement=shifted, growth=total + apparent)
        films = film(state, lubricant, temperature, starvation=starvation, heating=heating)
        previous = apparent, axial
        apparent, axial = kept(grown(state, films), previous)
        if max(np.abs(apparent - previous[0]).max(), np.abs(axial - previous[1]).max()) < CLOSE:
            break
    ring_displacement = _axially_shifted(state.displacement, -axial)
    return OnFilm(state, films, apparent, axial, ring_displacement, softened(state, films))


def _axially_shifted(displacement: ArrayLike, axial: Array) -> Array:
    """Add ``axial`` (…) to the axial component of displacements (…, 5)."""
    displacements = np.asarray(displacement, float)
    shape = np.broadcast_shapes(displacements.shape[:-1], axial.shape)
    shifted = np.broadcast_to(displacements, (*shape, 5)).copy()
    shifted[..., 0] += axial
    return shifted


def grown(state: BearingState, films: Film) -> tuple[Array, Array]:
    """Apparent radial growth and axial shift of the inner groove by films (…) [m], means over the
    balls weighted by their loads on either race; NaN where there is no state."""
    mean, races = np.zeros(2), state.operation.geometry.races
    for separation, race in zip(race_separation(state, films), races, strict=True):
        load = np.nan_to_num(state.contact_load)[..., race].sum(axis=-1)
        total = load.sum(axis=-1)
        share = load / np.where(total > 0.0, total, 1.0)[..., None]
        mean = mean + (share[..., None] * separation).sum(axis=-2)
    exists = np.asarray(state.outcome) == ""
    return np.where(exists, mean[..., 0], np.nan), np.where(exists, mean[..., 1], np.nan)


def kept(current: tuple[Array, Array], previous: tuple[Array, Array]) -> tuple[Array, Array]:
    """Return the current growth and shift, the previous ones where they are NaN: with its films the
    bearing has no state there, though it may have one without them."""
    growth, axial = (np.where(np.isnan(a), b, a) for a, b in zip(current, previous, strict=True))
    return growth, axial


def race_separation(state: BearingState, films: Film) -> tuple[Array, Array]:
    """Radial and axial distance by which films separate the inner race, and the outer one, from
    every ball (…, balls, 2) [m].

    It is along the normal of a single contact; of two contacts it is the one vector whose
    components along both normals are their films.
    """
    loaded = np.asarray(state.contact_load) > 0.0
    geometry = state.operation.geometry
    angle = np.where(loaded, state.contact_angle, 0.0) * geometry.sides
    normal = np.stack([np.cos(angle), np.sin(angle)], axis=-1) * loaded[..., None]
    thick = np.where(loaded, np.nan_to_num(films.central), 0.0)[..., None]
    inner, outer = (
        (np.linalg.pinv(normal[..., race, :]) @ thick[..., race, :])[..., 0]
        for race in geometry.races
    )
    return inner, outer


@checked
def softened(state: BearingState, films: Film) -> Array:
    """Tangent (…, 5, 5) of a state whose contacts have their films in series, at constant speed.

    Each contact is replaced by one of equal load whose slope is that of contact and film in series.
    This covers bearings of one groove a ring; others keep their tangent.
    """
    operation = state.operation
    g, speed = operation.geometry, state.speed.reshape(-1)
    turning = turns(g, speed) & (state.outcome.reshape(-1) == "")
    rows = np.flatnonzero(turning)
    if not (rows.size and g.single):
        return np.asarray(state.complete_stiffness)
    part = Problem.of(operation, full_assembly).take(rows)
    x = state.ball_centre.reshape(len(state.ball_centre), len(speed), -1)[:, rows]
    a = part.centres(state.displacement.reshape(-1, 5)[rows], x)
    springs = films.stiffness.reshape(len(speed), g.balls, -1)[rows]
    grooves = [
        _softer(groove, vector, springs[..., race].min(axis=-1))  # infinite without load
        for groove, vector, race in zip(
            (*g.inner_grooves, *g.outer_grooves), (a[:2] - x[:2], x[:2]), g.races, strict=True
        )
    ]
    soft = g._replace(inner_grooves=(grooves[0],), outer_grooves=(grooves[1],))
    stiffness = state.complete_stiffness.reshape(-1, 5, 5).copy()
    d = state.displacement.reshape(-1, 5)[rows]
    stiffness[rows] = linearise(replace(part, geometry=soft), d, x, np.ones(len(d))).stiffness
    return alike(state.load, state.displacement, stiffness.reshape(state.complete_stiffness.shape))


def _softer(groove: Groove, vector: Array, spring: Array) -> Groove:
    """Replace a contact by one of the same load at the same place, with the slope of contact and
    ``spring`` (states, balls) in series."""
    length = np.hypot(vector[0], facing_radius(groove, vector[1]))
    approach = np.maximum(length - groove.centre_distance, 0.0)
    load = groove.stiffness * approach**1.5
    loaded = load > 0.0
    contact = np.where(loaded, 1.5 * load / np.where(loaded, approach, 1.0), 1.0)
    deeper = np.where(loaded, approach * (1.0 + contact / spring), 0.0)
    stiffness: Any = np.where(loaded, load / np.where(loaded, deeper, 1.0) ** 1.5, groove.stiffness)
    reach: Any = np.where(loaded, length - deeper, groove.centre_distance)
    return groove._replace(stiffness=stiffness, centre_distance=reach)
