"""Life, static safety, heat, films and defect frequencies of every bearing of a spindle."""

from __future__ import annotations

from rotordyn.analyses.contract import in_folder
from rotordyn.analyses.life.spec import LifeSpec
from rotordyn.analyses.life.tables import LAYOUTS

ANALYSIS = in_folder(
    __name__,
    "page",
    "warnings",
    machine="spindle",
    place=35,
    spec=LifeSpec,
    bearings=True,
    costs={"life": 6, "heat": 6},
    tables=LAYOUTS,
    heading="life and heat",
    title="Life and heat",
)
