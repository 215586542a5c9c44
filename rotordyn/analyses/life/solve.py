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
from rotordyn.errors import InvalidInput
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.ring_stress import ring_stress
from rotordyn.results.display import RPM
from rotordyn.scene.lubrication import Lubrication, hot_rating
from rotordyn.scene.scene import Scene

Array = NDArray[np.float64]
Values = dict[str, NDArray[Any]]
OIL_FIELDS = (  # NaN without a lubricant
    *("inner_heat", "outer_heat", "spin_heat", "viscous_heat", "moment"),
    *("viscosity_ratio", "film", "film_ratio", "life_factor", "modified_life"),
)


def answer(scene: Scene, spec: LifeSpec) -> LifeResult:
    """One row per speed and bearing; a model that several seats share is computed once."""
    state, seats = scene.preload, scene.spindle.seats
    good = np.array([word == "" for word in scene.outcome])
    ratings = _ratings(scene.spindle, spec)
    of_model: dict[tuple[int, float, float], Values] = {}
    columns: list[Values] = []
    warm, rows = _temperatures(scene), scene.bearing_row
    hot = _rating_factor(spec, warm)[rows]
    oil_at = _oil_temperatures(scene, spec, warm)
    for k, (balls, column) in enumerate(state.seat_states()):
        rated = ratings.of(k)
        key = (id(balls), rated.dynamic, rated.static)
        if key not in of_model:
            of_model[key] = _of_bearings(balls, rated, spec, oil_at[id(balls)])
        columns.append({name: values[:, column] for name, values in of_model[key].items()})

    def joined(name: str) -> NDArray[Any]:
        values = np.stack([each[name] for each in columns], axis=1)[rows]
        blank: Any = {"U": "", "b": False}.get(values.dtype.kind, np.nan)
        return np.where(good[:, None], values, blank)

    stressed = ring_stress(scene.spindle, scene.bearing_speed, scene.temperatures)
    fields = {name: joined(name) for name in columns[0]}
    for name in ("revolutions", "life", "modified_life"):
        fields[name] = fields[name] * hot**3
    spectrum, safety, unloaded = _spectrum(scene, spec, ratings)
    oil = spec.lubricant
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
        ring_stress=np.where(good[:, None], stressed[rows], np.nan),
        rating_factor=np.where(good[:, None], hot, np.nan),
        set_life=bearings.life.set_life(fields["life"], axis=1),
        spectrum_life=spectrum,
        spectrum_safety=safety,
        spectrum_unloaded=unloaded,
        spectrum_set_life=float(bearings.life.set_life(spectrum)),
        viscosity=math.nan if oil is None else float(oil.oil.kinematic(oil.temperature)),
        reliability=spec.reliability,
        target=math.nan if spec.target is None else spec.target,
        **{
            f"{part}_temperature": np.where(good[:, None], warm[rows][..., k], np.nan)
            for k, part in enumerate(("ball", "inner", "outer"))
        },
        **fields,
    )


def _temperatures(scene: Scene) -> Array:
    """Of balls, inner and outer ring of every bearing (speeds, bearings, 3) [°C], NaN where the
    conditions say nothing of them."""
    speed, seats, known = scene.bearing_speed, scene.spindle.seats, scene.temperatures
    warm = np.full((len(speed), len(seats), 3), np.nan)
    if known is not None:
        for k, seat in enumerate(seats):
            rises = known.rises(seat.name, speed)
            for place, rise in enumerate((rises.balls, rises.inner, rises.outer)):
                warm[:, k, place] = rise + known.reference
    return warm


def _rating_factor(spec: LifeSpec, warm: Array) -> Array:
    """On C by the hottest of rings, balls and oil (speeds, bearings)."""
    oil = np.nan if spec.lubricant is None else spec.lubricant.temperature
    return hot_rating(np.fmax(np.fmax.reduce(warm, axis=-1), oil))


def _oil_temperatures(scene: Scene, spec: LifeSpec, warm: Array) -> dict[int, Array]:
    """Of the oil by batch of states (speeds, columns) [°C]: that of the balls where it follows from
    their heat, else as given."""
    given = math.nan if spec.lubricant is None else spec.lubricant.temperature
    balanced = scene.conditions.heat_flow is not None
    oiled: dict[int, Array] = {}
    for k, (balls, column) in enumerate(scene.preload.seat_states()):
        oil = oiled.setdefault(id(balls), np.full(balls.outcome.shape, given))
        if balanced:
            oil[:, column] = warm[:, k, 0]
    return oiled


class _Rated(NamedTuple):
    """C and C0 of one bearing [N], C0 over that of its grooves."""

    dynamic: float
    static: float
    static_share: float


class _Ratings(NamedTuple):
    """C and C0 used, and those of the grooves, of every bearing (bearings,) [N]."""

    dynamic: Array
    of_grooves: Array
    static: Array
    static_of_grooves: Array

    def of(self, k: int) -> _Rated:
        """Of bearing number ``k``."""
        static = float(self.static[k])
        return _Rated(float(self.dynamic[k]), static, static / float(self.static_of_grooves[k]))


def _ratings(spindle: Spindle, spec: LifeSpec) -> _Ratings:
    found: list[Array] = []
    for given, computed in (
        (spec.dynamic_ratings, bearings.life.dynamic_rating),
        (spec.static_ratings, bearings.life.static_rating),
    ):
        grooves = [computed(seat.bearing) for seat in spindle.seats]
        pairs = zip(spindle.seats, grooves, strict=True)
        used = [given.get(seat.name, value) for seat, value in pairs]
        found += [np.array(used), np.array(grooves)]
    return _Ratings(*found)


def _of_bearings(state: BearingState, rated: _Rated, spec: LifeSpec, oil: Array) -> Values:
    """Every quantity of the bearings of one model over speed (speeds, bearings)."""
    lived = bearings.life.life_of(state, rated.dynamic)
    cut = bearings.truncation(state)
    orders = bearings.life.frequencies(state)
    hertz = np.asarray(state.speed) / (2.0 * math.pi)
    with np.errstate(divide="ignore", invalid="ignore"):
        life = lived.revolutions / hertz
    spin = np.maximum(np.abs(state.inner_spin_to_roll), np.abs(state.outer_spin_to_roll))
    return {
        "revolutions": lived.revolutions,
        "life": life,
        "limiting": lived.limiting,
        "equivalent_load": lived.equivalent_load,
        "static_safety": bearings.life.static_safety(state) * rated.static_share,
        "pressure": np.asarray(state.contact_pressure).max(axis=(-2, -1)),
        "ellipse_length": cut.major.max(axis=(-2, -1)),
        "shoulder_margin": _least(cut.shoulder_margin),
        "lost_load": cut.lost_load.max(axis=(-2, -1)),
        "spin_to_roll": spin.max(axis=-1),
        "cage": orders.cage,
        "outer": orders.outer,
        "inner": orders.inner,
        "ball": orders.ball,
        **_oiled(state, lived, life, spec, oil, rated.static),
    }


def _oiled(
    state: BearingState,
    lived: bearings.life.ReferenceLife,
    life: Array,
    spec: LifeSpec,
    at: Array,
    static: float,
) -> Values:
    """What depends on the lubricant, the oil ``at`` its temperatures [°C], and C0 ``static`` [N];
    NaN without one."""
    lubricant = spec.lubricant
    if lubricant is None:
        nothing = {name: np.full_like(life, np.nan) for name in OIL_FIELDS}
        return {**nothing, "slips": np.zeros(life.shape, dtype=bool)}
    lost = bearings.heat.losses(
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
    factor = bearings.life.life_factor(kappa, lubricant.contamination, limit, lived.equivalent_load)
    if is_thrust(state.operation.grooves):
        factor = np.full_like(factor, np.nan)
    return {
        "inner_heat": lost.inner,
        "outer_heat": lost.outer,
        "spin_heat": lost.spin,
        "viscous_heat": lost.viscous,
        "moment": lost.moment,
        "slips": lost.slips,
        "viscosity_ratio": kappa,
        **_films(state, lubricant, at),
        "life_factor": factor,
        "modified_life": bearings.life.reliability_factor(spec.reliability) * factor * life,
    }


def _films(state: BearingState, lubricant: Lubrication, at: Array) -> Values:
    """Least film of the loaded contacts, and its least ratio to the roughness; 0 without load."""
    films = bearings.film.film(state, lubricant.oil, at)
    loaded = np.asarray(state.contact_load) > 0.0
    some = loaded.any(axis=(-2, -1))
    ratio = films.ratio(lubricant.ball_roughness, lubricant.race_roughness)
    return {
        name: np.where(some, np.where(loaded, values, np.inf).min(axis=(-2, -1)), 0.0)
        for name, values in (("film", films.least), ("film_ratio", ratio))
    }


def _least(margin: Array) -> Array:
    """Over balls and contacts, NaN where no contact has a margin."""
    least = np.where(np.isnan(margin), np.inf, margin).min(axis=(-2, -1))
    return np.where(np.isfinite(least), least, np.nan)


def _spectrum(scene: Scene, spec: LifeSpec, ratings: _Ratings) -> tuple[Array, Array, Array]:
    """Life [s] and least static safety of every bearing under the load spectrum, and the share of
    the time in which it turns without any load; NaN without a spectrum (bearings,)."""
    if not spec.spectrum:
        nothing = np.full(len(ratings.static), np.nan)
        return nothing, nothing, nothing
    steps = [_step(scene, spec, place, ratings) for place in range(len(spec.spectrum))]
    lives, safety, idle = (np.array(each) for each in zip(*steps, strict=True))
    shares = np.array([step.share for step in spec.spectrum])
    turning = shares * [step.speed > 0.0 for step in spec.spectrum]
    unloaded = turning @ idle / shares.sum()
    return np.asarray(bearings.life.mean_life(shares, lives)), safety.min(axis=0), unloaded


def _step(
    scene: Scene, spec: LifeSpec, place: int, ratings: _Ratings
) -> tuple[list[float], list[float], list[bool]]:
    """Life of every bearing under one step alone [s], infinite at rest, its static safety, and
    whether its inner ring presses on no ball; with the loads of the conditions besides.

    Raises
    ------
    InvalidInput : loads under which the machine, or a bearing, has no state
    """
    given, step = scene.conditions, spec.spectrum[place]
    conditions = replace(
        given,
        axial_force=given.axial_force + step.axial_force,
        loads=(*given.loads, *step.loads),
    )
    there = scene.at(np.array([step.speed])).under(conditions)
    if there.outcome[0]:
        raise InvalidInput(
            f"life: spectrum.{place + 1} at {step.speed * RPM.factor:.6g} rpm has no physical "
            f"solution: {there.outcome[0]}; change the loads or the speed of this step"
        )
    hot = ratings.dynamic * _rating_factor(spec, _temperatures(there))[0]
    lives, safety, idle = [], [], []
    share = ratings.static / ratings.static_of_grooves
    for seat, (balls, column), rated, more in zip(
        scene.spindle.seats, there.preload.seat_states(), hot, share, strict=True
    ):
        state, at = balls, column
        if step.radial.get(seat.name, 0.0) > 0.0:
            state, at = _under_radial_load(scene, step, seat, balls, column), 0
        revolutions = float(bearings.life.reference_life(state, float(rated)).flat[at])
        if math.isnan(revolutions):
            raise InvalidInput(
                f"life: spectrum.{place + 1}.radial.{seat.name}: no state under this load: given "
                f"{step.radial[seat.name]:.6g} N; allowed: what the bearing bears; lower it"
            )
        lives.append(revolutions * 2.0 * math.pi / step.speed if step.speed else np.inf)
        safety.append(float(more * bearings.life.static_safety(state).flat[at]))
        pressed = np.reshape(state.inner_load, (-1, np.shape(state.inner_load)[-1]))[at]
        idle.append(not (pressed > 0.0).any())
    return lives, safety, idle


def _under_radial_load(
    scene: Scene,
    step: LoadStep,
    seat: BearingSeat,
    balls: BearingState,
    column: int,
) -> BearingState:
    """A bearing that keeps its axial load and growth, untilted."""
    law, operation = seat.law(scene.law), balls.operation
    static, growth = (
        each.reshape(operation.shape)[:1, column]
        for each in (operation.static_growth, operation.growth)
    )
    return scene.spindle.mounted(seat).equilibrium(
        load=[float(balls.load[0, column, 0]), step.radial[seat.name], 0.0, np.nan, np.nan],
        displacement=[np.nan, np.nan, np.nan, 0.0, 0.0],
        speed=[step.speed],
        static_growth=static,
        growth=growth,
        **asdict(law),
    )
