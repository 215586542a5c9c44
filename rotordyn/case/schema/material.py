"""A material: ``models/materials/*.yaml``, or a mapping in place."""

from __future__ import annotations

from typing import Annotated

from pydantic import BeforeValidator

from rotordyn.case.schema.base import Entry
from rotordyn.case.schema.values import Text, none_if_unknown, quantity


class MaterialEntry(Entry):
    """Elastic constants and density."""

    name: Text
    young_modulus: Annotated[float, quantity("pressure", at_least="1 GPa", at_most="2000 GPa")]
    poisson_ratio: Annotated[float, quantity("number", above="-1", below="0.5")]
    density: Annotated[float, quantity("density", at_least="100 kg/m^3", at_most="30000 kg/m^3")]
    source: Text = ""
    note: Text = ""


OptionalMaterial = Annotated[MaterialEntry | None, BeforeValidator(none_if_unknown)]
