"""Declarations of the fields of results: each field carries its dimensions, unit and label.

A result is a frozen dataclass. Its array fields are declared with ``quantity`` (data over named
dimensions) or ``coordinate`` (the values of one dimension); everything else about files, tables and
figures is derived from that declaration.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import Field, field, fields
from typing import Any, NamedTuple

from rotordyn.results.display import Shown, shown


class Absence(NamedTuple):
    """Why a quantity has no finite number where no outcome gives the reason, and where.

    ``words`` follow "NaN" or "infinite". It applies to whole slices along ``by`` (none: everywhere
    or nowhere); or ``beside`` another field that is NaN, infinite, zero, false or empty there; or
    behind the ``last`` number along a dimension.
    """

    words: str
    by: tuple[str, ...] = ()
    beside: str = ""
    last: str = ""


def quantity(
    *dims: str,
    unit: str,
    label: str,
    printed: Shown | None = None,
    absent: Sequence[Absence] = (),
    infinite: Sequence[Absence] = (),
    comment: str = "",
) -> Any:
    """A field with data over ``dims``; ``unit`` of the data (SI), ``label`` for axes and tables.

    ``printed``: another unit of tables and figures than ``display.shown`` gives. ``absent``,
    ``infinite``: where it has no number, beside what an outcome says. ``comment``: what else must
    be known to read it, such as its frame.
    """
    metadata = _metadata("quantity", dims, unit, label, printed)
    remarks = {"absent": absent, "infinite": infinite, "comment": comment}
    return field(metadata=metadata | remarks)


def coordinate(dim: str, *, unit: str, label: str, printed: Shown | None = None) -> Any:
    """A field with the values of dimension ``dim`` (numbers, or a tuple of names: unit ``""``)."""
    return field(metadata=_metadata("coordinate", (dim,), unit, label, printed))


def _metadata(
    role: str, dims: tuple[str, ...], unit: str, label: str, printed: Shown | None
) -> dict[str, Any]:
    as_printed = printed or shown(unit)
    return {"role": role, "dims": dims, "unit": unit, "label": label, "printed": as_printed}


def absence(info: Mapping[str, Any]) -> str:
    """Explanation of missing and infinite numbers, from the metadata of a field; may be empty."""
    kinds = {"NaN": info.get("absent", ()), "infinite": info.get("infinite", ())}
    return "; ".join(
        f"{kind} {reason.words}" for kind, reasons in kinds.items() for reason in reasons
    )


def declared(result: Any) -> dict[str, Field[Any]]:
    """The declared fields of a result (instance or class), by name."""
    return {f.name: f for f in fields(result) if "role" in f.metadata}
