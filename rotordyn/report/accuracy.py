"""What is said of the error that elements leave in frequencies and receptances."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from rotordyn.analysis.results import CampbellResult, FrfResult


def accuracy_words(results: Mapping[str, Any]) -> list[str]:
    """A phrase per question: the largest estimated errors, and how far the mesh is good."""
    words = []
    if isinstance(modes := results.get("campbell"), CampbellResult) and modes.mode:
        worst = float(np.nanmax(modes.frequency_error, initial=0.0))
        words.append(f"frequencies within {worst:.1g}")
        if math.isfinite(modes.resolved_frequency):
            words.append(f"mesh good to {modes.resolved_frequency:.0f} Hz")
    if isinstance(response := results.get("frf"), FrfResult):
        worst = float(response.error.max(initial=0.0))
        words.append(f"receptances within {worst:.1g} of their peak")
    return words
