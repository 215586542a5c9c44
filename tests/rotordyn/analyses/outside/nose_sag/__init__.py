"""An analysis of a package outside: the mass of the rotor, said at every speed."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

from rotordyn.analyses.contract import Analysis, Code
from rotordyn.results.layout import Layout
from rotordyn.scene.spec import Spec

code = partial(Code, __name__)


@dataclass(frozen=True, slots=True)
class NoseSagSpec(Spec):
    """It takes nothing."""


ANALYSIS = Analysis(
    name="nose_sag",
    machine="spindle",
    spec=NoseSagSpec,
    solve=code("solve:solve"),
    figures=code("figures:figures"),
    tables=(Layout("nose_sag", ("speed",)),),
    summary=code("solve:summary"),
)
