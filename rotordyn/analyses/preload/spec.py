"""Specification of the preload analysis."""

from __future__ import annotations

from dataclasses import dataclass

from rotordyn.scene.spec import Spec


@dataclass(frozen=True, slots=True)
class PreloadSpec(Spec):
    """The dynamic preload state at every speed of the case; it has no choices."""
