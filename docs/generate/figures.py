"""The flagship's figures as the run leaves them, with fewer colours so that they stay small."""

from __future__ import annotations

import tempfile
from pathlib import Path

import rotordyn
from docs.generate.places import FIGURES, ROOT

SHOWN = ("machine", "campbell", "frf_map", "stiffness", "preload")
COLOURS = 192


def draw_figures() -> None:
    """Run the flagship and keep its figures ``SHOWN`` under ``docs/figures``."""
    from PIL import Image

    FIGURES.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made) / "out"
        rotordyn.run(rotordyn.load(ROOT / "cases" / "mfw2310.yaml")).save(folder)
        for name in SHOWN:
            with Image.open(folder / f"{name}.png") as full:
                small = full.convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE)
            small.save(FIGURES / f"mfw2310_{name}.png", optimize=True)
