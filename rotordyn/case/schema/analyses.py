"""What a case may ask, and the keys of each question."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

from pydantic import BeforeValidator, ConfigDict, Field, PlainValidator, WithJsonSchema

from bearings.ball.law import DYNAMICS
from rotordyn.analyses.bearing.spec import TILTS
from rotordyn.analyses.campbell.spec import MESH_FILES, MOST_TEETH
from rotordyn.analyses.frf.spec import QUANTITIES
from rotordyn.analyses.stiffness.spec import MOST_STEPS, VARIANTS
from rotordyn.case.node import UNKNOWN
from rotordyn.case.schema.base import Entry
from rotordyn.case.schema.conditions import Tangent
from rotordyn.case.schema.loads import SectionForcesEntry, UnbalanceResponseEntry
from rotordyn.case.schema.shapes import PLACE
from rotordyn.case.schema.sweep import Frequencies
from rotordyn.case.schema.values import (
    Amplitude,
    EngineOrder,
    Flag,
    Force,
    Frequency,
    Growth,
    LightLoad,
    Load,
    Moment,
    Name,
    RadialShare,
    Speed,
    Text,
    Travel,
    choice,
    given,
    whole,
    wrong,
)
from rotordyn.machine.support import FREEDOMS
from rotordyn.quantity import suggestion
from rotordyn.scene.conditions import TANGENTS


class PreloadEntry(Entry):
    """The preload table has no choices."""


def _empty_if_bare(value: Any) -> Any:
    return {} if value is None else value


_BARE = BeforeValidator(_empty_if_bare)


class ShapesInSpaceEntry(Entry):
    """Mode shapes in space, at the first and the last speed."""

    amplitude: Amplitude = 0.06
    animation: Flag = False
    files: list[Annotated[str, choice(*MESH_FILES)]] = []


class CampbellEntry(Entry):
    """Modes over speed."""

    max_frequency: Frequency = 4000.0
    teeth: list[Annotated[int, whole(1, MOST_TEETH)]] = []
    shapes: Flag = True
    shapes_3d: Annotated[ShapesInSpaceEntry | None, _BARE] = None
    engine_orders: list[EngineOrder] = [1]


class Place(NamedTuple):
    """A point and one of its directions; empty where unknown."""

    point: str
    direction: str

    def __str__(self) -> str:
        return f"{self.point}.{self.direction}"


def _place(value: Any) -> Place:
    if value is UNKNOWN:
        return Place("", "")
    point, _, direction = value.rpartition(".") if isinstance(value, str) else ("", "", "")
    if not point:
        raise wrong(f"not a place: given {given(value)}; allowed: POINT.DIRECTION such as tip.y")
    if direction not in FREEDOMS:
        raise wrong(
            f"unknown direction: given {given(value)}; allowed: {', '.join(FREEDOMS)}"
            + suggestion(direction, FREEDOMS)
        )
    return Place(point, direction)


PlaceText = Annotated[
    Place, PlainValidator(_place, json_schema_input_type=Annotated[str, WithJsonSchema(PLACE)])
]


class PairEntry(Entry):
    """Where the response is taken and where the force acts."""

    response: PlaceText
    excitation: PlaceText


class ResponseMatrixEntry(Entry):
    """Every response to every excitation."""

    responses: Annotated[list[PlaceText], Field(min_length=1)]
    excitations: Annotated[list[PlaceText], Field(min_length=1)]


class MeasuredEntry(Entry):
    """A measured response to lay over the computed one, from UFF type 58 or a CSV table."""

    name: Name = ""
    file: Text
    record: Annotated[int, whole(1, 1_000_000)] | None = None
    response: PlaceText
    excitation: PlaceText
    speed: Speed = 0.0


class FrfEntry(Entry):
    """Frequency responses over speed and frequency."""

    model_config = ConfigDict(
        json_schema_extra={
            "allOf": [
                {"anyOf": [{"required": ["pairs"]}, {"required": ["matrix"]}]},
                {"anyOf": [{"required": ["frequencies"]}, {"required": ["engine_orders"]}]},
            ]
        }
    )

    frequencies: Frequencies | None = None
    engine_orders: list[EngineOrder] = []
    quantity: Annotated[str, choice(*QUANTITIES)] = QUANTITIES[0]
    pairs: Annotated[list[PairEntry], Field(min_length=1)] = []
    matrix: ResponseMatrixEntry | None = None
    slices: list[Speed] = []
    measured: list[MeasuredEntry] = []

    @property
    def asked(self) -> list[tuple[Place, Place]]:
        """Response and excitation of the pairs, then of what the matrix adds to them."""
        found = [(pair.response, pair.excitation) for pair in self.pairs]
        if self.matrix is not None:
            found += [(r, e) for r in self.matrix.responses for e in self.matrix.excitations]
        return list(dict.fromkeys(found))


class StiffnessEntry(Entry):
    """Radial stiffness of a point."""

    point: Name
    max_force: LightLoad = 500.0
    steps: Annotated[int, whole(1, MOST_STEPS)] = 10
    variants: Annotated[list[Annotated[str, choice(*VARIANTS)]], Field(min_length=1)] = [*VARIANTS]
    second_stop: dict[Name, Travel] = {}


class BearingMapEntry(Entry):
    """A single bearing under one list of loads, axial, radial or moments; others may be fixed."""

    loads: Annotated[list[Load], Field(min_length=1)] = []
    radial_loads: Annotated[list[Force], Field(min_length=1)] = []
    moments: Annotated[list[Moment], Field(min_length=1)] = []
    axial_load: Force = 0.0
    radial_load: Force = 0.0
    moment: Moment = 0.0
    tilt: Annotated[str, choice(*TILTS)] = TILTS[0]
    dynamics: Annotated[str, choice(*DYNAMICS)] = DYNAMICS[0]
    static_growth: Growth = 0.0
    tangents: Annotated[list[Tangent], Field(min_length=1)] = [TANGENTS[0]]


class ControlEntry(Entry):
    """Which race controls the balls of a single bearing, over axial load."""

    max_load: Load
    min_load: LightLoad = 10.0
    radial: RadialShare = 0.0
    static_growth: Growth = 0.0


class AnalysesEntry(Entry):
    """One key per question; what is not named is not computed."""

    model_config = ConfigDict(json_schema_extra={"minProperties": 1})

    preload: Annotated[PreloadEntry | None, _BARE] = None
    campbell: Annotated[CampbellEntry | None, _BARE] = None
    frf: Annotated[FrfEntry | None, _BARE] = None
    stiffness: Annotated[StiffnessEntry | None, _BARE] = None
    section_forces: Annotated[SectionForcesEntry | None, _BARE] = None
    unbalance: Annotated[UnbalanceResponseEntry | None, _BARE] = None
    bearing: Annotated[BearingMapEntry | None, _BARE] = None
    control: Annotated[ControlEntry | None, _BARE] = None
