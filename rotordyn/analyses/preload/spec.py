"""The analysis of the preload state."""

from __future__ import annotations

from dataclasses import dataclass

from rotordyn.description import Description


@dataclass(frozen=True, slots=True)
class PreloadSpec(Description):
    """The dynamic preload state at every speed of the case."""
