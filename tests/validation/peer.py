"""A neutral scene → a Mitsuba dictionary, and its picture."""

import time

import mitsuba as mi
import numpy as np

import model
from model import SIZE


def rgb(values):
    return {"type": "rgb", "value": list(values)}


def placed(t, files):
    """A thing without its material. Mitsuba's shapes are a square of side 2 in xy that faces +z, a cube
    of side 2 and a unit sphere; meshes lie in the folder `files`."""
    transform = mi.ScalarTransform4f
    world = transform().translate(list(t.at))
    for axis, angle in zip(([0, 0, 1], [0, 1, 0], [1, 0, 0]), reversed(t.rotate)):
        world = world @ transform().rotate(axis, angle)
    match t.shape:
        case model.Sphere():
            return {"type": "sphere", "to_world": world @ transform().scale(t.shape.radius)}
        case model.Rectangle():
            flat = transform().rotate([1, 0, 0], -90)
            size = transform().scale([t.shape.x / 2, t.shape.z / 2, 1])
            return {"type": "rectangle", "to_world": world @ flat @ size}
        case model.Box():
            half = [t.shape.x / 2, t.shape.y / 2, t.shape.z / 2]
            return {"type": "cube", "to_world": world @ transform().scale(half)}
        case model.Mesh():
            return {"type": "obj", "filename": str(files / f"{t.shape.name}.obj"), "to_world": world}
    raise TypeError(t.shape)


def material(m, files):
    """The fields that a shape gets for its material."""
    match m:
        case model.Diffuse():
            bsdf = {"type": "diffuse", "reflectance": rgb(m.color)}
            return {"bsdf": {"type": "twosided", "bsdf": bsdf}}
        case model.Textured():
            image = {"type": "bitmap", "filename": str(files / f"{m.name}.png"), "format": "variant"}
            return {"bsdf": {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": image}}}
        case model.Metal() | model.Conductor():
            bsdf = {"type": "correlated_conductor", "color": rgb(m.color), "alpha": m.roughness**2}
            return {"bsdf": {"type": "twosided", "bsdf": bsdf}}
        case model.Glass():
            return {"bsdf": interface(m), **({"interior": medium(m.interior)} if m.interior else {})}
        case model.Lamp():
            black = {"type": "diffuse", "reflectance": rgb((0, 0, 0))}
            return {"bsdf": black, "emitter": {"type": "area", "radiance": rgb(m.radiance)}}
    raise TypeError(m)


def interface(m):
    if m.ior == 1:
        return {"type": "null"}
    if m.roughness:
        return {"type": "correlated_dielectric", "eta": m.ior, "alpha": m.roughness**2}
    return {"type": "dielectric", "int_ior": m.ior, "ext_ior": 1.0}


def medium(m):
    sigma_t = [a + s for a, s in zip(m.sigma_a, m.sigma_s)]
    albedo = [s / t if t else 0 for s, t in zip(m.sigma_s, sigma_t)]
    # A colour is at most 1 there, so the unit is what changes.
    scale = max(sigma_t)
    return {"type": "homogeneous", "sigma_t": rgb([t / scale for t in sigma_t]), "scale": scale,
            "albedo": rgb(albedo), "phase": {"type": "hg", "g": m.g}}


def camera(c):
    lens = {"type": "perspective"}
    if c.aperture:
        lens = {"type": "thinlens", "aperture_radius": c.aperture / 2, "focus_distance": c.focus}
    film = {"type": "hdrfilm", "width": SIZE[0], "height": SIZE[1], "pixel_format": "rgb",
            "component_format": "float32", "rfilter": {"type": "box"}}
    view = mi.ScalarTransform4f().look_at(list(c.origin), list(c.to), [0, 1, 0])
    return {**lens, "fov": c.fov, "fov_axis": "y", "near_clip": 1e-3, "far_clip": 1e3,
            "to_world": view, "film": film, "sampler": {"type": "independent"}}


def dictionary(scene, files):
    """What `mi.load_dict` takes."""
    media = any(isinstance(m, model.Glass) and m.interior for m in scene.materials.values())
    # Not `volpathmis`: its roulette is biased, see the page.
    integrator = "volpath" if media else "path"
    out = {"type": "scene", "integrator": {"type": integrator, "max_depth": scene.depth},
           "camera": camera(scene.camera)}
    if scene.sky:
        out["sky"] = {"type": "constant", "radiance": rgb(scene.sky)}
    for i, t in enumerate(scene.things):
        out[f"thing{i}"] = {**placed(t, files), **material(scene.materials[t.material], files)}
    for i, s in enumerate(scene.lights):
        ball = model.Thing(model.Sphere(s.radius), "", at=s.center)
        out[f"light{i}"] = {**placed(ball, files), **material(model.Lamp(s.radiance), files)}
    return out


def pictures(scene, files, replicates, spp):
    """Independent pictures as [replicate, y, x, channel], and the seconds they took."""
    loaded = mi.load_dict(dictionary(scene, files))
    start = time.monotonic()
    out = [np.array(mi.render(loaded, spp=spp, seed=seed), dtype=np.float64)
           for seed in range(replicates)]
    return np.array(out), time.monotonic() - start
