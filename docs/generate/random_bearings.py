"""Results of random bearings (``python -m benchmarks.random_bearings``) as tables."""

from __future__ import annotations

from typing import Any

from docs.generate.marked import table

Found = dict[str, Any]
LAWS = ("hybrid", "outer", "inner", "geometric")
STATUSES = {  # words of the table -> status of a ball
    "loaded": "loaded",
    "loaded on the side without a shoulder": "open side",
    "lost contact": "lost contact",
    "unloaded": "unloaded",
}


def random_bearings(found: Found) -> str:
    """Outcomes, residuals and tangents of single balls and of bearings."""
    balls, rings = found["balls"], found["bearings"]
    both = ((balls, "residual", "beyond 90°"), (rings, "ball residual", "with a ball beyond 90°"))
    rows = [
        ("states", *(_count(f["states"]) for f, _, _ in both)),
        ("solved", *(_share(f, "solved") for f, _, _ in both)),
        *(
            (f"no equilibrium, {law}", *(_share(f, f"no equilibrium, {law}") for f, _, _ in both))
            for law in LAWS
        ),
        ("no contact angle", "–", _share(rings, "no contact angle")),
        *(
            (f"balls: {name}", *(_status(f, status) for f, _, _ in both))
            for name, status in STATUSES.items()
        ),
        ("solved below 5 GPa", *(_share(f, "below 5 GPa", "solved") for f, _, _ in both)),
        ("a contact beyond 90°", *(_share(f, wide, "solved") for f, _, wide in both)),
        ("non-finite numbers", *(str(f["not finite"]) for f, _, _ in both)),
        ("contacts in tension", *(str(f["tensile"]) for f, _, _ in both)),
        (
            "largest residual of a ball",
            f"{balls['worst']['force']:.0e}",
            f"{rings['worst']['ball']:.0e}",
        ),
        ("largest residual of the ring", "–", f"{rings['worst']['ring']:.0e}"),
        (
            "residuals above 10⁻⁹",
            str(balls["residual above 1e-9"]),
            str(rings["ball residual above 1e-9"] + rings["ring residual above 1e-9"]),
        ),
        ("largest gap of the geometry", *(f"{f['worst']['gap']:.0e}" for f in (balls, rings))),
        ("gaps above 10⁻¹²", *(str(f["not closed"]) for f in (balls, rings))),
        ("K against finite differences: states", "–", _count(rings["tangents"])),
        (
            "of these decided in extended precision",
            "–",
            str(rings["tangents decided in extended precision"]),
        ),
        ("K with an error above 10⁻⁶", "–", str(rings["tangents off by more than 1e-6"])),
        ("K against finite differences: largest error", "–", f"{rings['worst']['tangent']:.0e}"),
        ("K at rest: states", "–", _count(rings["at rest"])),
        ("K at rest: asymmetry", "–", f"{rings['worst']['asymmetry at rest']:.0e}"),
        ("time per state [µs]", f"{balls['microseconds']:.0f}", _times(rings["microseconds"])),
    ]
    return table(("quantity", "single balls:", "bearings:"), rows)


def random_paths(found: Found) -> str:
    """Followed paths, starts and sweeps."""
    rows = []
    for name, key in (("single balls", "ball_paths"), ("bearings", "bearing_paths")):
        f = found[key]
        ends = [f"{f.get(f'refused: {end}', 0)} {end}" for end in ("fold", "jump", "lifted")]
        rows += [
            (f"{name} refused: no path ({', '.join(ends)})", *_agreed(f, "refused")),
            (f"{name} solved: the path arrives there", *_agreed(f, "solved")),
        ]
    ends = found["endings"]
    rows += [
        (
            "bearings refused: a state at every speed up to the reported one",
            str(ends["refusals"]),
            str(ends["states at all speeds below"]),
        ),
        (
            "bearings refused with further states above that speed: these are reported",
            str(ends["states again above"]),
            str(ends["states again above, reported"]),
        ),
    ]
    starts, sweeps, held = found["starts"], found["sweeps"], found["friction_sweeps"]
    rows += [
        (
            "same state from the state of another load and speed",
            str(starts["states"]),
            str(starts["states"] - starts.get("differing", 0)),
        ),
        (
            "sweeps of load or speed without a jump",
            str(sweeps["sweeps"]),
            str(sweeps["sweeps"] - sweeps["with a jump"]),
        ),
        (
            f"as above, with friction up to {found['friction']['friction']:g}",
            str(held["sweeps"]),
            str(held["sweeps"] - held["with a jump"]),
        ),
    ]
    return table(("check", "cases:", "confirmed:"), rows)


def random_kinds(found: Found) -> str:
    """Random states of every kind."""
    rows = []
    for kind, f in found.items():
        wrong = ("not finite", "tensile", "residual above 1e-9", "changed by another start")
        rows.append(
            (
                kind,
                str(f["states"]),
                str(f["no equilibrium"]),
                *(str(f[word]) for word in wrong),
                f"{max(f['worst'][k] for k in ('ball', 'ring')):.0e}",
            )
        )
    head = ("kind", "states:", "refused:", "not finite:", "in tension:", "residual above 1e-9:")
    return table((*head, "changed by another start:", "largest residual:"), rows)


def random_friction(found: Found) -> str:
    """Refusals with any friction and with a limited one."""
    f = found["friction"]
    rows = []
    for law in LAWS:
        for name, key in (("all sharings", law), ("`equal`, `inner`", f"{law}, share that fades")):
            total = f[f"states, {key}"]
            shares = (
                f"{100.0 * f.get(f'{word}, {key}', 0) / total:.3g} %" for word in ("any", "limited")
            )
            rows.append((law, name, _count(total), *shares))
    head = ("kinematics", "sharings", "states:", "refused, any friction:")
    return table((*head, f"refused, μ ≤ {f['friction']:g}:"), rows)


def plain_newton(balls: Found) -> str:
    """Results of the usual iteration on four unknowns."""
    names = ("physical", "tensile", "other", "failed")
    rows = [
        (
            f"{sign} contacts",
            _count(f["compared"]),
            *(f"{100.0 * f.get(n, 0) / f['compared']:.1f} %" for n in names),
            f"{100.0 * f['physical, held'] / f['compared, held']:.1f} %",
            f"{f['microseconds']:.0f}",
        )
        for sign, f in balls["plain"].items()
    ]
    head = ("plain Newton", "balls:", "physical:", "tensile root:", "other root:", "failed:")
    return table((*head, "physical, of held balls:", "µs per ball:"), rows)


def _count(number: int) -> str:
    return f"{number:,}".replace(",", " ")


def _share(found: Found, key: str, of: str = "states") -> str:
    return f"{100.0 * found.get(key, 0) / found[of]:.3g} %"


def _status(found: Found, name: str) -> str:
    total = sum(value for key, value in found.items() if key.startswith("ball: "))
    return f"{100.0 * found.get(f'ball: {name}', 0) / total:.3g} %"


def _times(times: Found) -> str:
    return ", ".join(f"{name} {value:.0f}" for name, value in times.items())


def _agreed(found: Found, group: str) -> tuple[str, str]:
    return str(found[group]), str(found[f"{group}, agreed"])
