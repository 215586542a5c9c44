"""Finds the models that files refer to by name or by path."""

from __future__ import annotations

from pathlib import Path

from rotordyn.quantity import suggestion

KINDS = ("bearings", "materials", "spindles", "tools")
_PACKAGE = Path(__file__).resolve().parents[1]


class UnknownModel(Exception):
    """No model of that name; the message lists those there are."""


def models_root() -> Path:
    """The folder of models: the one beside the package in a checkout, else the packaged copy."""
    checkout = _PACKAGE.parent / "models"
    if (checkout / "spindles").is_dir():
        return checkout
    return _PACKAGE / "_data" / "models"


def known(kind: str) -> list[str]:
    """Names of the models of one kind (``KINDS``), sorted."""
    return sorted(path.stem for path in (models_root() / kind).glob("*.yaml"))


def find(kind: str, reference: str, beside: Path) -> Path:
    """The file of a model: by name from the library, by path from the folder of ``beside``.

    A reference with a path separator or ending in ``.yaml`` is a path. Whether a path exists is
    seen on reading it; raises UnknownModel for a name the library does not hold.
    """
    if "/" in reference or "\\" in reference or reference.endswith((".yaml", ".yml")):
        return beside.parent / Path(reference).expanduser()
    names = known(kind)
    if reference in names:
        return models_root() / kind / f"{reference}.yaml"
    raise UnknownModel(
        f"unknown model: given '{reference}'; allowed: {', '.join(names)}, or the path of a file"
        + suggestion(reference, names)
    )
