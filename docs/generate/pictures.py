"""Figures of the documents: half the resolution of a report and few colours, so that the
files are small."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from docs.generate.places import FIGURES
from rotordyn.figures.style import save

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLOURS = 128


def keep_figure(figure: Figure, name: str) -> None:
    """A figure as ``name``.png in the folder of figures."""
    with tempfile.TemporaryDirectory() as made:
        save(figure, Path(made), name)
        keep_file(Path(made) / f"{name}.png", name)


def keep_file(drawn: Path, name: str) -> None:
    """A figure from a file, in the same form."""
    from PIL import Image

    with Image.open(drawn) as full:
        small = full.convert("RGB").reduce(2).quantize(COLOURS, dither=Image.Dither.NONE)
    small.save(FIGURES / f"{name}.png", optimize=True)
