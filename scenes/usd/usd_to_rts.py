#!/usr/bin/env python3
"""Turns a USD stage into a scene text and a glTF file that `rtc` compiles.

    python3 -m venv venv && venv/bin/pip install usd-core
    venv/bin/python scenes/usd/usd_to_rts.py kitchen.usdz -o kitchen.rts
    rtc kitchen.rts && rtr kitchen.pack

writes kitchen.rts with lights and camera, and kitchen.glb with meshes and materials. Each thing that is left out is
said in a line.
"""

import argparse
import math
import shutil
import sys
from pathlib import Path

from pxr import Gf, Tf, Usd, UsdGeom, UsdLux, UsdShade

import meshes
from glb import Glb
from surfaces import Surfaces

# Sides of the polygon that a disk light becomes.
DISK = 48


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("stage", type=Path, help="a .usd, .usda, .usdc or .usdz file")
    parser.add_argument("-o", "--output", type=Path,
                        help="the scene text [default: the stage's name in the working folder]")
    parser.add_argument("--time", type=float, help="time code of the moment that is shown [default: the first]")
    parser.add_argument("--camera", help="path or name of the camera [default: the first]")
    args = parser.parse_args()
    if args.output is None:
        args.output = Path(args.stage.stem + ".rts")
    if args.output.suffix != ".rts":
        parser.error("the output is a scene text: its name ends in .rts")
    return args


def numbers(values):
    return "(" + ", ".join(f"{x:.7g}" for x in values) + ")"


class Converter:
    """A stage, and what has been made of it."""

    def __init__(self, stage, args):
        self.stage, self.args, self.said = stage, args, set()
        self.time = Usd.TimeCode(stage.GetStartTimeCode() if args.time is None else args.time)
        self.cache = UsdGeom.XformCache(self.time)
        self.glb = Glb()
        self.surfaces = Surfaces(self.glb, self.time, self.say)
        self.meshes, self.lines, self.cameras = {}, [], []
        self.scale = UsdGeom.GetStageMetersPerUnit(stage)
        s, is_z_up = self.scale, UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z
        y, z = ((0, 0, -s), (0, s, 0)) if is_z_up else ((0, s, 0), (0, 0, s))
        # Rows: where the axes of the stage point in metres and +Y up.
        self.root = Gf.Matrix4d(s, 0, 0, 0, *y, 0, *z, 0, 0, 0, 0, 1)

    def say(self, text):
        """A line about what is left out, once."""
        if text not in self.said:
            self.said.add(text)
            print(f"note: {text}", file=sys.stderr)

    def world(self, prim):
        """From the frame of a prim to that of the scene; rows, as USD has them."""
        return self.cache.GetLocalToWorldTransform(prim) * self.root

    def run(self):
        prims = iter(Usd.PrimRange(self.stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()))
        for prim in prims:
            if prim.IsA(UsdGeom.Imageable) and not self.is_seen(prim):
                continue
            if prim.IsA(UsdGeom.PointInstancer):
                prims.PruneChildren()
                self.instances(UsdGeom.PointInstancer(prim))
            elif prim.IsA(UsdGeom.Mesh) or prim.IsA(UsdGeom.Cube):
                self.thing(prim, self.world(prim))
            elif prim.IsA(UsdGeom.Camera):
                self.cameras.append(UsdGeom.Camera(prim))
            elif prim.HasAPI(UsdLux.LightAPI):
                self.light(prim)
            elif prim.IsA(UsdGeom.Gprim):
                self.say(f"{prim.GetPath()}: a {prim.GetTypeName()} is left out; make it a mesh")

    def is_seen(self, prim):
        imageable = UsdGeom.Imageable(prim)
        hidden = (UsdGeom.Tokens.guide, UsdGeom.Tokens.proxy)
        return (imageable.ComputeVisibility(self.time) != UsdGeom.Tokens.invisible
                and imageable.ComputePurpose() not in hidden)

    # Geometry

    def thing(self, prim, matrix):
        """A place of a mesh."""
        mesh = self.mesh(prim)
        if mesh is not None:
            self.glb.node(str(prim.GetPath()), mesh, [x for row in matrix for x in row])

    def mesh(self, prim):
        """The index of its mesh; instances that look the same share theirs."""
        source = prim.GetPrimInPrototype() if prim.IsInstanceProxy() else prim
        key = source.GetPath(), self.material(prim)
        if key not in self.meshes:
            primitives = [self.glb.primitive(corners, material) for corners, material in self.parts(prim) if corners]
            self.meshes[key] = self.glb.mesh(prim.GetName(), primitives) if primitives else None
        return self.meshes[key]

    def parts(self, prim):
        if prim.IsA(UsdGeom.Cube):
            yield meshes.cube(UsdGeom.Cube(prim).GetSizeAttr().Get(self.time)), self.material(prim)
            return
        mesh = UsdGeom.Mesh(prim)
        for part, faces in meshes.faces_of(mesh, self.time):
            yield meshes.triangles(mesh, self.time, faces), self.material(part)

    def material(self, prim):
        bound, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
        if bound:
            return self.surfaces.index(bound)
        color = UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance("displayColor")
        values = color.ComputeFlattened(self.time) if color and color.HasValue() else None
        if values and len(values) > 1:
            self.say(f"{prim.GetPath()}: one of its {len(values)} display colours is taken")
        return self.surfaces.plain(values[0]) if values else None

    def instances(self, instancer):
        """Every place of the prototypes of a point instancer."""
        places = instancer.ComputeInstanceTransformsAtTime(self.time, self.time)
        world, paths = self.world(instancer.GetPrim()), instancer.GetPrototypesRel().GetTargets()
        for which, place in zip(instancer.GetProtoIndicesAttr().Get(self.time) or [], places or []):
            top = self.stage.GetPrimAtPath(paths[which])
            up = self.cache.GetLocalToWorldTransform(top.GetParent()).GetInverse()
            for prim in Usd.PrimRange(top, Usd.TraverseInstanceProxies()):
                if prim.IsA(UsdGeom.Mesh) or prim.IsA(UsdGeom.Cube):
                    # Places hold the prototype's own transform already.
                    own = self.cache.GetLocalToWorldTransform(prim) * up
                    rest = self.cache.GetLocalTransformation(top)[0].GetInverse()
                    self.thing(prim, own * rest * place * world)

    # Lights

    def light(self, prim):
        api, matrix = UsdLux.LightAPI(prim), self.world(prim)
        get = lambda name, default: self.attribute(prim, name, default)  # noqa: E731
        color = Gf.Vec3f(get("inputs:color", Gf.Vec3f(1)))
        if get("inputs:enableColorTemperature", False):
            color = Gf.CompMult(color, UsdLux.BlackbodyTemperatureAsRgb(get("inputs:colorTemperature", 6500.0)))
        strength = get("inputs:intensity", 1.0) * 2 ** get("inputs:exposure", 0.0)
        name = f"light{len(self.lines)}"
        kind = prim.GetTypeName()
        make = {"SphereLight": self.sphere, "RectLight": self.rectangle, "DiskLight": self.disk,
                "DistantLight": self.distant, "DomeLight": self.dome, "DomeLight_1": self.dome}.get(kind)
        if make is None or not api:
            self.say(f"{prim.GetPath()}: a {kind or 'light'} is left out")
            return
        self.lines.append(make(name, get, matrix, [strength * x for x in color]))

    def attribute(self, prim, name, default):
        attribute = prim.GetAttribute(name)
        value = attribute.Get(self.time) if attribute else None
        return default if value is None else value

    def stretch(self, matrix, axis):
        """The length of an axis in the scene, stage units."""
        return matrix.TransformDir(Gf.Vec3d(*(float(k == axis) for k in range(3)))).GetLength() / self.scale

    def radiance(self, get, color, area):
        """A normalised light spreads its intensity over its area, square units of the stage."""
        return [x / area for x in color] if get("inputs:normalize", False) else color

    def sphere(self, name, get, matrix, color):
        radius = get("inputs:radius", 0.5) * self.stretch(matrix, 0)
        color = self.radiance(get, color, 4 * math.pi * radius**2)
        at = matrix.ExtractTranslation()
        return (f"light {name}: sphere {{ center = {numbers(at)}m, radius = {radius * self.scale:.7g}m, "
                f"color = linear{numbers(color)} }}")

    def panel(self, name, shape, color):
        return (f"material {name}: emissive {{ color = linear{numbers(color)}, sides = front }}\n"
                f"instance {name}_panel {{ shape = {shape}, material = {name} }}")

    def rectangle(self, name, get, matrix, color):
        w, h = get("inputs:width", 1.0), get("inputs:height", 1.0)
        if get("inputs:texture:file", None):
            self.say(f"{name}: the texture of a rectangular light is left out")
        color = self.radiance(get, color, w * h * self.stretch(matrix, 0) * self.stretch(matrix, 1))
        # It shines towards -z.
        a, b, c = (matrix.Transform(Gf.Vec3d(x * w / 2, y * h / 2, 0)) for x, y in ((-1, -1), (-1, 1), (1, 1)))
        return self.panel(name, f"quad(a: {numbers(a)}m, b: {numbers(b)}m, c: {numbers(c)}m)", color)

    def disk(self, name, get, matrix, color):
        """A polygon of the same area."""
        radius = get("inputs:radius", 0.5)
        color = self.radiance(get, color, math.pi * radius**2 * self.stretch(matrix, 0) * self.stretch(matrix, 1))
        step = 2 * math.pi / DISK
        reach = radius * math.sqrt(step / math.sin(step))
        corner = [Gf.Vec3d(reach * math.cos(k * step), -reach * math.sin(k * step), 0) for k in range(DISK)]
        points = ", ".join(f"{numbers(matrix.Transform(p))}m" for p in [Gf.Vec3d(0), *corner])
        faces = ", ".join(f"(0, {1 + k}, {1 + (k + 1) % DISK})" for k in range(DISK))
        return self.panel(name, f"mesh(points: [{points}], faces: [{faces}])", color)

    def distant(self, name, get, matrix, color):
        angle = max(get("inputs:angle", 0.53), 0.01)
        color = self.radiance(get, color, math.pi * math.sin(math.radians(angle / 2)) ** 2)
        towards = matrix.TransformDir(Gf.Vec3d(0, 0, 1)).GetNormalized()
        return (f"light {name}: directional {{ direction = {numbers(towards)}, angular_diameter = {angle:.7g}deg, "
                f"color = linear{numbers(color)}, strength = 1 }}")

    def dome(self, name, get, matrix, color):
        if any(line.startswith("sky ") for line in self.lines):
            self.say(f"{name}: a scene has one sky; this one is left out")
            return ""
        file = get("inputs:texture:file", None)
        path = Path(file.resolvedPath or file.path) if file else None
        if path is None:
            return f"sky {name}: constant {{ color = linear{numbers(color)} }}"
        if not path.is_file():
            self.say(f"{name}: there is no file {path}")
            return f"sky {name}: constant {{ color = linear{numbers(color)} }}"
        if max(color) - min(color) > 1e-6 * max(color):
            self.say(f"{name}: the tint of the sky's image is left out")
        copy = self.args.output.with_name(self.args.output.stem + path.suffix)
        if copy.resolve() != path.resolve():
            shutil.copyfile(path, copy)
        # The middle of the image lies towards +z.
        axis = matrix.TransformDir(Gf.Vec3d(0, 0, 1))
        turn = 180 + math.degrees(math.atan2(axis[0], axis[2]))
        strength = sum(color) / 3
        return f'sky {name}: image {{ file = "{copy.name}", rotate = {turn:.7g}deg, strength = {strength:.7g} }}'

    # View

    def camera(self):
        """The camera's line, and the size of the film."""
        wanted = self.args.camera
        found = [c for c in self.cameras if wanted in (None, str(c.GetPath()), c.GetPrim().GetName())]
        if wanted and not found:
            names = ", ".join(str(c.GetPath()) for c in self.cameras) or "none"
            sys.exit(f"error: there is no camera {wanted}; there are: {names}")
        if not found:
            return ("camera eye: perspective { from = (2, 1.4, 3)m, to = (0, 0, 0)m, fit = stage }", (960, 540))
        camera = found[0]
        frame = camera.GetCamera(self.time).frustum
        world = self.world(camera.GetPrim())
        at = world.ExtractTranslation()
        view = world.TransformDir(Gf.Vec3d(0, 0, -1)).GetNormalized()
        up = world.TransformDir(Gf.Vec3d(0, 1, 0)).GetNormalized()
        # Lengths of a camera are tenths of a unit.
        tenth = 0.1 * self.scale
        focal, f_stop = camera.GetFocalLengthAttr().Get(self.time), camera.GetFStopAttr().Get(self.time)
        focus = camera.GetFocusDistanceAttr().Get(self.time) * self.scale or 1.0
        lens = ""
        if f_stop:
            lens = f", aperture = {focal * tenth / f_stop:.7g}m, focus = {focus:.7g}m"
        window = frame.window.GetSize()
        size = (960, max(1, round(960 * window[1] / window[0])))
        angle = 2 * math.degrees(math.atan(camera.GetHorizontalApertureAttr().Get(self.time) / (2 * focal)))
        if camera.GetProjectionAttr().Get() == UsdGeom.Tokens.orthographic:
            width = camera.GetHorizontalApertureAttr().Get(self.time) * tenth
            return (f"camera eye: orthographic {{ from = {numbers(at)}m, to = {numbers(at + view)}m, "
                    f"up = {numbers(up)}, width = {width:.7g}m }}", size)
        return (f"camera eye: perspective {{ from = {numbers(at)}m, to = {numbers(at + view * focus)}m, "
                f"up = {numbers(up)}, fov.horizontal = {angle:.7g}deg{lens} }}", size)

    def text(self):
        camera, size = self.camera()
        lines = ["rts 1", f"/// Made of {self.args.stage.name} by usd_to_rts.py.", ""]
        if self.glb.nodes:
            asset = self.args.output.with_suffix(".glb").name
            lines += [f'asset model = gltf("{asset}")', "instance stage { shape = model }"]
        lines += [line for line in self.lines if line]
        if not self.lines:
            self.say("there is no light: a sky is added")
            lines.append("sky day: gradient { }")
        return "\n".join([*lines, camera, f"film picture {{ size = {numbers(size)}px }}",
                          "render main: path { camera = eye, film = picture, samples = 256 }", ""])


def main():
    args = arguments()
    if not args.stage.is_file():
        sys.exit(f"error: there is no file {args.stage}")
    try:
        stage = Usd.Stage.Open(str(args.stage))
    except Tf.ErrorException:
        sys.exit(f"error: {args.stage} cannot be read as USD")
    made = Converter(stage, args)
    made.run()
    if not made.glb.nodes and not made.lines:
        sys.exit(f"error: {args.stage} has neither meshes nor lights")
    text = made.text()
    if made.glb.nodes:
        made.glb.write(args.output.with_suffix(".glb"))
    args.output.write_text(text)
    print(f"wrote {args.output}, {len(made.glb.nodes)} meshes, {len(made.glb.materials)} materials, "
          f"{len(made.lines)} lights")


if __name__ == "__main__":
    main()
