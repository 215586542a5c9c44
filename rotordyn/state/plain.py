"""Networks and paths in plain form (dicts, lists, numbers), read and checked.

A plain network is a dict (SI; positions from the mounted state at rest, where all are 0):

``bodies``: names; None is the ground wherever a body is named.
``laws``: name -> ``{kind: power, k, p}``, ``{kind: linear, k}``, ``{kind: table, d, F,
interpolation: linear | cubic}`` or ``{kind: rest_ball, z, kn, BD, alpha_deg, growth}``; none of
them pulls.
``bearings``: ``inner``, ``outer``, ``s`` ±1, ``n`` in tandem, ``law`` (of several the first applies
at rest), ``preload`` of one bearing at rest [N] or its deflection ``d0`` [m].
``springs``: ``body``, ``other``, ``P`` [N], ``e`` ±1, ``K`` [N/m] (0: constant force) or ``rigid``.
``stops``: ``body``, ``other``, ``low`` and ``high`` [m], one of which may be omitted.
``frictions``: ``body``, ``other``, ``limit`` [N], ``start``: its force at rest [N].
``path``: steps of ``force`` {body: N}, ``shift`` {"bearing 0" or ("spring", 0): m} and ``law``
{"0": name}; values that a step does not name stay.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from numbers import Real
from typing import Any, NoReturn

import numpy as np

from bearings.errors import shown
from rotordyn.arrays import Array
from rotordyn.errors import InvalidInput
from rotordyn.quantity import suggestion
from rotordyn.state.laws import AxialLaw, Power, RestBall, deflection, table
from rotordyn.state.network import Bearings, Frictions, Load, Network, Springs, Step, Stops

Plain = Mapping[str, Any]
LARGEST = 1e12  # N on a body
BETWEEN = 9  # places between two points of a table at which it must not fall
ROUND = 1e-9  # N
KEYS = {  # those of a network from name on belong to files of reference results: not read
    "network": "bodies laws bearings springs stops frictions path name why real answers events",
    "bearings": "inner outer s n law preload d0 name",
    "springs": "body other P K e rigid name",
    "stops": "body other low high name",
    "frictions": "body other limit start name",
    "path": "force shift law",
}
LAWS = {
    "power": "kind k p",
    "linear": "kind k",
    "table": "kind d F interpolation",
    "rest_ball": "kind z kn BD alpha_deg growth",
}


def network(plain: Plain) -> tuple[Network, Load, dict[str, AxialLaw]]:
    """Read the network, its load at rest, and its laws by name.

    Raises
    ------
    InvalidInput : one sentence that names the place and a remedy
    """
    _keys(plain, KEYS["network"], "network")
    bodies = tuple(_list(plain, "bodies"))
    if not bodies or len(set(bodies)) < len(bodies) or not all(isinstance(b, str) for b in bodies):
        _refuse("bodies", f"given {list(bodies)}; allowed: names, each once, at least one")
    laws = {name: _law(entry, f"laws {name}") for name, entry in _mapping(plain, "laws").items()}
    bearings, first = _bearings(_list(plain, "bearings"), bodies, laws)
    springs = _springs(_list(plain, "springs"), bodies)
    parts = Network(
        bodies,
        bearings,
        springs,
        _stops(_list(plain, "stops"), bodies),
        _frictions(_list(plain, "frictions"), bodies),
    )
    rest = Load(np.zeros(len(bodies)), np.zeros(len(first)), np.zeros(len(springs.force)), first)
    return parts, rest, laws


def steps(plain: Plain, parts: Network, rest: Load, laws: Mapping[str, AxialLaw]) -> Iterator[Step]:
    """Yield the steps of the path, each from the end of the one before."""
    for k, entry in enumerate(_list(plain, "path"), start=1):
        end = _load(entry, f"step {k} of the path", parts, rest, laws)
        yield Step(parts, rest, end)
        rest = end


def _load(
    entry: Plain, at: str, parts: Network, before: Load, laws: Mapping[str, AxialLaw]
) -> Load:
    """Read the load at the end of a step; values that it does not name stay as ``before``."""
    _keys(entry, KEYS["path"], at)
    force, shift, gap = (values.copy() for values in (before.force, before.shift, before.gap))
    chosen = list(before.laws)
    for body, value in _mapping(entry, "force", at).items():
        k = parts.bodies.index(_known(body, parts.bodies, f"{at}, force", "body"))
        force[k] = _number(value, f"{at}, force on {body}", least=-LARGEST, most=LARGEST)
    places = {f"bearing {k}": (shift, k) for k in range(len(shift))}
    places |= {f"spring {k}": (gap, k) for k in range(len(gap))}
    for place, value in _mapping(entry, "shift", at).items():
        name = " ".join(map(str, place)) if isinstance(place, tuple) else place
        of, k = places[_known(name, places, f"{at}, shift", "place")]
        of[k] = _number(value, f"{at}, shift of {place}")
    numbers = {str(k): k for k in range(len(chosen))}
    for bearing, name in _mapping(entry, "law", at).items():
        k = numbers[_known(str(bearing), numbers, f"{at}, law", "bearing")]
        chosen[k] = laws[_known(name, laws, f"{at}, law of bearing {bearing}", "law")]
    return Load(force, shift, gap, tuple(chosen))


def _law(entry: Plain, at: str) -> AxialLaw:
    _keys(entry, " ".join(dict.fromkeys(" ".join(LAWS.values()).split())), at)
    kind = _known(entry.get("kind"), LAWS, at, "kind of law")
    _keys(entry, LAWS[kind], at)
    if kind == "table":
        return _table(entry, at)
    if kind != "rest_ball":
        p = _number(entry.get("p"), f"{at}, p", least=1.0) if kind == "power" else 1.0
        return Power(_number(entry.get("k"), f"{at}, k", above=0.0), p)
    distance = _number(entry.get("BD"), f"{at}, BD", above=0.0)
    angle = math.radians(_number(entry.get("alpha_deg"), f"{at}, alpha_deg", least=0.0, most=89.0))
    growth = _number(entry.get("growth", 0.0), f"{at}, growth")
    if abs(math.cos(angle) + growth / distance) >= 1.0:
        _refuse(f"{at}, growth", f"{growth:g} m reduces the contact angle to 0; allowed: less")
    balls = _count(entry.get("z"), f"{at}, z")
    return RestBall(
        balls, _number(entry.get("kn"), f"{at}, kn", above=0.0), distance, angle, growth
    )


def _table(entry: Plain, at: str) -> AxialLaw:
    d = [_number(value, f"{at}, d") for value in _list(entry, "d")]
    force = [_number(value, f"{at}, F", least=0.0) for value in _list(entry, "F")]
    between = _known(entry.get("interpolation", "linear"), ("linear", "cubic"), at, "interpolation")
    cubic = between == "cubic"
    least = 4 if cubic else 2
    if len(d) != len(force) or len(d) < least or any(np.diff(d) <= 0.0):
        _refuse(at, f"allowed: at least {least} deflections d that rise, and as many loads F")
    law = table(d, force, cubic=cubic)
    places = np.linspace(d[:-1], d[1:], BETWEEN, axis=-1).ravel()
    loads = [law(place)[0] for place in places.tolist()]
    fall = next((k for k, (a, b) in enumerate(pairwise(loads)) if b < a - ROUND), None)
    if fall is not None:
        _refuse(
            f"{at}, F",
            f"falls beyond {places[fall]:.4g} m; allowed: loads that do not fall, between points "
            "either (a cubic overshoots near sudden changes: give more points, or linear)",
        )
    return law


def _bearings(
    entries: Sequence[Plain], bodies: Sequence[str], laws: Mapping[str, AxialLaw]
) -> tuple[Bearings, tuple[AxialLaw, ...]]:
    row, side, count, rest, first = [], [], [], [], []
    for k, entry in enumerate(entries):
        at = f"bearing {k}"
        _keys(entry, KEYS["bearings"], at)
        row.append(_row(entry, ("inner", "outer"), bodies, at))
        side.append(_sign(entry, "s", at))
        count.append(_count(entry.get("n", 1), f"{at}, n"))
        given_law = entry.get("law")
        names = given_law if isinstance(given_law, list | tuple) and given_law else [given_law]
        candidates = [laws[_known(name, laws, at, "law")] for name in names]
        first.append(candidates[0])
        rest.append(_rest(entry, first[-1], at))
    bearings = Bearings(_rows(row, bodies), np.array(side), np.array(count), np.array(rest))
    return bearings, tuple(first)


def _rest(entry: Plain, law: AxialLaw, at: str) -> float:
    """Read the deflection of a bearing at rest [m], given or by its preload."""
    if entry.get("d0") is not None:
        return _number(entry["d0"], f"{at}, d0")
    if entry.get("preload") is None:
        _refuse(at, "missing key: its preload or its deflection d0 at rest")
    preload = _number(entry["preload"], f"{at}, preload", least=0.0)
    d0 = deflection(law, preload)
    if not math.isfinite(d0):
        _refuse(f"{at}, preload", f"its law does not reach {preload:g} N; give another preload")
    return d0


def _springs(entries: Sequence[Plain], bodies: Sequence[str]) -> Springs:
    row, force, stiffness = [], [], []
    for k, entry in enumerate(entries):
        at = f"spring {k}"
        _keys(entry, KEYS["springs"], at)
        row.append(_row(entry, ("body", "other"), bodies, at))
        force.append(_sign(entry, "e", at) * _number(entry.get("P", 0.0), f"{at}, P"))
        flag = entry.get("rigid", False)
        if not isinstance(flag, bool):
            _refuse(f"{at}, rigid", f"given {shown(flag)}; allowed: True and False")
        rigid = flag or entry.get("K") == math.inf
        if rigid and entry.get("K") not in (None, math.inf):
            _refuse(at, f"rigid beside K {entry['K']:g} N/m; leave one of them out")
        stiffness.append(math.inf if rigid else _number(entry.get("K"), f"{at}, K", least=0.0))
    return Springs(_rows(row, bodies), np.array(force), np.array(stiffness))


def _stops(entries: Sequence[Plain], bodies: Sequence[str]) -> Stops:
    row, side, limit = [], [], []
    for k, entry in enumerate(entries):
        at = f"stop {k}"
        _keys(entry, KEYS["stops"], at)
        ends = _row(entry, ("body", "other"), bodies, at)
        if entry.get("low") is None and entry.get("high") is None:
            _refuse(at, "missing key: low, high or both")
        for key, sign in (("low", 1.0), ("high", -1.0)):
            if entry.get(key) is not None:
                value = _number(entry[key], f"{at}, {key}")
                if sign * value > 0.0:
                    _refuse(
                        f"{at}, {key}",
                        f"violated at rest, where the position is 0: given {value:g} m; allowed: "
                        f"0 or {'below' if sign > 0.0 else 'above'}",
                    )
                row.append(ends)
                side.append(sign)
                limit.append(value)
    return Stops(_rows(row, bodies), np.array(side), np.array(limit))


def _frictions(entries: Sequence[Plain], bodies: Sequence[str]) -> Frictions:
    row, limit, start = [], [], []
    for k, entry in enumerate(entries):
        at = f"friction {k}"
        _keys(entry, KEYS["frictions"], at)
        row.append(_row(entry, ("body", "other"), bodies, at))
        limit.append(_number(entry.get("limit"), f"{at}, limit", least=0.0))
        start.append(
            _number(entry.get("start", 0.0), f"{at}, start", least=-limit[-1], most=limit[-1])
        )
    return Frictions(_rows(row, bodies), np.array(limit), np.array(start))


def _row(entry: Plain, ends: tuple[str, str], bodies: Sequence[str], at: str) -> Array:
    """Row of a joint of two bodies: +1 at the first, −1 at the second, none for the ground."""
    row = np.zeros(len(bodies))
    names = [entry.get(end) for end in ends]
    if names[0] == names[1]:
        _refuse(at, f"both its ends are {names[0]}; allowed: two bodies, or one and the ground")
    for name, sign in zip(names, (1.0, -1.0), strict=True):
        if name is not None:
            row[list(bodies).index(_known(name, bodies, at, "body"))] = sign
    return row


def _rows(row: Sequence[Array], bodies: Sequence[str]) -> Array:
    return np.array(row).reshape(-1, len(bodies))


def _sign(entry: Plain, key: str, at: str) -> float:
    value = _number(entry.get(key, 1), f"{at}, {key}")
    if abs(value) != 1.0:
        _refuse(f"{at}, {key}", f"given {value:g}; allowed: 1 and -1")
    return value


def _count(value: object, at: str) -> int:
    number = _number(value, at, least=1.0)
    if number % 1.0:
        _refuse(at, f"given {number:g}; allowed: a whole number")
    return int(number)


def _number(
    value: object,
    at: str,
    *,
    least: float = -math.inf,
    above: float = -math.inf,
    most: float = math.inf,
) -> float:
    """Read a finite number within limits; raise InvalidInput for another value."""
    try:
        counts = isinstance(value, Real) and not isinstance(value, bool)
        number = float(value) if counts else math.nan  # type: ignore[arg-type]
    except OverflowError:
        number = math.inf
    if math.isfinite(number) and least <= number <= most and number > above:
        return number
    limits = [f"at least {least:g}"] if least > -math.inf else []
    limits += [f"above {above:g}"] if above > -math.inf else []
    limits += [f"at most {most:g}"] if most < math.inf else []
    _refuse(at, f"given {shown(value)}; allowed: a finite number {' and '.join(limits)}".rstrip())


def _known(value: object, allowed: Mapping[str, Any] | Sequence[str], at: str, what: str) -> str:
    """Return a name that is ``allowed``; raise InvalidInput for another value."""
    if not isinstance(value, str) or value not in allowed:
        known = list(allowed)
        listed = ", ".join(known) or "none, there are none"
        hint = suggestion(value, known) if isinstance(value, str) else ""
        _refuse(at, f"unknown {what}: given {shown(value)}; allowed: {listed}{hint}")
    return value


def _keys(mapping: object, allowed: str, at: str) -> None:
    if not isinstance(mapping, Mapping):
        _refuse(at, f"given {shown(mapping)}; allowed: a mapping with the keys {allowed}")
    for key in mapping:
        _known(key, allowed.split(), at, "key")


def _list(plain: Plain, key: str) -> list[Any]:
    value = plain.get(key)
    if value is None:
        return []
    if not isinstance(value, list | tuple | np.ndarray):
        _refuse(key, f"given {shown(value)}; allowed: a list")
    return list(value)


def _mapping(plain: Plain, key: str, at: str = "") -> Mapping[Any, Any]:
    value = plain.get(key, {})
    if not isinstance(value, Mapping):
        _refuse(f"{at}, {key}".removeprefix(", "), f"given {shown(value)}; allowed: a mapping")
    return dict(value)


def _refuse(at: str, sentence: str) -> NoReturn:
    raise InvalidInput(f"{at}: {sentence}")
