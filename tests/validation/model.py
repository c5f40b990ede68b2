"""The neutral form of a scene: what both renderers are told, in metres, degrees and linear Rec. 709.

Knows neither renderer. Shapes stand as in the scene language: a rectangle lies in the xz plane and
faces +y, a box and a sphere are around the origin; `rotate` turns about x, then y, then z, each
counter-clockwise seen from the tip of the axis; `at` moves last.
"""

from dataclasses import dataclass, field


def grey(value):
    """A colour without hue."""
    return (value, value, value)


@dataclass(frozen=True)
class Diffuse:
    color: tuple


@dataclass(frozen=True)
class Textured:
    """Diffuse; `texels`: rows of sRGB bytes from the top, which repeat."""

    name: str
    texels: list


@dataclass(frozen=True)
class Metal:
    """A metal of the glTF model: GGX with alpha = roughness^2, Schlick's Fresnel from `color`."""

    color: tuple
    roughness: float


@dataclass(frozen=True)
class Conductor:
    """One bounce of GGX with alpha = roughness^2, Schlick's Fresnel from `color`."""

    color: tuple
    roughness: float


@dataclass(frozen=True)
class Medium:
    """Absorption and scattering in 1/m for red, green, blue; `g`: mean cosine (Henyey-Greenstein)."""

    sigma_a: tuple
    sigma_s: tuple
    g: float = 0


@dataclass(frozen=True)
class Glass:
    """An interface to air; `ior` 1 is none at all. Rough: GGX with alpha = roughness^2."""

    ior: float
    roughness: float = 0
    interior: Medium | None = None


@dataclass(frozen=True)
class Lamp:
    """Gives off `radiance` to the front and scatters nothing."""

    radiance: tuple


@dataclass(frozen=True)
class Sphere:
    radius: float


@dataclass(frozen=True)
class Rectangle:
    x: float
    z: float


@dataclass(frozen=True)
class Box:
    x: float
    y: float
    z: float


@dataclass(frozen=True)
class Mesh:
    """Flat triangles; `corners`: three (position, uv) of each, counter-clockwise seen from the front."""

    name: str
    corners: list


@dataclass(frozen=True)
class Thing:
    shape: object
    material: str
    at: tuple = (0, 0, 0)
    rotate: tuple = (0, 0, 0)


@dataclass(frozen=True)
class SphereLight:
    center: tuple
    radius: float
    radiance: tuple


@dataclass(frozen=True)
class Camera:
    """`fov`: angle between the lower and the upper edge. `aperture`: diameter of the lens."""

    origin: tuple
    to: tuple
    fov: float
    aperture: float = 0
    focus: float = 0


@dataclass(frozen=True)
class Scene:
    """`spp`: samples of the final comparison, in all replicates; `depth`: longest path in segments."""

    name: str
    tests: str
    camera: Camera
    materials: dict
    things: list
    lights: list = field(default_factory=list)
    sky: tuple | None = None
    depth: int = 12
    spp: int = 4096


# Every picture is this large.
SIZE = (80, 60)
