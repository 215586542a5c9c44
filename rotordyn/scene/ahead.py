"""Preload states of several machines, solved together in advance."""

from __future__ import annotations

from collections.abc import Sequence

from bearings.errors import BearingError
from rotordyn.errors import RotordynError
from rotordyn.preload.together import Asked, dynamic_preloads
from rotordyn.scene.stage import Inputs, Memo
from rotordyn.scene.statics import Statics


def solve_ahead(machines: Sequence[Statics], memo: Memo) -> None:
    """Solve the states of ``machines`` together into their ``memo``, replacing earlier ones.

    Where one cannot be solved, none is stored: each is solved alone later, which reports why.
    """
    memo.ahead.clear()
    inputs, problems = list[Inputs](), list[Asked]()
    for machine in machines:
        if machine.alone or machine.seated in inputs or memo.known("unloaded", machine.seated):
            continue
        acting = machine.law, machine.axial_force, machine.conditions.temperatures
        problems.append(Asked(machine.grounded, machine.bearing_speed, *acting))
        inputs.append(machine.seated)
    if len(problems) > 1:
        try:
            memo.ahead.extend(zip(inputs, dynamic_preloads(problems), strict=True))
        except (BearingError, RotordynError):
            return
