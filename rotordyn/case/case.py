"""A case: one machine, how it is modelled, which speeds, which analyses."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Annotated

from bearings.bearing import BallBearing
from rotordyn.analyses.registry import analysis
from rotordyn.case.uncertain import Uncertain, Worded
from rotordyn.description import Description, Faults, ascending, within
from rotordyn.errors import InvalidInput
from rotordyn.machine.assembly import unknown
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.tool import Tool
from rotordyn.quantity import HIDDEN, Items, Key, Name, Speed, Sweep
from rotordyn.scene.agreement import last_setting_faults, setting_faults
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.spec import Setting, Spec

OF_BALLS = ("kinematics", "moment_sharing", "friction", "dynamics")


class ByName:
    """Mark of a mapping of specs by the name of their analysis, which determines their class."""


@dataclass(frozen=True, slots=True)
class Case(Description):
    """The case itself: a machine, how it is modelled, the speeds, and what is asked.

    Exactly one of ``spindle`` and ``bearing`` is given. Nothing that ``analyses`` does not name is
    computed. ``files``: every file read; ``digest``: their hash, with the changes that ``vary``
    made to them; ``sources``: of each that says so, its title and where its values come from: cases
    that differ in these alone are equal.
    ``variants``: other cases with the same speeds and analyses, by name; where there
    are any, they are solved side by side, and the case itself is not. ``tool``: what of
    ``spindle`` is the tool in its nose.
    """

    name: Annotated[str, HIDDEN]
    title: Annotated[str, Key(default=""), "one line, shown in summary and figures"]
    speeds: Annotated[
        tuple[Speed, ...], Items(), Sweep(), "every speed at which the analyses are solved"
    ]
    analyses: Annotated[
        Mapping[Name, Spec],
        ByName(),
        "analyses to solve; others are not computed",
    ]
    conditions: Annotated[Conditions, "speeds, loads and model choices"] = field(
        default_factory=Conditions
    )
    spindle: Annotated[Spindle | None, "name of a model, or a path; either this or `bearing`"] = (
        None
    )
    bearing: Annotated[
        BallBearing | None, "name or path of a single bearing; either this or `spindle`"
    ] = None
    references: Annotated[tuple[Reference, ...], "known values shown beside the computed ones"] = ()
    uncertain: Annotated[
        Uncertain | None,
        Worded(),
        "uncertain values, of which `--interval` gives the range of every result; or "
        "`as usual` ([how](howto/intervals.md))",
    ] = None
    files: Annotated[tuple[Path, ...], HIDDEN] = field(default=(), compare=False)
    digest: Annotated[str, HIDDEN] = field(default="", compare=False)
    sources: Annotated[Mapping[str, tuple[str, ...]], HIDDEN] = field(
        default_factory=dict, repr=False, compare=False
    )
    variants: Annotated[Mapping[Name, Case], HIDDEN] = field(default_factory=dict)
    tool: Annotated[Tool | None, HIDDEN] = field(default=None, repr=False, compare=False)

    @property
    def known(self) -> tuple[Reference, ...]:
        """References that hold under the conditions of this case."""
        return tuple(r for r in self.references if self._holds(r))

    def _holds(self, reference: Reference) -> bool:
        given = self.conditions
        return all(getattr(given, key) == word for key, word in reference.conditions.items())

    def vary(self, changes: Mapping[str, object]) -> Case:
        """Return this case with other values at dotted paths; see ``rotordyn.vary``."""
        from rotordyn.case.vary import vary

        return vary(self, changes)

    def _repr_html_(self) -> str:
        """Short table of machine, speeds and analyses for notebooks."""
        from rotordyn.markup import table

        return table(self.title or self.name, self._rows())

    def _rows(self) -> Iterator[tuple[str, str]]:
        yield "case", self.name
        if self.spindle is not None:
            yield "spindle", self.spindle.title or self.spindle.name
        else:
            yield "bearing", type(self.bearing).__name__
        ends = dict.fromkeys((self.speeds[0], self.speeds[-1]))
        rpm = " to ".join(f"{speed * 30.0 / math.pi:.6g}" for speed in ends)
        yield "speeds", f"{rpm} rpm, {len(self.speeds)} in all"
        given = [f"{name}: {getattr(self.conditions, name)}" for name in self._changed]
        yield "conditions", ", ".join(given) or "the defaults"
        yield "analyses", ", ".join(self.analyses)
        if self.variants:
            yield "variants", ", ".join(self.variants)

    @property
    def setting(self) -> Setting | None:
        """Spindle, conditions and speeds; None for a single bearing."""
        if self.spindle is None:
            return None
        return Setting(self.spindle, self.conditions, self.speeds)

    @property
    def _changed(self) -> list[str]:
        """Names of the conditions that are not the defaults."""
        given, usual = self.conditions, Conditions()
        names = (each.name for each in fields(usual) if each.compare)
        return [name for name in names if getattr(given, name) != getattr(usual, name)]

    @property
    def _named(self) -> dict[str, Spec]:
        """Analyses without those that are faulty and reported already."""
        return {name: spec for name, spec in self.analyses.items() if name}

    def _faults(self) -> Faults:
        if (self.spindle is None) == (self.bearing is None):
            given = "neither" if self.spindle is None else "both"
            yield (), f"a case has either a spindle or a bearing: given {given}"
            return
        faults = [*self.faults_alone()]
        yield from faults
        if any(path == ("analyses",) for path, _ in faults):
            return
        yield from self._asked_of_machine()
        if self.setting is not None:
            yield from setting_faults(self.setting)
            for name, spec in self.analyses.items():
                yield from within(("analyses", name), spec.faults_on(self.setting))
        yield from self._variants()

    def faults_alone(self) -> Faults:
        """Yield faults that do not depend on the machine."""
        yield from ascending("speeds", self.speeds)
        if not self.analyses:
            yield ("analyses",), "no analysis is given: name at least one"
        for name, spec in self._named.items():
            try:
                wanted = analysis(name).spec
            except InvalidInput as refusal:
                yield ("analyses",), str(refusal)
                continue
            if not isinstance(spec, wanted):
                given = type(spec).__name__
                yield ("analyses", name), f"needs a {wanted.__name__}: given a {given}"
        known = [each.name for each in fields(Conditions) if each.compare]
        for index, reference in enumerate(self.references):
            for name in reference.conditions:
                for sentence in unknown("condition", name, known):
                    yield ("references", index, "conditions"), sentence

    def _asked_of_machine(self) -> Faults:
        """Yield faults of analyses and conditions that do not apply to this kind of machine."""
        for name in self._named:
            record = analysis(name)
            if (record.machine == "bearing") != (self.bearing is not None):
                kind = "spindle" if self.bearing is None else "single bearing"
                yield ("analyses", name), f"this analysis does not apply to a {kind}"
            elif record.bearings and self.spindle is not None and not self.spindle.seats:
                yield ("analyses", name), "needs bearings: this spindle has none"
        for name in self._changed if self.bearing is not None else ():
            if name not in OF_BALLS:
                yield (
                    ("conditions", name),
                    f"does not apply to a single bearing; allowed: {', '.join(OF_BALLS)}",
                )

    def _variants(self) -> Faults:
        for name, variant in self.variants.items():
            if variant.speeds != self.speeds or variant.analyses != self.analyses:
                yield (
                    ("compare", name),
                    "the speeds and analyses of a variant must be those of the case",
                )
            if variant.variants:
                yield ("compare", name), "a variant has no variants of its own"

    def _last_faults(self) -> Faults:
        if self.uncertain is not None:
            from rotordyn.case.asked import faults_of

            yield from faults_of(self)
        if self.bearing is not None:
            for name, spec in self.analyses.items():
                yield from within(("analyses", name), spec.last_faults_of(self.bearing))
        if self.setting is None:
            return
        yield from last_setting_faults(self.setting)
        for name, spec in self.analyses.items():
            yield from within(("analyses", name), spec.last_faults_on(self.setting))
        if self.conditions.element_length is not None:
            from rotordyn.analyses.resolution import beyond_elements

            top = max(self.speeds, default=0.0)
            assert self.spindle is not None
            for why in beyond_elements(self.spindle, self.conditions, self.analyses, top):
                yield ("conditions", "element_length"), f"{why}: given {{given}}"
