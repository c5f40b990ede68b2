"""Poses a rigged model in Blender and in rtc, compares where it is, and writes docs/poses.md.

    python tests/models/poses.py target/release/rtc

It needs `bpy` (PyPI). The model is made here: a tube on two bones, which bends, moves and swells (a shape key). Blender
exports it as glTF and reports the box around it at some frames; `rtc show --bounds` reports that of `gltf(..., time: T)`. A
difference of more than 0.1 mm ends it with exit code 1, and nothing is written.
"""

import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import bpy  # first: bmesh comes with it
import bmesh

PAGE = Path(__file__).resolve().parent.parent.parent / "docs" / "poses.md"
FRAMES = [1, 7, 13, 25]
TOLERANCE = 1e-4

SCENE = """rts 1
asset rig = gltf("rig.glb", time: {ms}ms)
instance tube {{ shape = rig }}
camera eye: perspective {{ from = (0, 3, 5)m, to = (0, 1, 0)m }}
render main: path {{ camera = eye }}
"""


def key(thing, name: str, values: list) -> None:
    """Sets a property at the first and the last frame."""
    for frame, value in zip((FRAMES[0], FRAMES[-1]), values):
        setattr(thing, name, value)
        thing.keyframe_insert(name, frame=frame)


def straight(action) -> None:
    """Makes the curves of an action straight lines."""
    for layer in action.layers:
        for strip in layer.strips:
            for bag in strip.channelbags:
                for curve in bag.fcurves:
                    for point in curve.keyframe_points:
                        point.interpolation = "LINEAR"


def tube():
    bpy.ops.mesh.primitive_cylinder_add(vertices=12, radius=0.3, depth=2, location=(0, 0, 1))
    tube = bpy.context.object
    mesh = bmesh.new()
    mesh.from_mesh(tube.data)
    upright = [edge for edge in mesh.edges if abs(edge.verts[0].co.z - edge.verts[1].co.z) > 1]
    bmesh.ops.subdivide_edges(mesh, edges=upright, cuts=6)
    mesh.to_mesh(tube.data)
    mesh.free()
    tube.shape_key_add(name="Basis")
    swollen = tube.shape_key_add(name="swollen")
    for to, vertex in zip(swollen.data, tube.data.vertices):
        x, y, z = vertex.co
        to.co = (1.5 * x, 1.2 * y, z)
    key(swollen, "value", [0.0, 1.0])
    return tube


def bones(tube) -> None:
    bpy.ops.object.armature_add()
    rig = bpy.context.object
    bpy.ops.object.mode_set(mode="EDIT")
    root = rig.data.edit_bones[0]
    root.head, root.tail = (0, 0, 0), (0, 0, 1)
    tip = rig.data.edit_bones.new("tip")
    tip.head, tip.tail, tip.parent = (0, 0, 1), (0, 0, 2), root
    bpy.ops.object.mode_set(mode="OBJECT")
    tube.select_set(True)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.parent_set(type="ARMATURE_AUTO")
    tip = rig.pose.bones["tip"]
    tip.rotation_mode = "QUATERNION"
    key(tip, "rotation_quaternion", [(1, 0, 0, 0), (math.cos(0.6), math.sin(0.6), 0, 0)])
    key(rig, "location", [(0, 0, 0), (1, 0.5, 0)])


def blenders(tube, frame: int) -> list:
    """The box around the tube, in glTF's axes."""
    bpy.context.scene.frame_set(frame)
    posed = tube.evaluated_get(bpy.context.evaluated_depsgraph_get())
    world = [posed.matrix_world @ vertex.co for vertex in posed.to_mesh().vertices]
    points = [(p.x, p.z, -p.y) for p in world]
    return [[side(p[k] for p in points) for k in range(3)] for side in (min, max)]


def ours(rtc: str, folder: Path, seconds: float) -> list:
    scene = folder / "rig.rts"
    scene.write_text(SCENE.format(ms=1000 * seconds))
    command = [rtc, "show", "--bounds", scene]
    first = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()[0]
    corners = first.removeprefix("world").split("m,")[0].replace("m ..", "..").split("..")
    return [[float(x) for x in corner.strip().strip("()m").split(",")] for corner in corners]


def main() -> None:
    rtc = str(Path(sys.argv[1]).resolve())
    bpy.ops.wm.read_factory_settings(use_empty=True)
    model = tube()
    bones(model)
    for action in bpy.data.actions:
        straight(action)
    scene = bpy.context.scene
    scene.frame_end = FRAMES[-1]
    rows, worst = [], 0.0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        bpy.ops.export_scene.gltf(filepath=str(folder / "rig.glb"), export_animations=True)
        for frame in FRAMES:
            seconds = frame / scene.render.fps
            theirs, own = blenders(model, frame), ours(rtc, folder, seconds)
            off = max(abs(a - b) for a, b in zip(sum(theirs, []), sum(own, [])))
            worst = max(worst, off)
            size = " x ".join(f"{hi - lo:.4f}" for lo, hi in zip(*own))
            rows.append(f"| {frame} | {seconds:.3f} s | {size} m | {1000 * off:.2f} mm |")
    print("\n".join(rows))
    if worst > TOLERANCE:
        sys.exit(f"a corner is off by {1000 * worst:.2f} mm")
    PAGE.write_text(
        "# Poses of glTF files beside Blender's\n\n"
        "Written by `python tests/models/poses.py target/release/rtc`. A tube on two bones bends, moves and swells; "
        f"Blender {bpy.app.version_string} makes it, exports it, and reports the box around it at some frames. "
        "`gltf(\"rig.glb\", time: T)` has the same box, to the digits that `rtc show --bounds` prints.\n\n"
        "| frame | time | box | farthest corner off by |\n|---|---|---|---|\n" + "\n".join(rows) + "\n"
    )


main()
