"""Limits of tolerance classes (ISO 286), of bearing rings (ISO 492), and the interference of fits.

Deviations and interferences are on the DIAMETER [m]; ``bearings.fit.compound`` takes the radius.
Grades IT3 to IT7 above 18 mm and rings of the normal class are from catalogues; all others are
from memory of the standard [M].
"""

from __future__ import annotations

import re
from bisect import bisect_left
from typing import NamedTuple

from bearings.arguments import checked
from bearings.errors import InvalidBearing, shown

SIZES = (10.0, 18.0, 30.0, 50.0, 80.0, 120.0, 180.0, 250.0)  # [mm], over … up to and including
_IT = {  # µm, by size
    3: (3, 4, 4, 5, 6, 8, 10),
    4: (5, 6, 7, 8, 10, 12, 14),
    5: (8, 9, 11, 13, 15, 18, 20),
    6: (11, 13, 16, 19, 22, 25, 29),
    7: (18, 21, 25, 30, 35, 40, 46),
}
# Fundamental deviations [µm]: the lower one of shafts above the zero line, the upper one below it.
_ABOVE = {
    "k": (1, 2, 2, 2, 3, 3, 4),
    "m": (7, 8, 9, 11, 13, 15, 17),
    "n": (12, 15, 17, 20, 23, 27, 31),
    "p": (18, 22, 26, 32, 37, 43, 50),
}
_BELOW = {
    "f": (16, 20, 25, 30, 36, 43, 50),
    "g": (6, 7, 9, 10, 12, 14, 15),
    "h": (0, 0, 0, 0, 0, 0, 0),
}
_J = (3, 4, 5, 7, 9, 11, 13)  # below the zero line, j5 and j6
_WORD = re.compile(r"([a-z]{1,2}|[A-Z]{1,2})(\d+)")
_SHAFTS = ("f", "g", "h", "j", "js", "k", "m", "n", "p")
_HOLES = ("F", "G", "H", "JS", "K", "M", "N", "P")
_TIGHT = ("K", "M", "N", "P")  # holes with the deviations of shafts, their signs reversed
# Rings of bearings below their nominal diameter [µm], ISO 492: by class and size.
_BORE = {
    "normal": (8, 10, 12, 15, 20, 25, 30),
    "P4": (4, 5, 6, 7, 8, 10, 12),
}
_OUTSIDE = {
    "normal": {30.0: 9, 50.0: 11, 80.0: 13, 120.0: 15, 150.0: 18, 180.0: 25, 250.0: 30},
    "P4": {30.0: 5, 50.0: 6, 80.0: 7, 120.0: 8, 150.0: 9, 180.0: 10, 250.0: 11},
}


class Interference(NamedTuple):
    """Interference of a shaft in a bore, on the diameter [m]; negative: clearance.

    ``least`` … ``most``: of all parts within tolerance; ``mean``; ``probable``: mean ± half the
    root of the squared tolerances, within which nearly all assemblies lie (SKF prints these).
    """

    least: float
    most: float
    mean: float
    probable: tuple[float, float]

    def reduced(self, smoothing: float) -> Interference:
        """Subtract the ``smoothing`` of both surfaces when they are pressed together."""
        low, high = self.probable
        least, most, mean = (value - smoothing for value in self[:3])
        return Interference(least, most, mean, (low - smoothing, high - smoothing))


@checked
def limits(tolerance: str, diameter: float) -> tuple[float, float]:
    """Lower and upper deviation [m] of a class such as ``"k5"`` (shaft) or ``"H6"`` (hole).

    ``diameter`` [m]: above 10 mm up to 250 mm. Grades 3 to 7 of f, g, h, j (5 and 6), js, k
    (4 to 7), m, n, p, of F, G, H, JS, and of K, M, N, P (4 to 7).

    >>> [round(1e6 * each, 1) for each in limits("k5", 0.070)]
    [2.0, 15.0]

    Raises
    ------
    InvalidBearing : a class or diameter that the tables do not have
    """
    word = _WORD.fullmatch(tolerance)
    letter, grade = (word[1], int(word[2])) if word else ("", 0)
    if letter not in (*_SHAFTS, *_HOLES) or grade not in _IT:
        raise InvalidBearing(
            f"unknown tolerance class {shown(tolerance)}: a letter of {', '.join(_SHAFTS)} "
            f"(shafts) or {', '.join(_HOLES)} (holes) and a grade from 3 to 7, such as k5 or H6"
        )
    row = _size(diameter)
    if letter in ("k", *_TIGHT) and grade < 4:
        raise InvalidBearing(f"{tolerance} is not tabulated: {letter} is from grade 4 up")
    if letter == "j" and grade not in (5, 6):
        raise InvalidBearing(f"{tolerance} is not tabulated: j5 and j6 are")
    low, high = _deviations(letter, grade, row)
    return low * 1e-6, high * 1e-6


def _deviations(letter: str, grade: int, row: int) -> tuple[float, float]:
    """Lower and upper deviation [µm] in range ``row`` of the sizes."""
    width = _IT[grade][row]
    if letter in ("js", "JS"):
        return -width / 2.0, width / 2.0
    if letter == "j":
        return -_J[row], width - _J[row]
    if letter in _TIGHT:
        high = -_ABOVE[letter.lower()][row] + width - _IT[grade - 1][row]  # with Δ of ISO 286
        return high - width, high
    if letter in _ABOVE:
        return _ABOVE[letter][row], _ABOVE[letter][row] + width
    if letter in _BELOW:
        return -_BELOW[letter][row] - width, -_BELOW[letter][row]
    return _BELOW[letter.lower()][row], _BELOW[letter.lower()][row] + width


@checked
def bearing_bore(diameter: float, grade: str = "normal") -> tuple[float, float]:
    """Lower and upper deviation of a bearing's bore [m], class ``"normal"`` or ``"P4"``."""
    if grade not in _BORE:
        raise InvalidBearing(f"unknown class of a bearing {shown(grade)}: {', '.join(_BORE)}")
    return -_BORE[grade][_size(diameter)] * 1e-6, 0.0


@checked
def bearing_outside(diameter: float, grade: str = "normal") -> tuple[float, float]:
    """Lower and upper deviation of a bearing's outside diameter [m], class ``"normal"`` or
    ``"P4"``."""
    if grade not in _OUTSIDE:
        raise InvalidBearing(f"unknown class of a bearing {shown(grade)}: {', '.join(_OUTSIDE)}")
    size, table = diameter * 1e3, _OUTSIDE[grade]
    if not 18.0 < size <= 250.0:
        raise InvalidBearing(f"outside diameters are tabulated from 18 to 250 mm: got {size:g} mm")
    return -next(value for most, value in table.items() if size <= most + 1e-9) * 1e-6, 0.0


@checked
def interference(shaft: tuple[float, float], bore: tuple[float, float]) -> Interference:
    """Interference of shaft and bore of one nominal diameter, from the deviations of both [m]."""
    (s1, s2), (b1, b2) = shaft, bore
    middle = 0.5 * (s1 + s2 - b1 - b2)
    half = 0.5 * ((s2 - s1) ** 2 + (b2 - b1) ** 2) ** 0.5
    return Interference(s1 - b2, s2 - b1, middle, (middle - half, middle + half))


@checked
def one_third(shaft: tuple[float, float], bore: tuple[float, float]) -> float:
    """Probable interference after NKE [m]: a third of each tolerance from the go side."""
    (s1, s2), (b1, b2) = shaft, bore
    return (s2 - (s2 - s1) / 3.0) - (b1 + (b2 - b1) / 3.0)


@checked
def smoothing(shaft_roughness: float, bore_roughness: float, rule: str = "DIN 7190") -> float:
    """Interference lost to the roughness of both surfaces [m], on the diameter.

    ``"DIN 7190"`` [M]: 0.8 (Rz1 + Rz2) of the mean peak-to-valley heights; ``"NKE"``: 0.4 of every
    Ra. Raises InvalidBearing for another rule.
    """
    factors = {"DIN 7190": 0.8, "NKE": 0.4}
    if rule not in factors:
        raise InvalidBearing(f"unknown rule of smoothing {shown(rule)}: {', '.join(factors)}")
    return factors[rule] * (shaft_roughness + bore_roughness)


def _size(diameter: float) -> int:
    """Index of the range of sizes a diameter [m] lies in."""
    size = diameter * 1e3
    if not SIZES[0] < size <= SIZES[-1] + 1e-9:
        raise InvalidBearing(
            f"tolerances are tabulated above {SIZES[0]:g} mm up to {SIZES[-1]:g} mm, got {size:g} "
            "mm"
        )
    return bisect_left(SIZES, round(size, 6)) - 1  # rounded, since 0.018 m must count as 18 mm
