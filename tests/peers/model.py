"""The neutral form of a scene, in metres, degrees and linear Rec. 709; knows no renderer.

A rectangle lies in the xz plane and faces +y, a box and a sphere are around the origin. `rotate` turns about x, then
y, then z, each counter-clockwise seen from the tip of the axis; `at` moves last. +y is up.
"""

from dataclasses import dataclass


def grey(value):
    """A colour without hue."""
    return (value, value, value)


@dataclass(frozen=True)
class Diffuse:
    color: tuple


@dataclass(frozen=True)
class Metal:
    """One bounce of GGX with alpha = roughness^2; the microfacets reflect everything at every angle."""

    roughness: float


@dataclass(frozen=True)
class Medium:
    """Absorption and scattering in 1/m for red, green, blue; `g`: mean cosine (Henyey-Greenstein)."""

    sigma_a: tuple
    sigma_s: tuple
    g: float = 0


@dataclass(frozen=True)
class Glass:
    """A smooth interface to air around a closed thing; `ior` 1 is none at all."""

    ior: float
    interior: Medium | None = None


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
    """Flat triangles that `meshes.make` makes."""

    name: str


@dataclass(frozen=True)
class Thing:
    shape: object
    material: str
    at: tuple = (0, 0, 0)
    rotate: tuple = (0, 0, 0)


@dataclass(frozen=True)
class RectangleLight:
    """Gives off `radiance` to the front; what meets it from either side ends there."""

    shape: Rectangle
    radiance: tuple
    at: tuple
    rotate: tuple = (0, 0, 0)


@dataclass(frozen=True)
class SphereLight:
    """Gives off `radiance` from its surface; what meets it ends there."""

    shape: Sphere
    radiance: tuple
    at: tuple
    rotate: tuple = (0, 0, 0)


@dataclass(frozen=True)
class Camera:
    """A pinhole. `fov`: angle between the lower and the upper edge."""

    origin: tuple
    to: tuple
    fov: float


@dataclass(frozen=True)
class Scene:
    """`depth`: longest path in segments, the one from the camera and the one to the light included; surfaces of
    index 1 end none. `size`: width and height in pixels. `allowed`: share by which means may differ for a reason that
    the page names."""

    name: str
    shows: str
    camera: Camera
    materials: dict
    things: list
    lights: list
    depth: int
    size: tuple
    sky: tuple | None = None
    allowed: float = 0

    def meshes(self):
        """Names of the meshes, each once."""
        return list(dict.fromkeys(t.shape.name for t in self.things if isinstance(t.shape, Mesh)))

    def media(self):
        """Whether light may scatter inside something."""
        return any(isinstance(m, Glass) and m.interior for m in self.materials.values())
