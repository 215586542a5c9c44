"""Preload states of machines that come one after another, solved together before."""

from __future__ import annotations

from collections.abc import Sequence

from bearings.errors import BearingError
from rotordyn.errors import RotordynError
from rotordyn.preload.together import Asked, dynamic_preloads
from rotordyn.scene.stage import Inputs, Memo
from rotordyn.scene.statics import Statics


def solve_ahead(machines: Sequence[Statics], memo: Memo) -> None:
    """Leave the states of ``machines`` in the ``memo`` that they share, in place of those before.

    Where one of them cannot be solved, each is left to be solved by itself, which tells why.
    """
    memo.ahead.clear()
    inputs, asked = list[Inputs](), list[Asked]()
    for machine in machines:
        if machine.alone or machine.seated in inputs or memo.known("unloaded", machine.seated):
            continue
        acting = machine.law, machine.axial_force, machine.conditions.temperatures
        asked.append(Asked(machine.grounded, machine.bearing_speed, *acting))
        inputs.append(machine.seated)
    if len(asked) > 1:
        try:
            memo.ahead.extend(zip(inputs, dynamic_preloads(asked), strict=True))
        except (BearingError, RotordynError):
            return
