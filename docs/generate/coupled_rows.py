"""Effect of rotor damping on a tool coupled in place of a blank, without noise."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

import rotordyn
from docs.generate.marked import table
from rotordyn.analyses.coupling import Section, beam, between_points, couple, uncouple
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.tool import Tool
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene

Complex = NDArray[np.complex128]
BLANK, TOOLS = "hsk63_blank_60", ("hsk63_end_mill_12", "hsk63_end_mill_16")
POINTS, SPACING = ("tip", "inner"), 0.03  # m between them
LOSS = 0.04  # of the material where it has a loss factor
HERTZ = np.arange(2800.0, 4800.0, 2.0)
OMEGA = 2.0 * math.pi * HERTZ
PIECES = 24  # of a cone
HEAD = ("damping of the rotor", "`loss_factor`:", "12 mm: peaks [Hz]", "16 mm: peaks [Hz]")


def damping_table() -> str:
    """Peaks above 2.8 kHz of coupled end mills over those of the whole machine."""
    machine = rotordyn.model("spindles", "mfw2310")
    bare = replace(machine, rotor_damping=())
    rows = [
        ("modal, 1, 2, 5 %, all others 5 %", machine, 0.0),
        ("modal", machine, LOSS),
        ("none except of the bearings", bare, 0.0),
        (f"loss factor {LOSS:g} of its material", replace(bare, loss_factor=LOSS), LOSS),
    ]
    return table(HEAD, [_row(*row) for row in rows])


def peaks_over_computed(
    spindle: Spindle, tool: Tool, loss: float
) -> list[tuple[float, float, float]]:
    """For every peak of the whole machine: its frequency [Hz], and frequency and amplitude of the
    coupled peak, both relative to it; ``loss``: loss factor of blank and tool."""
    blank = rotordyn.model("tools", BLANK)
    known = _receptance(spindle.with_tool(blank), POINTS)
    front, *rest = _sections(blank, loss)
    parts = (front._replace(length=length) for length in (SPACING, front.length - SPACING))
    first, behind = next(parts), next(parts)
    off = between_points(beam(OMEGA, [first]), beam(OMEGA, [behind, *rest]))
    coupled = np.abs(couple(beam(OMEGA, _sections(tool, loss)), uncouple(off, known))[:, 0, 0])
    whole = np.abs(_receptance(spindle.with_tool(tool), POINTS[:1])[:, 0, 0])
    found = []
    for place in _tops(whole):
        near = min(_tops(coupled), key=lambda k, at=place: abs(HERTZ[k] / HERTZ[at] - 1.0))
        found.append((HERTZ[place], HERTZ[near] / HERTZ[place], coupled[near] / whole[place]))
    return found


def _row(what: str, spindle: Spindle, loss: float) -> tuple[str, ...]:
    cells = [what, f"{loss:g}"]
    for name in TOOLS:
        found = peaks_over_computed(spindle, rotordyn.model("tools", name), loss)
        listed = (f"{at:.0f}: {100.0 * (size - 1.0):+.1f} %" for at, _, size in found)
        cells.append(", ".join(listed).replace("-", "−"))
    return tuple(cells)


def _tops(size: NDArray[np.float64]) -> list[int]:
    inner = (size[1:-1] > size[:-2]) & (size[1:-1] > size[2:])
    return [int(k) for k in np.flatnonzero(inner) + 1]


def _receptance(spindle: Spindle, points: tuple[str, ...]) -> Complex:
    """(f, n, n) between points of a machine at rest, in y."""
    scene = Scene(spindle, Conditions(), np.zeros(1), 12000.0, points)
    system = scene.system(scene.owner(points[0], "y"))
    rows = np.array([system.linear.row(*spindle.place(point), "y") for point in points])
    count = len(points)
    answers = system.receptance(OMEGA, np.repeat(rows, count, axis=0), np.tile(rows, (count, 1)))
    return np.moveaxis(answers[0].reshape(count, count, -1), -1, 0)


def _sections(tool: Tool, loss: float) -> list[Section]:
    """Cylinders of a tool, its cones in pieces."""
    found = []
    for own in tool.sections:
        (front, rear), made = own.outer, own.material
        many = PIECES if front != rear else 1
        for k in range(many):
            outer = front + (rear - front) * (k + 0.5) / many
            elastic = made.young_modulus, own.density, made.poisson_ratio
            found.append(Section(own.length / many, outer, own.inner[0], *elastic, loss))
    return found
