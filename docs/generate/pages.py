"""Generated parts of every page."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path

from docs.generate.axial_rows import axial_table, phase_table
from docs.generate.bearing_rows import bearing_rows
from docs.generate.bending import axial_force_spans, axial_force_table, formulation_table
from docs.generate.choices import choice_table, linear_table
from docs.generate.coupled_rows import damping_table
from docs.generate.debongnie_rows import error_table, law_table
from docs.generate.engineer_rows import engineer_rows
from docs.generate.flagship import bearing_table, flagship, rest_rows, speed_rows
from docs.generate.heat_rows import heat_table, published_heat_table
from docs.generate.identified import (
    draw_identified,
    identified_table,
    predicted_table,
    synthetic_table,
)
from docs.generate.keys import key_tables
from docs.generate.known import comparison_table, omitted
from docs.generate.marked import rewrite, table
from docs.generate.modules import module_table
from docs.generate.places import DOCS, THEORY
from docs.generate.random_networks import random_networks
from docs.generate.ring_rows import thesis_table, walls_table
from docs.generate.rotor_rows import rotor_rows
from docs.generate.rows import HEAD, Row
from docs.generate.snippets import write_snippets
from docs.generate.synthetic_rotors import synthetic_rotors
from docs.generate.times import benchmark_parts, measured


def write_accuracy() -> None:
    """Published and independent values compared with computed ones."""
    rows = [*bearing_rows(), *rotor_rows(), *rest_rows(), *speed_rows()]
    rewrite(DOCS / "accuracy.md", {"accuracy": _accuracy(rows)})


def write_flagship() -> None:
    """The flagship compared with published, measured and independent values."""
    known = flagship()
    fresh = {
        "comparison": comparison_table(known),
        "bearings": bearing_table(),
        "omitted": omitted(known),
        "rest": _accuracy(rest_rows()),
        "speed": _accuracy(speed_rows()),
        "axial": axial_table(),
        "phases": phase_table(),
    }
    rewrite(DOCS / "mfw2310.md", fresh)


def write_keys() -> None:
    """The reference of keys."""
    rewrite(DOCS / "reference" / "keys.md", key_tables())


def write_bending() -> None:
    """Effect of formulation and axial force on the flagship."""
    rewrite(DOCS / "formulations.md", {"formulations": formulation_table()})
    fresh = {"axial-force": axial_force_spans(), "axial-stiffening": axial_force_table()}
    rewrite(DOCS / "theory" / "axial_force.md", fresh)


def write_choosing() -> None:
    """Effect of the choices of a case."""
    rewrite(DOCS / "howto" / "hypotheses.md", {"choices": choice_table(), "linear": linear_table()})


def write_coupled() -> None:
    """Effect of damping on a coupled tool."""
    rewrite(DOCS / "howto" / "measured_spindle.md", {"damping": damping_table()})


def write_theory() -> None:
    """Pages that explain the modules."""
    rewrite(THEORY / "README.md", {"modules": module_table()})


def write_rings() -> None:
    """Flexible rings, compared with published ones and with rigid ones."""
    fresh = {"thesis": thesis_table(), "walls": walls_table()}
    rewrite(THEORY / "flexible_rings.md", fresh)


def write_heat() -> None:
    """Friction by every model, and published values compared with computed ones."""
    fresh = {
        "heat": heat_table(),
        "published-heat": published_heat_table(),
        "checked": _accuracy(engineer_rows()),
    }
    rewrite(THEORY / "life.md", fresh)


def write_synthetic_rotors() -> None:
    """Random rotors identified from synthetic responses."""
    fresh = {"identified-rotors": synthetic_rotors(measured()["synthetic_rotors"])}
    rewrite(THEORY / "rotor_from_responses.md", fresh)


def write_networks() -> None:
    """Random networks with friction, from the last survey."""
    fresh = {"random-networks": random_networks(measured()["random_networks"])}
    rewrite(THEORY / "network.md", fresh)


def write_debongnie() -> None:
    """Power laws of Debongnie's approximation and its errors."""
    rewrite(THEORY / "debongnie.md", {"power-laws": law_table(), "errors": error_table()})


def write_benchmarks() -> None:
    """Times of the last measurement."""
    rewrite(DOCS / "benchmarks.md", benchmark_parts(measured()))


def write_identified() -> None:
    """The flagship identified again, with its figures."""
    fresh = {"identified": identified_table(), "predicted": predicted_table()}
    rewrite(DOCS / "mfw2310.md", fresh)
    draw_identified()


def write_synthetic() -> None:
    """Identification from synthetic data, as measured last."""
    rewrite(
        THEORY / "identification.md", {"synthetic": synthetic_table(measured()["identification"])}
    )


def write_outputs() -> None:
    """Output of the commands and the code of the pages, and figures of their runs."""
    with tempfile.TemporaryDirectory() as folder:
        write_snippets(Path(folder))


PAGES: dict[str, Callable[[], None]] = {
    "docs/reference/keys.md": write_keys,
    "docs/theory/README.md": write_theory,
    "docs/theory/debongnie.md": write_debongnie,
    "docs/theory/flexible_rings.md": write_rings,
    "docs/theory/life.md": write_heat,
    "docs/theory/network.md": write_networks,
    "docs/theory/rotor_from_responses.md": write_synthetic_rotors,
    "docs/benchmarks.md": write_benchmarks,
    "docs/formulations.md, docs/theory/axial_force.md": write_bending,
    "docs/howto/hypotheses.md": write_choosing,
    "docs/howto/measured_spindle.md": write_coupled,
    "docs/mfw2310.md": write_flagship,
    "docs/mfw2310.md, identified again": write_identified,
    "docs/theory/identification.md": write_synthetic,
    "docs/accuracy.md": write_accuracy,
    "README.md, docs/tutorial, docs/howto, docs/reference": write_outputs,
}


def _accuracy(rows: list[Row]) -> str:
    return table(HEAD, [row.cells for row in rows])
