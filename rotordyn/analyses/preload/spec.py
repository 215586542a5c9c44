"""What a case asks of the preload state."""

from __future__ import annotations

from dataclasses import dataclass

from rotordyn.description import Faults
from rotordyn.scene.spec import Setting, Spec


@dataclass(frozen=True, slots=True)
class PreloadSpec(Spec):
    """The dynamic preload state at every speed of the case; it has no choices."""

    def faults_on(self, setting: Setting) -> Faults:
        if not setting.spindle.seats:
            yield (), "needs bearings: this spindle has none"
