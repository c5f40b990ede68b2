"""The scene that all renderers are given: hills under 390,000 blades of grass, one round lamp, a grey sky."""

import json
import struct

import numpy as np

# Triangles: 2 SIDE^2 of ground, 2 a blade.
SIDE = 600
BLADES = 390_000
WIDTH = 60.0

SIZE = (640, 360)
DEPTH = 8
GROUND = (0.42, 0.36, 0.28)
GRASS = (0.18, 0.42, 0.12)
SKY = (0.35, 0.4, 0.5)
LAMP = {"center": (18.0, 26.0, -10.0), "radius": 3.0, "radiance": (90.0, 80.0, 65.0)}
CAMERA = {"from": (0.0, 6.0, 26.0), "to": (0.0, -1.5, 0.0), "fov_vertical": 40.0}


def height(x, z):
    return (1.6 * np.sin(0.21 * x + 0.4) * np.cos(0.17 * z) + 0.5 * np.sin(0.63 * x) * np.sin(0.71 * z)
            + 0.06 * np.sin(3.1 * x + 1.7 * z))


def ground():
    """Vertices and triangles, counter-clockwise seen from above."""
    line = np.linspace(-WIDTH / 2, WIDTH / 2, SIDE + 1)
    x, z = np.meshgrid(line, line, indexing="ij")
    vertices = np.stack([x, height(x, z), z], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(SIDE), np.arange(SIDE), indexing="ij")
    a = (i * (SIDE + 1) + j).ravel()
    b, c, d = a + 1, a + SIDE + 1, a + SIDE + 2
    return vertices, np.concatenate([np.stack([a, b, d], 1), np.stack([a, d, c], 1)])


def grass():
    """Two triangles for each blade, bent to one side."""
    rng = np.random.default_rng(7)
    x, z = rng.uniform(-WIDTH / 2, WIDTH / 2, (2, BLADES))
    turn = rng.uniform(0, 2 * np.pi, BLADES)
    tall = rng.uniform(0.1, 0.35, BLADES)
    lean = rng.uniform(0.1, 0.5, BLADES) * tall
    foot = np.stack([x, height(x, z) - 0.01, z], -1)
    side = np.stack([np.cos(turn), np.zeros(BLADES), np.sin(turn)], -1) * 0.008
    front = np.stack([-np.sin(turn), np.zeros(BLADES), np.cos(turn)], -1) * lean[:, None]
    up = np.stack([np.zeros(BLADES), tall, np.zeros(BLADES)], -1)
    left, right = foot - side, foot + side
    middle = foot + 0.5 * up + 0.2 * front
    tip = foot + up + front
    vertices = np.stack([left, right, middle + 0.7 * side, tip], 1).reshape(-1, 3)
    k = 4 * np.arange(BLADES)
    triangles = np.stack([np.stack([k, k + 1, k + 2], 1), np.stack([k, k + 2, k + 3], 1)], 1)
    return vertices, triangles.reshape(-1, 3)


def write_ply(path, vertices, triangles):
    faces = np.empty(len(triangles), dtype=[("n", "u1"), ("v", "<i4", 3)])
    faces["n"], faces["v"] = 3, triangles
    header = ("ply\nformat binary_little_endian 1.0\n"
              f"element vertex {len(vertices)}\nproperty float x\nproperty float y\nproperty float z\n"
              f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
    with open(path, "wb") as file:
        file.write(header.encode())
        file.write(vertices.astype("<f4").tobytes())
        file.write(faces.tobytes())


def write_glb(path, vertices, triangles):
    """Binary glTF of one mesh, as `rtc` reads it."""
    positions, indices = vertices.astype("<f4"), triangles.astype("<u4")
    low, high = positions.min(axis=0).tolist(), positions.max(axis=0).tolist()
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(positions), "type": "VEC3",
             "min": low, "max": high},
            {"bufferView": 1, "componentType": 5125, "count": indices.size, "type": "SCALAR"}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": positions.nbytes},
            {"buffer": 0, "byteOffset": positions.nbytes, "byteLength": indices.nbytes}],
        "buffers": [{"byteLength": positions.nbytes + indices.nbytes}]}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    data = positions.tobytes() + indices.tobytes()
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text)
        file.write(struct.pack("<I4s", len(data), b"BIN\0") + data)


def numbers(values):
    return "(" + ", ".join(f"{v:g}" for v in values) + ")"


RTS = f"""rts 1
/// Written by `tests/peers/peers.py`.
asset ground = gltf("ground.glb")
asset grass = gltf("grass.glb")
material soil: diffuse {{ color = linear{numbers(GROUND)} }}
material green: diffuse {{ color = linear{numbers(GRASS)} }}
instance hills {{ shape = ground, material = soil }}
instance meadow {{ shape = grass, material = green }}
light lamp: sphere {{ center = {numbers(LAMP["center"])}m, radius = {LAMP["radius"]:g}m, color = linear{numbers(LAMP["radiance"])} }}
sky above: constant {{ color = linear{numbers(SKY)} }}
camera eye: perspective {{ from = {numbers(CAMERA["from"])}m, to = {numbers(CAMERA["to"])}m, fov.vertical = {CAMERA["fov_vertical"]:g}deg }}
film wide {{ size = {numbers(SIZE)}px }}
render main: path {{ samples = 64, depth = {DEPTH} }}
"""


def write(folder):
    """All files of the scene; the number of triangles."""
    count = 0
    for name, (vertices, triangles) in {"ground": ground(), "grass": grass()}.items():
        write_ply(folder / f"{name}.ply", vertices, triangles)
        write_glb(folder / f"{name}.glb", vertices, triangles)
        count += len(triangles)
    (folder / "meadow.rts").write_text(RTS)
    return count
