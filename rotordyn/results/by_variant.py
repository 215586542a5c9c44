"""What variants have in common is said once."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

MOST_NAMED = 3  # variants that one sentence names


def by_variant(said: Mapping[str, Iterable[str]]) -> tuple[str, ...]:
    """What is ``said`` of variants by name, each sentence once, led by the names of its variants.

    >>> by_variant({"a": ["low", "hot"], "b": ["low"], "c": []})
    ('a, b: low', 'a: hot')
    """
    names: dict[str, list[str]] = {}
    for name, sentences in said.items():
        for sentence in dict.fromkeys(sentences):
            names.setdefault(sentence, []).append(name)
    return tuple(
        f"{_listed(held, len(said))}: {sentence}" if any(held) else sentence
        for sentence, held in names.items()
    )


def _listed(names: Sequence[str], of: int) -> str:
    if len(names) <= MOST_NAMED:
        return ", ".join(names)
    if len(names) == of:
        return f"all {of} variants"
    return f"{names[0]}, {names[1]} and {len(names) - 2} more variants"
