"""Frequencies that elements of a given length cannot carry at all."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from rotordyn.analyses.contract import Spec
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.equation.mesh import build_mesh
from rotordyn.equation.shaft import half_wave
from rotordyn.machine.spindle import Spindle
from rotordyn.results.display import RPM
from rotordyn.scene.conditions import Conditions


def beyond_elements(
    spindle: Spindle, conditions: Conditions, analyses: Mapping[str, Spec], top: float
) -> Iterator[str]:
    """A sentence for every response asked for where an element spans more than half a wave.

    ``top``: highest speed [rad/s]. Elements that follow the accuracy carry whatever is asked.
    """
    longest = conditions.element_length
    fastest = top * max(abs(ratio) for ratio in spindle.ratios.values())
    asked = {name: _highest(spec, fastest) for name, spec in analyses.items()}
    if longest is None or conditions.rotor == "rigid" or not any(asked.values()):
        return
    meshes = build_mesh(spindle, longest).of_rotors
    limits = {
        name: half_wave(spindle.part(name), meshes[name], abs(ratio) * top) / (2.0 * math.pi)
        for name, ratio in spindle.ratios.items()
    }
    weakest = min(limits, key=lambda name: limits[name])
    limit, mesh = limits[weakest], meshes[weakest]
    for name, highest in asked.items():
        if highest > limit:
            turned = f" ({highest * 2.0 * math.pi * RPM.factor:.0f} rpm)" if name != "frf" else ""
            yield (
                f"{name} goes up to {highest:.6g} Hz{turned}, and an element of "
                f"{mesh.length.max() * 1e3:.4g} mm carries bending up to {limit:.4g} Hz, half a "
                "wave: allowed: shorter elements, or accuracy instead"
            )


def _highest(spec: Spec, top: float) -> float:
    """Highest frequency of a response [Hz], 0 where there is none; ``top``: of all rotors."""
    if isinstance(spec, FrfSpec):
        return max(spec.frequencies, default=0.0)
    return top / (2.0 * math.pi) if isinstance(spec, UnbalanceSpec) else 0.0
