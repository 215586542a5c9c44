"""Radial stiffness in a line of text."""

from __future__ import annotations

from rotordyn.analyses.stiffness.result import StiffnessResult
from rotordyn.results.described import Described
from rotordyn.results.display import STIFFNESS
from rotordyn.results.text import from_to, unbroken


def summary(result: StiffnessResult) -> list[str]:
    """Tangent stiffness by bearing model at the first and last speed."""
    values = ", ".join(
        unbroken(f"{name.replace('_', ' ')} {from_to(values)}")
        for name, values in zip(result.variant, result.tangent.T * STIFFNESS.factor, strict=True)
    )
    return [f"stiffness  radial, tangent [N/µm] {values}"]


def cells(result: StiffnessResult, _: Described) -> dict[str, str]:
    """The same, a cell per bearing model."""
    return {
        f"{name.replace('_', ' ')} [N/µm]": from_to(values)
        for name, values in zip(result.variant, result.tangent.T * STIFFNESS.factor, strict=True)
    }
