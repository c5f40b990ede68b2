"""Triangles, materials and images → one binary glTF file.

Knows nothing of USD. Metres, +Y up, as glTF says.
"""

import array
import json
import struct

FLOAT, UINT = 5126, 5125


class Glb:
    """A file that grows: `image`, `material` and `mesh` give indices, `node` places a mesh."""

    def __init__(self):
        self.data = bytearray()
        self.views, self.accessors, self.images, self.textures = [], [], [], []
        self.materials, self.meshes, self.nodes = [], [], []
        self.extensions = set()

    def view(self, data):
        self.data += b"\0" * (-len(self.data) % 4)
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)})
        self.data += data
        return len(self.views) - 1

    def image(self, data, mime):
        """The index of a texture that shows it."""
        self.images.append({"bufferView": self.view(data), "mimeType": mime})
        self.textures.append({"source": len(self.images) - 1})
        return len(self.textures) - 1

    def material(self, material):
        """`material` is as glTF has it."""
        self.extensions.update(material.get("extensions", {}))
        self.materials.append(material)
        return len(self.materials) - 1

    def accessor(self, rows, width):
        """Rows of floats."""
        values = array.array("f", (x for row in rows for x in row))
        kind = {2: "VEC2", 3: "VEC3"}[width]
        self.accessors.append({"bufferView": self.view(values.tobytes()), "componentType": FLOAT, "count": len(rows),
                               "type": kind})
        return len(self.accessors) - 1

    def primitive(self, corners, material):
        """Corners of triangles, three each: (position, normal or None, uv or None); equal ones are stored once."""
        places, indices = {}, array.array("I")
        for corner in corners:
            indices.append(places.setdefault(corner, len(places)))
        rows = list(places)
        positions = [row[0] for row in rows]
        attributes = {"POSITION": self.accessor(positions, 3)}
        self.accessors[-1] |= {"min": [min(p[k] for p in positions) for k in range(3)],
                               "max": [max(p[k] for p in positions) for k in range(3)]}
        if rows[0][1] is not None:
            attributes["NORMAL"] = self.accessor([row[1] for row in rows], 3)
        if rows[0][2] is not None:
            attributes["TEXCOORD_0"] = self.accessor([row[2] for row in rows], 2)
        self.accessors.append({"bufferView": self.view(indices.tobytes()), "componentType": UINT,
                               "count": len(indices), "type": "SCALAR"})
        made = {"attributes": attributes, "indices": len(self.accessors) - 1}
        return made if material is None else made | {"material": material}

    def mesh(self, name, primitives):
        self.meshes.append({"name": name, "primitives": primitives})
        return len(self.meshes) - 1

    def node(self, name, mesh, matrix):
        """`matrix`: 16 numbers, column by column."""
        self.nodes.append({"name": name, "mesh": mesh, "matrix": matrix})

    def write(self, path):
        document = {"asset": {"version": "2.0", "generator": "usd_to_rts.py"}, "scene": 0,
                    "scenes": [{"nodes": list(range(len(self.nodes)))}], "nodes": self.nodes, "meshes": self.meshes,
                    "accessors": self.accessors, "bufferViews": self.views,
                    "buffers": [{"byteLength": len(self.data)}]}
        more = {"materials": self.materials, "images": self.images, "textures": self.textures,
                "extensionsUsed": sorted(self.extensions)}
        text = json.dumps(document | {key: value for key, value in more.items() if value}).encode()
        text += b" " * (-len(text) % 4)
        data = bytes(self.data) + b"\0" * (-len(self.data) % 4)
        with open(path, "wb") as file:
            file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)))
            file.write(struct.pack("<I4s", len(text), b"JSON") + text)
            file.write(struct.pack("<I4s", len(data), b"BIN\0") + data)
