"""Layout of the result in tables."""

from __future__ import annotations

from rotordyn.results.layout import Layout

LAYOUTS = (
    Layout("axial_cycle", ("speed", "branch")),
    Layout("axial_cycle_loss", ("speed",)),
    Layout("axial_cycle_held", ("speed", "force")),
    Layout("axial_cycle_stiffness", ("speed", "branch", "force")),
    Layout("axial_cycle_bodies", ("speed", "branch", "force"), ("body",)),
    Layout("axial_cycle_bearings", ("speed", "branch", "force"), ("bearing",)),
    Layout("axial_cycle_sleeves", ("speed", "branch", "force"), ("sleeve",)),
)
