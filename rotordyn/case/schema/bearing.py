"""Ball bearings of every kind: ``models/bearings/*.yaml``, or a mapping in place.

What the kinds have in common stands here; all other keys are the fields of the class of the kind,
read from its measures.
"""

from __future__ import annotations

from dataclasses import MISSING, fields
from functools import cache
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Union

from pydantic import Discriminator, Tag, create_model

from bearings.bearing import Measure
from bearings.kinds import DEFAULT, KINDS, kind_class
from bearings.materials import Material
from rotordyn.case.schema.base import Entry
from rotordyn.case.schema.material import MaterialEntry, OptionalMaterial
from rotordyn.case.schema.values import Diameter, Length, Text, choice, given, reads, whole
from rotordyn.measures import limits
from rotordyn.quantity import Whole, suggestion


class BearingEntry(Entry):
    """Keys of bearings of every kind; the kind adds its geometry and materials."""

    tag: ClassVar[str] = ""
    measures: ClassVar[dict[str, Measure]] = {}

    name: Text
    kind: Annotated[str, choice(*KINDS)] = DEFAULT
    source: Text = ""
    note: Text = ""
    bore_diameter: Diameter | None = None
    outside_diameter: Diameter | None = None
    width: Length | None = None


def wrong_kind(word: object) -> str:
    """A sentence for a word that is no kind of bearing; empty for a kind."""
    if isinstance(word, str) and word in KINDS:
        return ""
    allowed = ", ".join(KINDS)
    return (
        f"unknown kind of bearing: given {given(word)}; allowed: {allowed}{suggestion(word, KINDS)}"
    )


def kinds_with(key: str) -> list[str]:
    """The kinds that have this key."""
    return [kind for kind in KINDS if key in kind_class(kind).measures()]


@cache
def entry_of(kind: str) -> type[BearingEntry]:
    """The entry of one kind, by its word in ``KINDS``."""
    model = kind_class(kind)
    keys: dict[str, Any] = {f.name: _key(f.metadata["measure"], f.default) for f in fields(model)}
    entry = create_model(
        f"{KINDS[kind]}Entry",
        __base__=BearingEntry,
        __doc__=(model.__doc__ or "").partition("\n")[0],
        **keys,
    )
    entry.tag, entry.measures = f"<{kind}>", model.measures()
    return entry


def _key(measure: Measure, default: Any) -> Any:
    """Annotation and default of a field."""
    if measure.quantity == "material":
        return OptionalMaterial, ... if default is MISSING else _as_entry(default)
    annotation = _reader(measure)
    if default is MISSING:
        return annotation, ...
    return (annotation | None if default is None else annotation), default


@cache
def _reader(measure: Measure) -> Any:
    within = limits(measure)
    if isinstance(within, Whole):
        return Annotated[int, whole(within.at_least, within.at_most)]
    return Annotated[float, reads(within)]


def _as_entry(material: Material) -> MaterialEntry:
    return MaterialEntry.model_construct(
        name=material.name,
        young_modulus=material.young_modulus,
        poisson_ratio=material.poisson_ratio,
        density=material.density,
    )


def kind_in(value: Any) -> str:
    """The kind of a bearing in a file, as read or as an entry."""
    if isinstance(value, BearingEntry):
        return value.kind
    word = value.get("kind", DEFAULT) if isinstance(value, dict) else DEFAULT
    return word if isinstance(word, str) and word in KINDS else DEFAULT


def _tag(value: Any) -> str:
    return entry_of(kind_in(value)).tag


if TYPE_CHECKING:
    AnyBearing = BearingEntry
else:
    _KINDS = tuple(Annotated[entry_of(kind), Tag(entry_of(kind).tag)] for kind in KINDS)
    AnyBearing = Annotated[Union[_KINDS], Discriminator(_tag)]  # noqa: UP007
