"""What a designer should know of a machine at its speeds, one sentence each.

Nothing is solved for them: they read the description and what the analyses had solved anyway.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.machine.plausibility import implausible
from rotordyn.preload.growth import released_fits
from rotordyn.results.balls import gripping, pressed, slipping
from rotordyn.results.display import RPM
from rotordyn.scene.stability import instability

if TYPE_CHECKING:
    from rotordyn.scene.scene import Scene


def machine_warnings(scene: Scene) -> Iterator[str]:
    """Of the description, of its bearings where they were solved, of motions that grow."""
    top = float(scene.bearing_speed.max())
    yield from implausible(scene.spindle, top)
    for name, speed in released_fits(scene.spindle, top):
        yield (
            f"bearing {name}: the fit of its inner ring lets go at "
            f"{speed * RPM.factor:.0f} rpm; raise its interference"
        )
    for sleeve in scene.spindle.sleeves:
        if sleeve.friction > 0.0:
            yield (
                f"sleeve {sleeve.name}: its friction acts in axial_cycle alone; all other analyses "
                "take the state without friction"
            )
    if "preload" in scene.solved:
        yield from bearing_warnings(scene)
    for support in scene.spindle.supports:
        yield from support.held_at(scene.speed)
    systems = list(scene.systems.values())
    if systems:
        yield from instability(systems, scene.speed[scene.usable])


def bearing_warnings(scene: Scene) -> Iterator[str]:
    """Bearings pressed too hard, balls that slip or need much friction, shims that are small."""
    state = scene.preload
    speed, usable = state.speed, state.usable
    for seat, (balls, column) in zip(scene.spindle.seats, state.seat_states(), strict=True):
        name = f"bearing {seat.name}"
        peak, grip = (
            np.where(usable, np.fmax(*(part[:, column].max(axis=-1) for part in parts)), np.nan)
            for parts in (
                (balls.inner_pressure, balls.outer_pressure),
                (balls.inner_grip, balls.outer_grip),
            )
        )
        slips = np.where(usable, balls.slipping[:, column, 0], "")
        free = not any(slips)
        sentences = (
            pressed(name, speed, peak),
            slipping(name, speed, slips),
            gripping(name, speed, grip) if free else "",
        )
        yield from (sentence for sentence in sentences if sentence)
    yield from state.small_shims()
