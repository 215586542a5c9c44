"""Layout of the table of preload over temperature difference."""

from __future__ import annotations

from rotordyn.results.layout import Layout

LAYOUTS = (Layout("thermal_preload", ("speed", "difference"), ("bearing",)),)
