"""Where grooves end, beside contact angles, and the colours of contacts."""

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
    """Place and name of the contacts that bear load anywhere."""
    some = np.nan_to_num(result.contact_load).max(axis=(0, 1, 2)) > 0.0
    return [(place, name) for place, name in enumerate(result.contact) if some[place]]


def groove_ends(axes: Axes, result: BearingMapResult) -> None:
    """Lines at the shoulders and at the middles of grooves [deg], as far as they are known."""
    top = float(np.nanmax(result.ellipse_upper, initial=0.0)) * DEGREE.factor
    for letter, (ring, dash) in RINGS.items():
        at = next(k for k, name in enumerate(result.contact) if name.startswith(letter))
        for angle, what, width in (
            (result.shoulder_angle[at], f"shoulder of the {ring} ring", 0.9),
            (result.middle_angle[at], f"middle of the {ring} groove", 0.6),
        ):
            if np.isfinite(angle):
                here = angle * DEGREE.factor
                top = max(top, here)
                axes.axhline(here, color=BLACK, lw=width, ls=dash, label=what)
    low = min(0.0, float(np.nanmin(result.ellipse_lower, initial=0.0)) * DEGREE.factor)
    axes.set_ylim(low * 1.05, top * 1.06)
