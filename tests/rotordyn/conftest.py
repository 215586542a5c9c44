"""Fixtures made from the sample results."""

from __future__ import annotations

from typing import Any

import pytest

from tests.rotordyn.figures import samples


@pytest.fixture(scope="session")
def case() -> samples.SampleCase:
    return samples.case()


@pytest.fixture(scope="session")
def results() -> dict[str, Any]:
    return samples.results(count=9, points=300) | {
        "unbalance": samples.unbalance(9),
        "bearing": samples.bearing(5),
        "control": samples.control(5),
    }
