"""Meshes and images of the scenes → files that both renderers read."""

import struct
import zlib

import numpy as np

import model


def write_png(path, pixels):
    """An 8-bit RGB PNG of [y, x, channel]."""
    pixels = np.asarray(pixels, dtype=np.uint8)
    height, width = pixels.shape[:2]
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
                     + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def write_obj(path, mesh):
    """A Wavefront OBJ with the geometric normal at every corner."""
    lines = ["# Written by `tests/validation/validate.py`."]
    for i, corners in enumerate(mesh.corners):
        p = [np.array(position) for position, _ in corners]
        normal = np.cross(p[1] - p[0], p[2] - p[0])
        normal /= np.linalg.norm(normal)
        lines += [f"v {x:.7g} {y:.7g} {z:.7g}" for x, y, z in p]
        lines += [f"vt {u:.7g} {v:.7g}" for _, (u, v) in corners]
        lines.append("vn {:.7g} {:.7g} {:.7g}".format(*normal))
        at = range(3 * i + 1, 3 * i + 4)
        lines.append("f " + " ".join(f"{k}/{k}/{i + 1}" for k in at))
    path.write_text("\n".join(lines) + "\n")


def write(scene, folder):
    """Every file that the scene names."""
    for t in scene.things:
        if isinstance(t.shape, model.Mesh):
            write_obj(folder / f"{t.shape.name}.obj", t.shape)
    for m in scene.materials.values():
        if isinstance(m, model.Textured):
            write_png(folder / f"{m.name}.png", m.texels)
