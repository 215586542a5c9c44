"""Sentences of variants, merged where they are equal."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from rotordyn.results.severity import graded, severity_of

MOST_NAMED = 3  # variants that one sentence names


def by_variant(said: Mapping[str, Iterable[str]]) -> tuple[str, ...]:
    """Merge sentences by variant (``said``): each once, led by the names of its variants; warnings
    keep their severity.

    >>> by_variant({"a": ["low", "hot"], "b": ["low"], "c": []})
    ('a, b: low', 'a: hot')
    """
    names: dict[str, list[str]] = {}
    for name, sentences in said.items():
        for sentence in dict.fromkeys(sentences):
            names.setdefault(sentence, []).append(name)
    return tuple(
        graded(severity_of(sentence), f"{_listed(variants, len(said))}: {sentence}")
        if any(variants)
        else sentence
        for sentence, variants in names.items()
    )


def _listed(names: Sequence[str], of: int) -> str:
    if len(names) <= MOST_NAMED:
        return ", ".join(names)
    if len(names) == of:
        return f"all {of} variants"
    return f"{names[0]}, {names[1]} and {len(names) - 2} more variants"
