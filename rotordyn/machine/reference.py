"""Published and measured figures that travel with a machine, shown beside the computed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Annotated

from rotordyn.description import Description
from rotordyn.quantity import Choice, Speed

QUANTITIES = {
    "radial_stiffness": "N/m",  # subject: variant, default nonlinear
    "preload_sum": "N",
    "sleeve_displacement": "m",  # subject: sleeve
    "bending_frequency": "Hz",  # per mode, in order, at one speed; or of the mode that is subject
    "mean_bending_frequency": "Hz",  # of both whirls of a mode, per mode, in order, at one speed
    "torsion_frequency": "Hz",  # per mode, in order, at one speed
    "axial_stiffness": "N/m",
    "seat_shift": "m",  # subject: bearing
    "required_diameter": "m",  # subject: twist limit
    "frozen_error": "1",  # of the axial stiffness of one bearing; largest over its loads
}
KINDS = ("published", "measured")


@dataclass(frozen=True, slots=True)
class Reference(Description):
    """A series of known values over speed.

    ``quantity``: what it is, one of ``QUANTITIES``; ``subject``: the sleeve, bearing or variant it
    belongs to (may be empty); ``kind``: ``"measured"`` or ``"published"``; ``speeds`` [rad/s] and
    ``values`` (SI) are of one length; ``source`` cites it, ``remark`` says in one sentence why it
    may differ from the computed value. ``conditions``: words of the model that it was found with,
    such as ``{"rotor": "rigid"}``; it is compared only where they are in force.
    """

    quantity: Annotated[str, Choice(tuple(QUANTITIES))]
    kind: Annotated[str, Choice(KINDS)]
    source: str
    speeds: tuple[Speed, ...]
    values: tuple[float, ...]
    subject: str = ""
    remark: str = ""
    conditions: Mapping[str, str | float | bool | None] = field(default_factory=dict, hash=False)

    def _faults(self) -> Iterator[str]:
        if not self.values:
            yield "at least one value is needed"
        elif len(self.speeds) != len(self.values):
            yield f"{len(self.speeds)} speeds for {len(self.values)} values: allowed: one each"
