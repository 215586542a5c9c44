"""Published and measured values kept beside a machine."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import Field

from rotordyn.case.schema.base import Entry
from rotordyn.case.schema.conditions import ConditionsEntry
from rotordyn.case.schema.values import Speed, Text, choice
from rotordyn.machine.reference import KINDS, QUANTITIES

# The kind of quantity read for the unit in which a reference is kept.
KIND_OF_UNIT = {
    "N/m": "stiffness",
    "N": "force",
    "m": "length",
    "Hz": "frequency",
    "1": "ratio",
}


class ReferenceEntry(Entry):
    """A series of known values; one speed serves all values where only one is given."""

    quantity: Annotated[str, choice(*QUANTITIES)]
    subject: Text = ""
    kind: Annotated[str, choice(*KINDS)]
    source: Text
    speeds: Annotated[list[Speed], Field(min_length=1)]
    values: Annotated[list[Any], Field(min_length=1)]
    remark: Text = ""
    conditions: ConditionsEntry = ConditionsEntry()
