"""A neutral scene → `.rts` text, and its picture through `rtc` and `rtr`."""

import subprocess
import time
from pathlib import Path

import mitsuba as mi
import numpy as np

import model
from model import SIZE


def numbers(values):
    return "(" + ", ".join(f"{v:.9g}" for v in values) + ")"


def color(values):
    return "linear" + numbers(values)


def material(name, m):
    match m:
        case model.Diffuse():
            body = f"diffuse {{ color = {color(m.color)} }}"
        case model.Textured():
            body = f"diffuse {{ color = {m.name}.rgb }}"
        case model.Metal():
            body = f"principled {{ color = {color(m.color)}, metallic = 1, roughness = {m.roughness}, compensation = off }}"
        case model.Conductor():
            fields = f"color = {color(m.color)}, roughness = {m.roughness}, compensation = off"
            body = f"conductor {{ {fields} }}"
        case model.Glass():
            rough = f", roughness = {m.roughness}, compensation = off" if m.roughness else ""
            inside = f", interior = in_{name}" if m.interior else ""
            body = f"dielectric {{ ior = {m.ior}{rough}{inside} }}"
        case model.Lamp():
            body = f"emissive {{ color = {color(m.radiance)}, sides = front }}"
        case _:
            raise TypeError(m)
    return f"material {name}: {body}"


def medium(name, m):
    fields = [f"{key} = {numbers(v)}/m" for key, v in (("sigma_a", m.sigma_a), ("sigma_s", m.sigma_s))
              if any(v)]
    if m.g:
        fields.append(f"g = {m.g}")
    return f"medium in_{name}: homogeneous {{ {', '.join(fields)} }}"


def shape(s):
    match s:
        case model.Sphere():
            return f"sphere(radius: {s.radius}m)"
        case model.Rectangle():
            return f"rectangle(size: {numbers((s.x, s.z))}m)"
        case model.Box():
            return f"box(size: {numbers((s.x, s.y, s.z))}m)"
        case model.Mesh():
            return s.name
    raise TypeError(s)


def thing(index, t):
    fields = [f"shape = {shape(t.shape)}", f"material = {t.material}"]
    if any(t.at):
        fields.append(f"at = {numbers(t.at)}m")
    if any(t.rotate):
        fields.append(f"rotate = {numbers(t.rotate)}deg")
    return f"instance thing{index} {{ {', '.join(fields)} }}"


def light(index, s):
    fields = f"center = {numbers(s.center)}m, radius = {s.radius}m, color = {color(s.radiance)}"
    return f"light light{index}: sphere {{ {fields} }}"


def camera(c):
    fields = [f"from = {numbers(c.origin)}m", f"to = {numbers(c.to)}m", f"fov.vertical = {c.fov}deg"]
    if c.aperture:
        fields += [f"aperture = {c.aperture}m", f"focus = {c.focus}m"]
    return f"camera eye: perspective {{ {', '.join(fields)} }}"


def text(scene):
    """The whole file."""
    lines = ["rts 1", f"/// Written by `tests/validation/validate.py`: {scene.tests}.", ""]
    meshes = {t.shape.name for t in scene.things if isinstance(t.shape, model.Mesh)}
    images = [m.name for m in scene.materials.values() if isinstance(m, model.Textured)]
    lines += [f'asset {name} = obj("{name}.obj", unit: m, up: +y)' for name in sorted(meshes)]
    lines += [f'texture {name} = image("{name}.png", space: srgb)' for name in images]
    lines += [medium(name, m.interior) for name, m in scene.materials.items()
              if isinstance(m, model.Glass) and m.interior]
    lines += [material(name, m) for name, m in scene.materials.items()]
    lines += [thing(i, t) for i, t in enumerate(scene.things)]
    lines += [light(i, s) for i, s in enumerate(scene.lights)]
    if scene.sky:
        lines.append(f"sky above: constant {{ color = {color(scene.sky)} }}")
    lines += [
        camera(scene.camera),
        f"film small {{ size = {numbers(SIZE)}px }}",
        f"render main: path {{ samples = {scene.spp}, depth = {scene.depth} }}",
    ]
    return "\n".join(lines) + "\n"


class Renderer:
    """`rtc` and `rtr` of one folder."""

    def __init__(self, folder, work, threads):
        self.rtc, self.rtr = Path(folder) / "rtc", Path(folder) / "rtr"
        self.work, self.threads = Path(work), threads

    def version(self):
        run = subprocess.run([self.rtr, "--version"], check=True, capture_output=True, text=True)
        return run.stdout.strip()

    def write(self, scene, path):
        """Writes the scene as `rtc fmt` would have it."""
        path.write_text(text(scene))
        subprocess.run([self.rtc, "fmt", path], check=True)

    def pictures(self, path, replicates, spp):
        """Independent pictures as [replicate, y, x, channel], and the seconds they took.

        Each has a seed of its own rather than samples of its own: nothing that stratifies the
        samples of one seed can then tie replicates together.
        """
        pack = self.work / (path.stem + ".pack")
        subprocess.run([self.rtc, path, "-o", pack], check=True, capture_output=True)
        pictures = []
        start = time.monotonic()
        for seed in range(replicates):
            exr = self.work / (path.stem + ".exr")
            subprocess.run(
                [self.rtr, pack, "--device", "cpu", "--quiet", "--threads", str(self.threads),
                 "--spp", str(spp), "--seed", str(seed), "-o", exr], check=True)
            picture = np.array(mi.Bitmap(str(exr)), dtype=np.float64)
            assert picture.shape == (SIZE[1], SIZE[0], 3), picture.shape
            pictures.append(picture)
        return np.array(pictures), time.monotonic() - start
