"""Layouts of the tables of the preload state."""

from __future__ import annotations

from rotordyn.results.layout import Layout

LAYOUTS = (
    Layout("preload", ("speed", "bearing"), ("dof", "dof_other")),
    Layout("preload_bodies", ("speed", "body")),
    Layout("preload_sleeves", ("speed", "sleeve")),
    Layout("preload_stops", ("sleeve",)),
)
