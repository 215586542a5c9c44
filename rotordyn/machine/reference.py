"""Published and measured figures that travel with a machine, shown beside the computed."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Reference:
    """A series of known values over speed.

    ``quantity``: what it is, one of ``QUANTITIES``; ``subject``: the sleeve, bearing or variant it
    belongs to (may be empty); ``kind``: ``"measured"`` or ``"published"``; ``speeds`` [rad/s] and
    ``values`` (SI) are of one length; ``source`` cites it, ``remark`` says in one sentence why it
    may differ from the computed value.
    """

    quantity: str
    kind: str
    source: str
    speeds: tuple[float, ...]
    values: tuple[float, ...]
    subject: str = ""
    remark: str = ""


QUANTITIES = {
    "radial_stiffness": "N/m",  # subject: variant, default nonlinear
    "preload_sum": "N",
    "sleeve_displacement": "m",  # subject: sleeve
    "bending_frequency": "Hz",  # one value per mode, in order, at one speed
    "axial_stiffness": "N/m",
    "seat_shift": "m",  # subject: bearing
    "frozen_error": "1",  # of the axial stiffness of one bearing; largest over its loads
}
