"""Map of race control over load and speed: where control by a race begins and ends.

Jones' criterion, drawn as a map by Noël (doctoral thesis, IRCCyN, Nantes, 2013, Fig. 2.8).
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearings.ball.law import STANDARD, Law
from bearings.bearing import BallBearing
from bearings.errors import InvalidBearing
from bearings.geometry import geometry
from bearings.ring.state import BearingState
from rotordyn.arrays import Array, Flags, Indices

Index = Indices
RACES = ("inner", "outer")
LIGHTEST = 1e-3  # N
LEVELS = 48  # loads between which a change of control is sought
LOG_TOLERANCE = 1e-10  # of a boundary, relative
UPWARD = np.array([[[1.0]], [[-1.0]]])  # how the margin of each race crosses zero at its boundary
ABSENT = (  # sentences by race: margin positive, negative, crossing zero in the other direction
    (
        "inner race controls at every load that has a solution",
        "inner race controls at no load that has a solution",
        "inner race loses control as the load rises",
    ),
    (
        "outer race controls at every load that has a solution",
        "outer race controls at no load that has a solution",
        "outer race gains control as the load rises",
    ),
)
UNRESOLVED = "no solution next to the boundary"
THIRD = "third contact"  # of a ball, which slides: no race controls


@dataclass(frozen=True, eq=False, slots=True)
class ControlMap:
    """Race control of one bearing; ``speed`` (s,) [rad/s], ``load`` (l,) axial [N], ascending.

    ``inner_margin``, ``outer_margin`` (s, l): positive where that race controls every loaded ball
    (``BearingState.control_margins``, of the ball with the least); NaN beside an ``outcome``: no
    state, or balls with a third contact.
    ``boundary`` (2, s) [N], of the inner and the outer race: the load above which the inner race
    controls, and the one up to which the outer race does. ``absence`` (2, s): ``""``, or why there
    is none (the boundary is NaN). ``changes`` (2, s): how often the race gains or loses control
    between the loads; where more than once the boundary is the highest of its kind.
    ``pressure`` (2, s) [Pa]: largest contact pressure at the boundary.
    """

    speed: Array
    load: Array
    inner_margin: Array
    outer_margin: Array
    outcome: NDArray[np.str_]
    boundary: Array
    absence: NDArray[np.str_]
    changes: NDArray[np.int_]
    pressure: Array


def control_map(
    bearing: BallBearing,
    *,
    speed: ArrayLike,
    lowest: float,
    highest: float,
    radial: float = 0.0,
    static_growth: float = 0.0,
    growth: ArrayLike | None = None,
    law: Law = STANDARD,
) -> ControlMap:
    """Solve for both boundaries of race control at every speed, tilts blocked.

    Parameters
    ----------
    speed : of the inner ring, shape (s,) [rad/s]
    lowest, highest : ends of the range of axial loads, from 1 mN up [N]
    radial : radial over axial load; 0 = purely axial, where all balls are equal
    static_growth, growth : as for ``equilibrium``; growth (s,) [m]
    law : hypotheses on the balls

    Raises
    ------
    InvalidBearing : no speeds, loads that are not 1 mN ≤ lowest < highest, radial below 0
    """
    omega = np.asarray(speed, dtype=float)
    _check(omega, lowest, highest, radial)
    total = np.broadcast_to(static_growth if growth is None else growth, omega.shape)
    sweep = _Sweep(
        bearing,
        omega,
        np.asarray(total, dtype=float),
        radial,
        dict(static_growth=static_growth, **asdict(law)),
    )
    load = np.geomspace(lowest, highest, LEVELS)
    rows = np.repeat(np.arange(omega.size)[:, None], LEVELS, axis=1)
    state = sweep.state(np.broadcast_to(load, rows.shape), rows)
    margins, third = least_margins(state), three_contacts(state)
    boundary, absence, changes = _boundaries(sweep, load, margins)
    two_contacts = np.strings.replace(absence, "that has a solution", "with two contacts per ball")
    absence = np.where(third.any(axis=1), two_contacts, absence)
    outcome = np.where(third, THIRD, state.outcome)
    absence = np.where((outcome != "").all(axis=1), outcome[:, -1], absence)
    return ControlMap(
        speed=omega,
        load=load,
        inner_margin=margins[0],
        outer_margin=margins[1],
        outcome=outcome,
        boundary=boundary,
        absence=absence,
        changes=changes,
        pressure=_pressures(sweep, boundary),
    )


def least_margins(state: BearingState) -> Array:
    """Return the smallest margin of any loaded ball for both races (2, …); NaN without state, or
    where a loaded ball has more than two contacts."""
    margins = np.where(state.inner_load > 0.0, np.stack(state.control_margins), np.inf)
    valid = (state.outcome == "") & ~three_contacts(state)
    return np.where(valid, margins.min(axis=-1), np.nan)


def three_contacts(state: BearingState) -> Flags:
    """Return whether a ball has more than two contacts (…), which its inner race then loads."""
    return np.asarray((state.contacts > 2).any(axis=-1))


def resting_weight(bearing: BallBearing) -> float:
    """Return C = ai Ei/(ao Eo) for equal ball loads: that at rest, the limit of heavy loads.

    Above 1 the inner race controls at heavy load, below 1 the outer race does.
    """
    g = geometry(bearing.grooves)
    return g.race_ratio * (g.outer.stiffness / g.inner.stiffness) ** (4.0 / 3.0)


def quadratic(speed: Array, load: Array) -> tuple[Array, float]:
    """Return least-squares (a, b, c) of F = a ω² + b ω + c, and the largest misfit.

    ``speed`` and ``load`` (n,), at least four; units of the result follow theirs.
    """
    fit: Any = np.polynomial.Polynomial.fit(speed, load, 2)
    c, b, a = fit.convert().coef
    return np.array([a, b, c]), float(np.abs(fit(speed) - load).max())


@dataclass(frozen=True, eq=False, slots=True)
class _Sweep:
    """States of one bearing at the speeds and growths (s,) of a map."""

    bearing: BallBearing
    speed: Array
    growth: Array
    radial: float
    arguments: dict[str, Any]

    def state(self, load: Array, rows: Index) -> BearingState:
        """Solve the states under axial ``load`` (…) at the speeds ``rows`` (…)."""
        force = np.full((*load.shape, 5), np.nan)
        force[..., :3] = load[..., None] * np.array([1.0, self.radial, 0.0])
        return self.bearing.equilibrium(
            load=force,
            displacement=np.array([np.nan, np.nan, np.nan, 0.0, 0.0]),
            speed=self.speed[rows],
            growth=self.growth[rows],
            **self.arguments,
        )


def _boundaries(
    sweep: _Sweep, load: Array, margins: Array
) -> tuple[Array, NDArray[np.str_], NDArray[np.int_]]:
    """Return boundaries, sentences where there are none, and changes, each (2, s)."""
    lower, upper = np.sign(margins[..., :-1]), np.sign(margins[..., 1:])
    crossing = lower * upper < 0.0  # never next to a load without state
    bounding = crossing & (upper * UPWARD > 0.0)
    positive, negative = (margins > 0.0).any(axis=-1), (margins < 0.0).any(axis=-1)
    kind = np.where(positive & negative, 2, np.where(positive, 0, 1))
    absence = np.array(ABSENT)[np.arange(2)[:, None], kind]
    boundary = np.full(kind.shape, np.nan)
    race, row = np.nonzero(bounding.any(axis=-1))
    if race.size:
        last = bounding.shape[-1] - 1 - bounding[race, row, ::-1].argmax(axis=-1)
        boundary[race, row] = _roots(sweep, race, row, load[last], load[last + 1])
        absence[race, row] = np.where(np.isnan(boundary[race, row]), UNRESOLVED, "")
    return boundary, absence, crossing.sum(axis=-1)


def _roots(sweep: _Sweep, race: Index, row: Index, low: Array, high: Array) -> Array:
    """Return loads (n,) from ``low`` to ``high`` where margins cross zero; NaN without state."""
    from scipy.optimize import elementwise

    def margin(log_load: Array, entry: Array) -> Array:
        k = entry.astype(int)
        margins = least_margins(sweep.state(np.exp(log_load), row[k]))
        return np.asarray(np.take_along_axis(margins, race[k][None], axis=0)[0])

    root = elementwise.find_root(
        margin,
        (np.log(low), np.log(high)),
        args=(np.arange(race.size, dtype=float),),
        tolerances=dict(xatol=LOG_TOLERANCE, xrtol=0.0, fatol=0.0, frtol=0.0),
    )
    return np.where(root.success, np.exp(root.x), np.nan)


def _pressures(sweep: _Sweep, boundary: Array) -> Array:
    """Return the largest contact pressure in the states at the boundaries (2, s)."""
    pressure = np.full(boundary.shape, np.nan)
    race, row = np.nonzero(np.isfinite(boundary))
    if race.size:
        state = sweep.state(boundary[race, row], row)
        pressure[race, row] = np.maximum(state.inner_pressure, state.outer_pressure).max(axis=-1)
    return pressure


def _check(speed: Array, lowest: float, highest: float, radial: float) -> None:
    if speed.ndim != 1 or not speed.size:
        raise InvalidBearing(f"speed must have shape (s,) with one speed or more, got {speed!r}")
    if not 0.0 < lowest < highest < np.inf:
        raise InvalidBearing(
            f"loads must be 0 < lowest < highest, finite, got {lowest!r} and {highest!r} N"
        )
    if lowest < LIGHTEST:
        raise InvalidBearing(f"the lowest load must be {LIGHTEST:g} N or more, got {lowest!r} N")
    if not 0.0 <= radial < np.inf:
        raise InvalidBearing(f"radial over axial load must be from 0 and finite, got {radial!r}")
