"""Layouts of the tables of matrices."""

from __future__ import annotations

from rotordyn.results.layout import Layout

LAYOUTS = (
    Layout("matrices_ports", ("port", "column")),
    Layout("matrices_receptance", ("shown_speed", "frequency"), ("port",)),
)
