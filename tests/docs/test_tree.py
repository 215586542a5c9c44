"""The order of the pages of the site."""

from __future__ import annotations

import pytest

from docs.generate.places import DOCS, ROOT
from docs.site.tree import GROUPS


@pytest.mark.parametrize("folder", ["tutorial", "howto", "reference"])
def test_every_page_of_a_folder_has_its_place(folder: str) -> None:
    placed = {page for pages in GROUPS.values() for page in pages}
    pages = (DOCS / folder).glob("*.md")
    assert {page.relative_to(ROOT).with_suffix("").as_posix() for page in pages} <= placed
