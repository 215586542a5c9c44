"""Life, safety, heat, films and defect frequencies from the states the preload analysis shares."""

from __future__ import annotations

import math
from dataclasses import asdict, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import bearings
from bearings.life.rating import is_thrust
from bearings.ring.state import BearingState
from rotordyn.analyses.life.result import LifeResult
from rotordyn.analyses.life.spec import LifeSpec, LoadStep
from rotordyn.arrays import Array
from rotordyn.errors import InvalidInput
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.ring_stress import ring_stress
from rotordyn.results.display import RPM
from rotordyn.scene.lubrication import Lubrication, hot_rating
from rotordyn.scene.scene import Scene

Values = dict[str, NDArray[Any]]
OIL_FIELDS = (  # NaN without a lubricant
    *("inner_heat", "outer_heat", "spin_heat", "viscous_heat", "moment"),
    *("viscosity_ratio", "film", "film_ratio", "life_factor", "modified_life"),
)


def solve(scene: Scene, spec: LifeSpec) -> LifeResult:
    """Life, safety and heat of every bearing over speed, once for seats of one batch and rating."""
    state, seats = scene.preload, scene.spindle.seats
    solved = np.array([word == "" for word in scene.outcome])
    ratings = _ratings(scene.spindle, spec)
    computed: dict[tuple[int, float, float], Values] = {}
    columns: list[Values] = []
    temperatures, rows = _temperatures(scene), scene.bearing_row
    factor = _rating_factor(spec, temperatures)[rows]
    oil_at = _oil_temperatures(scene, spec, temperatures)
    for k, (balls, column) in enumerate(state.seat_states()):
        rating = ratings.of(k)
        key = (id(balls), rating.dynamic, rating.static)
        if key not in computed:
            computed[key] = _of_bearings(balls, rating, spec, oil_at[id(balls)])
        columns.append({name: values[:, column] for name, values in computed[key].items()})

    def joined(name: str) -> NDArray[Any]:
        values = np.stack([of_seat[name] for of_seat in columns], axis=1)[rows]
        blank: Any = {"U": "", "b": False}.get(values.dtype.kind, np.nan)
        return np.where(solved[:, None], values, blank)

    stress = ring_stress(scene.spindle, scene.bearing_speed, scene.temperatures)
    fields = {name: joined(name) for name in columns[0]}
    for name in ("revolutions", "life", "modified_life"):
        fields[name] = fields[name] * factor**3  # life goes with C³
    spectrum, safety, unloaded = _spectrum(scene, spec, ratings)
    lubricant = spec.lubricant
    return LifeResult(
        speed=scene.speed,
        bearing=tuple(seat.name for seat in seats),
        outcome=scene.outcome,
        dynamic_rating=ratings.dynamic,
        groove_rating=ratings.of_grooves,
        static_rating=ratings.static,
        groove_static_rating=ratings.static_of_grooves,
        fatigue_limit=np.array(
            [
                bearings.life.fatigue_load_limit(static, seat.bearing.pitch_diameter)
                for static, seat in zip(ratings.static.tolist(), seats, strict=True)
            ]
        ),
        ring_stress=np.where(solved[:, None], stress[rows], np.nan),
        rating_factor=np.where(solved[:, None], factor, np.nan),
        set_life=bearings.life.set_life(fields["life"], axis=1),
        spectrum_life=spectrum,
        spectrum_safety=safety,
        spectrum_unloaded=unloaded,
        spectrum_set_life=float(bearings.life.set_life(spectrum)),
        viscosity=math.nan
        if lubricant is None
        else float(lubricant.oil.kinematic(lubricant.temperature)),
        reliability=spec.reliability,
        target=math.nan if spec.target is None else spec.target,
        **{
            f"{part}_temperature": np.where(solved[:, None], temperatures[rows][..., k], np.nan)
            for k, part in enumerate(("ball", "inner", "outer"))
        },
        **fields,
    )


def _temperatures(scene: Scene) -> Array:
    """Temperatures of balls, inner and outer ring of every bearing (speeds, bearings, 3) [°C]; NaN
    where the conditions give none."""
    speed, seats, temperatures = scene.bearing_speed, scene.spindle.seats, scene.temperatures
    celsius = np.full((len(speed), len(seats), 3), np.nan)
    if temperatures is not None:
        for k, seat in enumerate(seats):
            rises = temperatures.rises(seat.name, speed)
            for place, rise in enumerate((rises.balls, rises.inner, rises.outer)):
                celsius[:, k, place] = rise + temperatures.reference
    return celsius


def _rating_factor(spec: LifeSpec, temperatures: Array) -> Array:
    """Factor on C at the temperature of the hottest of rings, balls and oil (speeds, bearings)."""
    oil = np.nan if spec.lubricant is None else spec.lubricant.temperature
    return hot_rating(np.fmax(np.fmax.reduce(temperatures, axis=-1), oil))


def _oil_temperatures(scene: Scene, spec: LifeSpec, temperatures: Array) -> dict[int, Array]:
    """Temperatures of the oil by batch of states (speeds, columns) [°C]: those of the balls where
    they follow from the heat of the bearings, else as given."""
    specified = math.nan if spec.lubricant is None else spec.lubricant.temperature
    from_heat = scene.conditions.heat_flow is not None
    by_batch: dict[int, Array] = {}
    for k, (balls, column) in enumerate(scene.preload.seat_states()):
        oil = by_batch.setdefault(id(balls), np.full(balls.outcome.shape, specified))
        if from_heat:
            oil[:, column] = temperatures[:, k, 0]
    return by_batch


class _Rating(NamedTuple):
    """C and C0 of one bearing [N], and C0 over that of its grooves."""

    dynamic: float
    static: float
    static_share: float


class _Ratings(NamedTuple):
    """C and C0 used, and those of the grooves, of every bearing (bearings,) [N]."""

    dynamic: Array
    of_grooves: Array
    static: Array
    static_of_grooves: Array

    def of(self, k: int) -> _Rating:
        """Ratings of bearing number ``k``."""
        static = float(self.static[k])
        return _Rating(float(self.dynamic[k]), static, static / float(self.static_of_grooves[k]))


def _ratings(spindle: Spindle, spec: LifeSpec) -> _Ratings:
    ratings: list[Array] = []
    for specified, computed in (
        (spec.dynamic_ratings, bearings.life.dynamic_rating),
        (spec.static_ratings, bearings.life.static_rating),
    ):
        grooves = [computed(seat.bearing) for seat in spindle.seats]
        pairs = zip(spindle.seats, grooves, strict=True)
        used = [specified.get(seat.name, value) for seat, value in pairs]
        ratings += [np.array(used), np.array(grooves)]
    return _Ratings(*ratings)


def _of_bearings(state: BearingState, rating: _Rating, spec: LifeSpec, oil: Array) -> Values:
    """All quantities of one batch of bearings over speed (speeds, bearings)."""
    reference = bearings.life.life_of(state, rating.dynamic)
    truncation = bearings.truncation(state)
    orders = bearings.life.frequencies(state)
    hertz = np.asarray(state.speed) / (2.0 * math.pi)
    with np.errstate(divide="ignore", invalid="ignore"):
        life = reference.revolutions / hertz
    spin = np.maximum(np.abs(state.inner_spin_to_roll), np.abs(state.outer_spin_to_roll))
    return {
        "revolutions": reference.revolutions,
        "life": life,
        "limiting": reference.limiting,
        "equivalent_load": reference.equivalent_load,
        "static_safety": bearings.life.static_safety(state) * rating.static_share,
        "pressure": np.asarray(state.contact_pressure).max(axis=(-2, -1)),
        "ellipse_length": truncation.major.max(axis=(-2, -1)),
        "shoulder_margin": _least(truncation.shoulder_margin),
        "lost_load": truncation.lost_load.max(axis=(-2, -1)),
        "spin_to_roll": spin.max(axis=-1),
        "cage": orders.cage,
        "outer": orders.outer,
        "inner": orders.inner,
        "ball": orders.ball,
        **_lubricated(state, reference, life, spec, oil, rating.static),
    }


def _lubricated(
    state: BearingState,
    lives: bearings.life.ReferenceLife,
    life: Array,
    spec: LifeSpec,
    at: Array,
    static: float,
) -> Values:
    """Quantities that depend on the lubricant, ``at`` oil temperatures [°C], C0 ``static`` [N]; NaN
    without a lubricant."""
    lubricant = spec.lubricant
    if lubricant is None:
        blank = {name: np.full_like(life, np.nan) for name in OIL_FIELDS}
        return {**blank, "slips": np.zeros(life.shape, dtype=bool)}
    losses = bearings.heat.losses(
        state,
        lubricant.oil,
        at,
        friction=lubricant.friction,
        oil_factor=bearings.heat.OIL_FACTORS[lubricant.supply],
        model=spec.heat,
        static_rating=static,
    )
    pitch = state.operation.grooves.pitch_diameter
    kappa = bearings.life.viscosity_ratio(lubricant.oil.kinematic(at), state.speed, pitch)
    limit = bearings.life.fatigue_load_limit(static, pitch)
    factor = bearings.life.life_factor(kappa, lubricant.contamination, limit, lives.equivalent_load)
    if is_thrust(state.operation.grooves):
        factor = np.full_like(factor, np.nan)  # a_ISO is not known above 45°
    return {
        "inner_heat": losses.inner,
        "outer_heat": losses.outer,
        "spin_heat": losses.spin,
        "viscous_heat": losses.viscous,
        "moment": losses.moment,
        "slips": losses.slips,
        "viscosity_ratio": kappa,
        **_films(state, lubricant, at),
        "life_factor": factor,
        "modified_life": bearings.life.reliability_factor(spec.reliability) * factor * life,
    }


def _films(state: BearingState, lubricant: Lubrication, at: Array) -> Values:
    """Least film thickness of loaded contacts, least ratio to the roughness; 0 without load."""
    films = bearings.film.film(state, lubricant.oil, at)
    loaded = np.asarray(state.contact_load) > 0.0
    is_loaded = loaded.any(axis=(-2, -1))
    ratio = films.ratio(lubricant.ball_roughness, lubricant.race_roughness)
    return {
        name: np.where(is_loaded, np.where(loaded, values, np.inf).min(axis=(-2, -1)), 0.0)
        for name, values in (("film", films.least), ("film_ratio", ratio))
    }


def _least(margin: Array) -> Array:
    """Least margin over balls and contacts; NaN where no contact has one."""
    least = np.where(np.isnan(margin), np.inf, margin).min(axis=(-2, -1))
    return np.where(np.isfinite(least), least, np.nan)


def _spectrum(scene: Scene, spec: LifeSpec, ratings: _Ratings) -> tuple[Array, Array, Array]:
    """Life [s] and least static safety of every bearing under the load spectrum, and the share of
    the time in which it turns without any load; NaN without a spectrum (bearings,)."""
    if not spec.spectrum:
        blank = np.full(len(ratings.static), np.nan)
        return blank, blank, blank
    steps = [_step(scene, spec, place, ratings) for place in range(len(spec.spectrum))]
    lives, safety, idle = (np.array(values) for values in zip(*steps, strict=True))
    shares = np.array([step.share for step in spec.spectrum])
    turning = shares * [step.speed > 0.0 for step in spec.spectrum]
    unloaded = turning @ idle / shares.sum()
    return np.asarray(bearings.life.mean_life(shares, lives)), safety.min(axis=0), unloaded


def _step(
    scene: Scene, spec: LifeSpec, place: int, ratings: _Ratings
) -> tuple[list[float], list[float], list[bool]]:
    """Life of every bearing under one step of the spectrum [s], infinite at rest, its static
    safety, and whether its inner ring loads no ball; the loads of the conditions act as well.

    Raises
    ------
    InvalidInput : loads under which the machine, or a bearing, has no state
    """
    base, step = scene.conditions, spec.spectrum[place]
    conditions = replace(
        base,
        axial_force=base.axial_force + step.axial_force,
        loads=(*base.loads, *step.loads),
    )
    under_step = scene.at(np.array([step.speed])).under(conditions)
    if under_step.outcome[0]:
        raise InvalidInput(
            f"life: spectrum.{place + 1} at {step.speed * RPM.factor:.6g} rpm has no physical "
            f"solution: {under_step.outcome[0]}; change the loads or the speed of this step"
        )
    dynamic_ratings = ratings.dynamic * _rating_factor(spec, _temperatures(under_step))[0]
    lives, safety, idle = [], [], []
    share = ratings.static / ratings.static_of_grooves
    for seat, (balls, column), dynamic, static_share in zip(
        scene.spindle.seats, under_step.preload.seat_states(), dynamic_ratings, share, strict=True
    ):
        state, index = balls, column
        if step.radial.get(seat.name, 0.0) > 0.0:
            state, index = _under_radial_load(scene, step, seat, balls, column), 0
        revolutions = float(bearings.life.reference_life(state, float(dynamic)).flat[index])
        if math.isnan(revolutions):
            raise InvalidInput(
                f"life: spectrum.{place + 1}.radial.{seat.name}: no solution under this load: "
                f"given {step.radial[seat.name]:.6g} N; lower the load"
            )
        lives.append(revolutions * 2.0 * math.pi / step.speed if step.speed else np.inf)
        safety.append(float(static_share * bearings.life.static_safety(state).flat[index]))
        ball_loads = np.reshape(state.inner_load, (-1, np.shape(state.inner_load)[-1]))[index]
        idle.append(not (ball_loads > 0.0).any())
    return lives, safety, idle


def _under_radial_load(
    scene: Scene,
    step: LoadStep,
    seat: BearingSeat,
    balls: BearingState,
    column: int,
) -> BearingState:
    """State of a bearing under its radial load, with axial load and growth kept, untilted."""
    law, operation = seat.law(scene.law), balls.operation
    static, growth = (
        values.reshape(operation.shape)[:1, column]
        for values in (operation.static_growth, operation.growth)
    )
    return scene.spindle.mounted(seat).equilibrium(
        load=[float(balls.load[0, column, 0]), step.radial[seat.name], 0.0, np.nan, np.nan],
        displacement=[np.nan, np.nan, np.nan, 0.0, 0.0],
        speed=[step.speed],
        static_growth=static,
        growth=growth,
        **asdict(law),
    )
