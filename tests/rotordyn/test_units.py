"""Quantities with units: what is read, what is refused, and that nothing else happens."""

from __future__ import annotations

import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotordyn import units
from rotordyn.errors import InvalidInput
from rotordyn.quantity import Quantity

READ = [
    ("24000 rpm", "speed", 24000 * math.pi / 30),
    ("24000 1/min", "speed", 24000 * math.pi / 30),
    ("24 000 rpm", "speed", 24000 * math.pi / 30),
    ("24\u2009000 rpm", "speed", 24000 * math.pi / 30),  # thin space
    ("-1\u202f234\u202f567.5 N", "force", -1234567.5),  # narrow no-break space
    ("32 cSt", "kinematic viscosity", 32e-6),
    ("24000 min^-1", "speed", 24000 * math.pi / 30),
    ("24000 min⁻¹", "speed", 24000 * math.pi / 30),
    ("5 rad/s", "speed", 5.0),
    ("4 kHz", "frequency", 4000.0),
    ("91.8 mm", "length", 0.0918),
    ("2.5 in", "length", 0.0635),
    ("2.5 inch", "length", 0.0635),
    ("4 mil", "length", 101.6e-6),
    ("100 lbf", "force", 444.82216152605),
    ("10 lb", "mass", 4.5359237),
    ("2 oz in", "unbalance", 2.0 * 0.028349523125 * 0.0254),
    ("30000 psi", "pressure", 30000 * 6894.757293168361),
    ("50 lbf/in", "stiffness", 50 * 4.4482216152605 / 0.0254),
    ("1e-3 m", "length", 0.001),
    ("-0.305 um", "length", -0.305e-6),
    ("43.2 µm", "length", 43.2e-6),  # micro sign
    ("43.2 μm", "length", 43.2e-6),  # Greek mu
    ("25 deg", "angle", math.radians(25)),
    ("25°", "angle", math.radians(25)),
    ("1.5 kN", "force", 1500.0),
    ("6.2 N/um", "stiffness", 6.2e6),
    ("6.2 N/µm", "stiffness", 6.2e6),
    ("1 N/mm", "stiffness", 1e3),
    ("1 kN/mm", "stiffness", 1e6),
    ("1 MN/m", "stiffness", 1e6),
    ("3 N/rad", "coupling stiffness", 3.0),
    ("3 N m/rad", "tilt stiffness", 3.0),
    ("2000 N s/m", "damping", 2000.0),
    ("2000 N·s/m", "damping", 2000.0),
    ("2000N*s/m", "damping", 2000.0),
    ("240 g", "mass", 0.24),
    ("288 kg mm^2", "inertia", 2.88e-4),
    ("288 kg·mm²", "inertia", 2.88e-4),
    ("288 kg mm**2", "inertia", 2.88e-4),
    ("210 GPa", "pressure", 210e9),
    ("7.85 g/cm^3", "density", 7850.0),
    ("7850 kg/m³", "density", 7850.0),
    ("5 %", "ratio", 0.05),
    ("0.05", "ratio", 0.05),
    (0.3, "number", 0.3),
    (25, "number", 25.0),
]


@pytest.mark.parametrize(("text", "kind", "value"), READ)
def test_read(text: str | float, kind: str, value: float) -> None:
    assert units.parse(text, kind) == pytest.approx(value, rel=1e-15)


def test_decimal_prefixes_round_once() -> None:
    assert units.parse("91.8 mm", "length") == 0.0918
    assert units.parse("6.1 um", "length") == 6.1e-6


REFUSED = [
    ("24000 Hz", "speed", "'Hz' is not a unit of speed"),
    ("2513 rpm", "frequency", "'rpm' is not a unit of frequency"),
    ("50 1/s", "frequency", "not a unit of frequency"),
    ("50 1/s", "speed", "not a unit of speed"),
    ("70", "length", "unit missing (length): given '70'; allowed: m, mm, um, in"),
    (0, "length", "unit missing"),
    ("70 mmm", "length", "did you mean mm?"),
    ("24000 RPM", "speed", "did you mean rpm?"),
    ("3 N/m", "tilt stiffness", "not a unit of tilt stiffness"),
    ("6,2 N/um", "stiffness", "not a finite number"),
    ("24 00 rpm", "speed", "unknown unit '00 rpm'"),
    ("−50 N", "force", "(write the minus as '-', which '−' is not, U+2212): given '−50 N'"),
    ("–50 N", "force", "which '–' is not, U+2013"),
    ("3000,5 rpm", "speed", "not a finite number (write a decimal point, and spaces or nothing"),
    ("3,000 rpm", "speed", "(write a decimal point, and spaces or nothing between groups of three"),
    ("3'000 rpm", "speed", "(write a decimal point"),
    ("3’000 rpm", "speed", "(write a decimal point"),
    ("3_000 rpm", "speed", "(write a decimal point"),
    ("G 2.5", "balance quality", "(the grade G 2.5 is written 2.5 mm/s): given 'G 2.5'"),
    ("G6.3", "balance quality", "written 6.3 mm/s"),
    ("0xBB8 rpm", "speed", "not a finite number: given '0xBB8 rpm'"),
    ("nan mm", "length", "not a finite number"),
    (math.inf, "number", "not a finite number"),
    (math.nan, "ratio", "not a finite number"),
    ("1e999 mm", "length", "too large"),
    ("mm", "length", "not a finite number"),
    ("", "length", "not a finite number"),
    (None, "length", "given nothing"),
    (True, "number", "given 'true'"),
    ([1], "length", "given a list"),
    ({"a": 1}, "length", "given a mapping"),
    ("1 m/", "length", "unknown unit"),
    ("1 /m", "length", "unknown unit"),
]


@pytest.mark.parametrize(("given_", "kind", "fragment"), REFUSED)
def test_refused(given_: object, kind: str, fragment: str) -> None:
    with pytest.raises(InvalidInput) as caught:
        units.parse(given_, kind)
    assert fragment in str(caught.value)


@pytest.mark.parametrize(
    ("bracketed", "plain"),
    [
        ("N/(m/s)", "N s/m"),
        ("N/(m*s)", "N/m/s"),
        ("N / (m · s)", "N/m/s"),
        ("(m/s²)/N", "m/s²/N"),
        ("N/(mm/s/kg)", "N s kg/mm"),
    ],
)
def test_division_by_brackets(bracketed: str, plain: str) -> None:
    assert units.parse_unit(bracketed) == units.parse_unit(plain)


def test_every_kind_reads_each_unit_it_offers() -> None:
    for kind, offered in units.KINDS.items():
        for unit in offered:
            value = units.parse(f"2.5 {unit}", kind)
            assert units.in_unit(value, unit) == pytest.approx(2.5, rel=1e-14)


def test_speed_and_frequency_never_stand_in_for_one_another() -> None:
    for unit in units.KINDS["speed"]:
        with pytest.raises(InvalidInput):
            units.parse(f"1 {unit}", "frequency")
    for unit in units.KINDS["frequency"]:
        with pytest.raises(InvalidInput):
            units.parse(f"1 {unit}", "speed")


numbers = st.floats(-1e12, 1e12, allow_nan=False)
choices = st.sampled_from([(kind, unit) for kind, us in units.KINDS.items() for unit in us])


@given(numbers, choices)
def test_round_trip(number: float, choice: tuple[str, str]) -> None:
    kind, unit = choice
    value = units.parse(f"{number!r} {unit}", kind)
    assert units.in_unit(value, unit) == pytest.approx(number, rel=1e-13, abs=1e-300)


def read_or_refused(text: str, kind: str) -> bool:
    """Whether the text gave a finite value, or a sentence that says why not."""
    try:
        return math.isfinite(units.parse(text, kind))
    except InvalidInput as error:
        return bool(str(error))


@given(st.text(), st.sampled_from(sorted(units.KINDS)))
def test_any_text_is_read_or_refused(text: str, kind: str) -> None:
    assert read_or_refused(text, kind)


@given(
    st.text("0123456789.eE+-", max_size=12),
    st.text("mkgGMunNPaHzrpsd%*/^·²µ -()19", max_size=12),
    st.sampled_from(sorted(units.KINDS)),
)
def test_near_quantities_are_read_or_refused(number: str, unit: str, kind: str) -> None:
    assert read_or_refused(f"{number} {unit}", kind)


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (24000 * math.pi / 30, "rpm", "24000 rpm"),
        (56.3e6, "N/um", "56.30 N/µm"),
        (2.88e-4, "kg mm^2", "288.0 kg·mm²"),
        (0.0, "mm", "0 mm"),
        (0.012, "%", "1.200 %"),
        (1e-12, "m", "1.000e-12 m"),
        (0.3, "", "0.3000"),
    ],
)
def test_format(value: float, unit: str, text: str) -> None:
    assert units.format_quantity(value, unit) == text


@pytest.mark.parametrize("text", ["24 00 rpm", "2400 000 rpm", "24 0000 rpm", "24  000 rpm"])
def test_only_groups_of_three_digits_are_one_number(text: str) -> None:
    with pytest.raises(InvalidInput, match="unknown unit"):
        units.parse(text, "speed")


@pytest.mark.parametrize(
    ("kind", "unit"), [("temperature", "degC"), ("temperature difference", "K")]
)
def test_degrees_that_are_meant(kind: str, unit: str) -> None:
    with pytest.raises(InvalidInput, match=rf"unknown unit 'C'.*\(did you mean {unit}\?\)"):
        units.parse("40 C", kind)


@pytest.mark.parametrize(
    ("text", "kind", "meant"),
    [
        ("95 °F", "temperature", "35 degC"),
        ("1.4e2 degF", "temperature", "60 degC"),
        ("-40 F", "temperature", "-40 degC"),
        ("50 Fahrenheit", "temperature difference", "27.7778 K"),
    ],
)
def test_degrees_fahrenheit_are_named_in_the_unit_that_is_read(
    text: str, kind: str, meant: str
) -> None:
    """The boiling point has 212, the freezing point 32 of them; a difference of 180 is 100 K."""
    with pytest.raises(InvalidInput, match=rf"Fahrenheit is not read \(did you mean {meant}\?\)"):
        units.parse(text, kind)


def test_fahrenheit_means_nothing_of_other_kinds() -> None:
    with pytest.raises(InvalidInput, match="unknown unit 'F'") as refused:
        units.parse("3 F", "force")
    assert "Fahrenheit" not in str(refused.value)


@pytest.mark.parametrize(
    ("limits", "given", "likely"),
    [
        (("pressure", "1 GPa", "2000 GPa"), "210 MPa", "210 GPa"),
        (("density", "100 kg/m^3", "30000 kg/m^3"), "7.85 kg/m^3", "7.85 g/cm^3"),
        (("length", "0.1 mm", "1 m"), "50 m", "50 mm"),
        (("ratio", "0 %", "100 %"), 20, "20 %"),
    ],
)
def test_a_number_that_another_unit_would_allow(
    limits: tuple[str, str, str], given: object, likely: str
) -> None:
    """The message asks for it; where no unit helps it asks nothing."""
    kind, low, high = limits
    with pytest.raises(InvalidInput, match=rf"out of range.*\(did you mean {re.escape(likely)}\?"):
        Quantity(kind, at_least=low, at_most=high).read(given)
    with pytest.raises(InvalidInput) as refused:
        Quantity(kind, at_least=low, at_most=high).read(f"-1 {units.KINDS[kind][0]}")
    assert "did you mean" not in str(refused.value)
