"""What there is to say about each state of a batch, in a few words; why there is none."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from bearings.ball.law import Law
from bearings.errors import NoEquilibrium
from bearings.ring.operation import Operation
from bearings.ring.request import solved
from bearings.ring.spin_up import Gap, spin_up
from bearings.ring.state import BearingState
from bearings.ring.tolerances import GROSS, IMPOSSIBLE, PERMANENT, STEEP
from bearings.ring.truncation import truncation

Array = NDArray[np.float64]

GIVEN = ("displacement", "load and displacement", "load")
RPM = math.pi / 30.0
REMEDIES = {
    "overloaded": "the balls are pressed far out of their grooves; is the unit of the load right?",
    "unloaded": "no load presses the rings together; give a load, or a displacement",
    "no contact angle": "growth leaves no contact angle; reduce the fit, or look at its sign",
}


def refusal(state: BearingState) -> NoEquilibrium:
    """The error of a single state that does not exist."""
    word = str(state.outcome)
    return NoEquilibrium(
        word,
        speed=float(state.operation.speed[0]),
        remedy=REMEDIES.get(word) or _remedy(state.operation.law),
        look=lambda: str(condition(state)).partition(": ")[2],
    )


def _remedy(law: Law) -> str:
    """What helps where there is no equilibrium under these assumptions."""
    ways = ["raise the load", "lower the speed"]
    if law.friction is None:
        ways.append("give a limit of friction")
    if not law.one_branch:
        ways.append("use outer or hybrid kinematics")
    return ", ".join(ways[:-1]) + f" or {ways[-1]}"


def condition(state: BearingState) -> NDArray[np.str_]:
    """What there is to say about each state (…), ``""`` where all balls carry as they should.

    ``"unloaded"``, ``"lost contact (balls 3–5)"``, ``"overloaded (pressure 4.6 GPa)"`` beyond the
    4.2 GPa of ISO 76, ``"beyond the groove (balls 2)"``, ``"contact ellipse passes the shoulder of
    the inner ring (balls 0–3), 12 % of its length lost"`` where its diameter is known,
    ``"loaded on the open side (balls 0–3)"``, ``"an arc presses beyond the middle of its groove
    …"``, ``"gross gyroscopic slip …"``, ``"slips on the inner race (balls 0–4)"``. Where there is
    no state: ``"no contact angle"``, ``"no equilibrium: stiffness vanishes above … rpm at this
    load"`` or ``"no equilibrium: balls 2–4 are thrown off a race above … rpm at this load"``: the
    first speed without a state, spinning up from rest (``bearings.ring.spin_up``); ``"(states again
    from … to … rpm)"`` where some exist above it.
    Balls count from 0.
    """
    balls = state.inner_load.shape[-1]
    pressure = np.maximum(state.inner_pressure, state.outer_pressure).reshape(-1, balls)
    angle = np.maximum(np.abs(state.inner_angle), np.abs(state.outer_angle)).reshape(-1, balls)
    angle = np.where(state.inner_load.reshape(-1, balls) > 0.0, angle, 0.0)
    status = state.status.reshape(-1, balls)
    slipping = state.slipping.reshape(-1, balls)
    cut, middle = _cut_off(state)
    grip = np.maximum(state.inner_grip, state.outer_grip).reshape(-1, balls)
    grip = np.where(state.operation.law.friction is None, grip, 0.0)
    steep = state.operation.grooves.free_angle > STEEP  # a groove of a thrust bearing ends later
    beyond = angle > (0.75 if steep else 0.5) * math.pi
    edges = zip(beyond, cut, middle, strict=True)
    remarks = zip(pressure, edges, grip, status, slipping, strict=True)
    refused = np.flatnonzero(state.outcome.reshape(-1) == "no equilibrium")
    ends = iter(endings(state.operation, refused) if refused.size else [])
    words = []
    for outcome, each in zip(state.outcome.reshape(-1), remarks, strict=True):
        if outcome == "no equilibrium":
            words.append(f"{outcome}: {next(ends)}")
        elif outcome:
            words.append(str(outcome))
        else:
            words.append("; ".join(_remarks(*each)))
    return np.array(words, dtype=str).reshape(state.outcome.shape)


def endings(operation: Operation, index: NDArray[np.intp]) -> list[str]:
    """Up to which speed questions that have no state have one, and what ends it."""
    gaps = first_gaps(operation, index)
    last = solved(operation.repeated(index, np.array([gap.low for gap in gaps])))
    load = np.minimum(last.inner_load, last.outer_load)
    force = np.abs(last.gyroscopic_moment) / operation.grooves.ball_diameter
    thrown = (load > 0.0) & (force > IMPOSSIBLE * load)
    return [_ending(operation, gap, balls) for gap, balls in zip(gaps, thrown, strict=True)]


def first_gaps(operation: Operation, index: NDArray[np.intp]) -> list[Gap]:
    """First gaps of speed of some questions; what their searches ask for is solved together."""
    jumps = not operation.law.one_branch
    searches = [spin_up(float(operation.speed[k]), jumps=jumps) for k in index]
    speeds, gaps = [next(search) for search in searches], [Gap(0.0)] * len(searches)
    going = list(range(len(searches)))
    while going:
        row = np.repeat(index[going], [len(speeds[k]) for k in going])
        found = solved(operation.repeated(row, np.concatenate([speeds[k] for k in going])))
        there, touch = found.outcome == "", found.inner_load > 0.0
        borders = np.cumsum([len(speeds[k]) for k in going])[:-1]
        parts = zip(going, np.split(there, borders), np.split(touch, borders), strict=True)
        for k, some, contacts in list(parts):
            try:
                speeds[k] = searches[k].send((some, contacts))
            except StopIteration as end:
                gaps[k] = end.value
                going.remove(k)
    return gaps


def _ending(operation: Operation, gap: Gap, thrown: NDArray[np.bool_]) -> str:
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
    return f"stiffness vanishes {where}"


def _cut_off(state: BearingState) -> tuple[Array, NDArray[np.bool_]]:
    """Largest share that the shoulder of each ring cuts off an ellipse (states, balls, 2).

    Also where a contact stands beyond the middle of its groove (states, balls).
    """
    cuts, split = truncation(state), len(state.operation.grooves.inner_offsets)
    cut, balls = cuts.beyond_shoulder, state.inner_load.shape[-1]
    rings = [cut[..., :split].max(axis=-1), cut[..., split:].max(axis=-1)]
    across = cuts.across_middle.any(axis=-1)
    return np.stack(rings, axis=-1).reshape(-1, balls, 2), across.reshape(-1, balls)


def _remarks(
    pressure: Array,
    edges: tuple[NDArray[np.bool_], Array, NDArray[np.bool_]],
    grip: Array,
    status: NDArray[np.str_],
    slipping: NDArray[np.str_],
) -> list[str]:
    """About a state that exists."""
    remarks = []
    if pressure.max() > PERMANENT:
        remarks.append(f"overloaded (pressure {pressure.max() / 1e9:.1f} GPa)")
    remarks += _at_the_edge(*edges)
    if (aside := status == "open side").any():
        remarks.append(f"loaded on the open side (balls {_ranges(aside)})")
    if (gross := grip > GROSS).any():
        remarks.append(
            f"gross gyroscopic slip (balls {_ranges(gross)} need a friction of {grip.max():.2g}): "
            "raise the load, lower the speed or give a limit of friction"
        )
    idle = (status == "lost contact") | (status == "unloaded")
    if idle.all():
        remarks.append("unloaded")
    elif idle.any():
        remarks.append(f"lost contact (balls {_ranges(idle)})")
    for race in ("inner", "outer", "both"):
        if (slipping == race).any():
            name = "both races" if race == "both" else f"{race} race"
            remarks.append(f"slips on the {name} (balls {_ranges(slipping == race)})")
    return remarks


def _at_the_edge(beyond: NDArray[np.bool_], cut: Array, middle: NDArray[np.bool_]) -> Iterator[str]:
    """About contacts that leave their groove."""
    if beyond.any():
        yield f"beyond the groove (balls {_ranges(beyond)})"
    for ring, share in zip(("inner", "outer"), cut.T, strict=True):
        if (some := share > 0.0).any():
            yield (
                f"contact ellipse passes the shoulder of the {ring} ring (balls {_ranges(some)}), "
                f"{100.0 * share.max():.2g} % of its length lost"
            )
    if middle.any():
        yield (
            f"an arc presses beyond the middle of its groove (balls {_ranges(middle)}): the shim "
            "is too small for two arcs, give none or a larger one"
        )


def _ranges(chosen: NDArray[np.bool_]) -> str:
    """The numbers of the chosen balls: 0–3, 7."""
    numbers = np.flatnonzero(chosen)
    runs = np.split(numbers, np.flatnonzero(np.diff(numbers) > 1) + 1)
    return ", ".join(f"{run[0]}" if len(run) == 1 else f"{run[0]}–{run[-1]}" for run in runs)
