"""The reference of the Python interface: its public names, found by looking at the packages."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
from collections.abc import Iterator
from dataclasses import is_dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

from rotordyn.analysis.result import declared

# Page -> (title, modules whose own public names it shows).
PAGES = {
    "rotordyn": ("rotordyn", ("rotordyn", "rotordyn.errors")),
    "bearings": ("bearings", ("bearings", "bearings.state", "bearings.rings")),
    "machine": ("Machines", ("rotordyn.machine.*",)),
    "questions": ("Questions", ("rotordyn.analysis.specs",)),
    "answers": ("Answers", ("rotordyn.analysis.results",)),
}
INTRODUCTION = """Python interface
================

What a designer imports. All is in SI units, descriptions and results are frozen; a variant is made
with ``dataclasses.replace``.
"""


def write_api(folder: Path) -> None:
    """One page per part of the interface, and the page that lists them."""
    folder.mkdir()
    seen: set[int] = set()
    for page, (title, modules) in PAGES.items():
        lines = [line for name in modules for m in _modules(name) for line in _module(m, seen)]
        text = "\n".join([title, "=" * len(title), "", *lines])
        (folder / f"{page}.rst").write_text(text, encoding="utf-8")
    listed = "\n".join(f"   {page}" for page in PAGES)
    text = f"{INTRODUCTION}\n.. toctree::\n   :maxdepth: 1\n\n{listed}\n"
    (folder / "index.rst").write_text(text, encoding="utf-8")


def _modules(name: str) -> Iterator[ModuleType]:
    if not name.endswith(".*"):
        yield importlib.import_module(name)
        return
    package = importlib.import_module(name.removesuffix(".*"))
    for found in pkgutil.iter_modules(package.__path__, f"{package.__name__}."):
        yield importlib.import_module(found.name)


def _module(module: ModuleType, seen: set[int]) -> Iterator[str]:
    """What a module says of itself, then its public names not shown yet."""
    shown = [(n, o) for n, o in list(_public(module)) if id(o) not in seen]
    if not shown:
        return
    seen.update(id(o) for _, o in shown)
    yield from (module.__name__, "-" * len(module.__name__), "")
    yield from (f".. automodule:: {module.__name__}", "   :no-index:", "")
    for name, thing in shown:
        yield from _entry(f"{module.__name__}.{name}", thing)


def _public(module: ModuleType) -> Iterator[tuple[str, Any]]:
    """What a module offers by name, or else the classes and functions that it defines."""
    listed = getattr(module, "__all__", None)
    for name in vars(module) if listed is None else listed:
        thing = getattr(module, name)
        own = getattr(thing, "__module__", None) == module.__name__
        is_code = inspect.isclass(thing) or inspect.isfunction(thing)
        if not name.startswith("_") and (listed is not None or (own and is_code)):
            yield name, thing


def _entry(path: str, thing: Any) -> Iterator[str]:
    if inspect.isclass(thing) and is_dataclass(thing) and declared(thing):
        yield from (f".. autoclass:: {path}()", "", *_fields(thing), "")
    elif inspect.isclass(thing):
        kind = "exception" if issubclass(thing, BaseException) else "class"
        yield from (f".. auto{kind}:: {path}", "   :members:", "")
    elif inspect.isfunction(thing):
        yield from (f".. autofunction:: {path}", "")
    else:
        module, _, name = path.rpartition(".")
        yield from (f".. py:data:: {name}", f"   :module: {module}", f"   :value: {thing!r}", "")


def _fields(result: type) -> Iterator[str]:
    """Table of a result's fields, as they are declared."""
    yield from ("   .. list-table::", "      :header-rows: 1", "")
    yield from _row("field", "dimensions", "unit", "what it is")
    for name, field in declared(result).items():
        dims, unit, label = (field.metadata[key] for key in ("dims", "unit", "label"))
        yield from _row(f"``{name}``", ", ".join(dims), unit or "–", label)


def _row(*cells: str) -> Iterator[str]:
    for k, cell in enumerate(cells):
        yield f"      {'*' if k == 0 else ' '} - {cell}"
