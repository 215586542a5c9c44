"""Whirl of an exact rotor in decimal arithmetic, where rounding plays no part."""

from __future__ import annotations

from decimal import Decimal, localcontext

from tests.oracles.exact_shaft.rotor import ExactRotor

DIGITS = 60
Column = list[Decimal]


def determinant(rotor: ExactRotor, omega: float) -> Decimal:
    """Of force and moment at the right end, for unit deflection and unit tilt at the left one.

    Zero at a whirl frequency [rad/s], negative of backward whirl. One plane, no sleeves, no axial
    force. The state (r, φ, Q, M) of each piece is summed up as the power series of e^{A h}.
    """
    with localcontext() as context:
        context.prec = DIGITS
        w, zero, one = Decimal(omega), Decimal(0), Decimal(1)
        columns = [[one, zero, zero, zero], [zero, one, zero, zero]]
        for node in range(len(rotor.x)):
            columns = [_past_node(rotor, node, w, column) for column in columns]
            if node < len(rotor.x) - 1:
                columns = [_along(rotor, node, w, column) for column in columns]
        (*_, a, b), (*_, c, d) = columns
        return a * d - b * c


def _past_node(rotor: ExactRotor, node: int, w: Decimal, state: Column) -> Column:
    terms, spin = rotor.terms, Decimal(rotor.spin)
    forces = []
    for i in (0, 1):
        total = state[2 + i]
        for j in (0, 1):
            k, p, m = (
                Decimal(float(matrix[node, i, j].real))
                for matrix in (terms.stiffness, terms.polar, terms.mass)
            )
            total += (k + w * spin * p - w * w * m) * state[j]
        forces.append(total)
    return [*state[:2], *forces]


def _along(rotor: ExactRotor, piece: int, w: Decimal, state: Column) -> Column:
    own, spin = rotor.segments, Decimal(rotor.spin)
    h, shear, bending, mass, rotary = (
        Decimal(float(values[piece]))
        for values in (own.length, own.shear, own.bending, own.line_mass, own.rotary)
    )
    total, term, n = list(state), list(state), 0
    while n < 8 or any(abs(t) > abs(v).scaleb(-DIGITS) for t, v in zip(term, total, strict=True)):
        n += 1
        r, phi, q, m = term
        slope = [
            phi + q / shear,
            m / bending,
            -mass * w * w * r,
            -q - rotary * (w * w - 2 * spin * w) * phi,
        ]
        term = [s * h / n for s in slope]
        total = [v + t for v, t in zip(total, term, strict=True)]
    return total
