"""Calls of public functions and classes with one argument that makes no sense.

Every public class and function is tried with what works, one argument of it replaced by every value
that makes no sense. What may come of it: a result, or an error of ours in a sentence.
"""

from __future__ import annotations

import math
import os
import pickle
import random
import resource
import signal
import warnings
from collections.abc import Callable, Iterator, Mapping
from dataclasses import fields, is_dataclass, replace
from datetime import date
from decimal import Decimal
from fractions import Fraction
from functools import cache, partial
from pathlib import Path
from tempfile import gettempdir
from typing import Any, NamedTuple

import numpy as np

LONGEST, SECONDS = 1500, 5.0  # characters of a message; of one call
GONE = Path(gettempdir()) / "no such folder"


class _Odd:
    """Equal to nothing, not even to itself; a number only by what it says."""

    def __eq__(self, other: object) -> bool:
        return False

    __hash__ = None  # type: ignore[assignment]

    def __float__(self) -> float:
        return 1.0

    def __len__(self) -> int:
        return 3


NONSENSE: dict[str, Any] = {
    "None": None,
    "True": True,
    "nan": math.nan,
    "inf": math.inf,
    "-inf": -math.inf,
    "zero": 0,
    "negative": -1.0,
    "tiny": 5e-324,
    "huge": 1e308,
    "huge integer": 10**400,
    "negative huge integer": -(10**400),
    "fraction": Fraction(1, 3),
    "huge fraction": Fraction(10**400, 3),
    "decimal": Decimal("1e5000"),
    "signalling": Decimal("sNaN"),
    "complex": 1j,
    "0-d": np.array(1.0),
    "0-d text": np.array("y"),
    "0-d object": np.array(None, dtype=object),
    "empty array": np.zeros(0),
    "array": np.array([1.0, 2.0, 3.0]),
    "array of flags": np.array([True, False]),
    "array of nan": np.full((2, 2), math.nan),
    "big shape": np.broadcast_to(1.0, (7, 1, 3)),
    "array of text": np.array(["y", "z"]),
    "array of objects": np.array([{}, None], dtype=object),
    "masked": np.ma.masked,
    "numpy integer": np.int64(-3),
    "float16": np.float16(math.inf),
    "date of numpy": np.datetime64("2024-01-01"),
    "empty text": "",
    "text": "nonsense",
    "number as text": "1",
    "quantity": "1 mm",
    "other quantity": "1e400 rpm",
    "nul": "\0",
    "surrogate": "\ud800",
    "long text": "y" * 100_000,
    "digits": "9" * 10_000,
    "arabic digits": "١٢",
    "bytes": b"y",
    "empty list": [],
    "list": [1.0, None, "x"],
    "ragged list": [[1.0], [1.0, 2.0]],
    "nested list": [[[[[[1.0]]]]]],
    "list of itself": [],
    "tuple of text": ("y", "y"),
    "set": {1.0},
    "mapping": {"a": 1.0},
    "mapping of odd keys": {1: None, None: (), math.nan: []},
    "range": range(3),
    "generator": None,
    "function": len,
    "class": int,
    "module": math,
    "object": None,
    "odd": None,
    "exception": ValueError("x"),
    "path": GONE,
    "date": date(2024, 1, 1),
    "slice": slice(None),
    "ellipsis": ...,
}  # fmt: skip
NONSENSE["list of itself"].append(NONSENSE["list of itself"])
_MADE = {"generator": lambda: iter([1.0, 2.0]), "object": object, "odd": _Odd}


def nonsense(name: str) -> Any:
    """A value by its name, made anew where a call would use it up."""
    return _MADE[name]() if name in _MADE else NONSENSE[name]


class Subject(NamedTuple):
    """Something to call, and arguments with which it works."""

    call: Callable[..., Any]
    arguments: Mapping[str, Any]
    documented: bool = False  # raises TypeError by its documentation


class Call(NamedTuple):
    """A subject with one argument replaced."""

    subject: str
    argument: str
    value: str


@cache
def subjects() -> dict[str, Subject]:
    """All that is called, by name."""
    return {**_descriptions(), **_bearings(), **_rest()}


def calls() -> list[Call]:
    """Every call."""
    return [
        Call(name, argument, value)
        for name, subject in subjects().items()
        for argument in subject.arguments
        for value in NONSENSE
    ]


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


class Found(NamedTuple):
    """What is wrong with a call."""

    call: Call
    fault: str


def tried(call: Call) -> str:
    """What is wrong with it; empty where it answers or refuses as it must."""
    from bearings.errors import BearingError
    from rotordyn.errors import RotordynError

    subject = subjects()[call.subject]
    given = {**subject.arguments, call.argument: nonsense(call.value)}
    with warnings.catch_warnings(record=True) as leaked:
        warnings.simplefilter("always")
        try:
            subject.call(**given)
        except (RotordynError, BearingError) as error:
            said = str(error)
            if len(said) > LONGEST or said.count("\n") > 3:
                return f"a message of {len(said)} characters, {said[:80]!r}"
            if not said.strip():
                return "no word"
        except TypeError as error:
            if not subject.documented:
                return _crash(error)
        except Exception as error:  # noqa: BLE001 - whatever comes out is the finding
            return _crash(error)
    return f"warning: {leaked[0].message!s:.80}" if leaked else ""


def _crash(error: BaseException) -> str:
    import traceback

    last = traceback.extract_tb(error.__traceback__)[-1]
    own = [f for f in traceback.extract_tb(error.__traceback__) if "hostile" not in f.filename]
    near = [f for f in own if "/rotordyn/" in f.filename or "/bearings/" in f.filename]
    at = near[-1] if near else last
    return f"{type(error).__name__} at {Path(at.filename).name}:{at.lineno}: {error!s:.80}"


class _TooLong(BaseException):
    pass


def _alarm(*_: object) -> None:
    raise _TooLong


def of(batch: list[Call]) -> Iterator[Found]:
    """What is wrong with the calls of a batch, tried one after the other in a fork; a call that
    ends the process or takes long is named."""
    rest = batch
    while rest:
        done, found, ended = _forked(rest)
        yield from found
        if ended:
            yield Found(rest[done], ended)
            done += 1
        rest = rest[done:]


def _forked(batch: list[Call]) -> tuple[int, list[Found], str]:
    out, into = os.pipe()
    process = os.fork()
    if process == 0:
        os.close(out)
        room = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 + 6_000_000_000
        resource.setrlimit(resource.RLIMIT_AS, (room, room))
        devnull = os.open(os.devnull, os.O_WRONLY)
        os.dup2(devnull, 1)
        os.dup2(devnull, 2)
        signal.signal(signal.SIGALRM, _alarm)
        with os.fdopen(into, "wb") as pipe:
            for call in batch:
                signal.setitimer(signal.ITIMER_REAL, 4 * SECONDS, 1.0)
                try:
                    fault = tried(call)
                except _TooLong:
                    fault = f"more than {4 * SECONDS:g} s"
                except BaseException as error:  # noqa: BLE001
                    fault = _crash(error)
                signal.setitimer(signal.ITIMER_REAL, 0.0)
                pipe.write(pickle.dumps(fault))
                pipe.flush()
        os._exit(0)
    os.close(into)
    found: list[Found] = []
    done = 0
    with os.fdopen(out, "rb") as pipe:
        while True:
            try:
                fault = pickle.load(pipe)
            except EOFError:
                break
            if fault:
                found.append(Found(batch[done], fault))
            done += 1
    _, status, _ = os.wait4(process, 0)
    ended = "" if done == len(batch) else f"the process ended, status {status}"
    return done, found, ended


def sample(count: int, seed: int = 0) -> list[Call]:
    """So many of all calls."""
    every = calls()
    return random.Random(seed).sample(every, min(count, len(every)))
