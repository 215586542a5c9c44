"""Printed unit of each SI quantity, for tables and figures only."""

from __future__ import annotations

import math
from dataclasses import dataclass

ROUNDING = 1e-6  # of a printed value: less is printed as zero
SMALL, LEAST = 1e-3, 1e-15  # bounds of values that are small by their unit, not by rounding


@dataclass(frozen=True, slots=True)
class Shown:
    """A printed unit; a value in SI times ``factor`` is the value printed."""

    unit: str
    factor: float = 1.0


RPM = Shown("rpm", 30.0 / math.pi)
PER_SECOND = Shown("rad/s")  # of poles, which are not speeds
MILLIMETRE = Shown("mm", 1e3)
MICROMETRE = Shown("µm", 1e6)
GRAM_MILLIMETRE = Shown("g·mm", 1e6)
STIFFNESS = Shown("N/µm", 1e-6)
DEGREE = Shown("deg", 180.0 / math.pi)
MEGAPASCAL = Shown("MPa", 1e-6)
GIGAPASCAL = Shown("GPa", 1e-9)
_ENGINEERING = {
    "rad/s": RPM,
    "m": MICROMETRE,
    "N/m": STIFFNESS,
    "rad": DEGREE,
    "Pa": GIGAPASCAL,
    "m/N": Shown("µm/N", 1e6),
    "(m/s)/N": Shown("(mm/s)/N", 1e3),
    "degC": Shown("°C"),
    "mm/min": Shown("1e6 mm/min", 1e-6),
    "1": Shown("-"),
    "": Shown(""),
}


def shown(unit: str) -> Shown:
    """Printed unit of values in SI ``unit``; unknown units stay as they are."""
    return _ENGINEERING.get(unit, Shown(unit))


def percent(share: float) -> str:
    """Format a share in percent, with two digits.

    >>> [percent(each) for each in (0.0561, 0.5, 1.0)]
    ['5.6 %', '50 %', '100 %']
    """
    return f"{float(f'{100.0 * share:.2g}'):g} %"


def number(value: float, digits: int = 1) -> str:
    """Format a value with ``digits`` decimals, or three digits where these would leave fewer;
    "none" without a value.

    >>> [number(each) for each in (903.04, 2.459, 0.0347, 1e-12, math.nan)], number(95.28, 0)
    (['903.0', '2.46', '0.0347', '0.0', 'none'], '95.3')
    """
    if not math.isfinite(value):
        return "none"
    value = value if abs(value) > ROUNDING else 0.0  # without a sign
    if 0.0 < abs(value) < 10.0 ** (1 - digits):
        return f"{value:.3g}"
    return f"{value:.{digits + (0.0 < abs(value) < 10.0 ** (2 - digits))}f}"


def sized(value: float, digits: int, *size: float) -> str:
    """Format a value as ``number`` does, also values that are small by their unit, such as m/N, and
    unbounded ones; ``size``: of adjacent values.

    >>> sized(3.0e-7, 6, 2.9e-7), sized(0.0, 6, 2e-7), sized(0.25, 3), sized(1e-17, 3)
    ('3e-07', '0', '0.250', '0.000')
    >>> sized(math.inf, 3), sized(math.nan, 3)
    ('unbounded', 'none')
    """
    if math.isinf(value):
        return "unbounded"
    largest = max((abs(term) for term in (value, *size) if math.isfinite(term)), default=0.0)
    if math.isfinite(value) and LEAST < largest < SMALL:
        return f"{value:.4g}"
    return number(value, digits)


def rounded_up(error: float) -> str:
    """Format an error with one digit, rounded up; "rounding" where it is zero.

    >>> rounded_up(1.4e-4), rounded_up(0.0)
    ('2e-04', 'rounding')
    """
    if error <= 0.0:
        return "rounding"
    power = math.floor(math.log10(error))
    return f"{math.ceil(error / 10.0**power - 1e-9) * 10.0**power:.0e}"


def is_rotation(dof: str) -> bool:
    """Whether a DOF (``y``, ``thz`` …) is an angle."""
    return dof.startswith("th")


def stiffness_unit(dof: str, other: str) -> str:
    """SI unit of the stiffness entry that gives the load on ``dof`` by a displacement ``other``.

    >>> stiffness_unit("y", "thz")
    'N/rad'
    """
    load = "N·m" if is_rotation(dof) else "N"
    return f"{load}/{'rad' if is_rotation(other) else 'm'}"


def load_unit(component: str) -> str:
    """SI unit of a load ``Fx`` … ``Mz``.

    >>> load_unit("Mx")
    'N·m'
    """
    return "N·m" if component.startswith("M") else "N"


def response_unit(pair: str, kind: str = "receptance") -> str:
    """SI unit of a frequency response of ``kind`` of a pair written ``tip.y / tip.thz``.

    >>> response_unit("tip.y / tip.thz"), response_unit("tip.y / tip.y", "inertance")
    ('m/(N·m)', '(m/s²)/N')
    """
    response, excitation = (port.rpartition(".")[2] for port in pair.split(" / "))
    load = "(N·m)" if is_rotation(excitation) else "N"
    motion = "rad" if is_rotation(response) else "m"
    per_time = {"receptance": "", "mobility": "/s", "inertance": "/s²"}[kind]
    return f"({motion}{per_time})/{load}" if per_time else f"{motion}/{load}"
