"""Renders a model with Blender's Cycles: `in_cycles.py JOB.json`, in the frame of `.rts` (metres, +Y up)."""

import json
import math
import sys
from pathlib import Path

import bpy
from mathutils import Matrix, Vector

sys.path.append(str(Path(__file__).resolve().parents[1] / "peers"))

from with_cycles import UP, Nodes, put, settings  # noqa: E402


def load(path):
    """Blender turns +Y up into its own +Z up; PLY and STL say no frame, and are taken as they are here."""
    match Path(path).suffix.lower():
        case ".glb" | ".gltf":
            # Nodes as they are stored, as `rtc` shows them, and not a moment of an animation.
            bpy.ops.import_scene.gltf(filepath=path, guess_original_bind_pose=False)
            for thing in bpy.data.objects:
                thing.animation_data_clear()
                if thing.type == "ARMATURE":
                    thing.data.pose_position = "REST"
        case ".obj":
            bpy.ops.wm.obj_import(filepath=path)
        case ".ply":
            bpy.ops.wm.ply_import(filepath=path, forward_axis="NEGATIVE_Z", up_axis="Y")
        case ".stl":
            bpy.ops.wm.stl_import(filepath=path, forward_axis="NEGATIVE_Z", up_axis="Y")
    for thing in list(bpy.data.objects):
        if thing.type in ("LIGHT", "CAMERA"):
            bpy.data.objects.remove(thing)


def smooth(angle):
    """Normals as `rtc` makes them where a file has none: across edges below this angle."""
    for thing in bpy.data.objects:
        if thing.type == "MESH" and not thing.data.has_custom_normals:
            bpy.ops.object.select_all(action="DESELECT")
            thing.select_set(True)
            bpy.context.view_layer.objects.active = thing
            bpy.ops.object.shade_smooth_by_angle(angle=math.radians(angle))


def paint(is_gltf):
    """What has no material is as `rtc` has it: a grey, in glTF the white metal of the specification."""
    nodes = Nodes("nothing")
    if is_gltf:
        nodes.link("Surface", "ShaderNodeBsdfPrincipled", **{"Base Color": (1, 1, 1, 1), "Metallic": 1, "Roughness": 1})
    else:
        nodes.link("Surface", "ShaderNodeBsdfDiffuse", Color=(0.5, 0.5, 0.5, 1))
    for thing in bpy.data.objects:
        if thing.type == "MESH" and not any(slot.material for slot in thing.material_slots):
            thing.data.materials.clear()
            thing.data.materials.append(nodes.material)


def camera(job):
    data = bpy.data.cameras.new("eye")
    data.sensor_fit, data.angle = "VERTICAL", math.radians(job["fov"])
    data.clip_start, data.clip_end = 1e-4, 1e6
    origin, to = UP @ Vector(job["from"]), UP @ Vector(job["to"])
    turn = (to - origin).to_track_quat("-Z", "Y").to_matrix().to_4x4()
    bpy.context.scene.camera = put("eye", data, Matrix.Translation(origin) @ turn)


def sky(path):
    """The middle of the image lies towards -z of the scene, which is +y here; Blender looks for it along +x."""
    space = bpy.data.worlds.new("sky")
    space.use_nodes = True
    tree = space.node_tree
    where, turn = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeMapping")
    image = tree.nodes.new("ShaderNodeTexEnvironment")
    turn.vector_type, turn.inputs["Rotation"].default_value = "POINT", (0, 0, -math.pi / 2)
    image.image = bpy.data.images.load(path)
    tree.links.new(where.outputs["Generated"], turn.inputs["Vector"])
    tree.links.new(turn.outputs[0], image.inputs["Vector"])
    tree.links.new(image.outputs["Color"], tree.nodes["Background"].inputs["Color"])
    bpy.context.scene.world = space


def main():
    job = json.loads(Path(sys.argv[1]).read_text())
    bpy.ops.wm.read_factory_settings(use_empty=True)
    load(job["model"])
    if not job["is_gltf"]:
        # What has no normals is flat in glTF.
        smooth(job["crease"])
    paint(job["is_gltf"])
    camera(job)
    sky(job["hdr"])
    settings(job["size"], job["spp"], 0, job["threads"], job["depth"], job["out"])
    for seed in range(job["seeds"]):
        bpy.context.scene.cycles.seed = seed
        bpy.context.scene.render.filepath = f"{job['out']}{seed}.exr"
        bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    main()
