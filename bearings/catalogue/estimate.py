"""Estimate of the internal geometry of an angular-contact bearing from printed catalogue values."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from bearings.arguments import checked
from bearings.arrays import Array
from bearings.catalogue.consistency import ROW_FACTOR, refuse_contradictions
from bearings.catalogue.pair import axial_law, pair_values
from bearings.catalogue.plausible import TIGHTEST, plausible, usual
from bearings.catalogue.printed import Catalogue, Value
from bearings.catalogue.races import contact_stiffness, static_rating
from bearings.errors import InvalidBearing, shown
from bearings.kinds.angular_contact import AngularContactBallBearing
from bearings.life.rating import Insides, rating
from bearings.materials import SILICON_NITRIDE, STEEL

FIELDS = ("ball_diameter", "balls", "pitch_diameter", "inner_conformity", "outer_conformity")
# Standard deviations of printed values relative to those of one and the same internal geometry
DEVIATION = {"rigidity": 0.015, "unloading": 0.01, "dynamic": 0.05, "static": 0.05}
_PAIR = (1.35, 1.95)  # printed over expected C that suggests a pair
_SPARSE = 0.69  # share of the pitch circle that balls usually exceed
_WHOLE_NEWTON = 0.29  # [N], standard deviation by rounding to whole newtons
_REFINED = 4  # combinations of ball diameter and number whose grooves are refined
_STEP = 0.005  # largest change of a conformity by refining
_FINEST = 1e-7  # the same, of the last grid of the search
_GRID, _FINER = 11, 0.3  # points of a grid in a direction; size of the next, finer one
_SEARCHES = 100  # at most
_PHRASES = (
    ("balls", "{:.0f} balls ({:.0f}–{:.0f})", 1.0),
    ("ball_diameter", "D {:.4g} mm ({:.4g}–{:.4g})", 1e3),
    ("inner_conformity", "fi {:.3f} ({:.3f}–{:.3f})", 1.0),
    ("outer_conformity", "fo {:.3f} ({:.3f}–{:.3f})", 1.0),
)


class Explained(NamedTuple):
    """Printed value and the corresponding value of the estimated bearing [SI]."""

    value: Value
    computed: float

    @property
    def deviation(self) -> float:
        """Computed over printed, less 1."""
        return self.computed / self.value.number - 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class EstimatedBearing(AngularContactBallBearing):
    """An angular-contact bearing whose internal geometry is estimated from catalogue values.

    It has the likeliest of the plausible geometries and can be used as any other bearing.

    Parameters
    ----------
    catalogue : the printed values
    spread : field -> (low, high), between which nine in ten of the plausible geometries lie; both
        are the value itself where the catalogue gives it

    Raises
    ------
    InvalidBearing : as of its kind
    """

    catalogue: Catalogue = field(compare=False, repr=False)
    spread: Mapping[str, tuple[float, float]] = field(compare=False, repr=False)

    @property
    def estimated(self) -> str:
        """Estimated data with their spread, and how C is interpreted; see ``BallBearing``."""
        phrases = []
        for name, phrase, scale in _PHRASES:
            low, high = (bound * scale for bound in self.spread[name])
            if getattr(self.catalogue, name) is None:
                phrases.append(phrase.format(getattr(self, name) * scale, low, high))
        if self.catalogue.dynamic_rating is not None:
            times = ROW_FACTOR**3
            phrases.append(
                f"C as that of one bearing (of a pair: lives are {times:.1f} times too long)"
            )
        return ", ".join(phrases)

    @property
    def explained(self) -> tuple[Explained, ...]:
        """Every printed value with that of this bearing."""
        values = self.catalogue.values
        computed = _computed(self._inside, self.catalogue)[:, 0]
        return tuple(Explained(v, float(c)) for v, c in zip(values, computed, strict=True))

    @property
    def doubt(self) -> str:
        """Warning where C seems to be that of a pair, since the other values lead to far less, or
        where rigidities lead to balls that leave much of the pitch circle empty.

        The first needs C0 or the balls: from rings and rigidity alone, the C that makers print of
        one bearing is 0.6 to 2.7 times that of the likeliest internal geometry. Rings and C0 alone
        do not detect a pair's C where fewer, larger balls explain both: printed C of one is 0.66 to
        1.17 times, that of a pair 1.07 to 1.91 times the expected one.
        """
        return self._of_pair or self._sparse

    @property
    def _sparse(self) -> str:
        free = self.catalogue.balls is None and self.catalogue.ball_diameter is None
        fill = self.balls * self.ball_diameter / (math.pi * self.pitch_diameter)
        if not (free and self.catalogue.rigidities) or fill > _SPARSE:
            return ""
        return (
            f"its most probable balls fill {fill:.0%} of the pitch circle, where 72 % and more are "
            "usual: check preloads (the force between the two bearings of a pair), rigidities (of "
            "the pair) and ratings (of one bearing)"
        )

    @property
    def _of_pair(self) -> str:
        catalogue = self.catalogue
        printed = catalogue.dynamic_rating
        if printed is None or (catalogue.static_rating is None and catalogue.ball_diameter is None):
            return ""
        without_rating = likeliest(replace(catalogue, dynamic_rating=None))
        expected = float(rating(without_rating._inside))
        if not _PAIR[0] < printed / expected < _PAIR[1]:
            return ""
        return (
            f"dynamic rating C {printed:.4g} N is {printed / expected:.2f} times the value that "
            f"the others give ({expected:.4g} N): a pair has 1.62 times as much; give that of one "
            "bearing"
        )

    @checked
    def pair(self, preload: float) -> tuple[float, float]:
        """Axial rigidity [N/m] and unloading force [N] of two, back to back, at a preload [N].

        Raises InvalidBearing for a preload that is not positive.
        """
        if not preload > 0.0:
            raise InvalidBearing(f"preload of a pair must be positive, got {shown(preload)}")
        scale, distance = _scale(self._inside, self.catalogue)
        law = axial_law(float(self.contact_angle))
        rigidity, unloading = pair_values(law, scale, distance, preload)
        return float(rigidity), float(unloading)

    def members(self, count: int = 24) -> tuple[AngularContactBallBearing, ...]:
        """Sample of equally likely bearings: the spread of any result is that over this sample."""
        x, likely, share = _weighed(self.catalogue)
        every = x.spread_over(likely.shape)
        middles = (np.arange(count) + 0.5) / count
        places = np.searchsorted(np.cumsum(share), middles).clip(0, share.size - 1)
        fields = (_fields(every.at(k), self.catalogue) for k in places)
        return tuple(AngularContactBallBearing(**each) for each in fields)

    @property
    def _inside(self) -> Insides:
        values: dict[str, Any] = {name: np.array(float(getattr(self, name))) for name in FIELDS}
        return Insides(**values, contact_angle=float(self.contact_angle))


@checked
def estimate(  # noqa: PLR0913 - a catalogue prints that many columns
    *,
    bore: float,
    outside_diameter: float,
    width: float | None = None,
    contact_angle: float,
    hybrid: bool = True,
    preloads: Sequence[float] = (),
    rigidities: Sequence[float | None] = (),
    unloading: Sequence[float | None] = (),
    dynamic_rating: float | None = None,
    static_rating: float | None = None,
    ball_diameter: float | None = None,
    balls: int | None = None,
    pitch_diameter: float | None = None,
    inner_conformity: float | None = None,
    outer_conformity: float | None = None,
) -> EstimatedBearing:
    """Estimate the internal geometry of an angular-contact bearing from printed catalogue values.

    Every internal geometry that fits into rings of this size is weighted by its prior probability
    and by how well it gives the printed values (``docs/theory/catalogue.md``); returns the
    likeliest.

    Parameters
    ----------
    bore, outside_diameter, width : of the rings [m]; ``width`` is stored but not used
    contact_angle : free contact angle α [rad]
    hybrid : balls of silicon nitride; False: of steel
    preloads : of a pair back to back, the maker's classes, shape (n,) [N]
    rigidities : axial, of the pair at each preload, shape (n,) [N/m]; None where not printed
    unloading : axial force that unloads one of the pair at each preload, shape (n,) [N]; likewise
    dynamic_rating, static_rating : C, C0 of one bearing [N]: radial, above 45° axial
    ball_diameter, balls, pitch_diameter, inner_conformity, outer_conformity : as far as printed

    Raises
    ------
    InvalidBearing : a value is out of range; or values contradict one another, with the largest
        set that does not
    """
    catalogue = Catalogue(
        bore=bore,
        outside_diameter=outside_diameter,
        width=width,
        contact_angle=contact_angle,
        ball_material=SILICON_NITRIDE if hybrid else STEEL,
        preloads=tuple(preloads),
        rigidities=tuple(rigidities),
        unloading=tuple(unloading),
        dynamic_rating=dynamic_rating,
        static_rating=static_rating,
        ball_diameter=ball_diameter,
        balls=balls,
        pitch_diameter=pitch_diameter,
        inner_conformity=inner_conformity,
        outer_conformity=outer_conformity,
    )
    return likeliest(catalogue)


@lru_cache(maxsize=32)  # seats and variants of a machine have the same few catalogue bearings
def likeliest(catalogue: Catalogue) -> EstimatedBearing:
    """Return the estimate from printed values; errors as for ``estimate``."""
    x, likely, share = _weighed(catalogue)
    best = _refined(x, likely, catalogue)
    spread = {name: _range(getattr(x, name), share, getattr(best, name)) for name in FIELDS}
    return EstimatedBearing(**_fields(best, catalogue), catalogue=catalogue, spread=spread)


def _weighed(catalogue: Catalogue) -> tuple[Insides, Array, Array]:
    """Return the grid of all plausible internal geometries, the logarithm of the posterior
    probability of each up to a constant, and the probability, normalised to a sum of 1."""
    x, weight = plausible(catalogue)
    computed = _computed(x, catalogue)
    apart = _apart(computed, catalogue)
    refuse_contradictions(catalogue, apart, computed, weight.ravel())
    likely = weight - 0.5 * (apart**2).sum(axis=0).reshape(weight.shape)
    share = np.exp(likely - likely.max())
    return x, likely, share / share.sum()


def _apart(computed: Array, catalogue: Catalogue) -> Array:
    """ln(computed/printed) in standard deviations, shape (values, insides)."""
    printed = np.array([v.number for v in catalogue.values]).reshape(-1, 1)
    deviations = np.array([_deviation(v) for v in catalogue.values]).reshape(-1, 1)
    return np.log(computed / printed) / deviations


def _scale(x: Insides, catalogue: Catalogue) -> tuple[Array, Array]:
    """P [N] and BD [m] of ``bearings.catalogue.pair``."""
    distance = x.free_distance
    stiffness = contact_stiffness(x, catalogue.ball_material, catalogue.ring_material)
    return x.balls * stiffness * distance**1.5, distance


def _computed(x: Insides, catalogue: Catalogue) -> Array:
    """Compute each printed value for each internal geometry, shape (values, insides)."""
    law = axial_law(x.contact_angle)
    scale, distance = _scale(x, catalogue)
    at = {
        p: pair_values(law, scale, distance, p)
        for p in {v.preload for v in catalogue.values}
        if p > 0.0
    }
    rows: list[Any] = []
    for value in catalogue.values:
        if value.kind == "dynamic":
            rows.append(rating(x))
        elif value.kind == "static":
            rows.append(static_rating(x, catalogue.ball_material, catalogue.ring_material))
        else:
            rows.append(at[value.preload][0 if value.kind == "rigidity" else 1])
    shape = np.broadcast_shapes(*map(np.shape, x[:-1]))
    full = [np.broadcast_to(row, shape).ravel() for row in rows]
    return np.array(full).reshape(len(rows), math.prod(shape))


def _deviation(value: Value) -> float:
    """Standard deviation of ln(computed/printed), including rounding to whole newtons."""
    share = DEVIATION[value.kind]
    if math.isnan(value.preload):
        return share
    # the rigidity follows the cube root of the preload, the unloading force the preload itself
    rounding = _WHOLE_NEWTON / value.preload
    if value.kind == "rigidity":
        return math.hypot(share, rounding / 3.0)
    return math.hypot(share, rounding, _WHOLE_NEWTON / value.number)


def _refined(x: Insides, likely: Array, catalogue: Catalogue) -> Insides:
    """Return the likeliest internal geometry, its conformities refined between grid points."""
    free = [name for name in FIELDS[3:] if getattr(catalogue, name) is None]
    section = catalogue.outside_diameter - catalogue.bore
    every, of_balls = x.spread_over(likely.shape), likely.reshape(len(likely), -1)
    order = np.argsort(-of_balls.max(axis=1), kind="stable")[:_REFINED]
    starts = [every.at(k * of_balls.shape[1] + int(of_balls[k].argmax())) for k in order]
    if not free:
        return starts[0]

    def cost(trial: Insides) -> Array:
        apart = _apart(_computed(trial, catalogue), catalogue)
        return np.asarray(0.5 * (apart**2).sum(axis=0) - usual(trial, section))

    # A pattern search, of all starts at once: scipy takes longer to load than this. A grid moves to
    # its best point, and becomes finer where that is not on its edge.
    centre = np.array([[getattr(start, name) for name in free] for start in starts])
    low, high = np.maximum(centre - _STEP, TIGHTEST)[:, None], (centre + _STEP)[:, None]
    axes = np.meshgrid(*[np.linspace(-1.0, 1.0, _GRID)] * len(free))
    steps = np.stack(axes, axis=-1).reshape(-1, len(free))
    half, each, costs = np.full(len(starts), _STEP), np.arange(len(starts)), np.empty(0)
    for _ in range(_SEARCHES):
        points = np.clip(centre[:, None] + half[:, None, None] * steps, low, high)
        columns = dict(zip(free, points.reshape(-1, len(free)).T, strict=True))
        found = cost(_repeated(starts, len(steps), columns)).reshape(len(starts), -1)
        best = found.argmin(axis=1)
        moved, centre, costs = centre, points[each, best], found[each, best]
        inside = (np.abs(centre - moved) < 0.99 * half[:, None]).all(axis=1)
        half = np.where(inside, _FINER * half, half)
        if half.max() < _FINEST:
            break
    k = int(costs.argmin())
    return starts[k]._replace(**dict(zip(free, centre[k].tolist(), strict=True)))


def _repeated(starts: Sequence[Insides], times: int, values: Mapping[str, Array]) -> Insides:
    """Every start ``times`` over, with other ``values`` (starts · times,) of some fields."""
    rows = {name: np.repeat([getattr(s, name) for s in starts], times) for name in FIELDS}
    fields: dict[str, Any] = {**rows, **values}
    return Insides(**fields, contact_angle=starts[0].contact_angle)


def _range(values: Array, share: Array, estimate: Any) -> tuple[float, float]:
    """Range from the 5 to the 95 % quantile of a value of the grid, extended to the refined
    estimate."""
    held = tuple(axis for axis, length in enumerate(values.shape) if length == 1)
    order, marginal = np.argsort(values, axis=None), share.sum(axis=held).ravel()
    total = np.cumsum(marginal[order])
    places = np.searchsorted(total, (0.05, 0.95)).clip(0, len(order) - 1)
    low, high = values.ravel()[order[places]]
    return min(float(low), float(estimate)), max(float(high), float(estimate))


def _fields(x: Insides, catalogue: Catalogue) -> dict[str, Any]:
    """Arguments of the constructor of an angular-contact bearing."""
    values: dict[str, Any] = {name: float(getattr(x, name)) for name in FIELDS}
    return values | {
        "balls": round(values["balls"]),
        "contact_angle": x.contact_angle,
        "ball_material": catalogue.ball_material,
        "ring_material": catalogue.ring_material,
    }
