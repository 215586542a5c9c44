"""What results call for attention to, in one sentence each."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rotordyn.analyses.registry import analysis, in_order


def result_warnings(results: Mapping[str, Any]) -> list[str]:
    """Sentences on modes that change with the model, unstable modes, bearings too hard pressed or
    slipping, contact ellipses cut off, shafts twisted: those of every analysis."""
    names = in_order(results)
    return [sentence for name in names for sentence in analysis(name).warnings(results[name])]
