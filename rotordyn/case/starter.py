"""A case and a spindle file to start from: copies of the shipped grinding spindle."""

from __future__ import annotations

import re
from pathlib import Path

from bearings.errors import shown
from rotordyn.case.library import cases_root, models_root
from rotordyn.errors import InvalidInput

START = "grinding_spindle"
_NAME = re.compile(r"\w[\w-]{0,99}")
_RESERVED = re.compile(r"con|prn|aux|nul|(com|lpt)[0-9¹²³]", re.IGNORECASE)
TITLE = "A grinding spindle, to start from"


def write_starter(name: str, folder: Path) -> tuple[Path, Path]:
    """Write ``NAME.yaml``, a case, and ``NAME_spindle.yaml``, its spindle, into ``folder``.

    Raises
    ------
    InvalidInput : the name is no plain word, or reserved on Windows; one of the files exists, or
        cannot be written
    """
    name = name.removesuffix(".yaml")
    if not _NAME.fullmatch(name):
        raise InvalidInput(
            f"not a name: {shown(name)}; allowed: up to 100 letters, digits, _ and -"
        )
    if _RESERVED.fullmatch(name):
        raise InvalidInput(
            f"{name} is the name of a device on Windows, where no file can have it; choose another "
            "name"
        )
    case, spindle = folder / f"{name}.yaml", folder / f"{name}_spindle.yaml"
    for path in (case, spindle):
        if path.exists():
            raise InvalidInput(f"{path} exists and is not overwritten; choose another name")
    text = (cases_root() / f"{START}.yaml").read_text(encoding="utf-8")
    texts = {
        spindle: (models_root() / "spindles" / f"{START}.yaml").read_text(encoding="utf-8"),
        case: text.replace(f"spindle: {START} ", f"spindle: {spindle.name} ").replace(
            f"title: {TITLE}", f"title: {name}, a grinding spindle to start from"
        ),
    }
    for path, text in texts.items():
        try:
            with path.open("x", encoding="utf-8", newline="\n") as file:
                file.write(text)
        except OSError as error:
            raise InvalidInput(f"{path} cannot be written: {error.strerror}") from None
    return case, spindle
