"""Published and measured values as text, beside what was computed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rotordyn.machine.reference import QUANTITIES, Reference
from rotordyn.results.display import MILLIMETRE, RPM, Shown, shown
from rotordyn.results.known import Match
from rotordyn.results.text import INDENT, unbroken, wrapped

_IN_MILLIMETRES = ("required_diameter",)


def known_lines(matched: Sequence[Match]) -> Iterator[str]:
    """Known value against ours, then its remark."""
    for each in matched:
        yield from wrapped(f"{each.reference.kind:10s} {known_beside_ours(each)}")
        yield from wrapped(INDENT + each.reference.remark)


def known_beside_ours(match: Match) -> str:
    """What is known of a quantity beside what was computed, in printed units."""
    reference, to = match.reference, _unit(match.reference)
    single = _one_speed(reference)
    pairs = [
        unbroken(
            f"{known * to.factor:.4g} | {ours * to.factor:.4g}"
            + ("" if single else f" @ {speed * RPM.factor:.0f}")
        )
        for speed, known, ours in zip(reference.speeds, reference.values, match.values, strict=True)
    ]
    where = "" if single else " @ rpm"
    return f"{_what(reference)}: {reference.kind} | ours{where}: {', '.join(pairs)}"


def known_values(reference: Reference) -> str:
    """What is known of a quantity, in printed units."""
    to, single = _unit(reference), _one_speed(reference)
    values = [
        unbroken(f"{v * to.factor:.4g}" + ("" if single else f" @ {s * RPM.factor:.0f} rpm"))
        for s, v in zip(reference.speeds, reference.values, strict=True)
    ]
    return f"{_what(reference)}: {', '.join(values)}"


def computed_values(match: Match) -> str:
    """What was computed of it, in the same order and units."""
    to = _unit(match.reference)
    return ", ".join(f"{v * to.factor:.4g}" for v in match.values)


def _unit(reference: Reference) -> Shown:
    if reference.quantity in _IN_MILLIMETRES:
        return MILLIMETRE
    return shown(QUANTITIES.get(reference.quantity, ""))


def _one_speed(reference: Reference) -> bool:
    return len(set(reference.speeds)) == 1


def _what(reference: Reference) -> str:
    """The quantity, its subject, its speed where there is one for all values, its unit."""
    subject = f" {reference.subject}".replace("_", " ") if reference.subject else ""
    rpm = f" at {reference.speeds[0] * RPM.factor:.0f} rpm" if _one_speed(reference) else ""
    return f"{reference.quantity.replace('_', ' ')}{subject}{rpm} [{_unit(reference).unit}]"
