"""A vibrating surface as binary glTF 2.0, which browsers and modelling programs play.

Re(u e^(iτ)) = Re u cos τ − Im u sin τ: two morph targets, Re u and −Im u, with the weights cos τ
and sin τ over one period. Only the core of the format is used.
"""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array, Complex, Indices

SECONDS = 2.0  # that one period takes
KEYS = 36  # instants of a period; between them weights are linear
PALE, DARK = np.array([255, 255, 229]), np.array([0, 90, 50])
_COMPONENT = {"f": 5126, "I": 5125, "B": 5121}
_KIND = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}
_VERTICES, _INDICES = 34962, 34963


def write_glb(
    path: Path,
    *,
    name: str,
    points: Array,
    triangles: Indices,
    motion: Complex,
    share: Array,
) -> None:
    """Write ``points`` (n, 3) [m] moving by the complex ``motion`` (n, 3) [m].

    ``share`` (n,) from 0 to 1: colour from pale to dark.
    """
    buffer = _Buffer()
    phase = np.linspace(0.0, 2.0 * np.pi, KEYS + 1)
    primitive = {
        "attributes": {
            "POSITION": buffer.add("f", points, _VERTICES, bounds=True),
            "COLOR_0": buffer.add("B", _colours(share), _VERTICES, normalized=True),
        },
        "indices": buffer.add("I", triangles.reshape(-1, 1), _INDICES),
        "targets": [
            {"POSITION": buffer.add("f", part, _VERTICES, bounds=True)}
            for part in (motion.real, -motion.imag)
        ],
        "material": 0,
    }
    time = buffer.add("f", phase[:, None] / (2.0 * np.pi) * SECONDS, bounds=True)
    weights = np.stack([np.cos(phase), np.sin(phase)], axis=1).reshape(-1, 1)
    sampler = {"input": time, "output": buffer.add("f", weights), "interpolation": "LINEAR"}
    channel = {"sampler": 0, "target": {"node": 0, "path": "weights"}}
    scene = {
        "asset": {"version": "2.0", "generator": "rotordyn"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": name}],
        "meshes": [{"name": name, "primitives": [primitive], "weights": [1.0, 0.0]}],
        "materials": [
            {"pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.7}},
        ],
        "animations": [{"name": "one period", "samplers": [sampler], "channels": [channel]}],
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{"byteLength": len(buffer.content)}],
    }
    path.write_bytes(_container(scene, bytes(buffer.content)))


class _Buffer:
    """Bytes of all arrays, with the format's description of each."""

    def __init__(self) -> None:
        self.content = bytearray()
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []

    def add(
        self,
        code: str,
        values: NDArray[Any],
        target: int = 0,
        *,
        bounds: bool = False,
        normalized: bool = False,
    ) -> int:
        """Append ``values`` (rows, width) as numbers of ``code``; returns the accessor."""
        packed = np.ascontiguousarray(values, dtype=f"<{code}" if code != "B" else np.uint8)
        view = {"buffer": 0, "byteOffset": len(self.content), "byteLength": packed.nbytes}
        self.views.append(view | ({"target": target} if target else {}))
        self.content += packed.tobytes()
        self.content += bytes(-len(self.content) % 4)
        accessor: dict[str, Any] = {
            "bufferView": len(self.views) - 1,
            "componentType": _COMPONENT[code],
            "count": packed.shape[0],
            "type": _KIND[packed.shape[1]],
        }
        if bounds:
            accessor |= {"min": packed.min(axis=0).tolist(), "max": packed.max(axis=0).tolist()}
        if normalized:
            accessor["normalized"] = True
        self.accessors.append(accessor)
        return len(self.accessors) - 1


def _colours(share: Array) -> NDArray[np.uint8]:
    mixed = PALE + share[:, None] * (DARK - PALE)
    opaque = np.full((len(share), 1), 255.0)
    return np.concatenate([mixed, opaque], axis=1).round().astype(np.uint8)


def _container(scene: dict[str, Any], content: bytes) -> bytes:
    """Return header and two chunks, text and numbers, each a multiple of four bytes."""
    text = json.dumps(scene, allow_nan=False, separators=(",", ":")).encode()
    chunks = ((b"JSON", text + b" " * (-len(text) % 4)), (b"BIN\0", content))
    body = b"".join(struct.pack("<I", len(data)) + kind + data for kind, data in chunks)
    return b"glTF" + struct.pack("<II", 2, 12 + len(body)) + body
