"""A single bearing over axial load and speed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import bearings
from bearings.bearing import BallBearing
from bearings.ring.state import BearingState
from rotordyn.analysis.display import RPM
from rotordyn.analysis.preload import BALL_QUANTITIES, FREEDOMS
from rotordyn.analysis.results import BearingMapResult
from rotordyn.analysis.results.kinds import Array
from rotordyn.analysis.specs import BearingMapSpec, Conditions
from rotordyn.errors import NoSolution
from rotordyn.machine.limits import HIGHEST_PRESSURE

SHOWN = (*BALL_QUANTITIES, "inner_spin_to_roll", "outer_spin_to_roll")


def answer(
    bearing: BallBearing, conditions: Conditions, speed: Array, spec: BearingMapSpec
) -> BearingMapResult:
    """State and tangent of ``bearing`` at every speed and load, tilts blocked.

    Raises
    ------
    NoSolution : no combination has a physical state
    """
    loads = np.zeros((len(speed), len(spec.loads), 5))
    loads[..., 0] = spec.loads
    state = bearing.equilibrium(
        load=loads,
        speed=speed[:, None] if conditions.bearings == "dynamic" else 0.0,
        static_growth=spec.static_growth,
        kinematics=conditions.kinematics,
        moment_sharing=conditions.moment_sharing,
        friction=conditions.law.friction,
    )
    outcome = _outcomes(speed, spec.loads, state)
    if (outcome != "").all():
        raise NoSolution(f"no load and speed of the case has a state: {outcome.flat[0]}")
    balls = {name: _where(outcome, getattr(state, name)[..., 0]) for name in SHOWN}
    good = outcome == ""
    tangents = [bearings.stiffness(state, t) for t in spec.tangents]
    return BearingMapResult(
        speed=speed,
        load=np.array(spec.loads),
        tangent=spec.tangents,
        dof=FREEDOMS,
        dof_other=FREEDOMS,
        outcome=outcome,
        deflection=_where(outcome, state.displacement[..., 0]),
        stiffness=_where(outcome, np.stack(tangents, axis=2)),
        slipping=np.where(good, state.slipping[..., 0], ""),
        control=np.where(good, state.control[..., 0], ""),
        control_agrees=good & state.control_agrees[..., 0],
        **balls,
    )


def tangent_error(result: BearingMapResult, tangent: str, freedom: str) -> Array:
    """Diagonal entry of ``tangent`` over that of the complete tangent, less 1 (speeds, loads)."""
    own, complete = (result.tangent.index(name) for name in (tangent, "complete"))
    place = result.dof.index(freedom)
    entry = result.stiffness[..., place, place]
    return np.asarray(entry[..., own] / entry[..., complete] - 1.0)


def _outcomes(speed: Array, loads: tuple[float, ...], state: BearingState) -> NDArray[np.str_]:
    """Empty where a state counts, else a sentence with its speed and load (speeds, loads)."""
    peak = np.fmax(state.inner_pressure, state.outer_pressure)[..., 0]
    words = np.where(
        peak > HIGHEST_PRESSURE,
        f"overloaded (peak pressure above {HIGHEST_PRESSURE / 1e9:g} GPa)",
        state.outcome,
    ).astype(object)
    for row, column in np.argwhere(words != ""):
        rpm = speed[row] * RPM.factor
        words[row, column] += f" at {rpm:.0f} rpm under {loads[column]:g} N"
    return words.astype(str)


def _where(outcome: NDArray[np.str_], values: Array) -> Array:
    """Values where the state counts, NaN where the outcome says why it does not."""
    good = (outcome == "").reshape(outcome.shape + (1,) * (values.ndim - outcome.ndim))
    return np.where(good, values, np.nan)
