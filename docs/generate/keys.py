"""The reference of all keys, from the schema of the files."""

from __future__ import annotations

import re
from importlib import import_module

from bearings.kinds import KINDS
from docs.generate.accepted import accepted, default
from docs.generate.marked import table
from rotordyn.case.schema.base import Entry, title
from rotordyn.case.schema.bearing import BearingEntry, entry_of
from rotordyn.case.schema.meanings import meanings

# Part of the page -> the entries it lists, in order of reading.
PAGES = {
    "case": (
        "case.CaseEntry case.VariantEntry conditions.ConditionsEntry sweep.SpeedRange "
        "analyses.AnalysesEntry analyses.PreloadEntry analyses.CampbellEntry "
        "analyses.ShapesInSpaceEntry analyses.FrfEntry "
        "sweep.FrequencyRange analyses.PairEntry analyses.ResponseMatrixEntry "
        "analyses.MeasuredEntry "
        "analyses.StiffnessEntry loads.SectionForcesEntry "
        "loads.PointLoadEntry loads.LineLoadEntry loads.UnbalanceEntry loads.TwistLimitEntry "
        "loads.UnbalanceResponseEntry loads.EccentricSpanEntry loads.BalanceGradeEntry "
        "analyses.BearingMapEntry analyses.ControlEntry"
    ),
    "spindle": (
        "spindle.SpindleEntry shaft.ShaftEntry shaft.SectionEntry shaft.MassEntry shaft.DiscEntry "
        "support.SeatEntry growth.GrowthEntry growth.QuadraticEntry growth.FitEntry "
        "growth.ShorteningEntry support.SleeveEntry support.SpringEntry support.SupportEntry "
        "squeeze_film.SqueezeFilmDamperEntry "
        "housing.HousingEntry housing.ModelFilesEntry "
        "joint.JointEntry joint.JointDampingEntry rotor.RotorEntry rotor.RotorDampingEntry "
        "matrix.WholeStiffnessEntry matrix.WholeDampingEntry "
        "drawbar.DrawbarEntry spindle.DampingEntry rotor.RayleighEntry "
        "support.BearingDampingEntry"
    ),
    "tool": "shaft.ToolEntry",
    "bearing": "bearing.BearingEntry " + " ".join(f"bearing.{kind}" for kind in KINDS),
    "material": "material.MaterialEntry",
    "reference": "reference.ReferenceEntry",
}
HEAD = ("key", "takes", "default", "meaning")


def key_tables() -> dict[str, str]:
    """Every part of the page, by name."""
    return {name: _from_reference(_part(listed.split())) for name, listed in PAGES.items()}


def _from_reference(text: str) -> str:
    """Links of meanings start at ``docs``; the page is in ``docs/reference``."""
    return re.sub(r"\]\((?=[\w/]+\.md)", "](../", text)


def entries() -> list[type[Entry]]:
    """All entries of the page."""
    return [_entry(place) for listed in PAGES.values() for place in listed.split()]


def keys(entry: type[Entry]) -> list[str]:
    """The keys of an entry as written in a file."""
    return [field.alias or name for name, field in entry.model_fields.items()]


def _part(places: list[str]) -> str:
    return "\n\n".join(_section(_entry(place)) for place in places)


def _entry(place: str) -> type[Entry]:
    module, name = place.split(".")
    if name in KINDS:
        return entry_of(name)
    found: type[Entry] = getattr(import_module(f"rotordyn.case.schema.{module}"), name)
    return found


def _section(entry: type[Entry]) -> str:
    words, fields = meanings(entry), entry.model_fields.values()
    rows = [
        (f"`{key}`", accepted(field), default(field), words[key])
        for key, field in zip(keys(entry), fields, strict=True)
        if key not in _inherited(entry)
    ]
    about = " ".join((entry.__doc__ or "").split()).replace("``", "`")
    head = f"### {title(entry)}\n\n{about}"
    return f"{head}\n\n{table(HEAD, rows)}" if rows else head


def _inherited(entry: type[Entry]) -> set[str]:
    """Keys that the entry of all bearings lists for every kind."""
    kind = issubclass(entry, BearingEntry) and entry is not BearingEntry
    return set(BearingEntry.model_fields) if kind else set()
