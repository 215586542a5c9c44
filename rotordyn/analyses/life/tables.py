"""Layouts of the tables of life and heat."""

from __future__ import annotations

from rotordyn.results.layout import Layout

LAYOUTS = (
    Layout("life", ("speed", "bearing")),
    Layout("life_bearings", ("bearing",)),
    Layout("life_set", ("speed",)),
)
