"""Plan of a solved case as text: stages below their callers, what was spared or not run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from rotordyn.results.text import wrapped

COLUMN = 48  # at which times are printed


def plan(
    seconds: Mapping[str, float],
    parents: Mapping[str, str],
    spared: Sequence[str],
    skipped: Mapping[str, str],
    job: Mapping[str, float],
) -> str:
    """Stages as a tree with their ``seconds``, each below its first caller in ``parents``.

    ``spared``: sentences; ``skipped``: stages and pictures that were not made -> why; ``job``:
    seconds of the work outside the stages.
    """
    lines = ["stages, each below the one that first needed it, with its own time"]
    lines += _tree(seconds, parents, "", 1)
    lines += [_timed(name, value, 1) for name, value in job.items()]
    if spared:
        lines += ["spared", *_entries(spared)]
    if skipped:
        reasons: dict[str, list[str]] = {}
        for name, why in skipped.items():
            reasons.setdefault(why, []).append(name)
        lines += [
            "not run",
            *_entries(f"{', '.join(names)}: {w}" for w, names in reasons.items()),
        ]
    return "\n".join(lines)


def _tree(
    seconds: Mapping[str, float], parents: Mapping[str, str], caller: str, depth: int
) -> Iterator[str]:
    for name in (name for name, parent in parents.items() if parent == caller and name in seconds):
        yield _timed(name, seconds[name], depth)
        yield from _tree(seconds, parents, name, depth + 1)


def _timed(name: str, seconds: float, depth: int) -> str:
    label = "  " * depth + name
    return f"{label:{COLUMN}}{1e3 * seconds:9.1f} ms"


def _entries(sentences: Sequence[str] | Iterator[str]) -> Iterator[str]:
    for sentence in sentences:
        yield from wrapped(f"  {sentence}")
