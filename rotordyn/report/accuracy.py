"""What is said of the error that elements leave in frequencies and receptances."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from rotordyn.analysis.display import number, rounded_up
from rotordyn.analysis.results import CampbellResult, FrequencyResponse, UnbalanceResult

_PLURAL = {"receptance": "receptances", "mobility": "mobilities", "inertance": "inertances"}


def accuracy_words(results: Mapping[str, Any]) -> list[str]:
    """A phrase per question: the largest estimated errors, and how far the mesh is good."""
    words = []
    if isinstance(modes := results.get("campbell"), CampbellResult) and modes.mode:
        words.append(f"frequencies within {rounded_up(modes.largest_error)}")
        if 1.0 <= modes.resolved_frequency < math.inf:
            words.append(f"mesh good to {number(modes.resolved_frequency, 0)} Hz")
        if modes.certified[[not word for word in modes.outcome]].all():
            words.append(f"number of modes proven ({_range(modes)})")
    if isinstance(response := results.get("frf"), FrequencyResponse):
        worst = float(response.error.max(initial=0.0))
        words.append(f"{_PLURAL[response.kind]} within {rounded_up(worst)} of their peak")
    if isinstance(turning := results.get("unbalance"), UnbalanceResult):
        worst = float(turning.error.max(initial=0.0))
        words.append(f"response to unbalance within {rounded_up(worst)} of its peak")
    return words


def _range(modes: CampbellResult) -> str:
    """Of the number of modes over speed."""
    least, most = np.nanmin(modes.modes_below), np.nanmax(modes.modes_below)
    return f"{most:.0f}" if least == most else f"{least:.0f} to {most:.0f}"
