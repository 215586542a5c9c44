"""What is said of the error of frequencies and receptances."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.analyses.frf.result import FrequencyResponse
from rotordyn.analyses.unbalance.result import UnbalanceResult
from rotordyn.results.display import rounded_up

_PLURAL = {"receptance": "receptances", "mobility": "mobilities", "inertance": "inertances"}


def accuracy_words(results: Mapping[str, Any]) -> list[str]:
    """A phrase per analysis: the largest estimated errors."""
    words = []
    if isinstance(modes := results.get("campbell"), CampbellResult) and modes.mode:
        words.append(f"frequencies within {rounded_up(modes.largest_error)}")
    if isinstance(response := results.get("frf"), FrequencyResponse):
        worst = float(response.error.max(initial=0.0))
        words.append(f"{_PLURAL[response.kind]} within {rounded_up(worst)} of their peak")
    if isinstance(turning := results.get("unbalance"), UnbalanceResult):
        worst = float(turning.error.max(initial=0.0))
        words.append(f"response to unbalance within {rounded_up(worst)} of its peak")
    return words
