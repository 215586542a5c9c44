"""Lists of the models and cases that come with rotordyn, with their sources."""

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
    """A file that comes with rotordyn.

    ``kind``: one of ``library.KINDS``, or ``"cases"``; ``name`` for reference; ``title``;
    ``sources`` of its values.
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
    """Return ``kind`` if there are such models; raises InvalidInput otherwise."""
    if isinstance(kind, str) and kind in KINDS:
        return kind
    hint = suggestion(kind, KINDS)
    raise InvalidInput(f"unknown kind of model: {shown(kind)}; allowed: {', '.join(KINDS)}{hint}")


def _shipped(kind: str, path: Path) -> Shipped:
    faults = Faults()
    root = read_document(path, faults, {})
    if root is None:
        raise InvalidInput(faults.reported)
    content = root.plain()
    title = str(content.get("title") or content.get("name") or "")
    if "estimate" in content:
        title += " (estimate)"
    return Shipped(kind, path.stem, title, sources_in(content))


def sources_in(content: Mapping[str, Any]) -> tuple[str, ...]:
    """Sources of the values of a file, as stated in it, a line each."""
    coefficients = content.get("coefficients", ())
    parts = (content, *(coefficients if isinstance(coefficients, list) else ()))
    sources = content.get("sources") or [part["source"] for part in parts if "source" in part]
    listed = sources if isinstance(sources, list) else [sources]
    return tuple(" ".join(str(s).split()) for s in listed)
