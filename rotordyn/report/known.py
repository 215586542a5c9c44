"""Published and measured values as text, beside computed ones."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rotordyn.machine.reference import QUANTITIES, Reference
from rotordyn.results.display import MILLIMETRE, RPM, Shown, shown
from rotordyn.results.known import Match
from rotordyn.results.text import INDENT, unbroken, wrapped

_IN_MILLIMETRES = ("required_diameter",)


def known_lines(matched: Sequence[Match]) -> Iterator[str]:
    """Lines of every known value beside the computed one, then its remark."""
    for match in matched:
        yield from wrapped(f"{match.reference.kind:10s} {known_beside_ours(match)}")
        yield from wrapped(INDENT + match.reference.remark)


def known_beside_ours(match: Match) -> str:
    """Known values of a quantity beside computed ones, in printed units."""
    reference, unit = match.reference, _unit(match.reference)
    single = _one_speed(reference)
    pairs = [
        unbroken(
            f"{known * unit.factor:.4g} | {ours * unit.factor:.4g}"
            + ("" if single else f" @ {speed * RPM.factor:.0f}")
        )
        for speed, known, ours in zip(reference.speeds, reference.values, match.values, strict=True)
    ]
    where = "" if single else " @ rpm"
    return f"{_subject(reference)}: {reference.kind} | computed{where}: {', '.join(pairs)}"


def known_values(reference: Reference) -> str:
    """Known values of a quantity, in printed units."""
    unit, single = _unit(reference), _one_speed(reference)
    values = [
        unbroken(f"{v * unit.factor:.4g}" + ("" if single else f" @ {s * RPM.factor:.0f} rpm"))
        for s, v in zip(reference.speeds, reference.values, strict=True)
    ]
    return f"{_subject(reference)}: {', '.join(values)}"


def computed_values(match: Match) -> str:
    """Computed values of a quantity, in the order and units of the known ones."""
    unit = _unit(match.reference)
    return ", ".join(f"{v * unit.factor:.4g}" for v in match.values)


def _unit(reference: Reference) -> Shown:
    if reference.quantity in _IN_MILLIMETRES:
        return MILLIMETRE
    return shown(QUANTITIES.get(reference.quantity, ""))


def _one_speed(reference: Reference) -> bool:
    return len(set(reference.speeds)) == 1


def _subject(reference: Reference) -> str:
    """Quantity, subject, speed where all values have the same, and unit of a reference."""
    subject = f" {reference.subject}".replace("_", " ") if reference.subject else ""
    rpm = f" at {reference.speeds[0] * RPM.factor:.0f} rpm" if _one_speed(reference) else ""
    return f"{reference.quantity.replace('_', ' ')}{subject}{rpm} [{_unit(reference).unit}]"
