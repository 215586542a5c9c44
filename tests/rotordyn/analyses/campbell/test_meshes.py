"""Mode shapes in the formats of other programs, read back by other readers than ours."""

from __future__ import annotations

import json
import struct
from pathlib import Path

import meshio
import numpy as np
import pytest

from rotordyn.analyses.campbell.gltf import KEYS, SECONDS
from rotordyn.analyses.campbell.meshes import (
    INSTANTS,
    MovingSurface,
    moving_surfaces,
    write_shape,
    write_shapes,
)
from rotordyn.analyses.campbell.spec import MESH_FILES, ShapesInSpaceSpec
from rotordyn.errors import InvalidInput
from rotordyn.surface.motion import at_phase, reach
from tests.rotordyn.figures import samples

AMPLITUDE = 0.05
LENGTH = 0.5282  # of the sample's shaft [m]


@pytest.fixture(scope="module")
def moving() -> MovingSurface:
    """The first forward bending mode of the sample at its top speed."""
    found = moving_surfaces(samples.spindle(), samples.campbell(3), AMPLITUDE)
    return next(one for one in found if one.name == "1_fw_24000rpm")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory, moving: MovingSurface) -> Path:
    path = tmp_path_factory.mktemp("meshes")
    for extension in MESH_FILES:
        write_shape(path / f"mode.{extension}", moving)
    return path


def test_scale_is_the_share_of_the_length_requested(moving: MovingSurface) -> None:
    assert moving.scale * reach(moving.shape).max() == pytest.approx(AMPLITUDE * LENGTH)


@pytest.mark.parametrize("extension", ["vtu", "vtk"])
def test_complex_displacement_comes_back_exactly(
    folder: Path, moving: MovingSurface, extension: str
) -> None:
    import pyvista

    path = folder / f"mode.{extension}"
    mesh, seen = meshio.read(path), pyvista.read(path)
    assert np.array_equal(seen.cell_data["body"], moving.surface.body)
    assert np.array_equal(mesh.points, moving.surface.points)
    assert np.array_equal(mesh.cells[0].data, moving.surface.triangles)
    assert np.array_equal(mesh.cell_data["body"][0], moving.surface.body)
    for data in (mesh.point_data, seen.point_data):
        both = np.asarray(data["displacement_re"]) + 1j * np.asarray(data["displacement_im"])
        assert np.array_equal(both, moving.shape)
        np.testing.assert_allclose(data["drawn"], moving.scale * moving.shape.real, rtol=1e-15)
        assert np.asarray(data["share"]).max() == 1.0


def test_series_holds_one_period_instant_by_instant(
    folder: Path, moving: MovingSurface, monkeypatch: pytest.MonkeyPatch
) -> None:
    import pyvista

    reader = pyvista.get_reader(folder / "mode.xdmf")
    assert reader.time_values == pytest.approx(np.arange(INSTANTS) / INSTANTS)
    monkeypatch.chdir(folder)
    with meshio.xdmf.TimeSeriesReader("mode.xdmf") as series:
        points, _ = series.read_points_cells()
        assert np.array_equal(points, moving.surface.points)
        for step in (0, 5, 17):
            instant, data, _ = series.read_data(step)
            drawn = moving.scale * at_phase(moving.shape, 2.0 * np.pi * instant)
            np.testing.assert_allclose(data["displacement"], drawn, rtol=0.0, atol=1e-15)


@pytest.mark.parametrize("extension", ["stl", "ply", "obj", "off"])
def test_deformed_surface_has_the_same_triangles(
    folder: Path, moving: MovingSurface, extension: str
) -> None:
    mesh = meshio.read(folder / f"mode.{extension}")
    (cells,) = mesh.cells
    corners = moving.deformed[moving.surface.triangles]
    np.testing.assert_allclose(mesh.points[cells.data], corners, rtol=0.0, atol=1e-7)


def glb(path: Path) -> tuple[dict, bytes]:
    """The two chunks of a file."""
    content = path.read_bytes()
    magic, version, length, size, kind = struct.unpack_from("<4sIII4s", content)
    assert (magic, version, length, kind) == (b"glTF", 2, len(content), b"JSON")
    rest = 20 + size
    binary, name = struct.unpack_from("<I4s", content, rest)
    assert (name, rest + 8 + binary) == (b"BIN\0", length)
    return json.loads(content[20:rest]), content[rest + 8 :]


def values(scene: dict, content: bytes, number: int) -> np.ndarray:
    accessor = scene["accessors"][number]
    view = scene["bufferViews"][accessor["bufferView"]]
    kind = {5126: "<f4", 5125: "<u4", 5121: "u1"}[accessor["componentType"]]
    width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor["type"]]
    assert view["byteOffset"] % 4 == 0
    flat = np.frombuffer(content, kind, accessor["count"] * width, view["byteOffset"])
    return flat.reshape(-1, width)


def test_glb_says_what_its_bytes_hold(folder: Path, moving: MovingSurface) -> None:
    scene, content = glb(folder / "mode.glb")
    assert scene["buffers"] == [{"byteLength": len(content)}]
    (primitive,) = scene["meshes"][0]["primitives"]
    number = primitive["attributes"]["POSITION"]
    points = values(scene, content, number)
    np.testing.assert_allclose(points, moving.surface.points, rtol=0.0, atol=1e-7)
    assert scene["accessors"][number]["min"] == pytest.approx(points.min(axis=0))
    assert scene["accessors"][number]["max"] == pytest.approx(points.max(axis=0))
    indices = values(scene, content, primitive["indices"]).reshape(-1, 3)
    assert np.array_equal(indices, moving.surface.triangles)


def test_glb_plays_the_motion(folder: Path, moving: MovingSurface) -> None:
    """Weights and morph targets, put together as the format says, are Re(u e^(iτ))."""
    scene, content = glb(folder / "mode.glb")
    (primitive,), (animation,) = scene["meshes"][0]["primitives"], scene["animations"]
    targets = [values(scene, content, target["POSITION"]) for target in primitive["targets"]]
    (sampler,) = animation["samplers"]
    time = values(scene, content, sampler["input"]).ravel()
    weights = values(scene, content, sampler["output"]).reshape(-1, 2)
    assert time == pytest.approx(np.linspace(0.0, SECONDS, KEYS + 1))
    for instant, (one, other) in zip(time, weights, strict=True):
        drawn = moving.scale * at_phase(moving.shape, 2.0 * np.pi * instant / SECONDS)
        shown = one * targets[0] + other * targets[1]
        np.testing.assert_allclose(shown, drawn, rtol=0.0, atol=1e-7)
    assert scene["meshes"][0]["weights"] == [1.0, 0.0]


def test_glb_is_played_by_another_reader(folder: Path, moving: MovingSurface) -> None:
    """VTK moves the surface through the box that it must have at each instant."""
    import pyvista
    from vtkmodules.vtkIOGeometry import vtkGLTFReader

    reader = vtkGLTFReader()
    reader.SetFileName(str(folder / "mode.glb"))
    reader.UpdateInformation()
    reader.EnableAnimation(0)
    for key in (0, KEYS // 4, 14):
        reader.UpdateTimeStep(SECONDS * key / KEYS)
        mesh = pyvista.wrap(reader.GetOutput()).combine()
        drawn = moving.scale * at_phase(moving.shape, 2.0 * np.pi * key / KEYS)
        points = moving.surface.points + drawn
        box = np.stack([points.min(axis=0), points.max(axis=0)], axis=1)
        assert mesh.bounds == pytest.approx(box.ravel(), abs=1e-6)
        assert mesh.n_cells == len(moving.surface.triangles)


def test_a_file_for_every_mode_speed_and_format(tmp_path: Path) -> None:
    result = samples.campbell(3)
    result.shape[:, 3:] = np.nan
    result.shape[0, 2] = np.nan  # a mode that is lost at rest
    made = write_shapes(
        tmp_path / "meshes", samples.spindle(), result, ShapesInSpaceSpec(files=("off", "stl"))
    )
    assert len(made) == 2 * (2 * 3 - 1)
    assert {path.name for path in made} == {path.name for path in (tmp_path / "meshes").iterdir()}
    assert not (tmp_path / "meshes" / "2_bw_0rpm.stl").exists()
    assert write_shapes(tmp_path / "no", samples.spindle(), result, ShapesInSpaceSpec()) == []
    assert not (tmp_path / "no").exists()


def test_unknown_format_is_named_with_those_there_are(
    tmp_path: Path, moving: MovingSurface
) -> None:
    with pytest.raises(InvalidInput, match=r"'fbx'; allowed: vtu, vtk, xdmf, glb, stl, ply, obj"):
        write_shape(tmp_path / "mode.fbx", moving)
    with pytest.raises(InvalidInput, match="'fbx'; allowed: vtu"):
        ShapesInSpaceSpec(files=("fbx",))
    assert list(tmp_path.iterdir()) == []
