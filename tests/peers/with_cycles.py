"""Renders a scene with Blender's Cycles: `with_cycles.py SCENE FOLDER WIDTH HEIGHT SPP SEED THREADS OUT.exr
[FIRST ALL]`: with the last two, SPP samples from FIRST on of a picture that has ALL.

Blender's z is up: `UP` turns the scene's frame into it. A sphere is a mesh of 81,920 triangles with the normals of the
sphere. Lamps are points or areas, which Cycles samples best; its lamps stop no light, so a black body stands in each.
"""

import math
import sys

import bpy
from mathutils import Matrix, Vector

import meshes
import model
import scenes

UP = Matrix.Rotation(math.pi / 2, 4, "X")


def world(t):
    """The place of a thing in Blender's frame."""
    out = UP @ Matrix.Translation(t.at)
    for axis, angle in zip("ZYX", reversed(t.rotate)):
        out = out @ Matrix.Rotation(math.radians(angle), 4, axis)
    return out


def put(name, data, place):
    thing = bpy.data.objects.new(name, data)
    thing.matrix_world = place
    bpy.context.collection.objects.link(thing)
    return thing


def polygons(vertices, faces, smooth=False):
    data = bpy.data.meshes.new("mesh")
    data.from_pydata(vertices, [], faces)
    data.polygons.foreach_set("use_smooth", [smooth] * len(faces))
    return data


def box(s):
    corners = [(x * s.x / 2, y * s.y / 2, z * s.z / 2) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return polygons(corners, faces)


def rectangle(s):
    x, z = s.x / 2, s.z / 2
    return polygons([(-x, 0, z), (x, 0, z), (x, 0, -z), (-x, 0, -z)], [(0, 1, 2, 3)])


def ball(radius, levels=6):
    vertices, triangles = meshes.ball(levels)
    return polygons((radius * vertices).tolist(), triangles.tolist(), smooth=True)


def mesh(s, folder):
    bpy.ops.wm.ply_import(filepath=f"{folder}/{s.name}.ply", forward_axis="Y", up_axis="Z")
    thing = bpy.context.selected_objects[0]
    data = thing.data
    bpy.data.objects.remove(thing)
    return data


def shape(s, folder):
    match s:
        case model.Sphere():
            return ball(s.radius)
        case model.Rectangle():
            return rectangle(s)
        case model.Box():
            return box(s)
        case model.Mesh():
            return mesh(s, folder)
    raise TypeError(s)


class Nodes:
    """An empty material."""

    def __init__(self, name):
        self.material = bpy.data.materials.new(name)
        self.material.use_nodes = True
        self.tree = self.material.node_tree
        self.tree.nodes.clear()
        self.output = self.tree.nodes.new("ShaderNodeOutputMaterial")

    def link(self, slot, kind, **inputs):
        """A node into a slot of the output."""
        node = self.tree.nodes.new(kind)
        for key, value in inputs.items():
            node.inputs[key.replace("_", " ")].default_value = value
        self.tree.links.new(node.outputs[0], self.output.inputs[slot])
        return node


def material(name, m):
    nodes = Nodes(name)
    match m:
        case model.Diffuse():
            nodes.link("Surface", "ShaderNodeBsdfDiffuse", Color=(*m.color, 1))
        case model.Metal():
            node = nodes.link("Surface", "ShaderNodeBsdfAnisotropic", Color=(1, 1, 1, 1), Roughness=m.roughness)
            node.distribution = "GGX"
        case model.Glass():
            if m.ior != 1:
                nodes.link("Surface", "ShaderNodeBsdfGlass", Color=(1, 1, 1, 1), Roughness=0, IOR=m.ior)
            if m.interior:
                medium(nodes, m.interior)
        case _:
            raise TypeError(m)
    return nodes.material


def medium(nodes, m):
    node = nodes.link("Volume", "ShaderNodeVolumeCoefficients", Absorption_Coefficients=m.sigma_a,
                      Scatter_Coefficients=m.sigma_s, Anisotropy=m.g)
    node.phase = "HENYEY_GREENSTEIN"


def lamp(s, black):
    """A lamp of the same radiance and the body in it. Power is pi times the area times the radiance."""
    match s:
        case model.SphereLight():
            light = bpy.data.lights.new("lamp", "POINT")
            light.use_soft_falloff, light.shadow_soft_size = False, s.shape.radius
            area, place = 4 * math.pi * s.shape.radius**2, world(s)
            body, behind = ball(0.999 * s.shape.radius, levels=4), world(s)
        case model.RectangleLight():
            light = bpy.data.lights.new("lamp", "AREA")
            light.shape, light.size, light.size_y = "RECTANGLE", s.shape.x, s.shape.z
            # It shines towards its own -z.
            area, place = s.shape.x * s.shape.z, world(s) @ UP
            body, behind = rectangle(s.shape), world(s) @ Matrix.Translation((0, -1e-4, 0))
        case _:
            raise TypeError(s)
    light.color = [v / max(s.radiance) for v in s.radiance]
    light.energy = math.pi * area * max(s.radiance)
    put("lamp", light, place).visible_camera = True
    body.materials.append(black)
    put("body", body, behind)


def camera(c):
    data = bpy.data.cameras.new("eye")
    data.sensor_fit, data.angle = "VERTICAL", math.radians(c.fov)
    data.clip_start, data.clip_end = 1e-3, 1e4
    origin, to = UP @ Vector(c.origin), UP @ Vector(c.to)
    turn = (to - origin).to_track_quat("-Z", "Y").to_matrix().to_4x4()
    bpy.context.scene.camera = put("eye", data, Matrix.Translation(origin) @ turn)


def sky(radiance):
    space = bpy.data.worlds.new("sky")
    space.use_nodes = True
    space.node_tree.nodes["Background"].inputs["Color"].default_value = (*radiance, 1)
    bpy.context.scene.world = space


def settings(size, spp, seed, threads, depth, out, part=()):
    render, cycles = bpy.context.scene.render, bpy.context.scene.cycles
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y = size
    render.resolution_percentage = 100
    render.threads_mode, render.threads = "FIXED", threads
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    render.filepath = out
    cycles.device, cycles.samples, cycles.seed = "CPU", spp, seed
    if part:
        cycles.use_sample_subset = True
        cycles.sample_offset, cycles.samples = part
        cycles.sample_subset_length = spp
    cycles.use_adaptive_sampling, cycles.use_denoising = False, False
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    # The rays from the camera and to the light are not bounces.
    for kind in ("max", "diffuse", "glossy", "transmission", "volume"):
        setattr(cycles, f"{kind}_bounces", depth - 2)
    cycles.transparent_max_bounces = 1024
    # Nothing that makes the picture darker or smoother than it is.
    cycles.sample_clamp_indirect = cycles.sample_clamp_direct = cycles.blur_glossy = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True


def main():
    name, folder, width, height, spp, seed, threads, out, *part = sys.argv[1:]
    scene = scenes.ALL[name]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    found = {key: material(key, m) for key, m in scene.materials.items()}
    for t in scene.things:
        data = shape(t.shape, folder)
        data.materials.clear()
        data.materials.append(found[t.material])
        put("thing", data, world(t))
    black = material("black", model.Diffuse((0, 0, 0)))
    for s in scene.lights:
        lamp(s, black)
    camera(scene.camera)
    if scene.sky:
        sky(scene.sky)
    settings((int(width), int(height)), int(spp), int(seed), int(threads), scene.depth, out, [int(n) for n in part])
    bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    main()
