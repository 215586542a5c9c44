"""What files of identifications hold: a case, what is sought in it, what was measured (SI)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any

from rotordyn.analyses.measured_response import MeasuredResponse
from rotordyn.quantity import (
    Choice,
    DampingRatio,
    Force,
    Frequency,
    Growth,
    Items,
    Key,
    Name,
    Rigidity,
    Share,
    Speed,
    Travel,
    Whole,
)

MINIMISED = ("squares", "absolute")
ALL = "all"
BRANCHES = ("falling", "rising")
MOST_STARTS = 1000
Lengths = tuple[Growth, ...]
Speeds = tuple[Speed, ...]


@dataclass(frozen=True, slots=True)
class UnknownEntry:
    """A number of the case that is sought, between two ends."""

    start_of_range: Annotated[Any, Key("from"), "lower end, with its unit"]
    to: Annotated[Any, "upper end"]
    prior: Annotated[Any, "what is known of it before; needs its deviation"] = None
    deviation: Annotated[Any, "standard deviation of the prior"] = None
    start: Annotated[Any, "where the search begins; by default the prior, or as in the case"] = None
    also: Annotated[tuple[str, ...], Items(0), "further paths that take the same value"] = ()
    name: Annotated[str, Key(default=""), "short one, for figures and tables"] = ""


@dataclass(frozen=True, slots=True)
class AxialCurveEntry:
    """Displacement over an axial force that falls and rises, `kind: axial curve`.

    Points in a CSV file with the columns `speed [rpm]`, `branch`, `force [N]`, `displacement [um]`,
    in the order in which they were measured.
    """

    kind: Annotated[str, "`axial curve`"]
    file: Annotated[str, "CSV file, beside this one"]
    deviation: Annotated[Travel, "standard deviation of the noise"]
    of: Annotated[str, "`shaft`, or the name of a sleeve"] = "shaft"
    tare: Annotated[Travel, "standard deviation of an offset of each speed"] = 0.0
    drift: Annotated[Travel, "of what grows evenly along the curve of each speed"] = 0.0
    points: Annotated[
        Annotated[int, Whole(2, 100_000)] | None,
        "evenly along each branch, force and displacement by their ranges; by default all",
    ] = None
    lowest: Annotated[Force | None, "lowest force of the cycle; by default of the points"] = None
    highest: Annotated[Force | None, "highest force of the cycle"] = None


@dataclass(frozen=True, slots=True)
class NoLoadEntry:
    """Displacement without axial force over speed, `kind: no load`."""

    kind: Annotated[str, "`no load`"]
    deviation: Annotated[Travel, "standard deviation of the noise"]
    speeds: Annotated[Speeds, Items(), "of the points"]
    displacements: Annotated[Lengths, Items(), "towards +x, from rest, at each speed"]
    of: Annotated[str, "`shaft`, or the name of a sleeve"] = "shaft"
    tare: Annotated[Travel, "standard deviation of an offset of all points"] = 0.0


@dataclass(frozen=True, slots=True)
class AxialStiffnessEntry:
    """Axial stiffness of the shaft at no load over speed, `kind: axial stiffness`."""

    kind: Annotated[str, "`axial stiffness`"]
    deviation: Annotated[Rigidity, "standard deviation of the noise"]
    speeds: Annotated[Speeds, Items(), "of the points"]
    stiffnesses: Annotated[tuple[Rigidity, ...], Items(), "at each speed"]
    branch: Annotated[str, Choice(BRANCHES), "of the cycle of force"]
    lowest: Annotated[Force, "lowest force of the cycle"]
    highest: Annotated[Force, "highest force of the cycle"]
    near: Annotated[Force, "it is read so much either side of `about`"] = 100.0
    about: Annotated[Force, "force about which it is read"] = 0.0


@dataclass(frozen=True, slots=True)
class StopEntry:
    """A sleeve that just meets its stop, `kind: stop met`."""

    kind: Annotated[str, "`stop met`"]
    deviation: Annotated[Travel, "standard deviation of the way of the sleeve"]
    sleeve: Annotated[Name, "that meets its stop"]
    speed: Annotated[Speed, "at which it does"]
    force: Annotated[Force | None, "at which it does, on the falling branch; none: at idle"] = None
    lowest: Annotated[Force | None, "lowest force of the cycle"] = None
    highest: Annotated[Force | None, "highest force of the cycle"] = None


@dataclass(frozen=True, slots=True)
class NumbersEntry:
    """Any number that the case computes, over speed, `kind: numbers`."""

    kind: Annotated[str, "`numbers`"]
    of: Annotated[
        str, "`analysis.variable` of its dataset, or `analysis: words` of a headline number"
    ]
    deviation: Annotated[str, "standard deviation of the noise, with its unit"]
    speeds: Annotated[Speeds, Items(), "of the points"]
    values: Annotated[tuple[str, ...], Items(), "at each speed, with their unit"]
    where: Annotated[
        Mapping[str, Any], "coordinate to a word (`*` any letters) or a number, besides speed"
    ] = field(default_factory=dict)
    nearest: Annotated[bool, "of several values at a speed the nearest counts, as of modes"] = False


@dataclass(frozen=True, slots=True)
class ResponsesEntry:
    """Frequency responses at any speeds, of UFF or CSV files, `kind: frequency responses`."""

    kind: Annotated[str, "`frequency responses`"]
    responses: Annotated[
        tuple[MeasuredResponse, ...],
        Items(),
        "each with its file, response, excitation and speed; those of one speed at the same "
        "frequencies",
    ]
    noise: Annotated[
        Share | None, "standard deviation of real and imaginary part each, over the response"
    ] = None
    averages: Annotated[
        Annotated[int, Whole(1, 1_000_000)] | None,
        "spectra averaged: noise follows from the coherence in the files instead",
    ] = None
    gain: Annotated[
        Share, "standard deviation of an unknown factor of every response over 1, as of sensors"
    ] = 0.0


@dataclass(frozen=True, slots=True)
class ModesEntry:
    """Frequencies and dampings of bending modes over speed, `kind: modes`."""

    kind: Annotated[str, "`modes`"]
    speeds: Annotated[Speeds, Items(), "of the modes, one for each"]
    frequencies: Annotated[tuple[Frequency, ...], Items(), "without damping, |λ|/2π"]
    deviation: Annotated[Share, "standard deviation of frequencies, over each"]
    dampings: Annotated[tuple[DampingRatio, ...] | None, Items(), "ratios"] = None
    damping_deviation: Annotated[Share | None, "of dampings, over each"] = None
    whirls: Annotated[
        tuple[Annotated[str, Choice(("forward", "backward"))], ...] | None,
        Items(),
        "which way each whirls; else the nearest frequency counts",
    ] = None


@dataclass(frozen=True, slots=True)
class PhaseEntry:
    """A model of a story: which unknowns it seeks, what it holds."""

    unknowns: Annotated[
        tuple[str, ...] | None, Items(), "those it seeks, by name or path; all by default"
    ] = None
    values: Annotated[Mapping[str, Any], "dotted path to a value that it holds"] = field(
        default_factory=dict
    )


@dataclass(frozen=True, slots=True)
class PredictedEntry:
    """A number of the case that is said of the identified machine."""

    of: Annotated[str, "as of a goal"]
    where: Annotated[Mapping[str, Any], "as of a goal"] = field(default_factory=dict)
    name: Annotated[str, Key(default=""), "in tables"] = ""
    measured: Annotated[str | None, "shown beside it, with its unit"] = None


@dataclass(frozen=True, slots=True)
class IdentificationFile:
    """An identification: numbers of one case sought so that it shows what was measured."""

    title: Annotated[str, Key(default=""), "one line, shown in summary and figures"]
    case: Annotated[str, "path of a case file, or the name of a case that comes with rotordyn"]
    unknowns: Annotated[Mapping[str, UnknownEntry], "dotted path, as of `vary`, to its ends"]
    measurements: Annotated[
        Mapping[str, Any], "name to what was measured, each with a `kind` of its own keys"
    ]
    hypotheses: Annotated[
        Mapping[str, Any], "dotted path to a list of values; every combination is held against all"
    ] = field(default_factory=dict)
    phases: Annotated[Mapping[str, PhaseEntry], "name to a model of a story, side by side"] = field(
        default_factory=dict
    )
    predict: Annotated[
        tuple[PredictedEntry, ...], Items(0), "said of the identified machine, with intervals"
    ] = ()
    profiles: Annotated[
        Annotated[str, Choice((ALL,))] | tuple[str, ...],
        "unknowns, by path or name, or `all`, whose intervals are found by profiles, too",
    ] = ()
    criterion: Annotated[
        str | None, "mean absolute difference up to which a model suffices; by default χ² decides"
    ] = None
    minimise: Annotated[
        str, Choice(MINIMISED), "squares of differences, or their absolute mean"
    ] = MINIMISED[0]
    starts: Annotated[int, Whole(1, MOST_STARTS), "of each search"] = 1
    seed: Annotated[int, Whole(0, 2**31 - 1), "of the starts besides the first"] = 0


KINDS: dict[str, type] = {
    "axial curve": AxialCurveEntry,
    "no load": NoLoadEntry,
    "axial stiffness": AxialStiffnessEntry,
    "stop met": StopEntry,
    "numbers": NumbersEntry,
    "frequency responses": ResponsesEntry,
    "modes": ModesEntry,
}
