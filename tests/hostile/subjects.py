"""Every public function and class, with arguments that work."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass, replace
from functools import cache, partial
from typing import Any, NamedTuple

import numpy as np

from tests.hostile.nonsense import GONE


class Subject(NamedTuple):
    """Something to call, and arguments with which it works."""

    call: Callable[..., Any]
    arguments: Mapping[str, Any]


@cache
def subjects() -> dict[str, Subject]:
    """All that is called, by name."""
    return {**_descriptions(), **_bearings(), **_rest()}


def _descriptions() -> dict[str, Subject]:
    """Everything that a shipped case is made of: each class with the fields of an instance."""
    import rotordyn

    held: dict[type, Any] = {}
    for shipped in rotordyn.cases():
        _collect(rotordyn.load(shipped.name), held, set())
    made = {}
    for kind, instance in sorted(held.items(), key=lambda pair: pair[0].__name__):
        names = [field.name for field in fields(kind) if field.init]
        made[kind.__name__] = Subject(
            partial(replace, instance), {name: getattr(instance, name) for name in names}
        )
    return made


def _collect(held: Any, found: dict[type, Any], seen: set[int]) -> None:
    if id(held) in seen:
        return
    seen.add(id(held))
    if isinstance(held, Mapping):
        for each in held.values():
            _collect(each, found, seen)
    elif isinstance(held, tuple | list):
        for each in held:
            _collect(each, found, seen)
    elif is_dataclass(held) and not isinstance(held, type):
        if type(held).__module__.split(".")[0] in ("rotordyn", "bearings"):
            found.setdefault(type(held), held)
        for field in fields(held):
            _collect(getattr(held, field.name), found, seen)


def _bearings() -> dict[str, Subject]:
    import bearings
    from bearings import film, fits, heat, life

    ball = bearings.AngularContactBallBearing(9.525e-3, 90e-3, 25, contact_angle=0.4363)
    state = ball.equilibrium(load=[1000.0, 50.0, 0.0, 0.0, 0.0], speed=1000.0)
    follower = bearings.Follower(ball, speed=1000.0)
    follower.load([1e-5, 0.0, 0.0, 0.0, 0.0])  # compiles once for all forks
    oil = bearings.Lubricant(32e-6, 5.4e-6)
    guide = bearings.LinearBallGuide(8, 3e-3, 20e-3, 2e-6)
    given = dict(
        load=[1000.0, 0.0, 0.0, None, None],
        displacement=[None, None, None, 0.0, 0.0],
        speed=1000.0,
        static_growth=0.0,
        growth=1e-6,
        kinematics="hybrid",
        moment_sharing="equal",
        friction=0.1,
        dynamics="resultant",
        start=None,
    )
    loaded = {"load": [1000.0, 0.0, 0.0, 0.0, 0.0]}
    estimated = dict(
        bore=60e-3,
        outside_diameter=95e-3,
        width=18e-3,
        contact_angle=0.4363,
        hybrid=True,
        preloads=[200.0],
        rigidities=[150e6],
        static_rating=20e3,
    )
    pair = ((0.0, 10e-6), (-8e-6, 0.0))
    found = {
        "equilibrium": Subject(ball.equilibrium, given),
        "equilibrium loaded": Subject(ball.equilibrium, loaded),
        "drawn": Subject(ball.drawn, dict(name="ball_diameter", value=1e-3)),
        "state.stiffness": Subject(state.stiffness, dict(method="complete")),
        "stiffness": Subject(bearings.stiffness, dict(state=state, method="complete")),
        "condition": Subject(bearings.condition, dict(state=state)),
        "truncation": Subject(bearings.truncation, dict(state=state)),
        "Follower": Subject(
            bearings.Follower,
            dict(bearing=ball, speed=1000.0, static_growth=0.0, growth=1e-6, law=bearings.Law()),
        ),
        "Follower.load": Subject(
            follower.load, dict(displacement=[1e-5, 0.0, 0.0, 0.0, 0.0], speed=1000.0)
        ),
        "Follower.displacement": Subject(
            follower.displacement, dict(load=[500.0, 0.0, 0.0, 0.0, 0.0], speed=1000.0)
        ),
        "Law": Subject(
            bearings.Law,
            dict(kinematics="hybrid", moment_sharing="equal", friction=0.1, dynamics="resultant"),
        ),
        "Lubricant": Subject(
            bearings.Lubricant,
            dict(
                viscosity_40=32.0,
                viscosity_100=5.4,
                density=870.0,
                pressure_viscosity=2e-8,
                conductivity=0.14,
            ),
        ),
        "Lubricant.kinematic": Subject(oil.kinematic, dict(celsius=40.0)),
        "Lubricant.dynamic": Subject(oil.dynamic, dict(celsius=40.0)),
        "Lubricant.thinning": Subject(oil.thinning, dict(celsius=40.0)),
        "LinearBallGuide": Subject(
            bearings.LinearBallGuide,
            dict(balls=8, ball_diameter=3e-3, column_diameter=20e-3, interference=2e-6),
        ),
        "guide.force": Subject(guide.force, dict(displacement=1e-6)),
        "guide.tangent": Subject(guide.tangent, dict(displacement=1e-6)),
        "guide.linear_range": Subject(guide.linear_range, dict(share=0.01)),
        "Material": Subject(
            bearings.Material,
            dict(
                name="steel",
                young_modulus=2e11,
                poisson_ratio=0.3,
                density=7800.0,
                thermal_expansion=1e-5,
            ),
        ),
        "estimate": Subject(bearings.estimate, estimated),
        "estimate.pair": Subject(bearings.estimate(**estimated).pair, dict(preload=200.0)),
        "film.film": Subject(
            film.film,
            dict(state=state, lubricant=oil, temperature=50.0, starvation=1.0, heating=True),
        ),
        "film.hamrock_dowson": Subject(
            film.hamrock_dowson,
            dict(
                load=100.0,
                entrainment=1.0,
                radius=0.01,
                modulus=2e11,
                ellipticity=5.0,
                viscosity=0.02,
                pressure_viscosity=2e-8,
            ),
        ),
        "film.inlet_heating": Subject(
            film.inlet_heating, dict(pressure=1e9, modulus=2e11, loading=0.1, slip=0.0)
        ),
        "fits.limits": Subject(fits.limits, dict(tolerance="k5", diameter=0.06)),
        "fits.bearing_bore": Subject(fits.bearing_bore, dict(diameter=0.06, grade="normal")),
        "fits.bearing_outside": Subject(fits.bearing_outside, dict(diameter=0.06, grade="P4")),
        "fits.interference": Subject(fits.interference, dict(shaft=pair[0], bore=pair[1])),
        "fits.one_third": Subject(fits.one_third, dict(shaft=pair[0], bore=pair[1])),
        "fits.smoothing": Subject(
            fits.smoothing, dict(shaft_roughness=1e-6, bore_roughness=1e-6, rule="DIN 7190")
        ),
        "heat.sliding": Subject(heat.sliding, dict(state=state, friction=0.05)),
        "heat.spin_moment": Subject(heat.spin_moment, dict(state=state, friction=0.05)),
        "heat.load_moment": Subject(heat.load_moment, dict(state=state, rating=2e4)),
        "heat.viscous_moment": Subject(
            heat.viscous_moment,
            dict(pitch_diameter=0.09, viscosity=20.0, speed=1000.0, oil_factor=1.0),
        ),
        "heat.skf_moment": Subject(
            heat.skf_moment,
            dict(
                radial=100.0,
                axial=500.0,
                speed=1000.0,
                viscosity=20.0,
                bore=0.06,
                outside=0.095,
                supply="oil-air",
                hybrid=False,
                ehl_friction=0.05,
            ),
        ),
        "heat.thermal_growth": Subject(
            heat.thermal_growth, dict(bearing=ball, temperature=np.array([20.0] * 3))
        ),
        "heat.losses": Subject(
            heat.losses,
            dict(
                state=state,
                lubricant=oil,
                temperature=50.0,
                friction=0.05,
                oil_factor=1.0,
                model="ellipse",
                static_rating=2e4,
            ),
        ),
        "life.basic_life": Subject(life.basic_life, dict(rating=3e4, load=1e3)),
        "life.dynamic_load": Subject(
            life.dynamic_load,
            dict(radial=100.0, axial=500.0, contact_angle=0.4363, axial_over_static=0.1),
        ),
        "life.equivalent_static": Subject(
            life.equivalent_static, dict(radial=100.0, axial=500.0, contact_angle=0.4363)
        ),
        "life.pair_rating": Subject(life.pair_rating, dict(single=3e4, rows=2)),
        "life.fatigue_load_limit": Subject(
            life.fatigue_load_limit, dict(static_rating=2e4, pitch_diameter=0.09)
        ),
        "life.life_factor": Subject(
            life.life_factor, dict(kappa=2.0, contamination=0.5, limit=1e3, load=1e3)
        ),
        "life.mean_life": Subject(life.mean_life, dict(share=[0.5, 0.5], life=[1e4, 2e4], axis=0)),
        "life.reference_viscosity": Subject(
            life.reference_viscosity, dict(speed=1000.0, pitch_diameter=0.09)
        ),
        "life.reliability_factor": Subject(life.reliability_factor, dict(reliability=0.9)),
        "life.set_life": Subject(life.set_life, dict(life=[1e4, 2e4], axis=-1)),
        "life.temperature_factor": Subject(life.temperature_factor, dict(celsius=100.0)),
        "life.viscosity_ratio": Subject(
            life.viscosity_ratio, dict(viscosity=20.0, speed=1000.0, pitch_diameter=0.09)
        ),
        "life.frequencies": Subject(life.frequencies, dict(state=state)),
        "life.nominal_frequencies": Subject(
            life.nominal_frequencies, dict(bearing=ball, contact_angle=0.4)
        ),
        "life.dynamic_rating": Subject(life.dynamic_rating, dict(bearing=ball)),
        "life.geometry_factor": Subject(life.geometry_factor, dict(bearing=ball)),
        "life.static_rating": Subject(life.static_rating, dict(bearing=ball, pressure=4.2e9)),
        "life.ball_ratings": Subject(life.ball_ratings, dict(bearing=ball, rating=3e4)),
        "life.life_of": Subject(
            life.life_of, dict(state=state, dynamic_rating=3e4, rotating="inner")
        ),
        "life.reference_life": Subject(
            life.reference_life, dict(state=state, dynamic_rating=3e4, rotating="inner")
        ),
        "life.static_safety": Subject(life.static_safety, dict(state=state, pressure=4.2e9)),
        "on_film": Subject(
            bearings.on_film.on_film,
            dict(
                bearing=ball,
                lubricant=oil,
                temperature=50.0,
                load=[1000.0, 0, 0, 0, 0],
                speed=1000.0,
                static_growth=0.0,
                growth=0.0,
                law=bearings.Law(),
                starvation=1.0,
                heating=True,
            ),
        ),
    }
    return found


def _rest() -> dict[str, Subject]:
    import rotordyn
    from rotordyn import units

    case = rotordyn.load("grinding_spindle")
    quick = case.vary({"analyses": {"preload": rotordyn.analyses.PreloadSpec()}, "speeds": [0.0]})
    results = rotordyn.run(quick)
    return {
        "load": Subject(rotordyn.load, dict(path="grinding_spindle")),
        "open": Subject(rotordyn.open, dict(folder="out")),
        "model": Subject(rotordyn.model, dict(kind="spindles", reference="grinding_spindle")),
        "models": Subject(rotordyn.models, dict(kind="spindles")),
        "run": Subject(rotordyn.run, dict(case=quick, interval=False)),
        "vary": Subject(rotordyn.vary, dict(description=quick, changes={})),
        "vary value": Subject(
            lambda value: quick.vary({"spindle.sleeves.*.spring.stiffness": value}),
            dict(value=1e6),
        ),
        "vary path": Subject(lambda path: quick.vary({f"{path}": 1e6}), dict(path="spindle.x")),
        "sensitivities": Subject(
            rotordyn.sensitivities,
            dict(case=quick, paths=["spindle.sleeves.*.spring.stiffness"]),
        ),
        "Span": Subject(rotordyn.Span, dict(low=1.0, high=2.0, count=3, log=False)),
        "Goal": Subject(rotordyn.Goal, dict(highest="preload.axial_load", lowest=None, where={})),
        "Limit": Subject(
            rotordyn.Limit,
            dict(
                of="preload.axial_load",
                where={},
                at_least=1.0,
                at_most=2.0,
                outside=None,
                absent=False,
            ),
        ),
        "sweep": Subject(
            rotordyn.sweep,
            dict(
                case=quick,
                varied={},
                sampling="grid",
                samples=None,
                seed=0,
                analyses=(),
                results=(),
                workers=1,
                cluster=None,
                folder=None,
                yes=False,
            ),
        ),
        "optimise": Subject(
            rotordyn.optimise,
            dict(
                case=quick, varied={}, goals=(), limits=(), trials=1, seed=0, workers=1, folder=None
            ),
        ),
        "write_report": Subject(rotordyn.write_report, dict(folder=GONE, path=GONE)),
        "results.plot": Subject(results.plot, dict(name="")),
        "units.parse": Subject(units.parse, dict(given="1 mm", kind="length")),
        "state.follow": Subject(rotordyn.state.follow, dict(description={})),
        "conditions": Subject(
            rotordyn.analyses.Conditions, dict(kinematics="hybrid", friction=1.0)
        ),
    }
