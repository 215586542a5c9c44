"""Rows of what a bearing engineer reads in catalogues and standards, each within its tolerance.

Sources and tolerances stand in the rows; ``[M]`` marks formulas of a standard from memory.
"""

from __future__ import annotations

import pytest

from docs.generate.engineer_rows import GROUPS
from docs.generate.marked import parts
from docs.generate.places import THEORY

PAGE = parts((THEORY / "life.md").read_text("utf-8"))["checked"]


@pytest.mark.parametrize("group", GROUPS)
def test_published_values_are_met(group: str) -> None:
    for row in GROUPS[group]():
        assert row.difference <= row.allowed, row.what
        assert row.source
        assert f"| {' | '.join(row.cells)} |" in PAGE, row.what


def test_the_page_has_no_other_rows() -> None:
    assert len(PAGE.splitlines()) - 2 == sum(len(group()) for group in GROUPS.values())
