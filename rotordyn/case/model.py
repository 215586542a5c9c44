"""Load one model as a frozen description, from the library or from a file."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, Literal, overload

from bearings.bearing import BallBearing
from bearings.errors import shown
from bearings.materials import Material
from rotordyn.analyses.stability_lobes.workpiece import Workpiece
from rotordyn.case.expand import opened
from rotordyn.case.forms import reading_of
from rotordyn.case.keys import MODELS
from rotordyn.case.library import find, known_kind
from rotordyn.errors import InvalidInput
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.tool import Tool

Model = Spindle | Tool | BallBearing | Material | Workpiece


@overload
def model(kind: Literal["spindles"], reference: str | Path) -> Spindle: ...
@overload
def model(kind: Literal["tools"], reference: str | Path) -> Tool: ...
@overload
def model(kind: Literal["bearings"], reference: str | Path) -> BallBearing: ...
@overload
def model(kind: Literal["materials"], reference: str | Path) -> Material: ...
@overload
def model(kind: Literal["workpieces"], reference: str | Path) -> Workpiece: ...
def model(kind: str, reference: str | Path) -> Model:
    """Load a model as a frozen description in SI units: by name from the library, or from a file.

    Parameters
    ----------
    kind : "spindles", "tools", "bearings", "materials" or "workpieces"
    reference : a name, or a path from the working directory (with a separator or ending in .yaml)

    Raises
    ------
    InvalidInput : unknown kind or model; or all faults of the file, each with its line
    """
    folder = known_kind(kind)
    if not isinstance(reference, str | os.PathLike):
        raise InvalidInput(f"a model is called by its name or path: got {shown(reference)}")
    root, reader = opened(find(folder, str(reference), Path("here")))
    declared: Any = next(each for each, name in MODELS.items() if name == folder)
    described: Model = reading_of(reader).value(declared, root)
    reader.faults.require_none()
    return described
