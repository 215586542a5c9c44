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

    start_of_range: Annotated[Any, Key("from"), "lower bound, with its unit"]
    to: Annotated[Any, "upper bound, with its unit"]
    prior: Annotated[Any, "prior value; needs a deviation"] = None
    deviation: Annotated[Any, "standard deviation of the prior"] = None
    start: Annotated[Any, "where the search begins; by default the prior, or as in the case"] = None
    also: Annotated[tuple[str, ...], Items(0), "further paths that take the same value"] = ()
    name: Annotated[str, Key(default=""), "short name for figures and tables"] = ""


@dataclass(frozen=True, slots=True)
class AxialCurveEntry:
    """Displacement over an axial force that falls and rises, `kind: axial curve`.

    Points in a CSV file with the columns `speed [rpm]`, `branch`, `force [N]`, `displacement [um]`,
    in the order in which they were measured.
    """

    kind: Annotated[str, "`axial curve`"]
    file: Annotated[str, "CSV file in the folder of this one"]
    deviation: Annotated[Travel, "standard deviation of the noise"]
    of: Annotated[str, "`shaft`, or the name of a sleeve"] = "shaft"
    tare: Annotated[Travel, "standard deviation of an offset of each speed"] = 0.0
    drift: Annotated[
        Travel, "standard deviation of a linear drift along the curve of each speed"
    ] = 0.0
    points: Annotated[
        Annotated[int, Whole(2, 100_000)] | None,
        "number of points kept of each branch, at equal arc lengths; by default all",
    ] = None
    lowest: Annotated[Force | None, "lowest force of the cycle; by default of the points"] = None
    highest: Annotated[Force | None, "highest force of the cycle"] = None


@dataclass(frozen=True, slots=True)
class NoLoadEntry:
    """Displacement without axial force over speed, `kind: no load`."""

    kind: Annotated[str, "`no load`"]
    deviation: Annotated[Travel, "standard deviation of the noise"]
    speeds: Annotated[Speeds, Items(), "speeds of the points"]
    displacements: Annotated[
        Lengths, Items(), "displacements towards +x from the position at rest, one for each speed"
    ]
    of: Annotated[str, "`shaft`, or the name of a sleeve"] = "shaft"
    tare: Annotated[Travel, "standard deviation of an offset of all points"] = 0.0


@dataclass(frozen=True, slots=True)
class AxialStiffnessEntry:
    """Axial stiffness of the shaft at no load over speed, `kind: axial stiffness`."""

    kind: Annotated[str, "`axial stiffness`"]
    deviation: Annotated[Rigidity, "standard deviation of the noise"]
    speeds: Annotated[Speeds, Items(), "speeds of the points"]
    stiffnesses: Annotated[tuple[Rigidity, ...], Items(), "stiffnesses, one for each speed"]
    branch: Annotated[str, Choice(BRANCHES), "branch of the force cycle"]
    lowest: Annotated[Force, "lowest force of the cycle"]
    highest: Annotated[Force, "highest force of the cycle"]
    near: Annotated[Force, "half of the force range over which the secant stiffness is taken"] = (
        100.0
    )
    about: Annotated[Force, "force at the middle of that range"] = 0.0


@dataclass(frozen=True, slots=True)
class StopEntry:
    """A sleeve that just reaches its stop, `kind: stop reached`."""

    kind: Annotated[str, "`stop reached`"]
    deviation: Annotated[Travel, "standard deviation of the travel of the sleeve"]
    sleeve: Annotated[Name, "sleeve that reaches its stop"]
    speed: Annotated[Speed, "speed at which the stop is reached"]
    force: Annotated[
        Force | None,
        "axial force on the falling branch at which the stop is reached; none: without force",
    ] = None
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
    speeds: Annotated[Speeds, Items(), "speeds of the points"]
    values: Annotated[tuple[str, ...], Items(), "values, one for each speed, with their unit"]
    where: Annotated[
        Mapping[str, Any], "coordinate to a word (`*` any letters) or a number, besides speed"
    ] = field(default_factory=dict)
    nearest: Annotated[bool, "compare the nearest of several values at a speed, as of modes"] = (
        False
    )


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
        "number of averaged spectra: noise follows from the coherence in the files instead",
    ] = None
    gain: Annotated[
        Share, "standard deviation of an unknown calibration factor of every response, over 1"
    ] = 0.0


@dataclass(frozen=True, slots=True)
class ModesEntry:
    """Frequencies and dampings of bending modes over speed, `kind: modes`."""

    kind: Annotated[str, "`modes`"]
    speeds: Annotated[Speeds, Items(), "speeds of the modes, one for each"]
    frequencies: Annotated[tuple[Frequency, ...], Items(), "undamped natural frequencies"]
    deviation: Annotated[Share, "relative standard deviation of the frequencies"]
    dampings: Annotated[tuple[DampingRatio, ...] | None, Items(), "damping ratios"] = None
    damping_deviation: Annotated[
        Share | None, "relative standard deviation of the damping ratios"
    ] = None
    whirls: Annotated[
        tuple[Annotated[str, Choice(("forward", "backward"))], ...] | None,
        Items(),
        "direction of whirl of each mode; otherwise the nearest frequency is taken",
    ] = None


@dataclass(frozen=True, slots=True)
class PhaseEntry:
    """One phase of an identification: the unknowns it seeks, the values it holds."""

    unknowns: Annotated[
        tuple[str, ...] | None, Items(), "unknowns to identify, by name or path; all by default"
    ] = None
    values: Annotated[Mapping[str, Any], "dotted path to a fixed value"] = field(
        default_factory=dict
    )


@dataclass(frozen=True, slots=True)
class PredictedEntry:
    """A number to compute for the identified machine."""

    of: Annotated[str, "number, as in a goal"]
    where: Annotated[Mapping[str, Any], "selection, as in a goal"] = field(default_factory=dict)
    name: Annotated[str, Key(default=""), "name in tables"] = ""
    measured: Annotated[str | None, "measured value for comparison, with its unit"] = None


@dataclass(frozen=True, slots=True)
class IdentificationFile:
    """An identification: numbers of one case sought so that it shows what was measured."""

    title: Annotated[str, Key(default=""), "one line, shown in summary and figures"]
    case: Annotated[str, "path of a case file, or the name of a case that comes with rotordyn"]
    unknowns: Annotated[Mapping[str, UnknownEntry], "dotted path, as in `vary`, to its bounds"]
    measurements: Annotated[
        Mapping[str, Any], "name to a measurement, whose `kind` decides its keys"
    ]
    hypotheses: Annotated[
        Mapping[str, Any], "dotted path to a list of values; every combination is a model"
    ] = field(default_factory=dict)
    phases: Annotated[
        Mapping[str, PhaseEntry], "name to a phase, a model with its own unknowns"
    ] = field(default_factory=dict)
    predict: Annotated[
        tuple[PredictedEntry, ...],
        Items(0),
        "numbers of the identified machine to compute, with intervals",
    ] = ()
    profiles: Annotated[
        Annotated[str, Choice((ALL,))] | tuple[str, ...],
        "unknowns, by path or name, or `all`, whose intervals are also found by profile likelihood",
    ] = ()
    criterion: Annotated[
        str | None, "mean absolute difference up to which a model suffices; by default χ² decides"
    ] = None
    minimise: Annotated[
        str,
        Choice(MINIMISED),
        "what is minimised: the squares of differences, or the mean of their absolute values",
    ] = MINIMISED[0]
    starts: Annotated[int, Whole(1, MOST_STARTS), "number of starts of each search"] = 1
    seed: Annotated[int, Whole(0, 2**31 - 1), "random seed of the starts after the first"] = 0


KINDS: dict[str, type] = {
    "axial curve": AxialCurveEntry,
    "no load": NoLoadEntry,
    "axial stiffness": AxialStiffnessEntry,
    "stop reached": StopEntry,
    "numbers": NumbersEntry,
    "frequency responses": ResponsesEntry,
    "modes": ModesEntry,
}
