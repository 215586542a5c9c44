"""Attributes of a results file by the CF conventions (Climate and Forecast metadata, CF-1.11).

Units are written as UDUNITS reads them: symbols with powers, a product as a space. Where the
entries of one variable have different units (a stiffness matrix, responses of several pairs), no
``units`` would be true: ``units_of_entries`` lists them.
"""

from __future__ import annotations

import re
from datetime import UTC, datetime

from rotordyn import __version__

CONVENTIONS = "CF-1.11"
SIGN_CONVENTION = "complex amplitude X of x(t) = Re(X exp(+i omega t)); a pole p of exp(p t)"
_POWERS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
_PART = re.compile(r"(?P<sign>[·/])?(?:\((?P<inner>[^()]*)\)|(?P<name>[a-zA-Z]+))(?P<power>-?\d+)?")


def units(text: str) -> dict[str, str]:
    """Attributes for the unit ``text`` of a declaration; none where it is empty.

    >>> units("rad/s"), units("N·m"), units("N, N·m")
    ({'units': 'rad s-1'}, {'units': 'N m'}, {'units_of_entries': 'N, N m'})
    >>> units("(rad/s²)/(N·m)")
    {'units': 'rad s-2 N-1 m-1'}
    """
    if not text:
        return {}
    if "," in text:
        listed = (_written(unit) for unit in text.split(", "))
        return {"units_of_entries": ", ".join(listed)}
    return {"units": _written(text)}


def _written(unit: str) -> str:
    if unit == "1":
        return unit
    powers = {name: power for name, power in _powers(unit.translate(_POWERS)).items() if power}
    return " ".join(name if power == 1 else f"{name}{power}" for name, power in powers.items())


def _powers(unit: str) -> dict[str, int]:
    """Power of every symbol of a product or quotient, in order of appearance."""
    total: dict[str, int] = {}
    position = 0
    while position < len(unit):
        part = _PART.match(unit, position)
        if part is None:
            raise ValueError(f"not a unit: {unit}")
        power = int(part["power"] or 1) * (-1 if part["sign"] == "/" else 1)
        inner = {part["name"]: 1} if part["name"] else _powers(part["inner"])
        for name, exponent in inner.items():
            total[name] = total.get(name, 0) + power * exponent
        position = part.end()
    return total


def about(case: str, title: str, digest: str) -> dict[str, str]:
    """Attributes of a whole file: title, source, history, sign convention, case and digest."""
    now = datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
    return {
        "Conventions": CONVENTIONS,
        "title": title or case,
        "source": f"rotordyn {__version__}",
        "history": f"{now} rotordyn {__version__}: results of case {case}",
        "comment": "Each variable says its units. A complex variable x is stored as x_re and x_im. "
        "NaN: no value; the outcome of the same speed, an absence or the comment of the variable "
        "says why.",
        "sign_convention": SIGN_CONVENTION,
        "case": case,
        "digest": digest,
    }
