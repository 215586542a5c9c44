"""Layouts of the tables of radial stiffness."""

from __future__ import annotations

from rotordyn.results.layout import Layout

LAYOUTS = (
    Layout("stiffness", ("speed", "variant")),
    Layout("stiffness_curves", ("speed", "variant", "force")),
    Layout("stiffness_bearings", ("speed", "force", "bearing")),
    Layout("stiffness_contact_loss", ("speed", "bearing")),
)
