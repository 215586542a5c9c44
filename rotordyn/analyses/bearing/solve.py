"""A single bearing over load and speed."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import bearings
from bearings.bearing import BallBearing
from bearings.heat.mounted import Mounting, ThermalState
from bearings.ring.condition import remedy
from bearings.ring.motion import ball_motion
from bearings.ring.state import BearingState
from rotordyn.analyses.bearing.result import BearingMapResult, MomentMapResult, RadialMapResult
from rotordyn.analyses.bearing.spec import AXIAL, FIXED, MOMENT, RADIAL, BearingMapSpec
from rotordyn.arrays import Array
from rotordyn.errors import NoSolution
from rotordyn.machine.limits import HIGHEST_PRESSURE
from rotordyn.results.balls import BALL_QUANTITIES, DOFS, races
from rotordyn.results.declaration import declared
from rotordyn.results.display import RPM
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.lubrication import hot_rating

SHOWN = (*BALL_QUANTITIES, "inner_spin_to_roll", "outer_spin_to_roll")
RESULTS = {AXIAL: BearingMapResult, RADIAL: RadialMapResult, MOMENT: MomentMapResult}
PLACES = {AXIAL: 0, RADIAL: 1, MOMENT: 4}  # of a component in (Fx, Fy, Fz, My, Mz)
TILTS = [3, 4]
SAME = 1e-3  # of a load: less is rounding of a load that a spring holds


def solve(
    bearing: BallBearing, conditions: Conditions, speed: Array, spec: BearingMapSpec
) -> BearingMapResult:
    """Solve state and tangent of ``bearing`` at every speed and load.

    Raises
    ------
    NoSolution : no combination has a physical state
    """
    bearing = spec.mounted(bearing)
    solved = _solved(bearing, conditions, speed, spec)
    state = solved.state
    outcome = _outcomes(speed, spec, solved)
    if (outcome != "").all():
        raise NoSolution(f"no load and speed of the case has a solution: {outcome.flat[0]}")
    valid = outcome == ""
    ball = np.argmax(np.nan_to_num(state.contact_load).max(axis=-1), axis=-1)

    def loaded(values: NDArray[Any]) -> NDArray[Any]:
        """Return values of the ball with the largest contact load."""
        return np.take_along_axis(values, ball[..., None], axis=-1)[..., 0]

    tangents = (
        [bearings.stiffness(state, t) for t in spec.tangents]
        if solved.stiffness is None
        else [solved.stiffness]
    )
    balls: dict[str, Any] = {n: _valid(outcome, loaded(getattr(state, n))) for n in SHOWN}
    displacement = _valid(outcome, solved.displacement)
    return RESULTS[spec.swept](
        speed=speed,
        load=np.array(spec.values),
        tangent=spec.tangents,
        dof=DOFS,
        dof_other=DOFS,
        outcome=outcome,
        axial_force=_valid(outcome, state.load[..., 0]),
        deflection=displacement[..., 0],
        radial_deflection=displacement[..., 1],
        tilt=displacement[..., 4],
        stiffness=_valid(outcome, np.stack(tangents, axis=2)),
        loaded_ball=ball,
        required_friction=_valid(outcome, _required_friction(state)),
        slipping=np.where(valid, races(np.where(state.driven, state.slipping, "")), ""),
        open_side=np.where(valid, (state.status == "open side").sum(axis=-1), 0),
        control=np.where(valid, loaded(state.control), ""),
        control_agrees=valid & loaded(state.control_agrees),
        attitude=_valid(outcome, loaded(ball_motion(state).attitude)),
        **balls,
        **_life(bearing, solved, outcome, spec),
        **_heat(bearing, conditions, solved, outcome, spec),
        **_contacts(bearing, state, outcome, spec),
    )


def _required_friction(state: BearingState) -> Array:
    """Return the largest friction coefficient that a driven ball requires."""
    both = np.fmax(state.inner_required_friction, state.outer_required_friction)
    return np.asarray(np.where(state.driven, both, 0.0).max(axis=-1))


class _Solved(NamedTuple):
    """States over speed and load; ``displacement`` and, with films, ``stiffness`` of the ring,
    ``temperature`` of the oil [°C], ``growth`` of the balls by films [m], ``hot``: with heat."""

    state: BearingState
    displacement: Array
    temperature: Array
    growth: Array
    stiffness: Array | None = None
    hot: ThermalState | None = None


def _solved(
    bearing: BallBearing, conditions: Conditions, speed: Array, spec: BearingMapSpec
) -> _Solved:
    oil = math.nan if spec.lubricant is None else spec.lubricant.temperature
    if spec.heat_flow is not None:
        hot = bearings.heat.heated(
            bearing,
            _mounting(conditions, spec),
            speed=speed[:, None],
            preload=np.array(spec.values),
        )
        state = hot.state
        no_growth = np.zeros(state.outcome.shape)
        return _Solved(state, hot.displacement, hot.temperatures.balls, no_growth, hot=hot)
    loads = np.zeros((len(speed), len(spec.values), 5))
    for component, index in PLACES.items():
        loads[..., index] = getattr(spec, FIXED[component])
    loads[..., PLACES[spec.swept]] = spec.values
    blocked = None
    if spec.tilt == "blocked":
        loads[..., TILTS] = np.nan
        blocked = np.where(np.isnan(loads), 0.0, np.nan)
    law = conditions.law
    request: dict[str, Any] = {
        "load": loads,
        "displacement": blocked,
        "speed": speed[:, None] if conditions.bearings == "dynamic" else 0.0,
        "static_growth": spec.static_growth,
    }
    if spec.films and spec.lubricant is not None:
        riding = bearings.on_film.on_film(bearing, spec.lubricant.oil, oil, **request, law=law)
        growth = np.hypot(riding.growth, riding.axial)
        displacement = riding.displacement
        return _Solved(riding.state, displacement, np.asarray(oil), growth, riding.stiffness)
    state = bearing.equilibrium(**request, **asdict(law))
    return _Solved(state, state.displacement, np.asarray(oil), np.zeros(state.outcome.shape))


def _mounting(conditions: Conditions, spec: BearingMapSpec) -> Mounting:
    lubricant, flow = spec.lubricant, spec.heat_flow
    assert lubricant is not None
    assert flow is not None
    return Mounting(
        lubricant.oil,
        flow.conductances,
        flow.surroundings,
        rigid=flow.mounting == "rigid",
        friction=lubricant.friction,
        oil_factor=bearings.heat.OIL_FACTORS[lubricant.supply],
        model=spec.heat,
        law=conditions.law,
        static_growth=spec.static_growth,
    )


def _heat(
    bearing: BallBearing,
    conditions: Conditions,
    solved: _Solved,
    outcome: NDArray[np.str_],
    spec: BearingMapSpec,
) -> dict[str, Any]:
    """Return temperatures, speed limits and growth by films; NaN where not computed."""
    names = ("ball_temperature", "inner_temperature", "outer_temperature")
    growth = {"film_growth": _valid(outcome, solved.growth)}
    if solved.hot is None:
        missing = {name: np.full(outcome.shape, np.nan) for name in names}
        return {**growth, **missing, "speed_limit": np.full(outcome.shape[1], np.nan)}
    temperatures = {
        name: _valid(outcome, values)
        for name, values in zip(names, solved.hot.temperatures[:3], strict=True)
    }
    return {**growth, **temperatures, "speed_limit": _limits(bearing, conditions, solved, spec)}


def _limits(
    bearing: BallBearing, conditions: Conditions, solved: _Solved, spec: BearingMapSpec
) -> Array:
    """Return the speed above which temperatures reach no balance, within the case (loads,)."""
    assert solved.hot is not None
    unbalanced, speed = solved.hot.outcome != "", np.asarray(solved.state.speed)[:, 0]
    limit = np.full(len(spec.values), np.nan)
    limited = np.flatnonzero(unbalanced.any(axis=0))
    if not limited.size:
        return limit
    first = unbalanced[:, limited].argmax(axis=0)
    limit[limited] = bearings.heat.speed_limit(
        bearing,
        _mounting(conditions, spec),
        preload=np.array(spec.values)[limited],
        slowest=np.where(first > 0, speed[first - 1], 0.0),
        fastest=speed[first],
    )
    return limit


def _life(
    bearing: BallBearing, solved: _Solved, outcome: NDArray[np.str_], spec: BearingMapSpec
) -> dict[str, Any]:
    """Return life and safety; heat and film where there is oil."""
    state = solved.state
    life = bearings.life.life_of(state, spec.dynamic_rating)
    rating_factor = hot_rating(solved.temperature)
    computed: dict[str, Array] = {
        "revolutions": life.revolutions * rating_factor**3,
        "rating_factor": rating_factor,
        "equivalent_load": life.equivalent_load,
        "static_safety": bearings.life.static_safety(state),
        **dict.fromkeys(("contact_heat", "spin_heat", "viscous_heat", "film"), np.asarray(np.nan)),
    }
    if (lubricant := spec.lubricant) is not None:
        factor = bearings.heat.OIL_FACTORS[lubricant.supply]
        losses = bearings.heat.losses(
            state,
            lubricant.oil,
            solved.temperature,
            friction=lubricant.friction,
            oil_factor=factor,
            model=spec.heat,
        )
        films = bearings.film.film(state, lubricant.oil, solved.temperature).least
        least = np.where(np.asarray(state.contact_load) > 0.0, films, np.inf).min(axis=(-2, -1))
        computed |= {
            "contact_heat": losses.inner + losses.outer,
            "spin_heat": losses.spin,
            "viscous_heat": losses.viscous,
            "film": np.where(np.isfinite(least), least, 0.0),
        }
    shown = {
        name: _valid(outcome, np.broadcast_to(values, outcome.shape))
        for name, values in computed.items()
    }
    grooves = float(bearings.life.dynamic_rating(bearing))
    return {
        **shown,
        "limiting": np.where(outcome == "", life.limiting, ""),
        "dynamic_rating": grooves if spec.dynamic_rating is None else spec.dynamic_rating,
        "groove_rating": grooves,
    }


def _contacts(
    bearing: BallBearing, state: BearingState, outcome: NDArray[np.str_], spec: BearingMapSpec
) -> dict[str, Any]:
    """Return results by contact: of all balls where they differ, else of one."""
    count = bearing.balls if spec.combined else 1
    truncation = bearings.truncation(state)
    by_contact = {
        "contact_load": state.contact_load,
        "contact_angle": state.contact_angle,
        "contact_pressure": state.contact_pressure,
        "ring_deflection": bearings.ring_deflection(state).normal,
        "ellipse_length": truncation.major,
        "ellipse_width": truncation.minor,
        "ellipse_lower": truncation.lower_end,
        "ellipse_upper": truncation.upper_end,
        "truncated": truncation.lost,
    }
    return {
        "ball": 2.0 * np.pi / bearing.balls * np.arange(count),
        "contact": bearing.contact_names,
        "contacts": np.where((outcome == "")[..., None], state.contacts[..., :count], 0),
        "shoulder_angle": truncation.shoulder_angle,
        "middle_angle": truncation.middle_angle,
        **{name: _valid(outcome, values[..., :count, :]) for name, values in by_contact.items()},
    }


def under(result: BearingMapResult, place: int, axial: str = "") -> str:
    """Return a load of the list as text: 250 N (``axial`` appended), 2000 N radial, 300 N·m."""
    unit = declared(result)["load"].metadata["unit"]
    text = f"{result.load[place]:g} {unit}"
    if isinstance(result, RadialMapResult):
        return f"{text} radial"
    return text if isinstance(result, MomentMapResult) else text + axial


def mounted_under(result: BearingMapResult, place: int, axial: str = "") -> str:
    """Return ``under``, with "as mounted" where heat changes the load in operation."""
    mounted = result.load[place]
    work = result.axial_force[np.isfinite(result.ball_temperature[:, place]), place]
    differs = (np.abs(work - mounted) > SAME * mounted).any()
    return under(result, place, axial) + " as mounted" * bool(differs)


def tangent_error(result: BearingMapResult, tangent: str, dof: str) -> Array:
    """Return the relative error of a diagonal entry to the complete tangent (speeds, loads)."""
    chosen, complete = (result.tangent.index(name) for name in (tangent, "complete"))
    k = result.dof.index(dof)
    entry = result.stiffness[..., k, k]
    return np.asarray(entry[..., chosen] / entry[..., complete] - 1.0)


def _outcomes(speed: Array, spec: BearingMapSpec, solved: _Solved) -> NDArray[np.str_]:
    """Return outcomes (speeds, loads): empty where valid, else a sentence with speed and load."""
    state = solved.state
    peak = np.fmax(state.inner_pressure, state.outer_pressure).max(axis=-1)
    sentences = np.where(
        peak > HIGHEST_PRESSURE,
        f"overloaded (peak pressure above {HIGHEST_PRESSURE / 1e9:g} GPa)",
        state.outcome,
    ).astype(object)
    if solved.hot is not None:
        sentences = np.where(solved.hot.outcome != "", solved.hot.outcome.astype(object), sentences)
    unit = {AXIAL: "N", RADIAL: "N radial", MOMENT: "N·m"}[spec.swept]
    for row, column in np.argwhere(sentences != ""):
        rpm = speed[row] * RPM.factor
        advice = f": {remedy(state)}" if sentences[row, column] == "no equilibrium" else ""
        sentences[row, column] += f" at {rpm:.0f} rpm under {spec.values[column]:g} {unit}{advice}"
    return sentences.astype(str)


def _valid(outcome: NDArray[np.str_], values: Array) -> Array:
    """Return values where the state is valid, NaN where the outcome says why it is not."""
    valid = (outcome == "").reshape(outcome.shape + (1,) * (values.ndim - outcome.ndim))
    return np.where(valid, values, np.nan)
