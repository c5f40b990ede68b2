"""The scenes of the comparison, each described once."""

import math

from model import (Box, Camera, Conductor, Diffuse, Glass, Lamp, Medium, Mesh, Metal, Rectangle, Scene,
                   Sphere, SphereLight, Textured, Thing, grey)


def checkers(tiles, side):
    """A floor of `tiles` x `tiles` squares in two materials, around the origin."""
    size = side / tiles
    first = (size - side) / 2
    return [
        Thing(Rectangle(size, size), "light" if (i + j) % 2 else "dark",
              at=(round(first + i * size, 6), 0, round(first + j * size, 6)))
        for i in range(tiles) for j in range(tiles)
    ]


CHECKERS = {"light": Diffuse((0.8, 0.78, 0.7)), "dark": Diffuse((0.1, 0.15, 0.3))}


def room():
    """Five walls of a box two metres wide, open towards +z."""
    return [
        Thing(Rectangle(2, 2), "white"),
        Thing(Rectangle(2, 2), "white", at=(0, 2, 0), rotate=(180, 0, 0)),
        Thing(Rectangle(2, 2), "white", at=(0, 1, -1), rotate=(90, 0, 0)),
        Thing(Rectangle(2, 2), "red", at=(-1, 1, 0), rotate=(0, 0, -90)),
        Thing(Rectangle(2, 2), "green", at=(1, 1, 0), rotate=(0, 0, 90)),
    ]


ROOM = {
    "white": Diffuse(grey(0.73)),
    "red": Diffuse((0.65, 0.05, 0.05)),
    "green": Diffuse((0.12, 0.45, 0.15)),
}

FRONT = Camera((0, 1, 3.4), (0, 1, 0), 32)

DIFFUSE = Scene(
    name="diffuse",
    tests="a rectangle light, turned boxes, light between diffuse walls",
    camera=FRONT,
    materials={**ROOM, "lamp": Lamp((14, 11, 7))},
    things=[
        *room(),
        Thing(Rectangle(0.5, 0.4), "lamp", at=(0, 1.999, 0.4), rotate=(180, 0, 0)),
        Thing(Box(0.6, 1.2, 0.6), "white", at=(-0.35, 0.6, -0.35), rotate=(0, 18, 0)),
        Thing(Box(0.5, 0.5, 0.5), "white", at=(0.4, 0.45, 0.3), rotate=(30, -16, 20)),
    ],
)

SPHERE_LIGHT = Scene(
    name="sphere_light",
    tests="sphere lights near and partly below the horizon, and a thin lens",
    camera=Camera((0, 1.1, 3.6), (0, 0.75, 0), 30, aperture=0.2, focus=3.2),
    materials={**ROOM, "blue": Diffuse((0.1, 0.2, 0.6))},
    things=[
        *room(),
        Thing(Sphere(0.35), "blue", at=(0.35, 0.35, 0.2)),
        Thing(Sphere(0.2), "white", at=(-0.2, 0.2, 0.6)),
    ],
    lights=[
        SphereLight((-0.6, 0.1, -0.3), 0.25, (3, 2.5, 2)),
        SphereLight((0.5, 1.85, 0.4), 0.06, (30, 40, 60)),
    ],
)

SMOOTH_GLASS = Scene(
    name="smooth_glass",
    tests="Fresnel, refraction and total reflection in two balls and a turned box",
    camera=Camera((0, 1.6, 4), (0, 0.35, 0), 30),
    materials={**CHECKERS, "glass": Glass(1.5), "dense": Glass(2.2)},
    things=[
        *checkers(8, 4),
        Thing(Sphere(0.4), "glass", at=(-0.6, 0.45, 0.2)),
        Thing(Box(0.5, 0.7, 0.4), "glass", at=(0.55, 0.36, 0.3), rotate=(0, 25, 0)),
        Thing(Sphere(0.35), "dense", at=(0.1, 0.4, -0.7)),
    ],
    lights=[SphereLight((1.5, 2.6, -0.5), 0.6, (6, 5, 4))],
    sky=(0.35, 0.45, 0.6),
    depth=16,
)

ROUGH_GLASS = Scene(
    name="rough_glass",
    tests="light through and off GGX glass of roughness 0.3, 0.5 and 0.8, without compensation",
    camera=Camera((0, 1.6, 4), (0, 0.35, 0), 30),
    materials={**CHECKERS, "frosted": Glass(1.5, 0.3), "dull": Glass(1.5, 0.5), "dense": Glass(2, 0.8)},
    things=[
        *checkers(8, 4),
        Thing(Sphere(0.4), "frosted", at=(-0.6, 0.45, 0.2)),
        Thing(Box(0.5, 0.7, 0.4), "dull", at=(0.55, 0.36, 0.3), rotate=(0, 25, 0)),
        Thing(Sphere(0.35), "dense", at=(0.1, 0.4, -0.7)),
    ],
    lights=[SphereLight((1.5, 2.6, -0.5), 0.6, (6, 5, 4))],
    sky=(0.35, 0.45, 0.6),
    depth=16,
)

def plate(index, y, z):
    """A plate at (0, y, z) that mirrors the middle of the lights into the camera of Veach's scene."""
    def angle(to):
        return math.atan2(to[2] - z, to[1] - y)

    tilt = math.degrees(angle(VEACH_EYE) + angle(VEACH_LIGHTS)) / 2
    return Thing(Box(3.4, 0.04, 0.5), f"plate{index}", at=(0, y, z), rotate=(round(tilt, 3), 0, 0))


VEACH_EYE = (0, 2, 5)
VEACH_LIGHTS = (0, 2.2, -1.6)

VEACH = Scene(
    name="veach",
    tests="four sizes of sphere light in four roughnesses of metal plate",
    camera=Camera(VEACH_EYE, (0, 0.45, -0.2), 25),
    materials={
        "wall": Diffuse(grey(0.4)),
        "plate0": Metal((0.9, 0.85, 0.7), 0.15),
        "plate1": Metal((0.9, 0.85, 0.7), 0.25),
        "plate2": Metal((0.9, 0.85, 0.7), 0.4),
        "plate3": Metal((0.9, 0.85, 0.7), 0.6),
    },
    things=[
        Thing(Rectangle(12, 12), "wall", at=(0, -0.3, 0)),
        Thing(Rectangle(12, 8), "wall", at=(0, 0, -3), rotate=(90, 0, 0)),
        plate(0, 0.95, -1.2),
        plate(1, 0.55, -0.6),
        plate(2, 0.25, 0.05),
        plate(3, 0.05, 0.75),
    ],
    lights=[
        SphereLight((-1.2, *VEACH_LIGHTS[1:]), 0.06, (90, 75, 60)),
        SphereLight((-0.4, *VEACH_LIGHTS[1:]), 0.12, (24, 28, 20)),
        SphereLight((0.4, *VEACH_LIGHTS[1:]), 0.2, (8, 10, 12)),
        SphereLight((1.2, *VEACH_LIGHTS[1:]), 0.3, (6, 4, 5)),
    ],
    depth=2,
    spp=8192,
)


BOX_CAMERA = Camera((0, 1.5, 2.6), (0, 0.25, 0), 30)
BOX_LIGHT = SphereLight((1.2, 2.4, 0.6), 0.9, (3, 2.8, 2.5))
BOX = Thing(Box(1.5, 0.45, 1), "inside", at=(0, 0.275, 0), rotate=(0, 20, 0))


def filled_box(name, tests, inside, **fields):
    """A box over a checkered floor."""
    return Scene(
        name=name,
        tests=tests,
        camera=BOX_CAMERA,
        materials={**CHECKERS, "inside": inside},
        things=[*checkers(8, 4), BOX],
        lights=[BOX_LIGHT],
        sky=(0.35, 0.45, 0.6),
        **fields,
    )


WATER = filled_box(
    "water",
    "a box of water that absorbs red most, index 1.333",
    Glass(1.333, interior=Medium((3, 0.8, 0.4), (0, 0, 0))),
    depth=64,
    spp=2048,
)

SLAB = filled_box(
    "slab",
    "a slab without an interface that scatters forwards, each colour its own density",
    Glass(1, interior=Medium((0.2, 0.3, 0.5), (2, 3, 4), 0.6)),
    depth=256,
    spp=2048,
)

MILK = filled_box(
    "milk",
    "a slab of index 1.33 that scatters backwards and absorbs",
    Glass(1.33, interior=Medium((0.1, 0.3, 0.8), (6, 5, 4), -0.3)),
    depth=256,
    spp=2048,
)

METALS = Scene(
    name="metals",
    tests="GGX metal balls of roughness 0.2, 0.4, 0.7 and 1",
    camera=Camera((0, 1.5, 4), (0, 0.42, 0), 30),
    materials={
        **CHECKERS,
        "metal0": Conductor((0.95, 0.75, 0.4), 0.2),
        "metal1": Conductor((0.95, 0.75, 0.4), 0.4),
        "metal2": Conductor((0.95, 0.75, 0.4), 0.7),
        "metal3": Conductor((0.95, 0.75, 0.4), 1),
    },
    things=[
        *checkers(8, 4),
        Thing(Sphere(0.4), "metal0", at=(-1, 0.4, -0.2)),
        Thing(Sphere(0.4), "metal1", at=(-0.4, 0.4, 0.6)),
        Thing(Sphere(0.4), "metal2", at=(0.2, 0.4, -0.4)),
        Thing(Sphere(0.4), "metal3", at=(0.8, 0.4, 0.5)),
    ],
    lights=[SphereLight((1.5, 2.6, 1), 0.9, (3, 2.7, 2.4))],
    sky=(0.35, 0.45, 0.6),
)

def torus(name, large, small, around, across, repeats):
    """A ring around y of flat triangles; its texture repeats as often around and across."""
    def corner(i, j):
        a, b = 2 * math.pi * i / around, 2 * math.pi * j / across
        out = large + small * math.cos(b)
        position = (out * math.sin(a), small * math.sin(b), out * math.cos(a))
        return position, (repeats[0] * i / around, repeats[1] * j / across)

    corners = []
    for i in range(around):
        for j in range(across):
            p, q, r, s = corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)
            corners += [(p, q, r), (p, r, s)]
    return Mesh(name, corners)


def octahedron(name, radius):
    """Eight triangles that face outwards."""
    corners = []
    for x in (-radius, radius):
        for y in (-radius, radius):
            for z in (-radius, radius):
                a, b, c = (x, 0, 0), (0, y, 0), (0, 0, z)
                order = (a, b, c) if x * y * z > 0 else (a, c, b)
                corners.append(tuple((p, (0, 0)) for p in order))
    return Mesh(name, corners)


# Hues that are unlike in every row and column, so that a flipped or turned image shows.
PATTERN = [[((37 * x + 90 * y) % 256, (200 - 23 * x) % 256, (60 + 41 * y) % 256) for x in range(8)]
           for y in range(6)]

MESH = Scene(
    name="mesh",
    tests="an OBJ mesh with an image that repeats, lit by a mesh that glows",
    camera=Camera((0.3, 2, 3), (0, 0.35, 0), 30),
    materials={"ground": Diffuse(grey(0.5)), "painted": Textured("pattern", PATTERN),
               "lamp": Lamp((9, 8, 7))},
    things=[
        Thing(Rectangle(6, 6), "ground"),
        Thing(torus("ring", 0.6, 0.25, 20, 10, (3, 1)), "painted", at=(0, 0.35, 0),
              rotate=(25, 0, 12)),
        Thing(octahedron("lamp_mesh", 0.3), "lamp", at=(0.9, 1.7, 0.4), rotate=(0, 20, 10)),
    ],
    sky=grey(0.15),
    depth=8,
)

ALL = [DIFFUSE, SPHERE_LIGHT, MESH, SMOOTH_GLASS, ROUGH_GLASS, WATER, SLAB, MILK, METALS,
       VEACH]
