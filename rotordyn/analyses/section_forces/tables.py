"""Layouts of the tables of section forces."""

from __future__ import annotations

from rotordyn.results.layout import Layout

LAYOUTS = (
    Layout("section_forces", ("speed", "cut"), repeating=True),
    Layout("section_forces_reactions", ("speed", "support"), ("component",), repeating=True),
    Layout("section_forces_twist", ("speed", "twist_limit"), repeating=True),
)
