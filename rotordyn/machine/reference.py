"""Published and measured values of a machine, shown beside the computed ones."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any

from rotordyn.description import Description, Faults
from rotordyn.quantity import Choice, Items, Quantity, Speed

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
_KIND_OF_UNIT = {
    "N/m": "stiffness",
    "N": "force",
    "m": "length",
    "Hz": "frequency",
    "1": "ratio",
}


def values_of(quantity: str) -> Any:
    """Annotation of known values: in units of their quantity, if there is such a quantity."""
    unit = QUANTITIES.get(quantity, "")
    value: Any = Annotated[float, Quantity(_KIND_OF_UNIT[unit])] if unit else Any
    return Annotated[tuple[value, ...], Items()]


@dataclass(frozen=True, slots=True)
class Reference(Description):
    """A series of known values over speed; in files one speed serves all values.

    ``speeds`` [rad/s] and ``values`` [SI] are of one length. ``conditions``: those of the model
    that gives them, such as ``{"rotor": "rigid"}``.
    """

    quantity: Annotated[str, Choice(tuple(QUANTITIES)), "quantity of the known values"]
    kind: Annotated[str, Choice(KINDS), "computed by others, or measured"]
    source: Annotated[str, "publication or measurement that gives the values"]
    speeds: Annotated[tuple[Speed, ...], Items(), "one per value, or one for all"]
    values: Annotated[tuple[float, ...], Items(), "known values, with units of the quantity"]
    subject: Annotated[str, "variant, sleeve or bearing it belongs to"] = ""
    remark: Annotated[str, "one sentence why it may differ from the computed value"] = ""
    conditions: Annotated[
        Mapping[str, str | float | bool | None],
        "the values are compared only under these conditions",
    ] = field(default_factory=dict, hash=False)

    def _faults(self) -> Faults:
        if len(self.speeds) != len(self.values):
            yield (
                ("speeds",),
                f"{len(self.speeds)} speeds for {len(self.values)} values: allowed: one each, or "
                "in files one for all",
            )
