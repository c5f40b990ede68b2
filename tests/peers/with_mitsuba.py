"""Renders a scene with Mitsuba 3:
`with_mitsuba.py SCENE FOLDER WIDTH HEIGHT SPP SEED THREADS OUT.npy VARIANT SAMPLER`."""

import sys

import drjit as dr
import mitsuba as mi
import numpy as np

import model
import scenes


def rgb(values):
    return {"type": "rgb", "value": list(values)}


def placed(t, folder):
    """A thing without its material. Mitsuba's shapes are a square of side 2 in xy that faces +z, a cube of side 2 and
    a unit sphere."""
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
            return {"type": "ply", "filename": f"{folder}/{t.shape.name}.ply", "face_normals": True, "to_world": world}
    raise TypeError(t.shape)


def material(m):
    """The fields that a shape gets for its material."""
    match m:
        case model.Diffuse():
            return {"bsdf": {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": rgb(m.color)}}}
        case model.Metal():
            ggx = {"type": "roughconductor", "material": "none", "distribution": "ggx", "alpha": m.roughness**2}
            return {"bsdf": {"type": "twosided", "bsdf": ggx}}
        case model.Glass():
            bsdf = {"type": "null"} if m.ior == 1 else {"type": "dielectric", "int_ior": m.ior, "ext_ior": 1.0}
            return {"bsdf": bsdf, **({"interior": medium(m.interior)} if m.interior else {})}
    raise TypeError(m)


def medium(m):
    sigma_t = [a + s for a, s in zip(m.sigma_a, m.sigma_s)]
    # A colour is at most 1 there, so the unit is what changes.
    scale = max(sigma_t)
    return {"type": "homogeneous", "sigma_t": rgb([t / scale for t in sigma_t]), "scale": scale,
            "albedo": rgb([s / t if t else 0 for s, t in zip(m.sigma_s, sigma_t)]),
            "phase": {"type": "hg", "g": m.g} if m.g else {"type": "isotropic"}}


def lamp(s, folder):
    return {**placed(s, folder), "bsdf": {"type": "diffuse", "reflectance": rgb((0, 0, 0))},
            "emitter": {"type": "area", "radiance": rgb(s.radiance)}}


def camera(c, size, sampler):
    film = {"type": "hdrfilm", "width": size[0], "height": size[1], "pixel_format": "rgb",
            "component_format": "float32", "rfilter": {"type": "box"}}
    view = mi.ScalarTransform4f().look_at(origin=list(c.origin), target=list(c.to), up=[0, 1, 0])
    return {"type": "perspective", "fov": c.fov, "fov_axis": "y", "near_clip": 1e-3, "far_clip": 1e4,
            "to_world": view, "film": film, "sampler": {"type": sampler}}


def dictionary(scene, folder, size, sampler="multijitter"):
    """What `mi.load_dict` takes."""
    out = {"type": "scene", "camera": camera(scene.camera, size, sampler),
           # Not `volpathmis`: its roulette is biased, see docs/validation.md.
           "integrator": {"type": "volpath" if scene.media() else "path", "max_depth": scene.depth}}
    if scene.sky:
        out["sky"] = {"type": "constant", "radiance": rgb(scene.sky)}
    for i, t in enumerate(scene.things):
        out[f"thing{i}"] = {**placed(t, folder), **material(scene.materials[t.material])}
    for i, s in enumerate(scene.lights):
        out[f"lamp{i}"] = lamp(s, folder)
    return out


def main():
    name, folder, width, height, spp, seed, threads, out, variant, sampler = sys.argv[1:]
    mi.set_variant(variant)
    dr.set_thread_count(int(threads))
    scene = mi.load_dict(dictionary(scenes.ALL[name], folder, (int(width), int(height)), sampler))
    np.save(out, np.array(mi.render(scene, spp=int(spp), seed=int(seed))))


if __name__ == "__main__":
    main()
