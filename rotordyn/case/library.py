"""The models and cases that come with rotordyn: found by name or by path, listed with sources."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bearings.errors import shown
from rotordyn.case.document import read_document
from rotordyn.case.faults import Faults
from rotordyn.errors import Fault, InvalidInput
from rotordyn.quantity import suggestion

KINDS = ("bearings", "materials", "spindles", "tools", "workpieces")
SPOKEN = {  # common names of materials that the library has under another name
    "ceramic": "silicon_nitride",
    "si3n4": "silicon_nitride",
    "100cr6": "bearing_steel",
    "carbide": "cemented_carbide",
}
_LISTED = 24  # models that a message lists
_PACKAGE = Path(__file__).resolve().parents[1]


def models_root() -> Path:
    """The folder of models: the one beside the package in a checkout, else the packaged copy."""
    checkout = _PACKAGE.parent / "models"
    if (checkout / "spindles").is_dir():
        return checkout
    return _PACKAGE / "_data" / "models"


def cases_root() -> Path:
    """The folder of cases, beside that of models."""
    return models_root().parent / "cases"


def files_of(kind: str) -> list[Path]:
    """Files of the models of one kind (``KINDS``), or of ``"cases"``, sorted by name."""
    folder = cases_root() if kind == "cases" else models_root() / kind
    return sorted(folder.glob("*.yaml"), key=lambda path: path.stem)


def known(kind: str) -> list[str]:
    """Names of the models of one kind, or of cases."""
    return [path.stem for path in files_of(kind)]


def find_case(reference: str | Path) -> Path:
    """The file of a case: a path, or the name of a case that comes with rotordyn.

    A file of that name comes first. Whether a path exists is seen on reading it; raises
    InvalidInput for a name that is neither a file nor a case.
    """
    path, text = Path(reference).expanduser(), str(reference)
    if isinstance(reference, Path) or is_path(text) or not text or os.path.isfile(path):
        return path
    names = known("cases")
    if text in names:
        return cases_root() / f"{text}.yaml"
    if os.path.exists(path):
        return path
    message = (
        f"no such file, and no case of that name; allowed: {_few(names)}, or the path of a file"
        f"{suggestion(text[:200], names) or ' (rotordyn cases lists all names)'}"
    )
    raise InvalidInput([Fault(text if len(text) <= 200 else f"{text[:197]}...", 0, 0, "", message)])


def is_path(reference: str) -> bool:
    """Whether a reference is a path: it has a separator or ends in ``.yaml``."""
    return "/" in reference or "\\" in reference or reference.endswith((".yaml", ".yml"))


def find(kind: str, reference: str, beside: Path) -> Path:
    """The file of a model: by name from the library, by path from the folder of ``beside``.

    A reference with a path separator or ending in ``.yaml`` is a path. Whether a path exists is
    seen on reading it; raises InvalidInput for a name the library does not hold.
    """
    if is_path(reference):
        return beside.parent / Path(reference).expanduser()
    names = known(kind)
    if reference in names:
        return models_root() / kind / f"{reference}.yaml"
    file = f"{reference}.yaml"
    hint = f" (did you mean {file}?)" if os.path.exists(beside.parent / file) else ""
    if not hint and (meant := SPOKEN.get(reference.lower())) in names:
        hint = f" (did you mean {meant}?)"
    raise InvalidInput(
        f"unknown model: given {shown(reference)}; allowed: {_few(names)}, or the path of a file"
        + (hint or suggestion(reference, names))
    )


def _few(names: list[str]) -> str:
    """Text of names; only the first ones of many."""
    return ", ".join(names[:_LISTED]) + (", …" if len(names) > _LISTED else "")


@dataclass(frozen=True, slots=True)
class Shipped:
    """A file that comes with rotordyn.

    ``kind``: one of ``KINDS``, or ``"cases"``; ``name`` for reference; ``title``;
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
