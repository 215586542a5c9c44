"""A single bearing over axial load and speed."""

from __future__ import annotations

import numpy as np

from bearings.angular_contact import AngularContactBallBearing
from rotordyn.analysis.preload import BALL_QUANTITIES, FREEDOMS
from rotordyn.analysis.results import Array, BearingMapResult
from rotordyn.analysis.specs import BearingMapSpec, Conditions
from rotordyn.errors import NoSolution


def answer(
    bearing: AngularContactBallBearing, conditions: Conditions, speed: Array, spec: BearingMapSpec
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
    )
    if (state.outcome != "").all():
        raise NoSolution(f"no load and speed of the case has a state: {state.outcome.flat[0]}")
    kept = {"inner_grip", "outer_grip"}
    balls = {n: getattr(state, n)[..., 0] for n in BALL_QUANTITIES if n not in kept}
    return BearingMapResult(
        speed=speed,
        load=np.array(spec.loads),
        dof=FREEDOMS,
        dof_other=FREEDOMS,
        outcome=state.outcome,
        deflection=state.displacement[..., 0],
        stiffness=state.stiffness("complete"),
        **balls,
    )
