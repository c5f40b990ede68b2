"""A neutral scene → a Mitsuba dictionary, and its picture."""

import time

import mitsuba as mi
import numpy as np

import model
from model import SIZE


def rgb(values):
    return {"type": "rgb", "value": list(values)}


def placed(t):
    """World from object of a thing, for Mitsuba's shapes: a square of side 2 in xy that faces +z,
    a cube of side 2, a unit sphere."""
    transform = mi.ScalarTransform4f
    world = transform().translate(list(t.at))
    for axis, angle in zip(([0, 0, 1], [0, 1, 0], [1, 0, 0]), reversed(t.rotate)):
        world = world @ transform().rotate(axis, angle)
    match t.shape:
        case model.Sphere():
            return "sphere", world @ transform().scale(t.shape.radius)
        case model.Rectangle():
            flat = transform().rotate([1, 0, 0], -90)
            return "rectangle", world @ flat @ transform().scale([t.shape.x / 2, t.shape.z / 2, 1])
        case model.Box():
            half = [t.shape.x / 2, t.shape.y / 2, t.shape.z / 2]
            return "cube", world @ transform().scale(half)
    raise TypeError(t.shape)


def material(m):
    """The fields that a shape gets for its material."""
    match m:
        case model.Diffuse():
            bsdf = {"type": "diffuse", "reflectance": rgb(m.color)}
            return {"bsdf": {"type": "twosided", "bsdf": bsdf}}
        case model.Metal():
            bsdf = {"type": "correlated_conductor", "color": rgb(m.color), "alpha": m.roughness**2}
            return {"bsdf": {"type": "twosided", "bsdf": bsdf}}
        case model.Glass():
            return {"bsdf": {"type": "dielectric", "int_ior": m.ior, "ext_ior": 1.0}}
        case model.Lamp():
            black = {"type": "diffuse", "reflectance": rgb((0, 0, 0))}
            return {"bsdf": black, "emitter": {"type": "area", "radiance": rgb(m.radiance)}}
    raise TypeError(m)


def camera(c):
    lens = {"type": "perspective"}
    if c.aperture:
        lens = {"type": "thinlens", "aperture_radius": c.aperture / 2, "focus_distance": c.focus}
    film = {"type": "hdrfilm", "width": SIZE[0], "height": SIZE[1], "pixel_format": "rgb",
            "component_format": "float32", "rfilter": {"type": "box"}}
    view = mi.ScalarTransform4f().look_at(list(c.origin), list(c.to), [0, 1, 0])
    return {**lens, "fov": c.fov, "fov_axis": "y", "near_clip": 1e-3, "far_clip": 1e3,
            "to_world": view, "film": film, "sampler": {"type": "independent"}}


def dictionary(scene):
    """What `mi.load_dict` takes."""
    out = {"type": "scene", "integrator": {"type": "path", "max_depth": scene.depth},
           "camera": camera(scene.camera)}
    if scene.sky:
        out["sky"] = {"type": "constant", "radiance": rgb(scene.sky)}
    for i, t in enumerate(scene.things):
        kind, world = placed(t)
        out[f"thing{i}"] = {"type": kind, "to_world": world, **material(scene.materials[t.material])}
    for i, s in enumerate(scene.lights):
        ball = model.Thing(model.Sphere(s.radius), "", at=s.center)
        kind, world = placed(ball)
        out[f"light{i}"] = {"type": kind, "to_world": world, **material(model.Lamp(s.radiance))}
    return out


def pictures(scene, replicates, spp):
    """Independent pictures as [replicate, y, x, channel], and the seconds they took."""
    loaded = mi.load_dict(dictionary(scene))
    start = time.monotonic()
    out = [np.array(mi.render(loaded, spp=spp, seed=seed), dtype=np.float64)
           for seed in range(replicates)]
    return np.array(out), time.monotonic() - start
