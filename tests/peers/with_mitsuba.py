"""Renders the meadow with Mitsuba 3: `with_mitsuba.py FOLDER SPP SEED OUT.npy VARIANT`."""

import sys

import mitsuba as mi
import numpy as np

import meadow


def rgb(values):
    return {"type": "rgb", "value": list(values)}


def mesh(folder, name, color):
    bsdf = {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": rgb(color)}}
    return {"type": "ply", "filename": f"{folder}/{name}.ply", "face_normals": True, "bsdf": bsdf}


def main():
    folder, spp, seed, out, variant = sys.argv[1:]
    mi.set_variant(variant)
    transform = mi.ScalarTransform4f
    eye = meadow.CAMERA
    width, height = meadow.SIZE
    scene = mi.load_dict({
        "type": "scene",
        "integrator": {"type": "path", "max_depth": meadow.DEPTH},
        "ground": mesh(folder, "ground", meadow.GROUND),
        "grass": mesh(folder, "grass", meadow.GRASS),
        "lamp": {"type": "sphere", "center": list(meadow.LAMP["center"]),
                 "radius": meadow.LAMP["radius"],
                 "emitter": {"type": "area", "radiance": rgb(meadow.LAMP["radiance"])}},
        "sky": {"type": "constant", "radiance": rgb(meadow.SKY)},
        "sensor": {
            "type": "perspective", "fov": eye["fov_vertical"], "fov_axis": "y",
            "to_world": transform().look_at(
                origin=list(eye["from"]), target=list(eye["to"]), up=[0, 1, 0]),
            "film": {"type": "hdrfilm", "width": width, "height": height, "pixel_format": "rgb",
                     "component_format": "float32", "rfilter": {"type": "box"}},
            "sampler": {"type": "multijitter"}},
    })
    picture = mi.render(scene, spp=int(spp), seed=int(seed))
    np.save(out, np.array(picture)[:, :, :3])


main()
