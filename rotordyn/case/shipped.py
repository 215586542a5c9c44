"""What comes with rotordyn: lists of its models and cases, with their sources."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bearings.errors import shown
from rotordyn.case.document import read_document
from rotordyn.case.faults import Faults
from rotordyn.case.library import KINDS, files_of
from rotordyn.errors import InvalidInput
from rotordyn.quantity import suggestion


@dataclass(frozen=True, slots=True)
class Shipped:
    """One file that comes with rotordyn.

    ``kind``: one of ``library.KINDS``, or ``"cases"``; ``name``: what it is called by; ``title``;
    ``sources``: where its values come from.
    """

    kind: str
    name: str
    title: str
    sources: tuple[str, ...]


def models(kind: str | None = None) -> tuple[Shipped, ...]:
    """The models of the library, or those of one kind; ``rotordyn.model`` takes their names.

    Raises
    ------
    InvalidInput : there is no such kind
    """
    kinds = KINDS if kind is None else (known_kind(kind),)
    return tuple(_shipped(kind, path) for kind in kinds for path in files_of(kind))


def cases() -> tuple[Shipped, ...]:
    """The cases that come with rotordyn; ``rotordyn.load`` takes their names."""
    return tuple(_shipped("cases", path) for path in files_of("cases"))


def known_kind(kind: object) -> str:
    """``kind`` where there are such models; raises InvalidInput otherwise."""
    if isinstance(kind, str) and kind in KINDS:
        return kind
    hint = suggestion(kind, KINDS)
    raise InvalidInput(f"unknown kind of model: {shown(kind)}; allowed: {', '.join(KINDS)}{hint}")


def _shipped(kind: str, path: Path) -> Shipped:
    faults = Faults()
    root = read_document(path, faults, {})
    if root is None:
        raise InvalidInput(faults.reported)
    held = root.plain()
    title = str(held.get("title") or held.get("name") or "")
    if "estimate" in held:
        title += " (estimate)"
    return Shipped(kind, path.stem, title, sources_in(held))


def sources_in(held: Mapping[str, Any]) -> tuple[str, ...]:
    """Where the values of a file come from, as it says, a line each."""
    coefficients = held.get("coefficients", ())
    parts = (held, *(coefficients if isinstance(coefficients, list) else ()))
    sources = held.get("sources") or [own["source"] for own in parts if "source" in own]
    listed = sources if isinstance(sources, list) else [sources]
    return tuple(" ".join(str(s).split()) for s in listed)
