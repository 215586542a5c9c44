"""Compliances of the rings of a bearing, for its solver."""

from __future__ import annotations

from dataclasses import dataclass, replace

from bearings.flexible_rings.compliance import Compliance
from bearings.flexible_rings.describe import FlexibleRings
from bearings.grooves import Grooves


@dataclass(frozen=True, eq=False, slots=True)
class Compliances:
    """Compliances of both rings of a bearing; None: rigid."""

    inner: Compliance | None
    outer: Compliance | None


def compliances(grooves: Grooves) -> Compliances | None:
    """Compute the compliances of the rings of a bearing; None where both are rigid."""
    rings = grooves.rings
    if rings is None:
        return None
    from bearings.flexible_rings.computed import compliance  # finite elements, for these alone

    assert isinstance(rings, FlexibleRings)
    grooves = replace(grooves, rings=None)  # that of a ring does not depend on the other ring
    return Compliances(
        None if rings.inner is None else compliance(grooves, rings.inner, inner=True),
        None if rings.outer is None else compliance(grooves, rings.outer, inner=False),
    )
