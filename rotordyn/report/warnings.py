"""Warnings of results, in one sentence each."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rotordyn.analyses.registry import analysis, in_order


def result_warnings(results: Mapping[str, Any]) -> list[str]:
    """Warnings of every analysis: of modes that change with the model, unstable modes, contact
    pressure, slip, truncated contact ellipses, twist."""
    names = in_order(results)
    return [sentence for name in names for sentence in analysis(name).warnings(results[name])]
