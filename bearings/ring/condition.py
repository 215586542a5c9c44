"""Remarks on each state of a batch as text, or the reason why a state does not exist."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearings.arguments import checked
from bearings.arrays import Array, Flags, Index, Words
from bearings.errors import NoEquilibrium
from bearings.grooves import STEEP
from bearings.ring import tolerances as tol
from bearings.ring.operation import Operation
from bearings.ring.request import solved
from bearings.ring.spin_up import Gap, spin_up
from bearings.ring.state import BearingState
from bearings.ring.truncation import truncation

GIVEN = ("displacement", "load and displacement", "load")
RPM = math.pi / 30.0
REMEDIES = {
    "overloaded": "the balls are pressed far out of their grooves; is the unit right?",
    "unloaded": "no load presses the rings together; give a load, or a displacement",
    "no contact angle": "growth leaves no contact angle; reduce the fit, or check its sign",
}


def refusal(state: BearingState) -> NoEquilibrium:
    """Build the error of a single state that does not exist."""
    outcome = str(state.outcome)
    return NoEquilibrium(
        outcome,
        speed=float(state.operation.speed[0]),
        remedy=REMEDIES.get(outcome) or remedy(state),
        look=lambda: str(condition(state)).partition(": ")[2],
    )


def remedy(state: BearingState) -> str:
    """Suggest remedies where there is no equilibrium under the hypotheses of a state."""
    law, free = state.operation.law, state.operation.free
    remedies = ["raise the load" if free.any() else "displace the ring less"]
    if law.dynamics == "frozen":
        return remedies[0]
    remedies.append("lower the speed")
    if law.dynamics == "resultant" and not state.operation.geometry.single:
        remedies.append('look at dynamics "frozen" (it counts the contacts of every ball)')
    if law.friction is None:
        remedies.append("give a limit of friction")
    if not law.one_branch:
        remedies.append("use outer or hybrid kinematics")
    return ", ".join(remedies[:-1]) + f" or {remedies[-1]}"


@checked
def condition(state: BearingState) -> Words:
    """Describe each state (…) as text, ``""`` where all balls carry load as they should.

    ``"unloaded"``, ``"lost contact (balls 3–5)"``, ``"overloaded (pressure 4.6 GPa)"`` beyond the
    4.2 GPa of ISO 76, ``"beyond the groove (balls 2)"``, ``"contact ellipse passes the shoulder of
    the inner ring (balls 0–3), 12 % of its length lost"`` where its diameter is known,
    ``"loaded on the open side (balls 0–3) …"``, ``"an arc presses beyond the middle of its groove
    …"``, ``"gross gyroscopic slip …"``, ``"slips on the inner race (balls 0–4)"``. Where there is
    no state: ``"no contact angle"``, ``"no equilibrium: stiffness vanishes above … rpm at this
    load"``, ``"no equilibrium: balls 2–4 are thrown off a race above … rpm at this load"`` or, far
    out of the grooves, ``"no equilibrium: the inner race lifts balls off the outer race …"``: the
    first speed without a state, spinning up from rest (``bearings.ring.spin_up``); ``"(states again
    from … to … rpm)"`` where some exist above it.
    Balls count from 0.
    """
    refused = np.flatnonzero(state.outcome.reshape(-1) == "no equilibrium")
    ends = iter(endings(state.operation, refused) if refused.size else [])
    remarks, texts = _remarks(state), []
    for k, outcome in enumerate(state.outcome.reshape(-1)):
        phrases = [
            sentence.format(balls=_ranges(balls[k]), most=value[k].max())
            for balls, sentence, value in remarks
            if balls[k].any()
        ]
        if outcome:
            phrases = [f"{outcome}: {next(ends)}" if outcome == "no equilibrium" else outcome]
        texts.append("; ".join(phrases))
    return np.array(texts, dtype=str).reshape(state.outcome.shape)


def endings(operation: Operation, index: Index) -> list[str]:
    """Describe, for each point without equilibrium, the highest speed with one and the cause of its
    loss."""
    gaps = first_gaps(operation, index)
    last = solved(operation.repeated(index, np.array([gap.low for gap in gaps])))
    load = np.minimum(last.inner_load, last.outer_load)
    force = np.abs(last.gyroscopic_moment) / operation.grooves.ball_diameter
    thrown = (load > 0.0) & (force > tol.IMPOSSIBLE * load)
    return [_ending(operation, gap, balls) for gap, balls in zip(gaps, thrown, strict=True)]


def first_gaps(operation: Operation, index: Index) -> list[Gap]:
    """Find the first gap of speed of some operating points; their searches are solved together."""
    jumps = not operation.law.one_branch
    searches = [spin_up(float(operation.speed[k]), jumps=jumps) for k in index]
    speeds, gaps = [next(search) for search in searches], [Gap(0.0)] * len(searches)
    while active := [k for k, requested in enumerate(speeds) if requested.size]:
        row = np.repeat(index[active], [len(speeds[k]) for k in active])
        states = solved(operation.repeated(row, np.concatenate([speeds[k] for k in active])))
        borders = np.cumsum([len(speeds[k]) for k in active])[:-1]
        results = (
            np.split(part, borders) for part in (states.outcome == "", states.inner_load > 0.0)
        )
        for k, *result in zip(active, *results, strict=True):
            try:
                speeds[k] = searches[k].send(tuple(result))
            except StopIteration as end:
                speeds[k], gaps[k] = np.empty(0), end.value
    return gaps


def _ending(operation: Operation, gap: Gap, thrown: Flags) -> str:
    """Describe the cause of the loss of equilibrium at a gap of speed, and where states exist
    again."""
    free = operation.free
    given = GIVEN[int(free.sum() > 0) + free.all()]
    where = f"above {gap.low / RPM:.0f} rpm at this {given}"
    if gap.low == 0.0:
        where = f"as soon as the ring turns at this {given}"
    if gap.again is not None:
        first, last = (f"{speed / RPM:.0f}" for speed in gap.again)
        span = f"from {first} to {last} rpm" if first != last else f"near {first} rpm"
        where += f" (states again{', with gaps,' if gap.broken else ''} {span})"
    if thrown.any():
        return f"balls {_ranges(thrown)} are thrown off a race {where}"
    if not free.any() and operation.law.dynamics == "frozen":  # nothing else ends a convex state
        return f"the inner race lifts balls off the outer race {where}"
    return f"stiffness vanishes {where}"


def _remarks(state: BearingState) -> list[tuple[Flags, str, Array]]:
    """Sentences on states that exist, with the balls (states, balls) and the values they quote."""
    cuts, grooves = truncation(state), state.operation.grooves

    def listed(values: NDArray[Any]) -> NDArray[Any]:
        return values.reshape(-1, state.inner_load.shape[-1])

    pressure = listed(np.maximum(state.inner_pressure, state.outer_pressure)) / 1e9
    angle = listed(np.maximum(np.abs(state.inner_angle), np.abs(state.outer_angle)))
    edge = math.pi * (0.75 if grooves.free_angle > STEEP else 0.5)
    lost, g = 100.0 * cuts.beyond_shoulder, state.operation.geometry
    inner, outer = (listed(lost[..., race].max(axis=-1)) for race in g.races)
    required = listed(np.maximum(state.inner_required_friction, state.outer_required_friction))
    status, slipping = listed(state.status), listed(state.slipping)
    idle = (status == "lost contact") | (status == "unloaded")
    all_idle = idle.all(axis=1, keepdims=True)
    open_side, backwards = status == "open side", state.load[..., 0].reshape(-1, 1) < 0.0
    bare = (
        "loaded on the open side (balls {balls}), where the rings have no shoulder: raise the "
        "thrust"
    )
    passes = (
        "contact ellipse passes the shoulder of the {} ring (balls {{balls}}), "
        "{{most:.2g}} % of its length lost"
    )
    sentences = [
        (pressure > tol.PERMANENT / 1e9, "overloaded (pressure {most:.1f} GPa)", pressure),
        (
            (angle >= edge) & (listed(state.inner_load) > 0.0),
            "beyond the groove (balls {balls})",
            angle,
        ),
        (inner > 0.0, passes.format("inner"), inner),
        (outer > 0.0, passes.format("outer"), outer),
        (
            listed(np.asarray(cuts.across_middle.any(axis=-1))),
            "an arc presses beyond the middle of its groove (balls {balls}): the shim is too small "
            "for two arcs, give none or a larger one",
            angle,
        ),
        (open_side & backwards, f"{bare}, or turn the bearing round", angle),
        (open_side & ~backwards, bare, angle),
        (
            (required > tol.GROSS) & (state.operation.law.friction is None),
            "gross gyroscopic slip (balls {balls} need a friction of {most:.2g}): raise the load, "
            "lower the speed or give a limit of friction",
            required,
        ),
        (idle & all_idle, "unloaded", required),
        (idle & ~all_idle, "lost contact (balls {balls})", required),
    ]
    races = {"inner": "inner race", "outer": "outer race", "both": "both races"}
    return sentences + [
        (slipping == race, f"slips on the {name} (balls {{balls}})", required)
        for race, name in races.items()
    ]


def _ranges(chosen: Flags) -> str:
    """Format the numbers of the chosen balls: 0–3, 7."""
    numbers = np.flatnonzero(chosen)
    runs = np.split(numbers, np.flatnonzero(np.diff(numbers) > 1) + 1)
    return ", ".join(f"{run[0]}" if len(run) == 1 else f"{run[0]}–{run[-1]}" for run in runs)
