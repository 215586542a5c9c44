"""Rendering in a process of its own: pictures that show the motion, and machines without OpenGL."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from rotordyn.view import apart
from rotordyn.view.apart import NoPictures, Rendering
from rotordyn.view.order import Order
from tests.rotordyn.figures import samples

FRAMES = 3
COLOURS = {"forward": (0x00, 0x72, 0xB2), "backward": (0xD5, 0x5E, 0x00)}


def order(modes: list[int], frames: int = 0) -> Order:
    """Some modes of the sample at its top speed; those of speed zero are lost."""
    found = samples.campbell(3)
    shape = found.shape[:, modes].copy()
    shape[0] = np.nan
    return Order(samples.spindle(), found.node, found.node_rotor, shape, 0.06, frames)


@pytest.fixture(scope="module")
def rendering() -> Iterator[Rendering]:
    with Rendering([order([1], FRAMES), order([0, 9])]) as rendered:
        try:
            rendered.finish()
        except NoPictures as none:
            pytest.skip(str(none))
        yield rendered


@pytest.mark.long
def test_pictures_of_every_order(rendering: Rendering) -> None:
    stills = [rendering.still(0, 1, 0), rendering.still(1, 1, 0), rendering.still(1, 1, 1)]
    for picture in stills:
        assert picture.dtype == np.uint8
        assert picture.shape == stills[0].shape
        assert picture.shape[1] == 1200
        share = (picture != 255).any(axis=2).mean()
        assert 0.15 < share < 0.8, "the rotor fills the picture, and does not overflow it"
        border = np.concatenate([picture[0], picture[-1], picture[:, 0], picture[:, -1]])
        assert (border == 255).all()
    with pytest.raises(FileNotFoundError):
        rendering.still(0, 0, 0)


@pytest.mark.parametrize(
    ("place", "there", "absent"),
    [((0, 1, 0), ["forward"], ["backward"]), ((1, 1, 0), ["backward"], ["forward"]),
     ((1, 1, 1), [], ["forward", "backward"])],
    ids=["forward", "backward", "torsion"],
)  # fmt: skip
def test_orbits_have_the_colour_of_their_whirl(
    rendering: Rendering, place: tuple[int, int, int], there: list[str], absent: list[str]
) -> None:
    picture = rendering.still(*place)
    count = {name: (picture == colour).all(axis=2).sum() for name, colour in COLOURS.items()}
    assert all(count[name] > 300 for name in there)
    assert all(count[name] == 0 for name in absent)


def test_frames_of_a_period_move(rendering: Rendering) -> None:
    frames = rendering.moving(0, 1, 0).astype(int)
    assert frames.shape[0] == FRAMES
    assert frames.shape[2] == 640
    for one in range(FRAMES):
        other = frames[(one + 1) % FRAMES]
        assert np.abs(frames[one] - other).mean() > 0.5


@pytest.mark.parametrize(
    ("program", "why"),
    [
        (("-c", "import os, signal; os.kill(os.getpid(), signal.SIGSEGV)"), r"\(OpenGL .*SIGSEGV"),
        (("-c", "raise ImportError('libGL.so.1: cannot open')"), r"libGL\.so\.1: cannot open"),
        (("-c", "raise SystemExit(3)"), "exit code 3"),
    ],
    ids=["crash", "library", "exit"],
)
def test_a_machine_without_opengl_gets_a_sentence(
    monkeypatch: pytest.MonkeyPatch, program: tuple[str, ...], why: str
) -> None:
    monkeypatch.setattr(apart, "PROGRAM", program)
    with Rendering([order([0])]) as rendered, pytest.raises(NoPictures, match=why) as caught:
        rendered.finish()
    assert "libegl1" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_rendering_that_hangs_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(apart, "PROGRAM", ("-c", "import time; time.sleep(60)"))
    monkeypatch.setattr(apart, "LONGEST", 0.2)
    monkeypatch.setattr(apart, "LONGEST_EACH", 0.0)
    with Rendering([order([0])]) as rendered:
        with pytest.raises(NoPictures, match="more than 0 s"):
            rendered.finish()
        assert not rendered.running


def test_leaving_early_ends_the_process_and_its_files(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(apart, "PROGRAM", ("-c", "import time; time.sleep(60)"))
    with Rendering([order([0])]) as rendered:
        assert rendered.running
    assert not rendered.running
    assert not rendered.folder.exists()


@pytest.mark.parametrize(("module", "package"), [("pyvista", "pyvista"), ("vtkmodules", "vtk")])
def test_a_package_that_is_missing_is_named_and_not_mesa(
    monkeypatch: pytest.MonkeyPatch, module: str, package: str
) -> None:
    blocked = f"""
import runpy, sys
class Blocked:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] == {module!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)
sys.meta_path.insert(0, Blocked())
runpy.run_module("rotordyn.view", run_name="__main__", alter_sys=True)
"""
    monkeypatch.setattr(apart, "PROGRAM", ("-c", blocked))
    with Rendering([order([0])]) as rendered, pytest.raises(NoPictures) as caught:
        rendered.finish()
    said = f"the package {package} is not installed: python -m pip install {package}"
    assert str(caught.value) == said
