"""Blender's side of read.py: opens a file with its multilayer reader and writes what it has read.

    python blender.py FILE.exr LAYER:NAME[,NAME ..] FOLDER

It writes FOLDER/passes.exr, every pass of the image node, FOLDER/NAME.exr, the matte of each name by the Cryptomatte
node, and FOLDER/blender.json, the names of the passes and Blender's version. It needs `bpy`.
"""

import json
import sys
from pathlib import Path

import bpy


def output(tree, folder: Path, name: str, items: list) -> None:
    """A file of 32 bits with these sockets as layers."""
    node = tree.nodes.new("CompositorNodeOutputFile")
    node.directory, node.file_name = str(folder), name
    node.format.media_type = "MULTI_LAYER_IMAGE"
    node.format.file_format = "OPEN_EXR_MULTILAYER"
    node.format.color_depth = "32"
    node.format.exr_codec = "ZIP"
    for title, kind, socket in items:
        node.file_output_items.new(kind, title)
        tree.links.new(socket, node.inputs[title])


def main() -> None:
    path, wanted, folder = Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3])
    layer, names = wanted.split(":")
    scene = bpy.context.scene
    image = bpy.data.images.load(str(path.resolve()))
    tree = bpy.data.node_groups.new("read", "CompositorNodeTree")
    scene.compositing_node_group = tree
    source = tree.nodes.new("CompositorNodeImage")
    source.image = image
    kinds = {"RGBA": "RGBA", "VECTOR": "VECTOR", "VALUE": "FLOAT"}
    passes = [(socket.name, kinds[socket.type], socket) for socket in source.outputs if socket.enabled]
    output(tree, folder, "passes", passes)
    for name in names.split(","):
        matte = tree.nodes.new("CompositorNodeCryptomatteV2")
        matte.source, matte.image = "IMAGE", image
        matte.layer_name, matte.matte_id = layer, name
        output(tree, folder, name, [("Matte", "FLOAT", matte.outputs["Matte"])])
    camera = bpy.data.objects.new("eye", bpy.data.cameras.new("eye"))
    scene.collection.objects.link(camera)
    scene.camera = camera
    # The size of what is read; a render runs the compositor.
    width, height = json.loads(sys.argv[4])
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = width, height, 100
    scene.render.use_compositing = True
    bpy.ops.render.render()
    found = {"version": bpy.app.version_string, "passes": [name for name, _, _ in passes], "type": image.type}
    (folder / "blender.json").write_text(json.dumps(found))


main()
