"""Ends of grooves beside contact angles, and the colours of contacts."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rotordyn.analyses.bearing.result import BearingMapResult
from rotordyn.figures.style import BLACK, BLUE, GREEN, ORANGE, RED
from rotordyn.results.display import DEGREE

if TYPE_CHECKING:
    from matplotlib.axes import Axes

COLOURS = {"i": BLUE, "o": RED, "ir": BLUE, "il": GREEN, "or": ORANGE, "ol": RED}
MARKS = dict(zip(COLOURS, ("o", "s", "o", "^", "v", "s"), strict=True))  # of contacts
RINGS = {"i": ("inner", "--"), "o": ("outer", "-.")}


def loaded_contacts(result: BearingMapResult) -> list[tuple[int, str]]:
    """Return index and name of the contacts that carry load anywhere."""
    loaded = np.nan_to_num(result.contact_load).max(axis=(0, 1, 2)) > 0.0
    return [(k, name) for k, name in enumerate(result.contact) if loaded[k]]


def groove_ends(axes: Axes, result: BearingMapResult) -> None:
    """Draw lines at shoulders and middles of grooves [deg], where they are known."""
    top = float(np.nanmax(result.ellipse_upper, initial=0.0)) * DEGREE.factor
    for letter, (ring, dash) in RINGS.items():
        contact = next(k for k, name in enumerate(result.contact) if name.startswith(letter))
        for angle, what, width in (
            (result.shoulder_angle[contact], f"shoulder of the {ring} ring", 0.9),
            (result.middle_angle[contact], f"middle of the {ring} groove", 0.6),
        ):
            if np.isfinite(angle):
                degrees = angle * DEGREE.factor
                top = max(top, degrees)
                axes.axhline(degrees, color=BLACK, lw=width, ls=dash, label=what)
    low = min(0.0, float(np.nanmin(result.ellipse_lower, initial=0.0)) * DEGREE.factor)
    axes.set_ylim(low * 1.05, top * 1.06)
