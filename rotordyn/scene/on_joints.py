"""What machines whose shaft has joints cannot be asked."""

from __future__ import annotations

from collections.abc import Iterable, Iterator


def obstacles_of_joints(asked: Iterable[str]) -> Iterator[tuple[tuple[str, ...], str]]:
    """Where a case asks what joints do not allow, and a sentence."""
    if "section_forces" in asked:
        yield (
            ("analyses", "section_forces"),
            "section forces take no joints, whose give the elastic line leaves out: leave out the "
            "joints",
        )
