"""How its result is laid out in tables."""

from __future__ import annotations

from rotordyn.results.layout import Layout

LAYOUTS = (Layout("thermal_preload", ("speed", "difference"), ("bearing",)),)
