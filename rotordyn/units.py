"""Quantities with units: conversion between text and SI numbers, done here alone.

``"24000 rpm"`` becomes 2513.27 (rad/s) where a speed is wanted and is refused where a frequency is.
A unit is a product of named units with powers; each is a power of ten, a factor and a dimension
over (metre, kilogram, second, radian, cycle, degree Celsius, which counts from 0 °C, kelvin, of
differences). Radian and cycle are dimensions here, so that speed [rad/s] and frequency
[cycle/s = Hz], or N/m and N/rad, cannot be mistaken for one another.
"""

from __future__ import annotations

import difflib
import math
import re
from dataclasses import dataclass
from functools import cache, lru_cache

from rotordyn.errors import InvalidInput

STANDARD_GRAVITY = 9.80665  # m/s²

Dimension = tuple[int, int, int, int, int, int, int]

NONE: Dimension = (0, 0, 0, 0, 0, 0, 0)


@dataclass(frozen=True, slots=True)
class Unit:
    """One SI-coherent scale: value [SI] = number · 10^``exponent`` · ``factor``."""

    exponent: int
    factor: float
    dimension: Dimension

    @property
    def scale(self) -> float:
        """SI value of one of this unit."""
        return float(f"1e{self.exponent}") * self.factor


_NAMED: dict[str, Unit] = {
    "m": Unit(0, 1.0, (1, 0, 0, 0, 0, 0, 0)),
    "g": Unit(-3, 1.0, (0, 1, 0, 0, 0, 0, 0)),
    "s": Unit(0, 1.0, (0, 0, 1, 0, 0, 0, 0)),
    "min": Unit(0, 60.0, (0, 0, 1, 0, 0, 0, 0)),
    "h": Unit(0, 3600.0, (0, 0, 1, 0, 0, 0, 0)),
    "rad": Unit(0, 1.0, (0, 0, 0, 1, 0, 0, 0)),
    "deg": Unit(0, math.pi / 180.0, (0, 0, 0, 1, 0, 0, 0)),
    "degC": Unit(0, 1.0, (0, 0, 0, 0, 0, 1, 0)),
    "K": Unit(0, 1.0, (0, 0, 0, 0, 0, 0, 1)),
    "cSt": Unit(-6, 1.0, (2, 0, -1, 0, 0, 0, 0)),
    "W": Unit(0, 1.0, (2, 1, -3, 0, 0, 0, 0)),
    "J": Unit(0, 1.0, (2, 1, -2, 0, 0, 0, 0)),
    "rpm": Unit(0, math.pi / 30.0, (0, 0, -1, 1, 0, 0, 0)),
    "Hz": Unit(0, 1.0, (0, 0, -1, 0, 1, 0, 0)),
    "N": Unit(0, 1.0, (1, 1, -2, 0, 0, 0, 0)),
    "Pa": Unit(0, 1.0, (-1, 1, -2, 0, 0, 0, 0)),
    "%": Unit(-2, 1.0, NONE),
    "in": Unit(-4, 254.0, (1, 0, 0, 0, 0, 0, 0)),
    "inch": Unit(-4, 254.0, (1, 0, 0, 0, 0, 0, 0)),
    "mil": Unit(-7, 254.0, (1, 0, 0, 0, 0, 0, 0)),
    "lbf": Unit(0, 4.4482216152605, (1, 1, -2, 0, 0, 0, 0)),
    "lb": Unit(0, 0.45359237, (0, 1, 0, 0, 0, 0, 0)),
    "oz": Unit(0, 0.028349523125, (0, 1, 0, 0, 0, 0, 0)),
    "psi": Unit(0, 4.4482216152605 / 0.0254**2, (-1, 1, -2, 0, 0, 0, 0)),
}
_PREFIXES = {"G": 9, "M": 6, "k": 3, "c": -2, "m": -3, "u": -6, "n": -9}
_PREFIXED = ("m", "g", "s", "rad", "Hz", "N", "Pa", "W", "J")
_WHOLE = {"1/min": "rpm", "min^-1": "rpm", "r/min": "rpm", "rev/min": "rpm"}
_SPELLING = str.maketrans({"µ": "u", "μ": "u", "·": "*", "⋅": "*", "×": "*", "°": "deg"})
_POWERS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")

# Kinds of quantity, and the units that messages offer; the dimension follows from these.
KINDS: dict[str, tuple[str, ...]] = {
    "number": ("",),
    "ratio": ("%", ""),
    "length": ("m", "mm", "um", "in"),
    "angle": ("deg", "rad"),
    "speed": ("rpm", "rad/s", "1/min"),
    "frequency": ("Hz", "kHz"),
    "force": ("N", "kN"),
    "mass": ("kg", "g"),
    "inertia": ("kg m^2", "kg mm^2"),
    "moment": ("N m", "kN m", "N mm"),
    "line load": ("N/m", "N/mm", "kN/m"),
    "unbalance": ("g mm", "kg mm", "kg m"),
    "balance quality": ("mm/s",),
    "rate": ("1/s",),
    "power": ("kW", "W"),
    "time": ("s", "ms", "us"),
    "pressure": ("Pa", "MPa", "GPa"),
    "viscosity": ("Pa s", "mPa s"),
    "kinematic viscosity": ("mm^2/s", "m^2/s"),
    "temperature": ("degC",),
    "temperature difference": ("K",),
    "thermal expansion": ("1/K", "um/m/K"),
    "thermal conductance": ("W/K",),
    "heat capacity": ("J/K", "kJ/K"),
    "duration": ("h", "min", "s"),
    "density": ("kg/m^3", "g/cm^3"),
    "stiffness": ("N/m", "N/mm", "N/um", "kN/mm", "MN/m"),
    "coupling stiffness": ("N/rad", "kN/rad", "N"),
    "tilt stiffness": ("N m/rad", "kN m/rad"),
    "damping": ("N s/m", "kN s/m"),
    "coupling damping": ("N s/rad", "N s"),
    "tilt damping": ("N m s/rad",),
}

_ALSO = {  # further spellings
    "pressure": ("N/m^2",),
    "kinematic viscosity": ("cSt",),
    "speed": ("rad s^-1",),
}
DIFFERENCE = {"temperature": "temperature difference"}  # kinds whose differences have another
_ZERO_IN_FAHRENHEIT = {"temperature": 32.0, "temperature difference": 0.0}
_MEANT = {"C": ("degC", "K"), "c": ("degC", "K"), "Celsius": ("degC", "K")}

_NUMBER = re.compile(
    r"\s*([+-]?(?:\d+\.?\d*|\.\d+))(?:[eE]([+-]?\d{1,4}))?(?![\d.,eExX_'’])\s*(.*)", re.S
)
_MARKED = re.compile(r"\s*[+-]?\d+[,_'’]\d")
_GRADE = re.compile(r"\s*G\s?(\d+(?:\.\d+)?)\s*")  # of balance quality
_DASHED = re.compile(r"\s*([‐-―−])\s*[\d.]")
_GROUPED = re.compile(r"(\s*[+-]?\d{1,3}(?:[ \u00a0\u2009\u202f]\d{3})+)(?!\d)")
_FACTOR = re.compile(r"\s*([*/]?)\s*([A-Za-z]+|%)(?:(?:\^|\*\*)([+-]?\d{1,2}))?")


def parse(given: object, kind: str) -> float:
    """SI value of ``given`` (text such as ``"6.2 N/um"``, or a number) as a quantity of ``kind``.

    ``kind`` is a key of ``KINDS``. Raises InvalidInput with a sentence that names what was given
    and what is allowed: no number, no unit, an unknown one, one of another kind, not finite.
    """
    if str(kind) not in KINDS:
        raise InvalidInput(f"no kind of quantity: given {shown(kind)}; allowed: {', '.join(KINDS)}")
    if isinstance(given, bool) or not isinstance(given, str | int | float):
        raise InvalidInput(f"expected {kind}: given {shown(given)}; {_allowed(kind)}")
    match = _NUMBER.fullmatch(_ungrouped(written(given)))
    if match is None:
        why = f"not a finite number{_not_plain(written(given))}"
        raise InvalidInput(f"{why}: given {shown(given)}; {_allowed(kind)}")
    mantissa, exponent, text = match.groups()
    unit = _unit_for(kind, text.strip(), given)
    value = float(f"{mantissa}e{int(exponent or 0) + unit.exponent}") * unit.factor
    if not math.isfinite(value):
        raise InvalidInput(f"too large a number: given {shown(given)}")
    return value


def _not_plain(text: str) -> str:
    """Hint on a notation of numbers that cannot be read; empty if none is recognised."""
    if dashed := _DASHED.match(text):
        return f" (write the minus as '-', which '{dashed[1]}' is not, U+{ord(dashed[1]):04X})"
    if grade := _GRADE.fullmatch(text):
        return f" (the grade {text.strip()} is written {grade[1]} mm/s)"
    if _MARKED.match(text):
        return " (write a decimal point, and spaces or nothing between groups of three digits)"
    return ""


def unit_of(given: object) -> str:
    """Unit of text such as ``"6.2 N/um"``; empty if there is none."""
    match = _NUMBER.fullmatch(_ungrouped(written(given))) if isinstance(given, str) else None
    return "" if match is None else match[3].strip()


def _ungrouped(text: str) -> str:
    """Remove spaces between groups of three digits of a number."""
    match = _GROUPED.match(text)
    return text if match is None else re.sub(r"\s", "", match[1]) + text[match.end() :]


def _unit_for(kind: str, text: str, given: object) -> Unit:
    if not text and "" not in KINDS[kind]:
        raise InvalidInput(f"unit missing ({kind}): given {shown(given)}; {_allowed(kind)}")
    try:
        unit = parse_unit(text)
    except InvalidInput:
        raise InvalidInput(
            f"unknown unit '{text}': given {shown(given)}; {_allowed(kind)}"
            f"{_fahrenheit(text, kind, given) or _hint(text, kind)}"
        ) from None
    if unit.dimension not in _dimensions(kind):
        raise InvalidInput(
            f"'{text}' is not a unit of {kind}: given {shown(given)}; {_allowed(kind)}"
        )
    return unit


@lru_cache(maxsize=256)
def parse_unit(text: str) -> Unit:
    """The unit spelled by ``text``; raises InvalidInput where it has none or an unknown one.

    A slash divides by the one factor after it, or by a product in brackets; µ, μ or u, a dot, star
    or space, ² or ^2 all do.
    """
    spelling = _normal(without_brackets(text))
    spelling = _WHOLE.get(spelling.replace(" ", ""), spelling)
    exponent, factor, dimension = 0, 1.0, NONE
    position = 1 if re.match(r"1 ?/", spelling) else 0
    while position < len(spelling):
        match = _FACTOR.match(spelling, position)
        if match is None or (position == 0 and match[1]):
            raise InvalidInput(f"unknown unit '{text}'")
        named = _named(match[2], text)
        power = int(match[3] or 1) * (-1 if match[1] == "/" else 1)
        exponent += power * named.exponent
        factor *= named.factor**power
        dimension = _plus(dimension, named.dimension, power)
        position = match.end()
    return Unit(exponent, factor, dimension)


def without_brackets(text: str) -> str:
    """Write a unit without brackets: division by a product becomes division by each factor, and
    by a quotient multiplication with its divisor.

    >>> without_brackets("rad/(N·m)"), without_brackets("(m/s²)/N"), without_brackets("N/(m/s)")
    ('rad/N/m', 'm/s²/N', 'N/m·s')
    """

    def divided(product: re.Match[str]) -> str:
        first, *others = re.split(r"\s*([·⋅*/ ])\s*", product[1].strip())
        pairs = zip(others[::2], others[1::2], strict=True)
        return f"/{first}" + "".join(("·" if by == "/" else "/") + name for by, name in pairs)

    return re.sub(r"\(([^()]*)\)", r"\1", re.sub(r"/\s*\(([^()]*)\)", divided, text))


def _named(name: str, whole: str) -> Unit:
    if name in _NAMED:
        return _NAMED[name]
    prefix, stem = name[:1], name[1:]
    if prefix in _PREFIXES and stem in _PREFIXED:
        base = _NAMED[stem]
        return Unit(base.exponent + _PREFIXES[prefix], base.factor, base.dimension)
    raise InvalidInput(f"unknown unit '{name}' in '{whole}'")


def pattern(kind: str) -> str:
    """Regular expression of the common spellings of a unit of ``kind``; ``""`` if it needs none.

    Every unit that matches can be read; more can be read than it matches.
    """
    return "|".join(
        dict.fromkeys(_spellings(unit) for unit in (*KINDS[kind], *_ALSO.get(kind, ())))
    )


def _spellings(unit: str) -> str:
    if unit in _WHOLE:
        whole = "|".join(_WHOLE).replace("/", r"\s*/\s*")
        return whole.replace("^-1", r"(?:\^-1|⁻¹)")
    if unit.startswith("1/"):  # one minute would be a speed
        return rf"1\s*/\s*{unit[2:]}|{unit[2:]}{_power('-1')}"
    spellings = []
    for position, (join, name, power) in enumerate(_FACTOR.findall(unit)):
        between = r"\s*/\s*" if join == "/" else r"(?:\s*[*·⋅×]\s*|\s+)"
        spellings.append((between if position else "") + _alike(name) + _power(power))
    return "".join(spellings)


def _power(power: str) -> str:
    raised = power.translate({plain: sign for sign, plain in _POWERS.items()})
    return rf"(?:(?:\^|\*\*){power}|{raised})" if power else ""


def _alike(name: str) -> str:
    """Pattern of the named units with the dimension of ``name``, and their prefixes."""
    dimension = _named(name, name).dimension
    stems = [stem for stem, unit in _NAMED.items() if unit.dimension == dimension]
    words = [f"[GMkcmuµμn]?{stem}" if stem in _PREFIXED else stem for stem in stems]
    signs = [stem.replace("deg", "°") for stem in stems if stem.startswith("deg")]
    return f"(?:{'|'.join(words + signs)})"


def in_unit(value: float, unit: str) -> float:
    """``value`` [SI] counted in ``unit``: ``in_unit(2513.27, "rpm")`` is 24000."""
    return value / parse_unit(unit).scale


def format_quantity(value: float, unit: str, digits: int = 4) -> str:
    """Format ``value`` [SI] with ``digits`` significant digits and its unit: ``"56.30 N/µm"``."""
    number = in_unit(value, unit)
    return f"{_significant(number, digits)} {pretty_unit(unit)}".rstrip()


def pretty_unit(unit: str) -> str:
    """A unit as printed on an axis: ``"kg mm^2"`` becomes ``"kg·mm²"``."""
    text = re.sub(r"\bu(?=[a-zA-Z])", "µ", _normal(unit)).replace("*", "·").replace(" ", "·")
    return re.sub(r"\^([23])", lambda m: "²" if m[1] == "2" else "³", text)


def _significant(number: float, digits: int) -> str:
    if number == 0.0 or not math.isfinite(number):
        return f"{number:g}"
    magnitude = math.floor(math.log10(abs(number)))
    if not -4 <= magnitude < 9:
        return f"{number:.{digits - 1}e}"
    return f"{number:.{max(0, digits - 1 - magnitude)}f}"


def _normal(text: str) -> str:
    marked = re.sub(r"([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)", lambda m: "^" + m[1].translate(_POWERS), text)
    return re.sub(r"\s+", " ", marked.translate(_SPELLING)).strip()


def _plus(left: Dimension, right: Dimension, power: int) -> Dimension:
    m, kg, s, rad, cycle, c, k = (a + power * b for a, b in zip(left, right, strict=True))
    return m, kg, s, rad, cycle, c, k


@cache
def _dimensions(kind: str) -> frozenset[Dimension]:
    return frozenset(parse_unit(unit).dimension for unit in KINDS[kind])


def _allowed(kind: str) -> str:
    names = [unit or "a plain number" for unit in KINDS[kind]]
    return f"allowed: {', '.join(names)}"


def _fahrenheit(text: str, kind: str, given: object) -> str:
    """Hint with the converted value if the unit is degrees Fahrenheit, which is not supported."""
    match = _NUMBER.fullmatch(_ungrouped(written(given)))
    if text.lower().removeprefix("°").removeprefix("deg").strip() not in ("f", "fahrenheit"):
        return ""
    if match is None or kind not in _ZERO_IN_FAHRENHEIT:
        return ""
    number = float(f"{match[1]}e{match[2] or 0}")
    value = (number - _ZERO_IN_FAHRENHEIT[kind]) / 1.8
    return f"; Fahrenheit is not read (did you mean {value:.6g} {KINDS[kind][0]}?)"


def _hint(text: str, kind: str) -> str:
    for meant in _MEANT.get(text, ()):
        if meant in KINDS[kind]:
            return f" (did you mean {meant}?)"
    units = {unit.lower(): unit for unit in KINDS[kind]}
    close = difflib.get_close_matches(_normal(text).lower(), list(units), n=1, cutoff=0.5)
    return f" (did you mean {units[close[0]]}?)" if close else ""


def written(given: object) -> str:
    """Text of a value; integers of thousands of digits, which Python refuses, get a description."""
    try:
        return given if isinstance(given, str) else " ".join(str(given).split())
    except ValueError:
        return "a very large number"


def shown(given: object) -> str:
    """Text of a value for messages, limited in length."""
    if given is None:
        return "nothing"
    if isinstance(given, dict):
        return "a mapping"
    if isinstance(given, list | tuple):
        return "a list"
    text = str(given).lower() if isinstance(given, bool) else written(given)
    return f"'{text if len(text) <= 40 else text[:37] + '...'}'"
