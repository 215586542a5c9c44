"""Which page gets which generated parts."""

from __future__ import annotations

from collections.abc import Callable

from docs.generate.bearing_rows import bearing_rows
from docs.generate.bending import axial_force_spans, axial_force_table, formulation_table
from docs.generate.choices import choice_table, linear_table
from docs.generate.debongnie_rows import error_table, law_table
from docs.generate.flagship import flagship, rest_rows, speed_rows
from docs.generate.keys import key_tables
from docs.generate.known import comparison_table, left_out
from docs.generate.marked import rewrite, table
from docs.generate.modules import module_table
from docs.generate.places import DOCS, README, THEORY
from docs.generate.rotor_rows import rotor_rows
from docs.generate.rows import HEAD, Row
from docs.generate.times import benchmark_parts, measured, short_table


def write_readme() -> None:
    """Accuracy and times."""
    rows = [*bearing_rows(), *rotor_rows(), *rest_rows(), *speed_rows()]
    rewrite(README, {"accuracy": _accuracy(rows), "times": short_table(measured())})


def write_flagship() -> None:
    """The flagship beside what is published, measured, and found by others."""
    known = flagship()
    fresh = {
        "comparison": comparison_table(known),
        "left-out": left_out(known),
        "rest": _accuracy(rest_rows()),
        "speed": _accuracy(speed_rows()),
    }
    rewrite(DOCS / "mfw2310.md", fresh)


def write_keys() -> None:
    """The reference of keys."""
    rewrite(DOCS / "keys.md", key_tables())


def write_bending() -> None:
    """What formulation and axial force do to the flagship."""
    rewrite(DOCS / "formulations.md", {"formulations": formulation_table()})
    fresh = {"axial-force": axial_force_spans(), "axial-stiffening": axial_force_table()}
    rewrite(DOCS / "theory" / "axial_force.md", fresh)


def write_choosing() -> None:
    """What the choices of a case change."""
    rewrite(DOCS / "choosing.md", {"choices": choice_table(), "linear": linear_table()})


def write_theory() -> None:
    """Which page explains which module."""
    rewrite(THEORY / "README.md", {"modules": module_table()})


def write_debongnie() -> None:
    """Power laws of Debongnie's approximation, and how far it is off."""
    rewrite(THEORY / "debongnie.md", {"power-laws": law_table(), "errors": error_table()})


def write_benchmarks() -> None:
    """Times, from what was measured last."""
    rewrite(DOCS / "benchmarks.md", benchmark_parts(measured()))


PAGES: dict[str, Callable[[], None]] = {
    "docs/keys.md": write_keys,
    "docs/theory/README.md": write_theory,
    "docs/theory/debongnie.md": write_debongnie,
    "docs/benchmarks.md": write_benchmarks,
    "docs/formulations.md, docs/theory/axial_force.md": write_bending,
    "docs/choosing.md": write_choosing,
    "docs/mfw2310.md": write_flagship,
    "README.md": write_readme,
}


def _accuracy(rows: list[Row]) -> str:
    return table(HEAD, [row.cells for row in rows])
