"""Reasons why a speed has no usable preload state, with what a designer can do about them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from rotordyn.arrays import Array, Flags, Indices
from rotordyn.machine.limits import HIGHEST_PRESSURE
from rotordyn.machine.matrix import entry_name
from rotordyn.machine.plausibility import unopposed
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.arrangement import SHAFT, Arrangement
from rotordyn.preload.network import Network, NetworkState

LEAST_PRELOAD = 0.05  # N: by rounding of ball positions loads below are known to 1e-9 at best
STILL = 1e-9  # m
UNASKED = 1.0  # N: substitute load of bearings that carry none at rest, or an unknown one
LEAST_LOAD = 1e-6  # of the largest axial force: below it a bearing counts as unloaded


def outcomes(
    spindle: Spindle,
    network: Network,
    rest: NetworkState,
    net: NetworkState,
    rest_loads: Callable[[], Array],
    *,
    warm: bool,
) -> tuple[str, ...]:
    """Return one sentence per speed: empty where the state is usable.

    ``rest``: the state under the stated preloads to which everything else refers; ``rest_loads`` of
    the bearings (bearings,), the external force included [N]; ``warm``: temperatures differ from
    those of assembly.
    """
    if not rest.converged[0] and np.abs(network.springs.force).max() >= LEAST_PRELOAD:
        sentence = (
            unopposed(spindle)
            or "the stated preloads are not in balance at rest: the springs must push against "
            "bearings that sit in the housing"
        )
        return (sentence,) * len(net.converged)
    sound, failed = _sound(network, net), np.flatnonzero(~net.converged)
    lost = lost_at_speed(spindle, network, rest_loads(), failed) if failed.size else {}
    sentences = tuple(
        ("" if sound[row] else lost.get(row) or _outcome(spindle, network, net, row, warm=warm))
        or _sideways(spindle, network, rest, net, row)
        for row in range(len(net.converged))
    )
    pressed = any(network.arrangement.force * seat.thrust > 0.0 for seat in spindle.seats)
    common = "" if pressed else unopposed(spindle)
    return (common,) * len(sentences) if common and all(sentences) else sentences


def _sideways(
    spindle: Spindle, network: Network, rest: NetworkState, net: NetworkState, row: int
) -> str:
    """Return the failure of a support that couples axial shift to other motion: bearings are solved
    under axial load alone."""
    shift = float(net.position[row, SHAFT] - rest.position[0, SHAFT])
    pushing = [support for support in spindle.supports if support.axial_coupling]
    if not pushing or abs(shift) <= STILL:
        return ""
    names = ", ".join(entry_name(*ends) for ends in pushing[0].axial_coupling)
    rpm = network.arrangement.speed[row] * 30.0 / math.pi
    return (
        f"support {pushing[0].name} pushes the shaft sideways at {rpm:.0f} rpm, where the shaft is "
        f"{shift * 1e6:+.2g} µm from rest ({names}): bearings are solved under axial load alone; "
        "omit these entries, or use the state at rest at every speed"
    )


def _sound(network: Network, net: NetworkState) -> Flags:
    """Return the speeds at which ``_outcome`` finds no failure, all at once: in balance, all
    bearings loaded and none too heavily."""
    load = net.response.load
    size = np.fmax(pushed(network), np.abs(load).max(axis=1, initial=0.0))
    pressed = np.where(
        network.both_ways, net.response.slope > 0.0, load > LEAST_LOAD * size[:, None]
    )
    sound = net.converged & pressed.all(axis=1) & (size >= LEAST_PRELOAD)
    for solved in net.response.states.values():
        peak = np.fmax(solved.state.inner_pressure, solved.state.outer_pressure)
        sound &= peak.max(axis=(1, 2)) <= HIGHEST_PRESSURE
    return np.asarray(sound & np.isfinite(load).all(axis=1))


def pushed(network: Network) -> float:
    """Return the largest force of a spring plus the external one [N]."""
    return float(np.abs(network.springs.force).max() + abs(network.arrangement.force))


def unpreloaded(spindle: Spindle, network: Network, row: int) -> str:
    """Return the failure of a machine whose bearings carry next to no load."""
    force, rpm = pushed(network), network.arrangement.speed[row] * 30.0 / math.pi
    if not spindle.sleeves and not force:
        return (
            f"no bearing is preloaded at {rpm:.0f} rpm, and no sleeve preloads any: put one on a "
            "sleeve with a spring, give an arrangement with its preload, or an axial force"
        )
    advice = f" of {LEAST_PRELOAD:g} N or more: given {force:.3g} N" if force else ""
    return f"no bearing is preloaded at {rpm:.0f} rpm: give the springs a preload{advice}"


def _outcome(spindle: Spindle, network: Network, net: NetworkState, row: int, *, warm: bool) -> str:
    """Return the failure at one speed: no preload or equilibrium, a bearing un- or overloaded."""
    rpm = network.arrangement.speed[row] * 30.0 / math.pi
    load, names = net.response.load[row], _names(spindle, network)
    pressed = (net.response.slope[row] > 0.0) & network.both_ways  # by its own clearance
    light = max(pushed(network), float(np.nanmax(np.abs(load), initial=0.0))) < LEAST_PRELOAD
    if light and not pressed.any():
        return unpreloaded(spindle, network, row)
    lost = np.flatnonzero(~np.isfinite(load))
    if lost.size:
        return (
            f"bearing {names[lost[0]]} has no equilibrium at {rpm:.0f} rpm: raise its preload or "
            "lower the speed"
        )
    if idle := _idle(network, net, row):
        return (
            f"bearing {names[idle[0]]} is unloaded at {rpm:.0f} rpm (preload lost): raise the "
            "preload"
            + " or lower the axial force" * bool(network.arrangement.force)
            + " or reduce the differences of temperature" * warm
        )
    loose = np.flatnonzero((net.response.slope[row] <= 0.0) & network.both_ways)
    if loose.size:
        return (
            f"bearing {names[loose[0]]} is within its clearance at {rpm:.0f} rpm: no ball is "
            "loaded, and without loads across the axis the position of the shaft in it is "
            "undetermined, even if other parts restrain the shaft: load the bearing by a spring "
            "or an axial force, remove its clearance, or give the loads across the axis "
            "(gravity, loads)"
        )
    if not net.converged[row]:
        return _unbalanced(network.arrangement, rpm)
    apart = pushed_apart(names, load, network.both_ways, rpm)
    return apart or _overload(names, net, row, rpm)


def _names(spindle: Spindle, network: Network) -> list[str]:
    """Return the names of the seats of every bearing of the arrangement."""
    return [
        ", ".join(spindle.seats[k].name for k in bearing.seats)
        for bearing in network.arrangement.bearings
    ]


def lost_at_speed(
    spindle: Spindle, network: Network, loads: Array, rows: Indices
) -> dict[int, str]:
    """Return failure and remedy for those of ``rows`` at which a bearing has no state under its
    axial load at rest, of ``loads`` (bearings,) [N]."""
    from bearings.ring.condition import remedy

    carries = np.isfinite(loads) & ((loads > 0.0) | network.both_ways)
    load = np.zeros((len(rows), len(loads), 5))
    load[..., 0] = np.where(carries, loads, UNASKED)
    names, speed, failures = _names(spindle, network), network.arrangement.speed, {}
    solved = network.at(rows).solve_bearings(range(len(loads)), None, load=load)
    for batch in solved.values():
        places, state = batch.places, batch.state
        lost = carries[places] & (state.outcome == "no equilibrium")
        for k, column in np.argwhere(lost).tolist():
            row, place = int(rows[k]), places[column]
            failures[row] = (
                f"bearing {names[place]} has no equilibrium at {speed[row] * 30.0 / math.pi:.0f} "
                f"rpm under the {loads[place]:.4g} N along its axis at rest: {remedy(state)}"
            )
    return failures


def _idle(network: Network, net: NetworkState, row: int) -> list[int]:
    """Return the bearings whose lost preload leaves play: they carry no load, and no external force
    presses the shaft against others."""
    load = net.response.load[row]
    pressed = np.where(network.both_ways, load != 0.0, load > 0.0)
    if network.arrangement.force and net.converged[row] and pressed.any():
        return []
    least = LEAST_LOAD * max(pushed(network), float(np.abs(load).max()))
    return np.flatnonzero((load <= least) & ~network.both_ways).tolist()


def pushed_apart(names: Sequence[str], load: Array, both_ways: Flags, rpm: float) -> str:
    """Return the failure of a bearing for thrust one way that is loaded from the other side, or "".

    ``load`` (bearings,): axial loads in their own frames [N].
    """
    least = LEAST_LOAD * float(np.abs(load).max(initial=0.0))
    apart = np.flatnonzero((load < -least) & ~both_ways)
    if not apart.size:
        return ""
    return (
        f"the loads push bearing {names[apart[0]]} apart at {rpm:.0f} rpm, so far that its balls "
        "would touch the side that takes no thrust: lower the loads, or give the sleeves end "
        "stops"
    )


def _unbalanced(joined: Arrangement, rpm: float) -> str:
    if not joined.force:
        return f"the axial arrangement has no equilibrium at {rpm:.0f} rpm: raise the preload"
    return (
        f"nothing balances the axial force of {joined.force:.4g} N on the shaft at {rpm:.0f} rpm: "
        "lower it, or raise the preload" + ", or give the sleeves end stops" * bool(joined.pushes)
    )


def _overload(names: list[str], net: NetworkState, row: int, rpm: float) -> str:
    """Return the failure of a bearing whose contact pressure exceeds the range of valid results."""
    for solved in net.response.states.values():
        peak = np.fmax(solved.state.inner_pressure, solved.state.outer_pressure)[row].max(axis=-1)
        over = np.flatnonzero(peak > HIGHEST_PRESSURE)
        if over.size:
            return (
                f"bearing {names[solved.places[over[0]]]} is overloaded at {rpm:.0f} rpm (peak "
                f"pressure {peak[over[0]] / 1e9:.1f} GPa, at most {HIGHEST_PRESSURE / 1e9:g} GPa): "
                "lower its preload"
            )
    return ""
