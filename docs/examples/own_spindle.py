"""A small spindle built from its parts: two bearings in O, a spring, a tool; all values in SI.

    python docs/examples/own_spindle.py [FIGURE]

shows the Campbell diagram and the radial stiffness at the tool tip, or writes them to FIGURE.
"""

import math
import sys

import matplotlib.pyplot as plt
import numpy as np

import rotordyn
from bearings import SILICON_NITRIDE, STEEL, AngularContactBallBearing
from rotordyn.analyses import CampbellSpec, Conditions, StiffnessSpec
from rotordyn.machine import BearingSeat, Section, Shaft, Sleeve, Spindle, Spring, Tool

SPEEDS = np.linspace(0.0, 30000.0, 16) * math.pi / 30.0  # rad/s

bearing = AngularContactBallBearing(
    ball_diameter=7.144e-3,
    pitch_diameter=55e-3,
    balls=19,
    contact_angle=math.radians(25.0),
    inner_conformity=0.54,
    outer_conformity=0.53,
    ball_material=SILICON_NITRIDE,
)
spindle = Spindle(
    name="small",
    shaft=Shaft(
        start=0.0,  # the nose face; the shaft runs to the rear
        sections=(
            Section(0.030, 60e-3, 20e-3, STEEL, "nose"),
            Section(0.220, 40e-3, 20e-3, STEEL, "body"),
        ),
    ),
    seats=(
        BearingSeat("front", bearing, x=0.050, thrust=+1, radial_damping=500.0),
        BearingSeat("rear", bearing, x=0.210, thrust=-1, radial_damping=500.0),
    ),
    sleeves=(Sleeve("rear", ("rear",), Spring(preload=400.0, stiffness=4e6)),),
    rotor_damping=(0.01,),
)
tool = Tool(
    name="cutter",
    sections=(Section(0.060, 20e-3, 0.0, STEEL, "shank"),),
    points={"tip": -0.060},
)
case = rotordyn.Case(
    name="own_spindle",
    title="Small spindle with two bearings in O",
    spindle=spindle.with_tool(tool),
    conditions=Conditions(kinematics="hybrid"),
    speeds=SPEEDS,
    analyses={"campbell": CampbellSpec(max_frequency=3000.0), "stiffness": StiffnessSpec("tip")},
)
found = rotordyn.run(case)

modes, tangent = found["campbell"], found["stiffness"].tangent.sel(variant="nonlinear")
figure, (campbell, stiffness) = plt.subplots(1, 2, figsize=(10, 4.5), layout="constrained")
for mode in modes.mode.values:
    campbell.plot(modes.speed_rpm, modes.frequency.sel(mode=mode), label=mode)
campbell.set(xlabel="speed [rpm]", ylabel="frequency [Hz]", title=case.title, ylim=(0, 4500))
campbell.legend(ncols=2, loc="upper center")
stiffness.plot(modes.speed_rpm, tangent / 1e6)
stiffness.set(xlabel="speed [rpm]", ylabel="radial stiffness [N/µm]", title="At the tool tip")
stiffness.set_ylim(bottom=0.0)
if len(sys.argv) > 1:
    figure.savefig(sys.argv[1])
else:
    plt.show()
