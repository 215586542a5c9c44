"""What machines whose shaft has joints cannot be asked."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rotordyn.analysis.shaft import EXACT, Modelled


def obstacles_of_joints(
    conditions: Modelled, asked: Iterable[str]
) -> Iterator[tuple[tuple[str, ...], str]]:
    """Where a case asks what joints do not allow, and a sentence."""
    if conditions.shaft == EXACT:
        yield (
            ("conditions", "shaft"),
            "the exact shaft takes no joints: given 'exact'; allowed: elements",
        )
    if "section_forces" in asked:
        yield (
            ("analyses", "section_forces"),
            "section forces take no joints, whose give the elastic line leaves out: leave out the "
            "joints",
        )
