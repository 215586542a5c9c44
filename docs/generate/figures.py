"""Figures of a run of the flagship, with fewer colours so that the files are small."""

from __future__ import annotations

import tempfile
from pathlib import Path

import rotordyn
from docs.generate.pictures import keep_file
from docs.generate.places import FIGURES, ROOT

SHOWN = ("machine", "campbell", "frf_map", "stiffness", "preload")


def draw_figures() -> None:
    """Run the flagship and keep its figures ``SHOWN`` under ``docs/figures``."""
    FIGURES.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made) / "out"
        rotordyn.run(rotordyn.load(ROOT / "cases" / "mfw2310.yaml")).save(folder)
        for name in SHOWN:
            keep_file(folder / f"{name}.png", f"mfw2310_{name}")
