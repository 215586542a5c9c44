"""A figure that a notebook shows by itself, whether or not pyplot is loaded."""

from __future__ import annotations

import io

from matplotlib.figure import Figure


class ShownFigure(Figure):
    """A matplotlib figure of no window, with a picture for notebooks."""

    def _repr_png_(self) -> bytes:
        held = io.BytesIO()
        self.savefig(held, format="png", dpi=self.dpi)
        return held.getvalue()
