"""State of a solved bearing: its data, and quantities that follow from them without solving."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from bearings.arrays import Array, Flags, Index, Words
from bearings.ball.kinematics import Angles, inner_share, orbit_and_spin, tan_beta
from bearings.ball.law import Law, check_name
from bearings.errors import InvalidBearing
from bearings.ring.assembly import alike, full_assembly
from bearings.ring.operation import Operation

RATIO_ROUNDING = 1e-15  # below which a ratio is rounding
DRIVEN = 0.05  # least load of a driven ball over the largest ball load of the bearing


@dataclass(frozen=True, eq=False)
class BearingState:
    """Physical state of a bearing, or a batch of states with leading shape (…).

    ``load`` (…, 5) [N, N·m], ``displacement`` (…, 5) [m, rad], ``speed`` (…) [rad/s] without its
    sign. ``residual`` (…): largest imbalance of a ball over the largest ball load, or of the ring
    over its load. ``complete_stiffness`` (…, 5, 5).

    By contact (…, balls, contacts), in the order of the bearing's ``contact_names``:
    ``contact_load`` [N], ``contact_angle`` [rad] (NaN without load; where contacts are i and o
    negative on the side away from thrust), ``contact_pressure`` [Pa].

    By ball (…, balls): ``inner_load``, ``outer_load`` [N]: resultants of the races;
    ``inner_angle``, ``outer_angle`` [rad]: their directions; ``inner_pressure``,
    ``outer_pressure`` [Pa]: largest of each race; ``centrifugal_force`` [N],
    ``gyroscopic_moment`` [N·m]; ``inner_required_friction``, ``outer_required_friction``:
    friction coefficient that each race needs to carry its share of the gyroscopic moment;
    ``status``: ``"loaded"``, ``"open side"`` (loaded against the side without a shoulder, or in the
    middle of the groove), ``"lost contact"`` (rides the outer race), ``"unloaded"`` (at rest).

    ``outcome`` (…): ``""`` where the state exists; where it does not, all numbers are NaN.
    ``ball_centre`` (2, …, balls), with the shifts of grooves behind where rings deform: a start
    for neighbouring states; ``operation``: the operating points.
    """

    operation: Operation

    load: Array
    displacement: Array
    speed: Array
    residual: Array
    complete_stiffness: Array
    contact_load: Array
    contact_angle: Array
    contact_pressure: Array
    inner_load: Array
    outer_load: Array
    inner_angle: Array
    outer_angle: Array
    inner_pressure: Array
    outer_pressure: Array
    centrifugal_force: Array
    gyroscopic_moment: Array
    inner_required_friction: Array
    outer_required_friction: Array
    status: Words
    outcome: Words
    ball_centre: Array

    def rows(self, index: Index | tuple[Index, ...]) -> BearingState:
        """Select places of the batch by indices of its first axis, or of its axes as in numpy."""
        names = [field.name for field in fields(self)[1:-1]]
        return BearingState(
            self.operation.rows(index),
            ball_centre=np.moveaxis(np.moveaxis(self.ball_centre, 0, -1)[index], -1, 0),
            **{name: getattr(self, name)[index] for name in names},
        )

    def stiffness(self, method: str = "complete") -> Array:
        """Tangent K = ∂load/∂displacement, shape (…, 5, 5) [N/m, N/rad, N·m/rad].

        ``"complete"`` contains the variation of Fc and Mg; it is not symmetric at speed.
        ``"frozen"`` keeps Fc and Mg as they are (Cao & Altintas, J. Mech. Des. 126 (2004) 1089); at
        rest, and with the ``dynamics`` of that name, it is the complete one. A third method,
        ``"difference"``, solves the bearing anew: ``bearings.stiffness``.

        Raises
        ------
        InvalidBearing : an unknown method
        """
        check_name("stiffness method", method, ("complete", "frozen", "difference"))
        if method == "complete":
            return self.complete_stiffness
        if method == "difference":
            raise InvalidBearing(
                "differences need new solutions of the bearing: use bearings.stiffness(state, "
                "'difference')"
            )
        exists = self.outcome.reshape(-1) == ""
        if not exists.any() or self.operation.law.dynamics == "frozen":
            return self.complete_stiffness
        from bearings.ring.linearised import frozen_tangents  # the balance of balls, rarely needed

        displacements, balls = (
            self.displacement.reshape(-1, 5),
            self.ball_centre.reshape(len(self.ball_centre), exists.size, -1),
        )
        stiffness = self.complete_stiffness.reshape(-1, 5, 5).copy()
        for index, tangent in frozen_tangents(self.operation, displacements, balls, exists):
            stiffness[index] = tangent
        return alike(self.load, self.displacement, stiffness.reshape(*self.outcome.shape, 5, 5))

    @property
    def _law(self) -> Law:
        law = self.operation.law
        assert isinstance(law, Law)  # ``rows`` takes states of several laws apart
        return law

    @property
    def contacts(self) -> NDArray[np.int_]:
        """Number of loaded contacts of each ball (…, balls)."""
        return np.asarray((self.contact_load > 0.0).sum(axis=-1))

    @property
    def driven(self) -> Flags:
        """Balls that the inner race drives (…, balls): those of less than ``DRIVEN`` of the largest
        load are dragged along by the cage, whatever their friction."""
        load = np.asarray(self.inner_load)
        return np.asarray(load > DRIVEN * load.max(axis=-1, keepdims=True, initial=0.0))

    @property
    def slipping(self) -> Words:
        """Which race of each ball slips under the given friction (…, balls): ``""`` for none."""
        friction = self.operation.law.friction
        most = math.inf if friction is None else friction * (1.0 - 1e-9)
        inner, outer = self.inner_required_friction >= most, self.outer_required_friction >= most
        return np.select([inner & outer, inner, outer], ["both", "inner", "outer"], "")

    @property
    def race_weight(self) -> Array:
        """C = Qi ai Ei/(Qo ao Eo) of the spin friction moments (…, balls); 0 on a free race."""
        g = self.operation.geometry
        outer = np.where(self.outer_load > 0.0, self.outer_load, np.inf)
        deep = (self.inner_load / g.inner.stiffness) / (outer / g.outer.stiffness)
        return np.asarray(g.race_ratio * deep ** (4.0 / 3.0))

    @property
    def control_margins(self) -> tuple[Array, Array]:
        """C cos(αi − αo) − 1 and cos(αi − αo) − C of each ball, inner and outer race (…, balls).

        Jones (1959): a race controls where its friction moment, turned onto the normal of the other
        race, is the larger one, that is where its margin is positive.
        """
        weight, cosine = self.race_weight, np.cos(self.inner_angle - self.outer_angle)
        return weight * cosine - 1.0, cosine - weight

    @cached_property
    def control(self) -> Words:
        """The race that controls each ball after Jones' criterion (…, balls).

        ``"inner"``, ``"outer"``, ``"neither"``, or ``""`` for a ball that the inner race does not
        load, or that has more than two contacts, one of which slides.
        """
        inner, outer = self.control_margins
        word = np.where(inner > 0.0, "inner", np.where(outer > 0.0, "outer", "neither"))
        return np.where((self.inner_load > 0.0) & (self.contacts == 2), word, "")

    @property
    def control_agrees(self) -> Flags:
        """False where the kinematics assumes control by a race that does not have it (…, balls).

        Only "outer" and "inner" assume control by a race; only balls with one loaded contact a
        race are compared.
        """
        assumed = self._law.kinematics
        agrees = (self.control == assumed) | (self.control == "")
        return agrees | (assumed not in ("inner", "outer"))

    @property
    def inner_spin_to_roll(self) -> Array:
        """Spin over rolling of each ball on the inner race (…, balls); 0 without inner load."""
        return self._spin_to_roll[0]

    @property
    def outer_spin_to_roll(self) -> Array:
        """Spin over rolling of each ball on the outer race (…, balls); 0 without inner load."""
        return self._spin_to_roll[1]

    @cached_property
    def _spin_to_roll(self) -> tuple[Array, Array]:
        """Component of the ball's rotation against a race along the contact line (sin α, cos α)
        over that along the tangent (cos α, −sin α), axial and radial parts. Without gross slip
        (1 − γ cos αi) tan(αi − β) + γ sin αi and (1 + γ cos αo) tan(αo − β) − γ sin αo (Harris). It
        does not depend on speed: at rest it is the limit of slow rotation.
        """
        (si, ci, so, co, g, _), t = self.angles, self.tan_beta
        inner = (1.0 - g * ci) * (si - ci * t) / (ci + si * t) + g * si
        outer = (1.0 + g * co) * (so - co * t) / (co + so * t) - g * so
        return self._without_rounding(inner), self._without_rounding(outer)

    @property
    def angles(self) -> Angles:
        """Sines and cosines of the angles of the resultants, γ and the race weight."""
        si, ci = np.sin(self.inner_angle), np.cos(self.inner_angle)
        so, co = np.sin(self.outer_angle), np.cos(self.outer_angle)
        return Angles(si, ci, so, co, self.operation.geometry.size_ratio, self.race_weight)

    @cached_property
    def tan_beta(self) -> Array:
        """tan β of each ball's axis of rotation (…, balls) by the hypothesis, reduced where a race
        slips."""
        law, g, angles = self._law, self.operation.geometry, self.angles
        ideal = np.asarray(tan_beta(law.numbers.kinematics, angles).value)
        if law.friction is None:
            return ideal
        inertia = g.ball_inertia * self.speed[..., None] ** 2
        moment = inertia * orbit_and_spin(angles, ideal)[1].value
        slips = self.slipping != ""
        return np.where(slips, self.gyroscopic_moment / np.where(slips, moment, 1.0), 1.0) * ideal

    def _without_rounding(self, ratio: Array) -> Array:
        """Set a ratio to 0 where it is rounding, and for balls without inner load."""
        significant = (self.inner_load > 0.0) & (np.abs(ratio) > RATIO_ROUNDING)
        return np.where(significant | np.isnan(self.inner_load), ratio, 0.0)

    @cached_property
    def outer_ring_load(self) -> Array:
        """Load (Fx, Fy, Fz, My, Mz) of the balls on the outer ring (…, 5) [N, N·m].

        Fx is that of ``load``; Fy and Fz are greater by the centrifugal forces. The moments are
        about the centre of the circle of *outer* groove middles, for which the axial place of the
        inner ones gives arms: per ball axial force fa, radial force fr (contacts, and friction
        λo Mg/D across their resultant) give Ro fa − x̄ fr + λo fo Mg, x̄ the axial place where the
        resultant acts (0 with one groove), Ro the radius of the circle of outer groove centres.
        """
        g, law = self.operation.geometry, self._law
        share = 2.0 - inner_share(law.numbers.sharing, self.race_weight)[0]
        moment = share * self.gyroscopic_moment
        along, across = self.outer_load, moment / g.ball_diameter
        sin, cos = np.sin(self.outer_angle), np.cos(self.outer_angle)
        axial, radial = along * sin + across * cos, along * cos - across * sin
        tilting = -g.outer_conformity * moment + self._outer_middle() * radial
        action = (axial, radial, tilting)
        flat = (part.reshape(-1, g.balls) for part in action)
        return full_assembly(g, outer=True).load((*flat,)).reshape(*self.outcome.shape, 5)

    def _outer_middle(self) -> Array | float:
        """x̄ = Σ x Q cos α / Σ Q cos α of the outer contacts (…, balls) [m]."""
        grooves = self.operation.geometry.outer_grooves
        if len(grooves) == 1:
            return 0.0
        load = self.contact_load[..., -2:] * np.cos(np.nan_to_num(self.contact_angle[..., -2:]))
        total = load.sum(axis=-1)
        return (load @ np.array([x.offset for x in grooves])) / np.where(total != 0.0, total, 1.0)
