"""An end mill on a spindle that is known only by a blank, measured at two points with noise.

    python docs/examples/blank_measurement.py [FIGURE]

takes the blank from its receptances, puts the end mill in its place and shows its tip beside that
of the whole machine, or writes the figure to FIGURE. The measurement is computed, with 1 % noise.
"""

import math
import sys
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

import rotordyn
from rotordyn.analyses.coupling import (
    Section,
    amplification,
    beam,
    between_points,
    couple,
    uncouple,
)
from rotordyn.analyses.frf.records import read_record
from rotordyn.analyses.modal_fit import modal_fit
from rotordyn.case.library import find_case

BLANK, TOOL, SPACING = "hsk63_blank_60", "hsk63_end_mill_16", 0.03  # m from tip to inner
HIGHEST = 3000.0  # Hz, to which the whole machine is computed


def shaft(name, pieces=24):
    """Cylinders of a tool, its cones in pieces."""
    found = []
    for own in rotordyn.model("tools", name).sections:
        steel, (front, rear) = own.material, own.outer
        many = pieces if front != rear else 1
        for k in range(many):
            outer = front + (rear - front) * (k + 0.5) / many
            elastic = steel.young_modulus, steel.density, steel.poisson_ratio
            found.append(Section(own.length / many, outer, own.inner[0], *elastic))
    return found


file = find_case("mfw2310_blank").parent / "data" / "made_up_blank.csv"
pairs = ("tip.y / tip.y", "tip.y / inner.y", "inner.y / inner.y")
records = [read_record(file, pair, None) for pair in pairs]
omega = 2.0 * math.pi * np.array(records[0].frequency)
measured = np.array([record.values for record in records]).T
measured, omega = (each[omega <= 2.0 * math.pi * HIGHEST] for each in (measured, omega))
cylinder, *rest = shaft(BLANK)
pieces = (cylinder._replace(length=each) for each in (SPACING, cylinder.length - SPACING))
front, behind = next(pieces), next(pieces)
blank = between_points(beam(omega, [front]), beam(omega, [behind, *rest]))
tool = beam(omega, shaft(TOOL))
fit = modal_fit(omega, measured, modes=6)

whole = rotordyn.load("mfw2310_tools").variants[TOOL]
whole = replace(whole, speeds=(0.0,), analyses={"frf": whole.analyses["frf"]})
exact = rotordyn.run(whole)["frf"].receptance[0, 0]
exact = exact.sel(frequency=omega / 2.0 / math.pi, method="nearest").values

figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
hertz = omega / 2.0 / math.pi
axes.semilogy(hertz, np.abs(exact) * 1e6, "k", lw=2.5, alpha=0.4, label="whole machine")
for name, own in (
    ("coupled, as measured", measured),
    (f"coupled, six modes fitted (misfit {fit.misfit:.2%})", fit(omega)),
):
    ends = own[:, [[0, 1], [1, 2]]]  # tip and inner point
    tip = couple(tool, uncouple(blank, ends))[:, 0, 0]
    off = np.median(np.abs(tip - exact) / np.abs(exact))
    larger = np.median(amplification(blank, ends)[:, 0, 0])
    said = f"{name}: median error {off:.1%}, in the nose the noise is {larger:.0f}-fold"
    axes.semilogy(hertz, np.abs(tip) * 1e6, lw=1.0, label=said)
axes.set(xlabel="frequency [Hz]", ylabel="receptance at the tip [µm/N]", title=TOOL)
figure.legend(loc="outside lower center", fontsize="small")
plt.savefig(sys.argv[1]) if len(sys.argv) > 1 else plt.show()
