"""Axial load of bearings over deflection as piecewise linear curves, many bearings in one call.

Curves are coarser than the tables of ``axial_tables``, for the many machines of an identification.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import NamedTuple

import numpy as np

from bearings.ball.law import Law
from bearings.ball.laws import Laws
from bearings.bearing import BallBearing
from rotordyn.arrays import Array
from rotordyn.preload.arrangement import Arrangement
from rotordyn.preload.axial_ends import begins, turns, without_state

# Lengths in thousandths of the free distance of groove centres, some 1 µm; dense near 0, by halving
# steps above it: there the law d^1.5 of a bearing at rest is not smooth
PARTS = (
    (-300.0, -100.0, 20.0),
    (-100.0, -40.0, 4.0),
    (-40.0, 50.0, 1.5),
    (50.0, 80.0, 5.0),
    (80.0, 300.1, 10.0),
)
SOLVED = np.unique(
    np.concatenate([*(np.arange(*part) for part in PARTS), 2.0 ** -np.arange(0.0, 8.0), [0.0]])
)  # deflections at which bearings are solved; with thrust both ways, from the onset of load
FINE = np.unique(
    np.round(np.concatenate([np.arange(-300.0, 300.1), np.arange(-40.0, 40.0, 0.1)]), 1)
)  # points of a curve on the spline through the solved ones
FAR = 5e3  # to which a curve is extended beyond the spline: constant below, linear above
MOST_KEPT = 400  # curves; those of a fit over many machines would fill the memory


@dataclass(frozen=True, eq=False, slots=True)
class Curve:
    """Axial load [N] over deflection [m]: non-decreasing, linear between its points."""

    deflection: Array
    load: Array

    def __call__(self, d: Array) -> Array:
        """Return the loads [N] at deflections ``d`` [m]."""
        return np.interp(d, self.deflection, self.load)


class Inputs(NamedTuple):
    """Inputs of a curve: bearing model, its law, growths [m], ``speed`` [rad/s]."""

    model: BallBearing
    law: Law | Laws
    static_growth: float
    growth: float
    speed: float


@dataclass
class BearingCurves:
    """Curves of bearings solved so far."""

    known: dict[Inputs, Curve] = field(default_factory=dict)

    def of(self, joined: Arrangement) -> list[list[Curve]]:
        """Return the curve of every bearing at every speed, as lists (speeds, bearings)."""
        requested = [
            [
                Inputs(b.model, b.law, *map(float, (b.static_growth[k], b.growth[k], omega)))
                for b in joined.bearings
            ]
            for k, omega in enumerate(joined.speed)
        ]
        missing = {
            key: bearing.seats[0] + 1
            for row in requested
            for key, bearing in zip(row, joined.bearings, strict=True)
            if key not in self.known
        }
        for key in list(self.known)[: max(0, len(self.known) + len(missing) - MOST_KEPT)]:
            if not any(key in row for row in requested):
                del self.known[key]
        groups: dict[tuple[BallBearing, Law | Laws], list[Inputs]] = {}
        for key in missing:
            groups.setdefault((key.model, key.law), []).append(key)
        for group in groups.values():
            self._solve(group, missing)
        return [[self.known[key] for key in row] for row in requested]

    def _solve(self, group: list[Inputs], number: dict[Inputs, int]) -> None:
        """Solve bearings of one model and law in one call; ``number`` of each in the spindle."""
        from bearings.ring.tangents import stiffness

        model, law, *rest = zip(*group, strict=True)
        static_growth, growth, speed = (np.array(values)[:, None] for values in rest)
        unit, both_ways = 1e-3 * model[0].free_distance, model[0].both_ways
        start = np.maximum(begins(model[0], static_growth, growth), 0.0) * both_ways
        place = start + SOLVED * unit
        displacement = np.zeros((len(group), len(SOLVED), 5))
        displacement[..., 0] = place
        state = model[0].equilibrium(
            displacement=displacement,
            speed=speed,
            static_growth=static_growth,
            growth=growth,
            **asdict(law[0]),
        )
        slopes = stiffness(state, "complete")[..., 0, 0]
        lowest = 0.0 if both_ways else turns(model[0], static_growth)
        loads = np.where(place >= lowest, state.load[..., 0], np.nan)
        for key, onset, d, load, slope in zip(
            group, start[:, 0], place, loads, slopes, strict=True
        ):
            solved = np.isfinite(load) & np.isfinite(slope)
            if solved.sum() < 2:
                which = f"bearing number {number[key]} of the spindle"
                raise without_state(which, key.speed, key.growth)
            points, drawn = np.stack([d, load, slope])[:, solved], onset + FINE * unit
            if both_ways:  # the law is odd
                points, drawn = points[:, points[0] > 0.0], np.union1d(-drawn, drawn)
                mirrored = points[:, ::-1] * np.array([[-1.0], [-1.0], [1.0]])
                points = np.concatenate([mirrored, points], axis=1)
            self.known[key] = _curve(points[0], points[1], points[2], drawn, unit)


def _curve(d: Array, load: Array, slope: Array, drawn: Array, unit: float) -> Curve:
    """Return the curve through loads [N] and slopes [N/m] at deflections ``d`` [m].

    A spline gives its points ``drawn`` [m]; it extends to ``FAR`` times ``unit`` [m] at both ends.
    """
    from scipy.interpolate import CubicHermiteSpline

    inside = drawn[(d[0] <= drawn) & (d[-1] >= drawn)]
    fine = np.maximum.accumulate(CubicHermiteSpline(d, load, slope)(inside))
    step = (fine[-1] - fine[-2]) / (inside[-1] - inside[-2])
    far = FAR * unit
    loads = np.concatenate([fine[:1], fine, [fine[-1] + step * (far - inside[-1])]])
    return Curve(np.concatenate([[-far], inside, [far]]), loads)
