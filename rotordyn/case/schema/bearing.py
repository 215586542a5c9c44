"""An angular-contact ball bearing: ``models/bearings/*.yaml``, or a mapping in place."""

from __future__ import annotations

from typing import Annotated

from rotordyn.case.schema.base import Entry
from rotordyn.case.schema.material import OptionalMaterial
from rotordyn.case.schema.values import Diameter, Length, Text, quantity, whole

Conformity = Annotated[float, quantity("number", above="0.5", at_most="0.7")]


class BearingEntry(Entry):
    """Inner geometry and materials; bore, outside diameter and width where they are known."""

    name: Text
    source: Text = ""
    note: Text = ""
    ball_diameter: Annotated[float, quantity("length", at_least="0.2 mm", at_most="200 mm")]
    pitch_diameter: Annotated[float, quantity("length", at_least="1 mm", at_most="5 m")]
    balls: Annotated[int, whole(3, 500)]
    contact_angle: Annotated[float, quantity("angle", at_least="0 deg", at_most="60 deg")]
    inner_conformity: Conformity = 0.52
    outer_conformity: Conformity = 0.52
    ball_material: OptionalMaterial
    ring_material: OptionalMaterial
    bore_diameter: Diameter | None = None
    outside_diameter: Diameter | None = None
    width: Length | None = None
