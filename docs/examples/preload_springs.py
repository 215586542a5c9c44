"""How stiff should the preload springs be? Five values compared.

    python docs/examples/preload_springs.py [FIGURE]

shows Campbell diagrams and receptances at the tool at top speed, or writes them to FIGURE.
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import rotordyn

FREQUENCY = np.arange(10.0, 2000.0, 5.0)  # Hz
case = rotordyn.load("mfw2310").vary({
    "analyses.campbell.max_frequency": 2000.0,
    "analyses.frf.frequencies": FREQUENCY,
    "speeds": [f"{rpm} rpm" for rpm in range(0, 24001, 2000)],
})  # fmt: skip
figure, (campbell, frf) = plt.subplots(1, 2, figsize=(10, 4.5), layout="constrained")
for number, stiffness in enumerate((2.5, 5.0, 10.0, 20.0, 40.0)):  # N/µm
    found = rotordyn.run(case.vary({"spindle.sleeves.*.spring.stiffness": f"{stiffness} N/um"}))
    modes, map_ = found["campbell"], found["frf"].receptance.sel(pair="Oc2.y / Oc2.y")
    bending = modes.frequency.where(modes.kind == "bending", drop=True)
    look = {"color": f"C{number}", "label": f"{stiffness:g} N/µm"}
    campbell.plot(modes.speed_rpm, bending, **look)
    frf.semilogy(FREQUENCY, abs(map_.isel(speed=-1)) * 1e6, **look)
campbell.set(xlabel="speed [rpm]", ylabel="frequency [Hz]", title="Bending modes", ylim=(0, 2000))
frf.set(xlabel="frequency [Hz]", ylabel="receptance [µm/N]", title="Tool Oc2.y at 24 000 rpm")
frf.legend(title="preload springs")
plt.savefig(sys.argv[1]) if len(sys.argv) > 1 else plt.show()
