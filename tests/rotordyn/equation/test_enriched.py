"""The finer model of a large body: its matrices hold those of the coarser one, and its vectors are
those of the coarser one and one step of inverse iteration."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.sparse import csr_array

from rotordyn.equation import component
from rotordyn.equation.component import Component
from rotordyn.equation.fineness import Fineness
from rotordyn.equation.mesh import build_mesh
from rotordyn.equation.reduce import enriched, reduce
from rotordyn.equation.structure import Structure
from rotordyn.machine.shaft import Section
from rotordyn.machine.spindle import Spindle
from tests.oracles.rotors import STEEL, STEPPED, support
from tests.oracles.stepped_rotors import jointed, stepped_rotor
from tests.rotordyn.equation.test_reduce import free_chain

HELD = replace(STEPPED, supports=(support("a", 0.0, (2e8, 2e8)), support("b", 0.2, (2e8, 2e8))))
CONE = replace(
    HELD, shaft=replace(HELD.shaft, sections=(Section(0.32, 0.06, 0.02, STEEL, "", 0.04, 0.01),))
)
THIN = replace(HELD, shaft=replace(HELD.shaft, shear_coefficient="none"))


def both(spindle: Spindle, accuracy: float) -> list[tuple[Component, Component]]:
    """Components of a model and of a finer one."""
    make = partial(Structure, spindle, build_mesh(spindle))
    fine = Fineness(3000.0, 500.0, accuracy)
    coarse = make(fine)
    finer = make(replace(fine, finer=1), coarse=coarse)
    return list(zip(coarse.components, finer.components, strict=True))


@pytest.mark.parametrize("accuracy", [1e-2, 1e-4, 1e-8])
@pytest.mark.parametrize("spindle", [HELD, THIN], ids=["sheared", "rigid in shear"])
def test_nested_dof_have_the_matrices_of_the_coarser_model(
    spindle: Spindle, accuracy: float
) -> None:
    draw = np.random.default_rng(7)
    for coarse, finer in both(jointed(draw, spindle), accuracy):
        assert finer.coarse is not None
        _, own, there = finer.coarse
        assert sorted(there) == coarse.dofs.tolist()
        assert len(set(own)) == len(own) < len(finer.dofs)
        for name in ("mass", "stiffness", "softening", "damping"):
            fine = finer.assembled(name)[np.ix_(finer.local(own), finer.local(own))]
            known = coarse.assembled(name)[np.ix_(coarse.local(there), coarse.local(there))]
            np.testing.assert_allclose(fine, known, rtol=1e-10, atol=1e-12 * np.abs(known).max())


def test_nested_dof_of_cones() -> None:
    """Quadrature of another degree has other last digits."""
    for coarse, finer in both(CONE, 1e-4):
        assert finer.coarse is not None
        own, there = finer.local(finer.coarse.here), coarse.local(finer.coarse.there)
        fine, known = finer.assembled("mass"), coarse.assembled("mass")
        np.testing.assert_allclose(
            fine[np.ix_(own, own)], known[np.ix_(there, there)], rtol=1e-6, atol=1e-9 * known.max()
        )


@pytest.mark.parametrize("seed", range(5))
def test_errors_are_squared(seed: int) -> None:
    """Vectors that are a little wrong give values that err by the square of theirs."""
    mass, stiffness = (csr_array(each) for each in free_chain(seed, 400))
    rigid = np.ones((400, 1))
    exact, modes = eigh(stiffness.toarray(), mass.toarray())
    mixed = np.random.default_rng(seed).normal(size=(20, 5))
    wrong = modes[:, 1:6] + 1e-3 * modes[:, 40:60] @ mixed
    kept = [(w @ stiffness @ w) / (w @ mass @ w) for w in wrong.T]
    before = np.abs(np.array(kept) / exact[1:6] - 1.0)
    found = enriched(mass, stiffness, rigid, wrong)
    after = np.abs(found.values[1:6] / exact[1:6] - 1.0)
    assert (before > 1e-5).all()
    assert (after <= before**2 + 1e-12).all()
    assert found.vectors.T @ mass @ found.vectors == pytest.approx(np.eye(11), abs=1e-9)
    assert found.vectors.T @ stiffness @ found.vectors == pytest.approx(
        np.diag(found.values), abs=1e-9 * found.values.max()
    )


def test_no_more_vectors_than_the_body_has_motions() -> None:
    """All motions are known but one, and the steps from each, which links far stiffer than the
    others make uncertain, seem new."""
    size, links = 40, np.ones(39)
    links[3::3] = 1e8
    stiffness = np.diag(np.r_[links, 0.0] + np.r_[0.0, links])
    stiffness -= np.diag(links, 1) + np.diag(links, -1)
    exact, modes = eigh(stiffness)
    found = enriched(
        csr_array(np.eye(size)), csr_array(stiffness), np.ones((size, 1)), modes[:, 1:]
    )
    assert len(found.values) == size
    assert found.values[1:12] == pytest.approx(exact[1:12], rel=1e-5)


def test_what_the_coarser_model_knows_already_is_not_added() -> None:
    mass, stiffness = (csr_array(each) for each in free_chain(3, 400))
    rigid = np.ones((400, 1))
    coarse = reduce(mass, stiffness, rigid, np.eye(400)[:, :0], 0.05)
    found = enriched(mass, stiffness, rigid, coarse.vectors[:, 1:])
    assert found.values[: len(coarse.values)] == pytest.approx(coarse.values, rel=1e-8, abs=1e-12)


def test_values_are_those_of_the_whole_reduction(monkeypatch: pytest.MonkeyPatch) -> None:
    """What a body changes by as it is refined is the same either way."""
    band, compared = Fineness(3000.0).band, 0
    for seed in range(8):
        spindle = stepped_rotor(np.random.default_rng(seed))
        ways = []
        for large in (10**9, 1):
            monkeypatch.setattr(component, "LARGE", large)
            pairs = both(spindle, 1e-3)
            below = [(coarse, int((coarse.values < band**2).sum())) for coarse, _ in pairs]
            ways.append([finer.values for _, finer in pairs])
        for usual, other, (coarse, many) in zip(*ways, below, strict=True):
            change, likewise = (np.abs(own[:many] - coarse.values[:many]) for own in (usual, other))
            told = change > 1e-9 * coarse.values[:many]
            assert likewise[told] == pytest.approx(change[told], rel=0.3)
            compared += int(told.sum())
    assert compared > 20
