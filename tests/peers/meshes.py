"""Meshes made from nothing, the same on every machine: vertices [n, 3] and triangles [m, 3], counter-clockwise
seen from the front.

The meadow is 1,500,000 triangles: ground and grass. The court is 1,502,240: terrain, petals and columns.
"""

import numpy as np

WIDTH = 60.0
# Triangles: 2 SIDE^2 of ground, 2 a blade.
SIDE, BLADES = 600, 390_000
# 2 COURT^2 of terrain, 8 a petal, 2 SLICES FLUTES a column.
COURT, PETALS = 500, 60_000
COLUMNS, FLUTES, SLICES = 12, 160, 136


def grid(rows, columns, around=False):
    """Two triangles for each cell of (rows + 1) x (columns + 1) vertices, rows first; `around`: the last column of
    cells ends at the first vertices, of which there are `columns` then."""
    width = columns if around else columns + 1
    i, j = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    next_j = (j + 1) % width
    a, b = i * width + j, i * width + next_j
    c, d = a + width, b + width
    a, b, c, d = (v.ravel() for v in (a, b, c, d))
    return np.concatenate([np.stack([a, b, d], 1), np.stack([a, d, c], 1)])


def field(height, side):
    """A square of WIDTH metres with heights."""
    line = np.linspace(-WIDTH / 2, WIDTH / 2, side + 1)
    x, z = np.meshgrid(line, line, indexing="ij")
    return np.stack([x, height(x, z), z], axis=-1).reshape(-1, 3), grid(side, side)


def many(vertices, triangles, copies):
    """`vertices`: [copies, n, 3] of one shape → all of them as one mesh."""
    first = vertices.shape[1] * np.arange(copies)[:, None, None]
    return vertices.reshape(-1, 3), (np.asarray(triangles)[None] + first).reshape(-1, 3)


def hills(x, z):
    return (1.6 * np.sin(0.21 * x + 0.4) * np.cos(0.17 * z) + 0.5 * np.sin(0.63 * x) * np.sin(0.71 * z)
            + 0.06 * np.sin(3.1 * x + 1.7 * z))


def ground():
    return field(hills, SIDE)


def grass():
    """Two triangles for each blade, bent to one side."""
    rng = np.random.default_rng(7)
    x, z = rng.uniform(-WIDTH / 2, WIDTH / 2, (2, BLADES))
    turn = rng.uniform(0, 2 * np.pi, BLADES)
    tall = rng.uniform(0.1, 0.35, BLADES)
    lean = rng.uniform(0.1, 0.5, BLADES) * tall
    foot = np.stack([x, hills(x, z) - 0.01, z], -1)
    side = np.stack([np.cos(turn), np.zeros(BLADES), np.sin(turn)], -1) * 0.008
    front = np.stack([-np.sin(turn), np.zeros(BLADES), np.cos(turn)], -1) * lean[:, None]
    up = np.stack([np.zeros(BLADES), tall, np.zeros(BLADES)], -1)
    left, right = foot - side, foot + side
    middle = foot + 0.5 * up + 0.2 * front
    tip = foot + up + front
    return many(np.stack([left, right, middle + 0.7 * side, tip], 1), [(0, 1, 2), (0, 2, 3)], BLADES)


def dunes(x, z):
    """Terrain that is flat around the origin."""
    far = np.minimum((x**2 + z**2) / 300, 1)
    return far * (1.2 * np.sin(0.31 * x) * np.cos(0.27 * z) + 0.9) + 0.02 * np.sin(2.3 * x) * np.sin(2.9 * z)


def terrain():
    return field(dunes, COURT)


def petals():
    """Curled petals, eight triangles each: most lie on the terrain, some are in the air."""
    rng = np.random.default_rng(11)
    spread = 14 * np.sqrt(rng.uniform(0, 1, PETALS))
    angle = rng.uniform(0, 2 * np.pi, PETALS)
    x, z = spread * np.cos(angle), spread * np.sin(angle)
    falls = rng.uniform(0, 1, PETALS) < 0.15
    above = np.where(falls, rng.uniform(0, 5, PETALS), rng.uniform(0.03, 0.08, PETALS))
    middle = np.stack([x, dunes(x, z) + above, z], -1)
    turn = rng.uniform(0, 2 * np.pi, PETALS)
    tilt = np.where(falls, 1.5, 0.3) * rng.uniform(-1, 1, PETALS)
    flat = np.stack([np.cos(turn), np.zeros(PETALS), np.sin(turn)], -1)
    across = np.stack([-np.sin(turn) * np.cos(tilt), np.sin(tilt), np.cos(turn) * np.cos(tilt)], -1)
    up = np.cross(across, flat)
    rim = np.linspace(0, 2 * np.pi, 9)[:-1]
    # Longer than wide, with its rim raised.
    shape = np.stack([0.09 * np.cos(rim), 0.055 * np.sin(rim), 0.02 + 0.012 * np.cos(2 * rim)], -1)
    axes = np.stack([flat, across, up], 1)
    ring = middle[:, None] + np.einsum("rk,nkc->nrc", shape, axes)
    fan = [(0, 1 + (k + 1) % 8, 1 + k) for k in range(8)]
    return many(np.concatenate([middle[:, None], ring], 1), fan, PETALS)


def columns():
    """A ring of fluted columns, open at both ends, which lie in the ground and out of sight."""
    angle = 2 * np.pi * np.arange(FLUTES) / FLUTES
    y = np.linspace(-0.5, 5.5, SLICES + 1)
    flutes = 1 - 0.06 * np.abs(np.sin(10 * angle))
    swell = 0.45 - 0.012 * y + 0.08 * np.exp(-((y - 5.2) / 0.2) ** 2) + 0.1 * np.exp(-((y - 0.1) / 0.15) ** 2)
    radius = swell[:, None] * flutes[None]
    one = np.stack([radius * np.cos(angle), np.broadcast_to(y[:, None], radius.shape), radius * np.sin(angle)], -1)
    place = 2 * np.pi * (np.arange(COLUMNS) + 0.5) / COLUMNS
    foot = np.stack([7 * np.cos(place), np.zeros(COLUMNS), 7 * np.sin(place)], -1)
    triangles = grid(SLICES, FLUTES, around=True)[:, ::-1]
    return many(one.reshape(1, -1, 3) + foot[:, None], triangles, COLUMNS)


def make(name):
    """The mesh of this name."""
    makers = (ground, grass, terrain, petals, columns)
    return next(m for m in makers if m.__name__ == name)()


def ball(levels):
    """A unit sphere of 20 4^levels triangles: an icosahedron whose edges are halved again and again."""
    g = (1 + 5**0.5) / 2
    vertices = np.array([(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g),
                         (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]) / np.sqrt(1 + g * g)
    triangles = np.array([(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2),
                          (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5),
                          (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)])
    for _ in range(levels):
        edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
        unique, which = np.unique(edges, axis=0, return_inverse=True)
        middle = vertices[unique].sum(axis=1)
        middle /= np.linalg.norm(middle, axis=1, keepdims=True)
        ab, bc, ca = (which.reshape(3, -1) + len(vertices))
        a, b, c = triangles.T
        vertices = np.concatenate([vertices, middle])
        triangles = np.concatenate([np.stack(t, 1) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return vertices, triangles
