"""The questions of a case and the conditions they share."""

from __future__ import annotations

from rotordyn.analysis.specs import (
    BearingMapSpec,
    CampbellSpec,
    Conditions,
    ControlSpec,
    FrfSpec,
    Port,
    PreloadSpec,
    ShapesInSpaceSpec,
    Spec,
    StiffnessSpec,
)
from rotordyn.case.build.sweep import values
from rotordyn.case.schema.analyses import (
    AnalysesEntry,
    BearingMapEntry,
    CampbellEntry,
    ControlEntry,
    FrfEntry,
    PreloadEntry,
    StiffnessEntry,
)
from rotordyn.case.schema.conditions import ConditionsEntry


def conditions(entry: ConditionsEntry) -> Conditions:
    """How the machine is modelled."""
    return Conditions(**entry.model_dump())


def questions(entry: AnalysesEntry) -> dict[str, Spec]:
    """Spec by name, in the order of the registry of keys."""
    asked = {name: getattr(entry, name) for name in type(entry).model_fields}
    return {name: _spec(question) for name, question in asked.items() if question is not None}


def _spec(
    entry: PreloadEntry
    | CampbellEntry
    | FrfEntry
    | StiffnessEntry
    | BearingMapEntry
    | ControlEntry,
) -> Spec:
    match entry:
        case CampbellEntry():
            return _campbell(entry)
        case FrfEntry():
            pairs = tuple((Port(*pair.response), Port(*pair.excitation)) for pair in entry.pairs)
            return FrfSpec(values(entry.frequencies), pairs, tuple(entry.slices))
        case StiffnessEntry():
            return _stiffness(entry)
        case BearingMapEntry():
            return BearingMapSpec(tuple(entry.loads), entry.static_growth, tuple(entry.tangents))
        case ControlEntry():
            return ControlSpec(entry.max_load, entry.min_load, entry.radial, entry.static_growth)
        case PreloadEntry():
            return PreloadSpec()


def _campbell(entry: CampbellEntry) -> CampbellSpec:
    asked = entry.shapes_3d
    in_space = None
    if asked is not None:
        in_space = ShapesInSpaceSpec(asked.amplitude, asked.animation, tuple(asked.files))
    return CampbellSpec(entry.max_frequency, tuple(entry.teeth), entry.shapes, in_space)


def _stiffness(entry: StiffnessEntry) -> StiffnessSpec:
    return StiffnessSpec(
        point=entry.point,
        max_force=entry.max_force,
        steps=entry.steps,
        variants=tuple(entry.variants),
        second_stop=dict(entry.second_stop),
    )
