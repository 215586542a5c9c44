"""Tests in a copy of the tree: which of them execute a function, how long they take, which fail.

Each run is a fork of this process, which has the libraries loaded but nothing of the project.
numba is kept out: what is compiled is the same source, and compiling takes longer than most tests.
"""

from __future__ import annotations

import ast
import json
import os
import sys
import time
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import FrameType
from typing import Any, NamedTuple

import pytest

from tests.hostile.judged import judged

OURS = ("rotordyn", "bearings", "tests", "docs")
LIBRARIES = ("numpy", "scipy.linalg", "scipy.optimize", "scipy.sparse.linalg", "scipy.signal",
             "scipy.integrate", "scipy.interpolate", "scipy.special", "xarray", "yaml", "h5netcdf",
             "hypothesis", "matplotlib.figure", "mpmath")  # fmt: skip
FIRST = 12.0  # s of processor time for a test file without any change
STARTING = 5.0  # s that any run may take
USUAL = (
    "-p",
    "no:cacheprovider",
    "-p",
    "no:xdist",
    "-W",
    "ignore::pytest.PytestAssertRewriteWarning",
)
LATE = "time: four times what it takes without the change"


class Ran(NamedTuple):
    """A test that passes without any change: seconds, and functions executed as path:line."""

    name: str
    seconds: float
    reached: frozenset[str]


class Recorder:
    """Plugin of pytest: writes a line for each test that passes."""

    def __init__(self, tree: Path, record: Path) -> None:
        self.root, self.record = f"{tree}{os.sep}", record
        self.reached: set[str] = set()
        self.passed = True

    def _called(self, frame: FrameType, event: str, _: Any) -> None:
        name = frame.f_code.co_filename
        if name.startswith(self.root):
            self.reached.add(f"{name[len(self.root) :]}:{frame.f_code.co_firstlineno}")

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        self.reached, self.passed, begin = set(), True, time.process_time()
        sys.settrace(self._called)
        try:
            return (yield)
        finally:
            sys.settrace(None)
            if self.passed:
                seconds = round(time.process_time() - begin, 3)
                line = json.dumps([item.nodeid, seconds, sorted(self.reached)])
                with self.record.open("a", encoding="utf-8") as file:
                    file.write(line + "\n")

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        self.passed &= report.passed


class Chosen:
    """Plugin of pytest: some tests, in their order."""

    def __init__(self, names: list[str]) -> None:
        self.names = names

    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        known = {item.nodeid: item for item in items}
        items[:] = [known[name] for name in self.names if name in known]

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.failed:
            print(report.nodeid, file=sys.stderr)  # noqa: T201


class Tests:
    """Tests of the copy ``tree``; what is known of them is kept in the folder ``known``."""

    def __init__(self, tree: Path, known: Path) -> None:
        self.tree, self.known = tree, known
        sys.modules["numba"] = None  # type: ignore[assignment]
        for library in LIBRARIES:
            import_module(library)

    def reaching(self, file: str, function: str) -> list[Ran]:
        """Tests of a file that execute a function (path:line), the quickest first."""
        ran = [each for each in self._ran(file) if function in each.reached]
        return sorted(ran, key=lambda each: each.seconds)

    def failing(self, file: str, tests: list[Ran]) -> str:
        """The first of some tests of a file that fails, or never ends; empty where all pass."""
        chosen = Chosen([each.name for each in tests])
        most = STARTING + sum(each.seconds for each in tests)
        found = judged(lambda: self._run(file, chosen, "-x"), most)
        if found.code == -1:
            return LATE
        lines = found.said.splitlines()
        return (lines[0] if lines else "a crash") if found.code else ""

    def _ran(self, file: str) -> list[Ran]:
        record = self.known / f"{file.replace('/', '.')}.jsonl"
        if not record.exists():
            record.touch()
            judged(lambda: self._run(file, Recorder(self.tree, record)), FIRST / 4.0)
        lines = record.read_text(encoding="utf-8").splitlines()
        read = [json.loads(line) for line in lines]
        return [Ran(name, seconds, frozenset(reached)) for name, seconds, reached in read]

    def _run(self, file: str, plugin: object, *words: str) -> int:
        """Run a test file with the packages of the copy; meant for a fork."""
        for name in [name for name in sys.modules if name.split(".")[0] in OURS]:
            del sys.modules[name]
        here = Path(__file__).parents[2]
        sys.path[:] = [p for p in sys.path if Path(p or ".").resolve() != here]
        sys.path.insert(0, str(self.tree))
        os.chdir(self.tree)
        usual = ["-q", *USUAL, "--hypothesis-profile", "ci"]
        place = ["--rootdir", str(self.tree), "-c", str(self.tree / "pyproject.toml")]
        return int(pytest.main([file, *words, *usual, *place], plugins=[plugin]))


def function_at(text: str, line: int) -> int:
    """First line of the innermost function around a line, its decorators included."""
    around = [
        node
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.FunctionDef) and node.lineno <= line <= (node.end_lineno or 0)
    ]
    inner = max(around, key=lambda node: node.lineno)
    return min([inner.lineno, *(each.lineno for each in inner.decorator_list)])
