"""A mesh for measuring `rtc`: terrain, petals and columns over a wide plain, edges from 4 mm to 566 m.

`python landscape.py FOLDER` writes `landscape.rts` and its mesh of 1,500,162 triangles, and the meadow beside it;
`rtc --timings --no-cache` then says what compiling them takes, `trees -- --ordinary FOLDER` (`docs/bvh.md`) what
building their trees does. Unlike the meadow this is one mesh, and its triangles differ more in size.
"""

import sys
from pathlib import Path

import numpy as np

import mesh_files
import scenes
import to_rts

# Triangles: 2 of the plain, 2 SIDE^2 of terrain, 2 a petal, 2 SIDES a column.
SIDE = 600
PETALS = 300_000
COLUMNS, SIDES = 5_630, 16
# Metres.
PLAIN, WIDTH = 400.0, 120.0


def height(x, z):
    return 3.0 * np.sin(0.11 * x + 0.4) * np.cos(0.09 * z) + 0.7 * np.sin(0.43 * x) * np.sin(0.51 * z)


def plain():
    s, y = PLAIN / 2, -6.0
    vertices = np.array([[-s, y, -s], [s, y, -s], [s, y, s], [-s, y, s]])
    return vertices, np.array([[0, 2, 1], [0, 3, 2]])


def terrain():
    line = np.linspace(-WIDTH / 2, WIDTH / 2, SIDE + 1)
    x, z = np.meshgrid(line, line, indexing="ij")
    vertices = np.stack([x, height(x, z), z], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(SIDE), np.arange(SIDE), indexing="ij")
    a = (i * (SIDE + 1) + j).ravel()
    b, c, d = a + 1, a + SIDE + 1, a + SIDE + 2
    return vertices, np.concatenate([np.stack([a, b, d], 1), np.stack([a, d, c], 1)])


def directions(rng, count):
    d = rng.normal(size=(count, 3))
    return d / np.linalg.norm(d, axis=1, keepdims=True)


def petals(rng):
    """Rhombi with sides of 4 to 40 mm, in clusters above the terrain."""
    cluster = rng.integers(0, 300, PETALS)
    x, z = rng.uniform(-WIDTH / 2, WIDTH / 2, (2, 300))
    center = np.stack([x, height(x, z) + rng.uniform(0.3, 3.0, 300), z], -1)[cluster]
    center += directions(rng, PETALS) * 0.3 * np.cbrt(rng.uniform(0, 1, PETALS))[:, None]
    u = directions(rng, PETALS)
    v = np.cross(u, directions(rng, PETALS))
    v /= np.linalg.norm(v, axis=1, keepdims=True)
    side = 0.004 * 10 ** rng.uniform(0, 1, (PETALS, 1))
    u, v = u * side / np.sqrt(2), v * side / np.sqrt(2)
    vertices = np.stack([center - u, center - v, center + u, center + v], 1).reshape(-1, 3)
    k = 4 * np.arange(PETALS)
    triangles = np.stack([np.stack([k, k + 1, k + 2], 1), np.stack([k, k + 2, k + 3], 1)], 1)
    return vertices, triangles.reshape(-1, 3)


def columns(rng):
    """Upright, 1 to 6 m high, 4 to 20 cm thick."""
    x, z = rng.uniform(-WIDTH / 2, WIDTH / 2, (2, COLUMNS))
    foot = np.stack([x, height(x, z) - 0.2, z], -1)
    radius, tall = rng.uniform(0.02, 0.1, COLUMNS), rng.uniform(1.0, 6.0, COLUMNS)
    angle = 2 * np.pi * np.arange(SIDES) / SIDES
    ring = np.stack([np.cos(angle), np.zeros(SIDES), np.sin(angle)], -1)
    low = foot[:, None, :] + radius[:, None, None] * ring[None]
    high = low + tall[:, None, None] * np.array([0.0, 1.0, 0.0])
    vertices = np.concatenate([low, high], 1).reshape(-1, 3)
    k = np.arange(SIDES)
    n, top = (k + 1) % SIDES, SIDES
    side = np.concatenate([np.stack([k, n + top, n], 1), np.stack([k, k + top, n + top], 1)])
    triangles = side[None] + 2 * SIDES * np.arange(COLUMNS)[:, None, None]
    return vertices, triangles.reshape(-1, 3)


RTS = """rts 1
/// Written by `tests/peers/landscape.py`.
asset land = gltf("landscape.glb")
material earth: diffuse { color = linear(0.4, 0.38, 0.3) }
instance all { shape = land, material = earth }
sky above: constant { color = linear(0.6, 0.7, 0.9) }
camera eye: perspective { from = (0, 8, 40)m, to = (0, 0, 0)m, fov.vertical = 40deg }
film wide { size = (640, 360)px }
render main: path { samples = 64, depth = 8 }
"""


def write(folder):
    """The scene and its mesh; the number of triangles."""
    rng = np.random.default_rng(11)
    all_vertices, all_triangles, first = [], [], 0
    for vertices, triangles in (plain(), terrain(), petals(rng), columns(rng)):
        all_vertices.append(vertices)
        all_triangles.append(triangles + first)
        first += len(vertices)
    triangles = np.concatenate(all_triangles)
    mesh_files.write_glb(folder / "landscape.glb", np.concatenate(all_vertices), triangles)
    (folder / "landscape.rts").write_text(RTS)
    return len(triangles)


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    # The meadow as all renderers are given it.
    print(write(folder), to_rts.write(folder, scenes.MEADOW, scenes.MEADOW.size), "triangles")
