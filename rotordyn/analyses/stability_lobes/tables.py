"""Tables of the stability lobes."""

from __future__ import annotations

from rotordyn.results.layout import Layout

LAYOUTS = (
    Layout("stability_lobes", ("cutting_speed",)),
    Layout("stability_pockets", ("pocket",)),
    Layout("milled_surface", ("milling_speed",), ("wall", "direction")),
)
