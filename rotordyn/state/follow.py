"""Solution of a plain network along its plain path (both as in ``rotordyn.state.plain``)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from rotordyn.state.along import along
from rotordyn.state.conditions import MODES, Event
from rotordyn.state.contacts import State
from rotordyn.state.network import Network
from rotordyn.state.no_equilibrium import NoEquilibrium
from rotordyn.state.plain import network, steps
from rotordyn.state.rest import mounted_state

OF_BEARINGS = ("load", "unload")


def follow(description: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Follow a network along its path, exactly from event to event.

    ``description``: a plain network with its path (``rotordyn.state.plain``), SI.

    Returns one mapping for the end of every step: ``x`` {body: m}; of one bearing of each set its
    ``deflection`` [m] and ``load`` [N]; forces on the bodies [N]: ``friction`` with its ``mode``
    (stick, slip+ or slip-: its direction), ``stop`` (the limits in their order) and ``rigid``
    springs; ``events`` of the step: ``step`` from 1, ``at``: its share done, ``kind`` (slip+,
    slip-, close, open; stick where sliding comes to rest within a step; snap where the network
    jumps to another equilibrium), ``index``: of the friction, the limit or the body that jumps
    farthest; and ``unloading``, the same of bearings (unload, load). Where friction and a stop
    both hold a body, only the sum of their forces is determined.

    Raises
    ------
    InvalidInput : the network, its rest or its path cannot be used; one sentence
    NoEquilibrium : nothing balances a body; the sentence names it, the step and the force

    Source: Coulomb friction and unilateral contact in rate form (theory: the axial network).
    """
    parts, rest, laws = network(description)
    state = mounted_state(parts, rest)
    results = []
    for k, step in enumerate(steps(description, parts, rest, laws), start=1):
        try:
            state, events = along(step, state)
        except NoEquilibrium as none:
            raise NoEquilibrium(
                none.share, none.body, f"step {k} of the path, at {none.share:.6g} of it: {none}"
            ) from None
        results.append(_result(parts, state, k, events))
    return results


def _result(parts: Network, state: State, k: int, events: list[Event]) -> dict[str, Any]:
    listed = [
        {"step": k, "at": event.share, "kind": event.kind, "index": event.index} for event in events
    ]
    return {
        "x": dict(zip(parts.bodies, state.x.tolist(), strict=True)),
        "deflection": state.at.deflection.tolist(),
        "load": state.at.load.tolist(),
        "friction": state.friction.tolist(),
        "mode": [MODES[int(np.sign(slip))] for slip in state.slip],
        "stop": (parts.stops.side * state.press).tolist(),
        "rigid": state.rigid.tolist(),
        "events": [event for event in listed if event["kind"] not in OF_BEARINGS],
        "unloading": [event for event in listed if event["kind"] in OF_BEARINGS],
    }
