"""Rotors of a machine and of variants: mass, centre of gravity, moments of inertia."""

from __future__ import annotations

from collections.abc import Sequence

from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import SPINDLE
from rotordyn.results.described import Described
from rotordyn.results.display import MILLIMETRE

HEADS = (
    "mass [kg]",
    "centre of gravity [mm]",
    "polar inertia [kg·m²]",
    "diametral inertia [kg·m²]",
)
SPEED = "speed over the spindle's"


def rotor_lines(spindle: Spindle) -> list[str]:
    """A line of a summary for each rotor."""
    lines = []
    for name, ratio in spindle.ratios.items():
        m = rotor_inertia(spindle.part(name))
        prefix = f"{name}, {ratio:g} × the speed, " if name != SPINDLE else ""
        lines.append(
            f"rotor      {prefix}{_mass(m.mass)}, centre of gravity at {m.centre * 1e3:.1f} mm, "
            f"inertia polar {m.polar:.4g}, diametral {m.diametral:.4g} kg m²"
        )
    return lines


def rotor_table(variants: Sequence[Described]) -> tuple[list[str], list[list[str]]]:
    """Heads, and a row for each rotor of each variant, once where variants are equal; no row
    without rotors."""
    rotors = [(v.title or v.name, _rows(v.spindle)) for v in variants if v.spindle is not None]
    several = any(len(rows) > 1 for _, rows in rotors)
    differ = any(rows != rotors[0][1] for _, rows in rotors)
    first, last = int(differ and not several), None if several else -1
    heads = [*["variant"] * differ, *["rotor", *HEADS, SPEED][first:last]]
    return heads, [
        [*[title] * differ, *row[first:last]]
        for title, rows in (rotors if differ else rotors[:1])
        for row in rows
    ]


def _rows(spindle: Spindle) -> list[list[str]]:
    rows = []
    for name, ratio in spindle.ratios.items():
        m = rotor_inertia(spindle.part(name))
        values = (m.mass, m.centre * MILLIMETRE.factor, m.polar, m.diametral)
        speed = "" if name == SPINDLE else f"{ratio:g}"
        rows.append([name, *(f"{value:.4g}" for value in values), speed])
    return rows


def _mass(mass: float) -> str:
    return f"{mass:.2f} kg" if mass >= 0.1 else f"{mass * 1e3:.3g} g"
