"""What supports and bearings stand on: a rigid body on springs, or a reduced model from files."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BeforeValidator, ConfigDict, Field

from rotordyn.case.node import UNKNOWN
from rotordyn.case.reduced import ReducedModel
from rotordyn.case.schema.base import Entry
from rotordyn.case.schema.matrix import (
    DampingMatrix,
    DampingMatrixEntry,
    StiffnessMatrix,
    StiffnessMatrixEntry,
)
from rotordyn.case.schema.values import Inertia, Mass, Name, Station, Text, wrong


class ModelFilesEntry(Entry):
    """A reduced model as Matrix Market files, SI units, rows and columns by their places."""

    mass: Text
    stiffness: Text
    damping: Text = ""
    places: Annotated[list[Text], Field(min_length=1)]


def _read(value: Any) -> Any:
    """What the files hold (``expand`` has read them); nothing where their fault is reported."""
    if value is UNKNOWN or isinstance(value, ReducedModel):
        return None if value is UNKNOWN else value
    raise wrong("not a model: a .npz file, or a mapping with mass, stiffness and places, is needed")


class HousingEntry(Entry):
    """A body between ground and the supports and bearings that it carries.

    Either a rigid one on springs, which moves in the freedoms that its stiffness names (`x`,
    `mass`, `stiffness` …), or a reduced `model`.
    """

    model_config = ConfigDict(
        json_schema_extra={
            "oneOf": [{"required": ["x", "mass", "stiffness"]}, {"required": ["model"]}]
        }
    )

    name: Name
    carries: Annotated[list[Name], Field(min_length=1)]
    x: Station | None = None
    mass: Mass | None = None
    polar_inertia: Inertia = 0.0
    diametral_inertia: Inertia = 0.0
    stiffness: StiffnessMatrix = StiffnessMatrixEntry()
    damping: DampingMatrix = DampingMatrixEntry()
    model: Annotated[Any, BeforeValidator(_read)] = None
