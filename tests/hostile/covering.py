"""Tests that execute a function, how long they take, and which of them fails with another source.

All are collected once, in this process; each trial is a fork of it, where the code of a module's
functions is exchanged in place: nothing is imported or collected again.
numba is kept out: what is compiled is the same source, and compiling takes longer than most tests.
"""

from __future__ import annotations

import ast
import gc
import json
import os
import signal
import sys
import time
from collections import defaultdict
from collections.abc import Iterator
from functools import _lru_cache_wrapper
from importlib import import_module
from pathlib import Path
from types import CodeType, FrameType, FunctionType
from typing import Any, NamedTuple

import pytest

from tests.hostile.judged import judged

ROOT = Path(__file__).parents[2]
SOURCES = ("bearings.", "rotordyn.")
FIRST = 30.0  # s of processor time for a test file without any change
STARTING = 2.0  # s that any test may take
USUAL = (
    "-q", "-s", "-m", "", "-p", "no:cacheprovider", "-p", "no:xdist", "--hypothesis-profile", "ci",
)  # fmt: skip


class Ran(NamedTuple):
    """A test that passes without any change: seconds, and functions executed as path:name."""

    name: str
    seconds: float
    reached: frozenset[str]


class Late(BaseException):
    """A test takes more than four times what it takes without the change."""


class Recorder:
    """Plugin of pytest: functions that a test executes, and whether any fails."""

    def __init__(self) -> None:
        self.root = f"{ROOT}{os.sep}"
        self.reached: set[str] = set()
        self.failed = False

    def called(self, frame: FrameType, event: str, _: Any) -> None:
        """A tracer of calls."""
        name = frame.f_code.co_filename
        if name.startswith(self.root):
            self.reached.add(f"{name[len(self.root) :]}:{frame.f_code.co_qualname}")

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        self.failed |= report.failed


class Tests:
    """Collected tests; what is known of them is kept in the folder ``known``."""

    def __init__(self, session: pytest.Session, known: Path) -> None:
        self.known, self.recorder = known, Recorder()
        session.config.pluginmanager.register(self.recorder)
        self.items = {item.nodeid: item for item in session.items}
        self.files = defaultdict(list)
        for item in session.items:
            self.files[item.nodeid.partition("::")[0]].append(item)
        self._read: dict[str, list[Ran]] = {}

    def reaching(self, file: str, function: str) -> list[Ran]:
        """Tests of a file that execute a function (path:name), the quickest first."""
        if file not in self._read:
            self._read[file] = self._ran(file)
        ran = [each for each in self._read[file] if function in each.reached]
        return sorted(ran, key=lambda each: each.seconds)

    def failing(self, tests: list[Ran], path: str, text: str) -> str:
        """The first of some tests that fails with another text of a module, or takes too long;
        empty where all pass."""
        allowed = FIRST + sum(each.seconds for each in tests)
        found = judged(lambda: self._try(tests, path, text), allowed)
        lines = found.said.splitlines()
        return (lines[-1] if lines else "a crash") if found.code else ""

    def _try(self, tests: list[Ran], path: str, text: str) -> int:
        _quiet()
        _exchange(path, text)
        _forget()
        signal.signal(signal.SIGVTALRM, _late)
        items = [self.items[each.name] for each in tests if each.name in self.items]
        most = {each.name: STARTING + 4.0 * each.seconds for each in tests}
        for item, after in zip(items, [*items[1:], None], strict=True):
            signal.setitimer(signal.ITIMER_VIRTUAL, most[item.nodeid])
            item.ihook.pytest_runtest_protocol(item=item, nextitem=after)
            if self.recorder.failed:
                print(item.nodeid, file=sys.stderr)  # noqa: T201
                return 1
        return 0

    def _ran(self, file: str) -> list[Ran]:
        record = self.known / f"{file.replace('/', '.')}.jsonl"
        if not record.exists():
            record.touch()
            judged(lambda: self._record(file, record), FIRST / 4.0)
        lines = record.read_text(encoding="utf-8").splitlines()
        read = [json.loads(line) for line in lines]
        return [Ran(name, seconds, frozenset(reached)) for name, seconds, reached in read]

    def _record(self, file: str, record: Path) -> int:
        _quiet()
        items = self.files[file]
        for item, after in zip(items, [*items[1:], None], strict=True):
            _forget()
            self.recorder.reached, self.recorder.failed = set(), False
            begin = time.process_time()
            sys.settrace(self.recorder.called)
            try:
                item.ihook.pytest_runtest_protocol(item=item, nextitem=after)
            finally:
                sys.settrace(None)
            seconds = round(time.process_time() - begin, 3)
            if not self.recorder.failed:
                line = json.dumps([item.nodeid, seconds, sorted(self.recorder.reached)])
                with record.open("a", encoding="utf-8") as out:
                    out.write(line + "\n")
        return 0


def _quiet() -> None:
    """What pytest prints of a test in a fork is seen by nobody."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)


def _late(*_: Any) -> None:
    raise Late


def _exchange(path: str, text: str) -> None:
    """Give the functions of a module the code of another text of it, line by line the same."""
    import_module(path.removesuffix(".py").replace("/", "."))
    place = str(ROOT / path)
    codes = {
        (code.co_qualname, code.co_firstlineno): code
        for code in _codes(compile(text, place, "exec", dont_inherit=True))
        if not code.co_name.startswith("<")
    }
    for each in gc.get_objects():
        if type(each) is FunctionType and each.__code__.co_filename == place:
            old = each.__code__
            each.__code__ = codes.get((old.co_qualname, old.co_firstlineno), old)


def _forget() -> None:
    """What functions of the source keep of former calls, so that every test executes them again."""
    for each in gc.get_objects():
        if type(each) is _lru_cache_wrapper and each.__module__.startswith(SOURCES):
            each.cache_clear()


def _codes(code: CodeType) -> Iterator[CodeType]:
    yield code
    for inner in code.co_consts:
        if isinstance(inner, CodeType):
            yield from _codes(inner)


def function_at(text: str, line: int) -> str:
    """Name of the innermost function around a line, as Python qualifies it."""
    around = [
        (node.lineno, name)
        for node, name in _functions(ast.parse(text), "")
        if node.lineno <= line <= (node.end_lineno or 0)
    ]
    return max(around)[1]


def _functions(tree: ast.AST, within: str) -> Iterator[tuple[ast.FunctionDef, str]]:
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.FunctionDef):
            yield node, within + node.name
            yield from _functions(node, f"{within}{node.name}.<locals>.")
        elif isinstance(node, ast.ClassDef):
            yield from _functions(node, f"{within}{node.name}.")
        else:
            yield from _functions(node, within)
