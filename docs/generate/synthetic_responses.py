"""Writes the synthetic responses of cases/identification/grinding_spindle_taps.yaml: computed tap
tests of a spindle, at rest and at 6000 rpm.

The machine is the grinding spindle of the library with the changed values ``TRUE``. Real and
imaginary part of every sample have noise of 2 % of its amplitude; the coherence is that of this
noise for ten averages.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pyuff

import rotordyn
from rotordyn.analyses.measured_response import MeasuredResponse, Port
from rotordyn.study.identification.responses import Responses
from rotordyn.study.identification.trial import Trial

TRUE = {
    "spindle.shaft.sections.nose.outer_diameter": "88 mm",
    "spindle.shaft.sections.middle.outer_diameter": "74 mm",
    "spindle.shaft.sections.tail.outer_diameter": "46 mm",
    "spindle.discs.wheel.width": "36 mm",
    "spindle.masses.pulley.mass": "1.85 kg",
    "spindle.bearings.a.damping.radial": "800 N s/m",
    "spindle.bearings.b.damping.radial": "800 N s/m",
    "spindle.bearings.c.damping.radial": "350 N s/m",
    "spindle.bearings.d.damping.radial": "350 N s/m",
}
FREQUENCY = np.arange(300.0, 2201.0, 8.0)
PORTS = ("nose", "pulley")  # of the responses; the impact is at the nose
NOISE, AVERAGES = 0.02, 10
RPM = np.pi / 30.0


def responses(case: rotordyn.Case, speed: float, rng: np.random.Generator) -> list[np.ndarray]:
    """Receptances with noise [m/N] at a speed [rad/s]."""
    nothing = (1.0,) * len(FREQUENCY)
    nose = Port("nose", "y")
    asked = tuple(
        MeasuredResponse(p, Port(p, "y"), nose, tuple(FREQUENCY.tolist()), nothing, nothing, speed)
        for p in PORTS
    )
    machine = Responses(name="taps", responses=asked, noise=NOISE)
    found = machine.computed(Trial(case), {speed: 2.0 * np.pi * FREQUENCY})[speed]
    noisy = []
    for one in asked:
        noise = rng.normal(size=(2, len(FREQUENCY)))
        noisy.append(found[one.pair] * (1.0 + NOISE * (noise[0] + 1j * noise[1])))
    return noisy


def write_uff(path: Path, values: list[np.ndarray]) -> None:
    """Inertances as records of type 58, as an analyser exports them."""
    path.unlink(missing_ok=True)
    square = -((2.0 * np.pi * FREQUENCY) ** 2)
    for number, (point, one) in enumerate(zip(PORTS, values, strict=True), start=1):
        pyuff.UFF(str(path)).write_sets(
            {
                "type": 58,
                "func_type": 4,
                "id1": f"{point}.y / nose.y, synthetic, grinding spindle",
                "rsp_node": number,
                "rsp_dir": 2,
                "ref_node": 1,
                "ref_dir": 2,
                "ord_data_type": 5,
                "abscissa_spacing": 1,
                "abscissa_min": FREQUENCY[0],
                "abscissa_inc": FREQUENCY[1] - FREQUENCY[0],
                "num_pts": len(FREQUENCY),
                "abscissa_spec_data_type": 18,
                "abscissa_axis_units_lab": "Hz",
                "ordinate_spec_data_type": 12,
                "ordinate_axis_units_lab": "m/s^2",
                "orddenom_spec_data_type": 13,
                "orddenom_axis_units_lab": "N",
                "data": square * one,
                "x": FREQUENCY,
            },
            "add",
        )


def write_csv(path: Path, values: list[np.ndarray]) -> None:
    """Receptances with their coherence."""
    coherence = 1.0 / (1.0 + 2.0 * AVERAGES * NOISE**2)
    pairs = [f"{point}.y / nose.y" for point in PORTS]
    head = [f"{pair} {part} [um/N]" for pair in pairs for part in ("real", "imaginary")]
    lines = ["# synthetic data of a grinding spindle at 6000 rpm, ten averages"]
    lines.append(",".join(["frequency [Hz]", *head, "coherence"]))
    for k, frequency in enumerate(FREQUENCY):
        cells = [f"{part * 1e6:.5g}" for one in values for part in (one[k].real, one[k].imag)]
        lines.append(",".join([f"{frequency:g}", *cells, f"{coherence:.4f}"]))
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def main(folder: Path) -> None:
    """Write both files into a folder."""
    case = rotordyn.vary(rotordyn.load("grinding_spindle"), TRUE)
    rng = np.random.default_rng(58)
    write_uff(folder / "taps_at_rest.uff", responses(case, 0.0, rng))
    write_csv(folder / "taps_6000rpm.csv", responses(case, 6000.0 * RPM, rng))


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
