"""Compilation of plain functions of this package, together with all functions they call.

numba is imported here alone, when it is first needed; without it the functions run as they are,
some hundred times slower. Its cache notices no change in a function that is called from another
file: it is kept in a folder named after the sources of this package.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import stat
import tempfile
import warnings
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path
from types import FunctionType
from typing import Any

from bearings.ball.plane import some, where

PACKAGE = "bearings"
LEAST_DISK = 50e6  # bytes a disk must have free to keep compiled functions


@cache
def compiled(function: Callable[..., Any]) -> Any:
    """Compile ``function`` with all functions of this package that it calls, at its first call, and
    keep it on disk for the next process."""
    if not available():
        return function
    import numba

    folder = _folder()
    if folder is None:
        return numba.njit(_bound(function), error_model="numpy")
    default: str = numba.config.CACHE_DIR  # type: ignore[attr-defined]
    try:
        numba.config.CACHE_DIR = str(folder)  # type: ignore[attr-defined]
        return numba.njit(_bound(function), cache=True, error_model="numpy")
    finally:
        numba.config.CACHE_DIR = default  # type: ignore[attr-defined]


@cache
def _callee(function: FunctionType) -> Any:
    """Compile ``function`` for calls from compiled code only.

    It has no wrapper by which Python could call it: compiling takes 0.6 of the time with wrappers.
    """
    import numba

    njit: Any = numba.njit  # its types leave these options out, with which it compiles its own
    options = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
    return njit(_bound(function), error_model="numpy", **options)


@cache
def available() -> bool:
    """Whether numba is installed and can be imported; that takes a while. Warns where it cannot."""
    try:
        import numba  # noqa: F401
    except ImportError as error:  # also where it does not fit the numpy that is installed
        gone = isinstance(error, ModuleNotFoundError)
        why = "is not installed" if gone else f"cannot be loaded ({error})"
        warnings.warn(
            f"the package numba {why}, and balls are computed some hundred times slower: python -m "
            "pip install numba",
            RuntimeWarning,
            stacklevel=2,
        )
        return False
    return True


def is_kept() -> bool:
    """Whether an earlier process has left compiled functions on disk."""
    folder = _folder()
    return folder is not None and any(folder.rglob("*.nbi"))


def _chosen(condition: Any, yes: Any, no: Any) -> Any:
    """``bearings.ball.plane.where`` for one ball."""
    return yes if condition else no


def _itself(condition: Any) -> Any:
    """``bearings.ball.plane.some`` for one ball."""
    return condition


def _bound(function: Callable[..., Any]) -> FunctionType:
    """Copy a function with the names of the functions it calls bound to their compiled forms."""
    assert isinstance(function, FunctionType)
    names = dict(function.__globals__)
    for name in function.__code__.co_names:
        other = names.get(name)
        if other is where:
            names[name] = _callee(_chosen)
        elif other is some:
            names[name] = _callee(_itself)
        elif isinstance(other, FunctionType) and other.__module__.split(".")[0] == PACKAGE:
            names[name] = _callee(other)
    bound = FunctionType(function.__code__, names, function.__name__, function.__defaults__)
    bound.__module__, bound.__qualname__ = function.__module__, function.__qualname__
    return bound


@cache
def _folder() -> Path | None:
    """Writable folder of this user, named by a hash of the sources; None where there is none."""
    digest = hashlib.sha256()
    for source in sorted(Path(__file__).parents[2].rglob("*.py")):
        digest.update(source.read_bytes())
    name = f"{PACKAGE}-{digest.hexdigest()[:16]}"
    for root in _roots():
        try:
            root.mkdir(parents=True, exist_ok=True)
            (root / name).mkdir(mode=0o700, exist_ok=True)
        except OSError:
            continue
        if os.access(root / name, os.W_OK) and shutil.disk_usage(root).free > LEAST_DISK:
            return root / name
    return None


def _roots() -> Iterator[Path]:
    """Yield folders for caches: that set for numba, else those of this user's system; where none
    of these can be written, one among temporary files."""
    for variable in ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME", "LOCALAPPDATA"):
        if path := os.environ.get(variable):
            yield Path(path) / "rotordyn"
    with suppress(RuntimeError):  # a user without a home
        yield Path.home() / ".cache" / "rotordyn"
    if hasattr(os, "getuid") and (temporary := _private_temporary(os.getuid())) is not None:
        yield temporary


def _private_temporary(user: int) -> Path | None:
    """Folder among temporary files that only this user may write to, since its files are run."""
    try:
        folder = Path(tempfile.gettempdir()) / f"rotordyn-{user}"
        with suppress(FileExistsError):
            folder.mkdir(mode=0o700)
        status = folder.lstat()
    except OSError:
        return None
    private = stat.S_ISDIR(status.st_mode) and status.st_uid == user and not status.st_mode & 0o077
    return folder if private else None
