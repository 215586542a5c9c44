"""The prose of the pages uses the words of the field (Genta, Friswell, Childs, Harris, Bathe)."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from docs.generate.marked import parts
from docs.generate.places import DOCS, README, ROOT

# Word of our own -> the usual one.
USUAL = {
    r"told|tells?": "reported, estimated",
    r"left out": "truncated, neglected, omitted",
    r"lent|lends": "fictitious",
    r"freedoms?(?! from)": "DOF, degrees of freedom",
    r"knots?": "breakpoint",
    r"creep(s|ing)": "overdamped",
    r"twins?": "tandem set",
    r"likeness": "modal assurance criterion, FRAC",
    r"gives? way": "flexible",
    r"grip": "required friction",
    r"asked of|(is|was|are) asked(?! for)": "specified, computed",
}
PAGES = sorted(
    [README, *DOCS.rglob("*.md"), *(ROOT / d / "README.md" for d in ("cases", "models"))]
)


def prose(page: str) -> str:
    """A page without its generated parts, its code and the targets of its links."""
    for name, part in parts(page).items():
        page = page.replace(f"<!-- begin {name} -->\n{part}", f"<!-- begin {name} -->")
    page = re.sub(r"```.*?```|^    .*?$|`[^`\n]*`|\]\([^)]*\)", "", page, flags=re.S | re.M)
    return re.sub(r"degrees\s+of\s+freedom", "DOF", page, flags=re.I)


@pytest.mark.parametrize("page", PAGES, ids=lambda p: p.relative_to(ROOT).as_posix())
def test_prose_has_no_words_of_our_own(page: Path) -> None:
    text = prose(page.read_text(encoding="utf-8"))
    found = {
        match[0]: usual
        for word, usual in USUAL.items()
        for match in re.finditer(rf"\b({word})\b", text, re.I)
    }
    assert found == {}
