"""Conditions that end a smooth part of a path: limits at which a contact changes its kind."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rotordyn.arrays import Array
from rotordyn.state.contacts import TINY, State
from rotordyn.state.network import Load, Network, Step, limits
from rotordyn.state.rates import Rates, rates

SLIPS = {"slip+": 1, "slip-": -1, "halt": 0}  # direction of sliding after the event
MODES = {1: "slip+", -1: "slip-", 0: "stick"}
LENGTH = 1e-3  # m: unit of the margins of gaps and deflections


@dataclass(frozen=True, slots=True)
class Condition:
    """Limit of a part. ``kind``: slip+, slip- (friction at its limit), halt (of sliding),
    close, open (stops), rise, fall (a bearing to the next or the last kink of its law); ``index``
    among these."""

    kind: str
    index: int


@dataclass(frozen=True, slots=True)
class Event:
    """Event at a ``share`` of the step. ``kind``: slip+, slip-, stick, close, open, snap, unload or
    load; ``index`` of the friction, stop (limits in their order), body or bearing."""

    share: float
    kind: str
    index: int


def conditions(step: Step, state: State) -> list[Condition]:
    """List all conditions that may end the part that begins with ``state``."""
    rubs = step.network.frictions.limit > 0.0
    laws = step.load(0.0).laws
    low, high = limits(laws, state.piece)
    return [
        *(Condition("slip+", k) for k in np.flatnonzero(state.sticks & rubs).tolist()),
        *(Condition("slip-", k) for k in np.flatnonzero(state.sticks & rubs).tolist()),
        *(Condition("halt", k) for k in np.flatnonzero(~state.sticks & rubs).tolist()),
        *(Condition("open" if shut else "close", k) for k, shut in enumerate(state.closed)),
        *(Condition("fall", k) for k, end in enumerate(low.tolist()) if end > -np.inf),
        *(Condition("rise", k) for k, end in enumerate(high.tolist()) if end < np.inf),
    ]


def measures(
    step: Step, state: State, load: Load, of: list[Condition], rate: Rates | None = None
) -> Array:
    """Margin of every condition, positive while it is met (conditions,).

    ``rate`` of the state, if it is known.
    """
    stops, frictions = step.network.stops, step.network.frictions
    gap = stops.side * (stops.row @ state.x - stops.limit) / LENGTH
    low, high = limits(load.laws, state.piece)
    sliding = np.zeros(len(state.slip))
    if any(condition.kind == "halt" for condition in of):
        rate = rate or rates(step, state)
        sliding = state.slip * (frictions.row @ rate.x) / rate.pace
    values = {
        "slip+": 1.0 + state.friction / np.maximum(frictions.limit, TINY),
        "slip-": 1.0 - state.friction / np.maximum(frictions.limit, TINY),
        "halt": sliding,
        "close": gap,
        "open": state.press / (state.at.size + TINY),
        "fall": (state.at.deflection - low) / LENGTH,
        "rise": (high - state.at.deflection) / LENGTH,
    }
    return np.array([values[condition.kind][condition.index] for condition in of])


def slopes(step: Step, state: State, of: list[Condition], rate: Rates) -> Array:
    """Rates of the measures over the share of the step (conditions,); those of halts are NaN."""
    stops, frictions, bearings = step.network.stops, step.network.frictions, step.network.bearings
    rubs = rate.friction / np.maximum(frictions.limit, TINY)
    pressed = bearings.side * (bearings.row @ rate.x + step.end.shift - step.start.shift) / LENGTH
    values = {
        "slip+": rubs,
        "slip-": -rubs,
        "halt": np.full(len(rubs), np.nan),
        "close": stops.side * (stops.row @ rate.x) / LENGTH,
        "open": rate.press / (state.at.size + TINY),
        "fall": pressed,
        "rise": -pressed,
    }
    return np.array([values[condition.kind][condition.index] for condition in of])


def changed(network: Network, state: State, ended: Condition) -> State:
    """Change the kind of the contact that ended a part."""
    k = ended.index
    if ended.kind in SLIPS:
        slip, friction, anchor = state.slip.copy(), state.friction.copy(), state.anchor.copy()
        slip[k] = SLIPS[ended.kind]
        friction[k] = np.copysign(network.frictions.limit[k], friction[k])
        anchor[k] = network.frictions.row[k] @ state.x
        return replace(state, slip=slip, friction=friction, anchor=anchor)
    if ended.kind in ("close", "open"):
        closed, press = state.closed.copy(), state.press.copy()
        closed[k], press[k] = ended.kind == "close", 0.0
        return replace(state, closed=closed, press=press)
    piece = state.piece.copy()
    piece[k] += 1 if ended.kind == "rise" else -1
    return replace(state, piece=piece)


def events(before: State, after: State, share: float, ended: Condition | None) -> list[Event]:
    """List what changed at an event; sticking counts only where sliding has come to rest."""
    crossed = []
    for k, (was, now) in enumerate(zip(before.slip.tolist(), after.slip.tolist(), strict=True)):
        halts = ended is not None and ended.kind in ("halt", "rise", "fall")
        if was != now and (now or halts):
            crossed.append(Event(share, MODES[now], k))
    pairs = (
        (before.closed, after.closed, "close", "open"),
        (before.piece > 0, after.piece > 0, "load", "unload"),
    )
    for before_flags, after_flags, begins, ends in pairs:
        for k in np.flatnonzero(before_flags != after_flags).tolist():
            crossed.append(Event(share, begins if after_flags[k] else ends, k))
    return crossed
