"""Renders the meadow with Blender's Cycles on the CPU: `with_cycles.py FOLDER SPP SEED OUT.exr THREADS`."""

import math
import sys

import bpy
from mathutils import Vector

import meadow


def place(v):
    """Blender's z is up."""
    return (v[0], -v[2], v[1])


def mesh(folder, name, color):
    bpy.ops.wm.ply_import(filepath=f"{folder}/{name}.ply", forward_axis="NEGATIVE_Z", up_axis="Y")
    thing = bpy.context.selected_objects[0]
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    diffuse, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    diffuse.inputs["Color"].default_value = (*color, 1)
    links.new(diffuse.outputs[0], output.inputs["Surface"])
    thing.data.materials.clear()
    thing.data.materials.append(material)


def lamp():
    """A sphere of the same radiance: power pi times the area times the radiance."""
    center, radius, radiance = (meadow.LAMP[k] for k in ("center", "radius", "radiance"))
    light = bpy.data.lights.new("lamp", "POINT")
    light.shadow_soft_size = radius
    light.color = [v / max(radiance) for v in radiance]
    light.energy = max(radiance) * 4 * math.pi**2 * radius**2
    thing = bpy.data.objects.new("lamp", light)
    thing.location = place(center)
    bpy.context.collection.objects.link(thing)


def camera():
    eye = meadow.CAMERA
    data = bpy.data.cameras.new("eye")
    data.sensor_fit, data.angle = "VERTICAL", math.radians(eye["fov_vertical"])
    thing = bpy.data.objects.new("eye", data)
    origin = Vector(place(eye["from"]))
    thing.location = origin
    thing.rotation_euler = (Vector(place(eye["to"])) - origin).to_track_quat("-Z", "Y").to_euler()
    bpy.context.collection.objects.link(thing)
    bpy.context.scene.camera = thing


def sky():
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (*meadow.SKY, 1)
    bpy.context.scene.world = world


def settings(spp, seed, out, threads):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = meadow.SIZE
    scene.render.resolution_percentage = 100
    scene.render.threads_mode, scene.render.threads = "FIXED", threads
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = out
    cycles = scene.cycles
    cycles.device, cycles.samples, cycles.seed = "CPU", spp, seed
    cycles.use_adaptive_sampling, cycles.use_denoising = False, False
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    # The camera ray and the ray to the light are not bounces.
    cycles.max_bounces = cycles.diffuse_bounces = meadow.DEPTH - 2
    cycles.sample_clamp_indirect = cycles.sample_clamp_direct = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True


def main():
    folder, spp, seed, out, threads = sys.argv[1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    mesh(folder, "ground", meadow.GROUND)
    mesh(folder, "grass", meadow.GRASS)
    lamp()
    camera()
    sky()
    settings(int(spp), int(seed), out, int(threads))
    bpy.ops.render.render(write_still=True)


main()
