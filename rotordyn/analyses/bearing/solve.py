"""A single bearing over load and speed."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import bearings
from bearings.bearing import BallBearing
from bearings.heat.mounted import Heated, Mounting
from bearings.ring.condition import remedy
from bearings.ring.motion import ball_motion
from bearings.ring.state import BearingState
from rotordyn.analyses.bearing.result import BearingMapResult, MomentMapResult, RadialMapResult
from rotordyn.analyses.bearing.spec import AXIAL, FIXED, MOMENT, RADIAL, BearingMapSpec
from rotordyn.errors import NoSolution
from rotordyn.machine.limits import HIGHEST_PRESSURE
from rotordyn.results.balls import BALL_QUANTITIES, DOFS
from rotordyn.results.declaration import declared
from rotordyn.results.display import RPM
from rotordyn.results.kinds import Array
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.lubrication import hot_rating

SHOWN = (*BALL_QUANTITIES, "inner_spin_to_roll", "outer_spin_to_roll")
RESULTS = {AXIAL: BearingMapResult, RADIAL: RadialMapResult, MOMENT: MomentMapResult}
PLACES = {AXIAL: 0, RADIAL: 1, MOMENT: 4}  # of a component in (Fx, Fy, Fz, My, Mz)
TILTS = [3, 4]
SAME = 1e-3  # of a load: what a spring holds at work but for rounding


def answer(
    bearing: BallBearing, conditions: Conditions, speed: Array, spec: BearingMapSpec
) -> BearingMapResult:
    """State and tangent of ``bearing`` at every speed and load.

    Raises
    ------
    NoSolution : no combination has a physical state
    """
    bearing = spec.mounted(bearing)
    solved = _solved(bearing, conditions, speed, spec)
    state = solved.state
    outcome = _outcomes(speed, spec, solved)
    if (outcome != "").all():
        raise NoSolution(f"no load and speed of the case has a state: {outcome.flat[0]}")
    good = outcome == ""
    most = np.argmax(np.nan_to_num(state.contact_load).max(axis=-1), axis=-1)

    def there(values: NDArray[Any]) -> NDArray[Any]:
        """Of the ball with the largest contact load."""
        return np.take_along_axis(values, most[..., None], axis=-1)[..., 0]

    tangents = (
        [bearings.stiffness(state, t) for t in spec.tangents]
        if solved.stiffness is None
        else [solved.stiffness]
    )
    balls: dict[str, Any] = {n: _where(outcome, there(getattr(state, n))) for n in SHOWN}
    moved = _where(outcome, solved.displacement)
    return RESULTS[spec.swept](
        speed=speed,
        load=np.array(spec.values),
        tangent=spec.tangents,
        dof=DOFS,
        dof_other=DOFS,
        outcome=outcome,
        axial_force=_where(outcome, state.load[..., 0]),
        deflection=moved[..., 0],
        radial_deflection=moved[..., 1],
        tilt=moved[..., 4],
        stiffness=_where(outcome, np.stack(tangents, axis=2)),
        loaded_ball=most,
        slipping=np.where(good, there(state.slipping), ""),
        control=np.where(good, there(state.control), ""),
        control_agrees=good & there(state.control_agrees),
        attitude=_where(outcome, there(ball_motion(state).attitude)),
        **balls,
        **_life(bearing, solved, outcome, spec),
        **_heat(bearing, conditions, solved, outcome, spec),
        **_contacts(bearing, state, outcome, spec),
    )


class _Solved(NamedTuple):
    """States over speed and load; ``displacement`` and, where films act, ``stiffness`` of the ring,
    ``temperature`` of the oil [°C], ``growth`` of the balls by films [m], ``hot``: with heat."""

    state: BearingState
    displacement: Array
    temperature: Array
    growth: Array
    stiffness: Array | None = None
    hot: Heated | None = None


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
        cold = np.zeros(state.outcome.shape)
        return _Solved(state, hot.displacement, hot.temperatures.balls, cold, hot=hot)
    loads = np.zeros((len(speed), len(spec.values), 5))
    for component, place in PLACES.items():
        loads[..., place] = getattr(spec, FIXED[component])
    loads[..., PLACES[spec.swept]] = spec.values
    held = None
    if spec.tilt == "blocked":
        loads[..., TILTS] = np.nan
        held = np.where(np.isnan(loads), 0.0, np.nan)
    law = conditions.law
    asked: dict[str, Any] = {
        "load": loads,
        "displacement": held,
        "speed": speed[:, None] if conditions.bearings == "dynamic" else 0.0,
        "static_growth": spec.static_growth,
    }
    if spec.films and spec.lubricant is not None:
        ridden = bearings.on_film.on_film(bearing, spec.lubricant.oil, oil, **asked, law=law)
        grown = np.hypot(ridden.growth, ridden.axial)
        moved = ridden.displacement
        return _Solved(ridden.state, moved, np.asarray(oil), grown, ridden.stiffness)
    state = bearing.equilibrium(**asked, **asdict(law))
    return _Solved(state, state.displacement, np.asarray(oil), np.zeros(state.outcome.shape))


def _mounting(conditions: Conditions, spec: BearingMapSpec) -> Mounting:
    oiled, flow = spec.lubricant, spec.heat_flow
    assert oiled is not None
    assert flow is not None
    return Mounting(
        oiled.oil,
        flow.conductances,
        flow.surroundings,
        rigid=flow.mounting == "rigid",
        friction=oiled.friction,
        oil_factor=bearings.heat.OIL_FACTORS[oiled.supply],
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
    """Temperatures, speed limits and growth by films; NaN where nothing is known of them."""
    names = ("ball_temperature", "inner_temperature", "outer_temperature")
    grown = {"film_growth": _where(outcome, solved.growth)}
    if solved.hot is None:
        nothing = {name: np.full(outcome.shape, np.nan) for name in names}
        return {**grown, **nothing, "speed_limit": np.full(outcome.shape[1], np.nan)}
    reached = {
        name: _where(outcome, each)
        for name, each in zip(names, solved.hot.temperatures[:3], strict=True)
    }
    return {**grown, **reached, "speed_limit": _limits(bearing, conditions, solved, spec)}


def _limits(
    bearing: BallBearing, conditions: Conditions, solved: _Solved, spec: BearingMapSpec
) -> Array:
    """Speed above which temperatures reach no balance, between those of the case (loads,)."""
    assert solved.hot is not None
    fails, speed = solved.hot.outcome != "", np.asarray(solved.state.speed)[:, 0]
    limit = np.full(len(spec.values), np.nan)
    ends = np.flatnonzero(fails.any(axis=0))
    if not ends.size:
        return limit
    first = fails[:, ends].argmax(axis=0)
    limit[ends] = bearings.heat.speed_limit(
        bearing,
        _mounting(conditions, spec),
        preload=np.array(spec.values)[ends],
        slowest=np.where(first > 0, speed[first - 1], 0.0),
        fastest=speed[first],
    )
    return limit


def _life(
    bearing: BallBearing, solved: _Solved, outcome: NDArray[np.str_], spec: BearingMapSpec
) -> dict[str, Any]:
    """Life and safety; heat and film where there is oil."""
    state = solved.state
    lived = bearings.life.life_of(state, spec.dynamic_rating)
    hot = hot_rating(solved.temperature)
    computed: dict[str, Array] = {
        "revolutions": lived.revolutions * hot**3,
        "rating_factor": hot,
        "equivalent_load": lived.equivalent_load,
        "static_safety": bearings.life.static_safety(state),
        **dict.fromkeys(("contact_heat", "spin_heat", "viscous_heat", "film"), np.asarray(np.nan)),
    }
    if (oiled := spec.lubricant) is not None:
        factor = bearings.heat.OIL_FACTORS[oiled.supply]
        lost = bearings.heat.losses(
            state,
            oiled.oil,
            solved.temperature,
            friction=oiled.friction,
            oil_factor=factor,
            model=spec.heat,
        )
        films = bearings.film.film(state, oiled.oil, solved.temperature).least
        least = np.where(np.asarray(state.contact_load) > 0.0, films, np.inf).min(axis=(-2, -1))
        computed |= {
            "contact_heat": lost.inner + lost.outer,
            "spin_heat": lost.spin,
            "viscous_heat": lost.viscous,
            "film": np.where(np.isfinite(least), least, 0.0),
        }
    shown = {
        name: _where(outcome, np.broadcast_to(values, outcome.shape))
        for name, values in computed.items()
    }
    grooves = float(bearings.life.dynamic_rating(bearing))
    return {
        **shown,
        "limiting": np.where(outcome == "", lived.limiting, ""),
        "dynamic_rating": grooves if spec.dynamic_rating is None else spec.dynamic_rating,
        "groove_rating": grooves,
    }


def _contacts(
    bearing: BallBearing, state: BearingState, outcome: NDArray[np.str_], spec: BearingMapSpec
) -> dict[str, Any]:
    """What results have by contact: of all balls where they differ, else of one."""
    count = bearing.balls if spec.combined else 1
    cut = bearings.truncation(state)
    by_contact = {
        "contact_load": state.contact_load,
        "contact_angle": state.contact_angle,
        "contact_pressure": state.contact_pressure,
        "ring_deflection": bearings.ring_deflection(state).normal,
        "ellipse_length": cut.major,
        "ellipse_width": cut.minor,
        "ellipse_lower": cut.lower_end,
        "ellipse_upper": cut.upper_end,
        "truncated": cut.lost,
    }
    return {
        "ball": 2.0 * np.pi / bearing.balls * np.arange(count),
        "contact": bearing.contact_names,
        "contacts": np.where((outcome == "")[..., None], state.contacts[..., :count], 0),
        "shoulder_angle": cut.shoulder_angle,
        "middle_angle": cut.middle_angle,
        **{name: _where(outcome, each[..., :count, :]) for name, each in by_contact.items()},
    }


def under(result: BearingMapResult, place: int, axial: str = "") -> str:
    """A load of the list in words: 250 N (with ``axial`` behind it), 2000 N radial, 300 N·m."""
    unit = declared(result)["load"].metadata["unit"]
    words = f"{result.load[place]:g} {unit}"
    if isinstance(result, RadialMapResult):
        return f"{words} radial"
    return words if isinstance(result, MomentMapResult) else words + axial


def mounted_under(result: BearingMapResult, place: int, axial: str = "") -> str:
    """The same, and that it is the load as mounted where heat makes it another one at work."""
    given = result.load[place]
    work = result.axial_force[np.isfinite(result.ball_temperature[:, place]), place]
    differs = (np.abs(work - given) > SAME * given).any()
    return under(result, place, axial) + " as mounted" * bool(differs)


def tangent_error(result: BearingMapResult, tangent: str, dof: str) -> Array:
    """Diagonal entry of ``tangent`` over that of the complete tangent, less 1 (speeds, loads)."""
    chosen, complete = (result.tangent.index(name) for name in (tangent, "complete"))
    place = result.dof.index(dof)
    entry = result.stiffness[..., place, place]
    return np.asarray(entry[..., chosen] / entry[..., complete] - 1.0)


def _outcomes(speed: Array, spec: BearingMapSpec, solved: _Solved) -> NDArray[np.str_]:
    """Empty where a state counts, else a sentence with its speed and load (speeds, loads)."""
    state = solved.state
    peak = np.fmax(state.inner_pressure, state.outer_pressure).max(axis=-1)
    words = np.where(
        peak > HIGHEST_PRESSURE,
        f"overloaded (peak pressure above {HIGHEST_PRESSURE / 1e9:g} GPa)",
        state.outcome,
    ).astype(object)
    if solved.hot is not None:
        words = np.where(solved.hot.outcome != "", solved.hot.outcome.astype(object), words)
    unit = {AXIAL: "N", RADIAL: "N radial", MOMENT: "N·m"}[spec.swept]
    for row, column in np.argwhere(words != ""):
        rpm = speed[row] * RPM.factor
        helps = f": {remedy(state)}" if words[row, column] == "no equilibrium" else ""
        words[row, column] += f" at {rpm:.0f} rpm under {spec.values[column]:g} {unit}{helps}"
    return words.astype(str)


def _where(outcome: NDArray[np.str_], values: Array) -> Array:
    """Values where the state counts, NaN where the outcome says why it does not."""
    good = (outcome == "").reshape(outcome.shape + (1,) * (values.ndim - outcome.ndim))
    return np.where(good, values, np.nan)
