"""Shared by every test: how hypothesis draws its examples, and a folder for costly results."""

from __future__ import annotations

import gc
import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from rotordyn.figures import style

# Duration is no measure of correctness: no deadline, no failure on a slow machine.
_UNHURRIED = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("explore", _UNHURRIED)
settings.register_profile("ci", _UNHURRIED, derandomize=True, print_blob=True)
settings.load_profile("explore")


@pytest.hookimpl(tryfirst=True)  # before options choose by marks
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Of the parameter sets of a test marked ``few(n)`` all but n are ``long``, evenly spread."""
    every: dict[str, list[pytest.Item]] = {}
    for item in items:
        if item.get_closest_marker("few"):
            every.setdefault(item.nodeid.split("[")[0], []).append(item)
    for sets in every.values():
        (count,) = next(sets[0].iter_markers("few")).args
        kept = {round((k + 0.5) * len(sets) / count - 0.5) for k in range(count)}
        for k, item in enumerate(sets):
            if k not in kept:
                item.add_marker("long")


def pytest_collection_finish() -> None:
    """What is collected by now, all modules and tests, stays: to look through it again and again
    for garbage takes a twentieth of the time."""
    gc.freeze()
    gc.set_threshold(20_000, 20, 20)


@pytest.fixture(scope="session")
def shared(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of this run of the tests alone, one and the same for all of its processes."""
    own = tmp_path_factory.getbasetemp()
    return (own.parent if "PYTEST_XDIST_WORKER" in os.environ else own) / "shared"


@pytest.fixture(scope="session")
def runs(shared: Path) -> Path:
    """Where each case is run once, for whichever test asks first (``docs.site.runs``)."""
    return shared / "runs"


@pytest.fixture(scope="module")
def draft() -> Iterator[None]:
    """Figures have few dots, which takes two thirds of the time; all else about them is the same.

    Their size in print has its own test (``figures/test_catalogue``).
    """
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(style, "DPI", 60)
        yield
