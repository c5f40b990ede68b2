"""The scenes, each described once for all renderers."""

import math

from model import (Box, Camera, Diffuse, Glass, Medium, Mesh, Metal, Rectangle, RectangleLight, Scene, Sphere,
                   SphereLight, Thing, grey)

# Mitsuba lifts rays off surfaces by 9e-5 (1 + largest coordinate): of two large meshes with small triangles it shows
# 0.15 % more light, and 0.7 % more when the meadow is moved 100 m away.
LIFTED = 0.002

SIDE = 2.22


def room(left, right):
    """Five walls of a box, open towards +z."""
    wall, half = Rectangle(SIDE, SIDE), SIDE / 2
    return [
        Thing(wall, "white"),
        Thing(wall, "white", at=(0, SIDE, 0), rotate=(180, 0, 0)),
        Thing(wall, "white", at=(0, half, -half), rotate=(90, 0, 0)),
        Thing(wall, left, at=(-half, half, 0), rotate=(0, 0, -90)),
        Thing(wall, right, at=(half, half, 0), rotate=(0, 0, 90)),
    ]


ROOM_CAMERA = Camera((0, SIDE / 2, 5.55), (0, SIDE / 2, 0), 30)

CORNELL = Scene(
    name="box",
    shows="diffuse box, two blocks, rectangle light",
    camera=ROOM_CAMERA,
    materials={"white": Diffuse(grey(0.73)), "red": Diffuse((0.65, 0.05, 0.05)),
               "green": Diffuse((0.12, 0.45, 0.15))},
    things=[
        *room("red", "green"),
        Thing(Box(0.66, 1.32, 0.66), "white", at=(-0.37, 0.66, -0.36), rotate=(0, 18, 0)),
        Thing(Box(0.66, 0.66, 0.66), "white", at=(0.39, 0.33, 0.38), rotate=(0, -16, 0)),
    ],
    lights=[RectangleLight(Rectangle(0.52, 0.42), (14, 10.92, 7), at=(0, SIDE - 0.001, 0), rotate=(180, 0, 0))],
    depth=12,
    size=(512, 512),
)

BALLS = Scene(
    name="balls",
    shows="box with a sphere light, a ball of glass and one of rough metal",
    camera=ROOM_CAMERA,
    materials={"white": Diffuse(grey(0.73)), "blue": Diffuse((0.09, 0.2, 0.52)),
               "orange": Diffuse((0.72, 0.24, 0.06)), "glass": Glass(1.5), "metal": Metal(0.3)},
    things=[
        *room("blue", "orange"),
        Thing(Sphere(0.36), "glass", at=(0.5, 0.36, 0.42)),
        Thing(Sphere(0.42), "metal", at=(-0.52, 0.42, -0.15)),
    ],
    lights=[SphereLight(Sphere(0.13), (28, 21, 14), at=(0, 1.86, 0))],
    depth=16,
    size=(512, 512),
)

EYE, LAMPS = (0, 2, 5), (2.2, -1.6)


def plate(index, y, z):
    """A plate at (0, y, z) that mirrors the middle of the lights into the camera."""
    def angle(to_y, to_z):
        return math.atan2(to_z - z, to_y - y)

    tilt = math.degrees(angle(EYE[1], EYE[2]) + angle(*LAMPS)) / 2
    return Thing(Box(3.4, 0.04, 0.5), f"plate{index}", at=(0, y, z), rotate=(round(tilt, 3), 0, 0))


VEACH = Scene(
    name="plates",
    shows="four sphere lights in four rough metal plates (Veach)",
    camera=Camera(EYE, (0, 0.45, -0.2), 25),
    materials={"wall": Diffuse(grey(0.4)),
               # alpha 0.005, 0.02, 0.05, 0.1
               **{f"plate{i}": Metal(alpha**0.5) for i, alpha in enumerate((0.005, 0.02, 0.05, 0.1))}},
    things=[
        Thing(Rectangle(12, 12), "wall", at=(0, -0.3, 0)),
        Thing(Rectangle(12, 8), "wall", at=(0, 0, -3), rotate=(90, 0, 0)),
        plate(0, 0.95, -1.2), plate(1, 0.55, -0.6), plate(2, 0.25, 0.05), plate(3, 0.05, 0.75),
    ],
    lights=[
        SphereLight(Sphere(0.04), (200, 165, 135), at=(-1.2, *LAMPS)),
        SphereLight(Sphere(0.1), (32, 37, 27), at=(-0.4, *LAMPS)),
        SphereLight(Sphere(0.2), (8, 10, 12), at=(0.4, *LAMPS)),
        SphereLight(Sphere(0.3), (6, 4, 5), at=(1.2, *LAMPS)),
    ],
    depth=4,
    size=(640, 400),
)


def on_checkers(name, shows, shape, inside, depth):
    """A thing over a floor of tiles, under a large lamp and a blue sky."""
    tiles = [Thing(Rectangle(0.5, 0.5), "light" if (i + j) % 2 else "dark", at=(0.5 * i - 1.75, 0, 0.5 * j - 1.75))
             for i in range(8) for j in range(8)]
    high = shape.y if isinstance(shape, Box) else 2 * shape.radius
    return Scene(
        name=name,
        shows=shows,
        camera=Camera((0, 1.5, 2.6), (0, 0.25, 0), 30),
        materials={"light": Diffuse((0.8, 0.78, 0.7)), "dark": Diffuse((0.1, 0.15, 0.3)), "inside": inside},
        things=[*tiles, Thing(shape, "inside", at=(0, 0.05 + high / 2, 0), rotate=(0, 20, 0))],
        lights=[SphereLight(Sphere(0.5), (10, 9.3, 8.3), at=(1.2, 2.4, 0.6))],
        sky=(0.35, 0.45, 0.6),
        depth=depth,
        size=(512, 384),
    )


SLAB_SIZE = Box(1.5, 0.45, 1)

WATER = on_checkers("water", "block of water that absorbs, index 1.333", SLAB_SIZE,
                    Glass(1.333, Medium((3, 0.8, 0.4), grey(0))), depth=32)

SLAB = on_checkers("slab", "slab that scatters forwards, without an interface", SLAB_SIZE,
                   Glass(1, Medium((0.2, 0.3, 0.5), (2, 3, 4), 0.6)), depth=128)

BALL = on_checkers("ball", "ball of index 1.33 that scatters", Sphere(0.42),
                   Glass(1.33, Medium((0.1, 0.3, 0.8), (6, 5, 4))), depth=128)

COURT = Scene(
    name="court",
    shows="terrain, petals and columns: 1,502,240 triangles",
    camera=Camera((2.5, 2.6, 15), (-0.3, 1.6, 0), 36),
    materials={"earth": Diffuse((0.36, 0.33, 0.25)), "pink": Diffuse((0.75, 0.42, 0.5)), "stone": Diffuse(grey(0.6))},
    things=[Thing(Mesh("terrain"), "earth"), Thing(Mesh("petals"), "pink"), Thing(Mesh("columns"), "stone")],
    lights=[SphereLight(Sphere(2.5), (110, 90, 65), at=(-16, 14, 12))],
    sky=(0.35, 0.42, 0.55),
    depth=8,
    size=(640, 360),
    allowed=LIFTED,
)

MEADOW = Scene(
    name="meadow",
    shows="hills under 390,000 blades of grass: 1,500,000 triangles",
    camera=Camera((0, 6, 26), (0, -1.5, 0), 40),
    materials={"soil": Diffuse((0.42, 0.36, 0.28)), "green": Diffuse((0.18, 0.42, 0.12))},
    things=[Thing(Mesh("ground"), "soil"), Thing(Mesh("grass"), "green")],
    lights=[SphereLight(Sphere(3), (90, 80, 65), at=(18, 26, -10))],
    sky=(0.35, 0.4, 0.5),
    depth=8,
    size=(640, 360),
    allowed=LIFTED,
)

ALL = {s.name: s for s in (CORNELL, BALLS, VEACH, WATER, SLAB, BALL, COURT, MEADOW)}
