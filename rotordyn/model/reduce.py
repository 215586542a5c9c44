"""Shim until the one reduction lands."""

from __future__ import annotations

from rotordyn.numerics.reduction import RitzBasis as Basis
from rotordyn.numerics.reduction import ritz_basis


def reduce(mass, stiffness, rigid, ports, cutoff):  # type: ignore[no-untyped-def]
    """Shim."""
    return ritz_basis(mass, stiffness, cutoff, ports, rigid)


__all__ = ["Basis", "reduce"]
