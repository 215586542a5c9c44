"""The bar in the bore of the shaft."""

from __future__ import annotations

from typing import Annotated

from pydantic import Discriminator, Field, Tag

from rotordyn.case.schema.base import Entry, form
from rotordyn.case.schema.values import Pull, Station, choice
from rotordyn.machine.drawbar import EVERYWHERE


def _guides_form(value: object) -> str:
    return "<list>" if form(value) == "<list>" else "<word>"


Guides = Annotated[
    Annotated[str, choice(EVERYWHERE), Tag("<word>")] | Annotated[list[Station], Tag("<list>")],
    Discriminator(_guides_form),
]


class DrawbarEntry(Entry):
    """The bar in the bore: it pulls the shaft together between two stations."""

    force: Pull
    start: Station = Field(alias="from")
    to: Station
    guides: Guides = []
