"""Table of modules and the pages of theory that explain them, read from the links of the pages."""

from __future__ import annotations

import ast
import posixpath
import re
from pathlib import Path

from docs.generate.marked import table
from docs.generate.places import ROOT, THEORY

PACKAGES = ("bearings", "bearings/catalogue", "rotordyn/equation", "rotordyn/equation/elements")
PACKAGES += tuple(f"rotordyn/{r}" for r in ("preload", "numerics", "surface"))
PACKAGES += tuple(f"rotordyn/{r}" for r in ("results", "scene", "modes", "analyses", "analyses/*"))
# Array types, checks, what a case specifies and how a result is reported need no theory.
PLAIN = {
    "arguments",
    "measure",
    "arrays",
    "spec",
    "result",
    "known",
    "summary",
    "planned_summary",
    "tables",
    "meshes",
    "gltf",
    "uff",
    "unlimited",
    "page",
}
_LINK = re.compile(r"\]\(((?:\.\./)+[\w/]+\.py)\)")


def modules() -> list[Path]:
    """Every public module of the packages that compute."""
    found = (path for package in PACKAGES for path in sorted(ROOT.glob(f"{package}/*.py")))
    return [path for path in found if not path.name.startswith("_") and path.stem not in PLAIN]


def explained() -> dict[Path, list[Path]]:
    """Module -> the pages that link it; empty where none does."""
    pages: dict[Path, list[Path]] = {module: [] for module in modules()}
    for page in sorted(THEORY.glob("*.md")):
        for target in dict.fromkeys(_LINK.findall(page.read_text(encoding="utf-8"))):
            module = (page.parent / target).resolve()
            if module in pages and page.name != "README.md":
                pages[module].append(page)
    return pages


def module_table() -> str:
    """One line per module, for the first page of the theory."""
    lines = []
    for module, pages in explained().items():
        path = module.relative_to(ROOT).as_posix()
        link = f"[`{path}`]({posixpath.relpath(path, 'docs/theory')})"
        found = ", ".join(f"[{title(page)}]({page.name})" for page in pages)
        lines.append((link, found or "–", first_line(module)))
    return table(("module", "page", "content"), lines)


def title(page: Path) -> str:
    """First heading of a page."""
    return page.read_text(encoding="utf-8").partition("\n")[0].removeprefix("# ")


def first_line(path: Path) -> str:
    """First line of a module's docstring."""
    docstring = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
    return docstring.partition("\n")[0]
