#!/usr/bin/env python3
"""A stage is written, converted and rendered beside the same scene in `.rts`; the pictures must agree.

    python tests/usd/check.py --rtr-dir target/release
"""

import argparse
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

import numpy as np
import OpenEXR
from pxr import Gf, Sdf, Usd, UsdGeom, UsdLux, UsdShade, Vt

SCRIPT = Path(__file__).resolve().parents[2] / "scenes/usd/usd_to_rts.py"
FILM = "film picture { size = (160, 120)px }\nrender main: path { camera = eye, film = picture, samples = 256 }\n"

# What the stage below is, as one would write it: centimetres and +Z up are gone.
BY_HAND = """rts 1
material red: principled { color = linear(0.8, 0.2, 0.1), roughness = 0.3 }
material floor: principled { color = linear(0.5, 0.5, 0.5), roughness = 0.5 }
instance ground { shape = rectangle(size: (4, 4)m), material = floor }
instance block { shape = box(size: (0.6, 0.6, 0.6)m), material = red, at = (-0.5, 0.3, 0)m, rotate = (0, 30, 0)deg }
instance tile[i in 0..3] {
  shape = rectangle(size: (0.2, 0.2)m)
  material = red
  at = (0.3 + 0.3 * i, 0.2 + 0.1 * i, 0.5)m
}
texture squares = image("squares.png", space: srgb)
material paint: principled { color = squares.rgb, roughness = 0.9 }
instance card { shape = quad(a: (-1.6, 0.1, 0.4)m, b: (-1, 0.1, 0.4)m, c: (-1, 0.7, 0.4)m), material = paint }
light bulb: sphere { center = (1, 1.5, 1)m, radius = 0.1m, color = linear(60, 50, 40) }
light panel: rectangle { at = (-1, 2, 0)m, direction = (0, -1, 0), size = (0.5, 0.8)m, color = linear(8) }
light sun: directional { direction = (0, 0.5, 0.8660254), angular_diameter = 5deg, color = linear(30, 28, 20), strength = 1 }
sky day: constant { color = linear(0.1, 0.15, 0.2) }
camera eye: perspective { from = (0, 2, 5)m, to = (0, 0.2, 0)m, fov.horizontal = 39.5977527deg }
"""


def look_at(eye, target):
    """The transform of a camera, +Z up."""
    return Gf.Matrix4d().SetLookAt(Gf.Vec3d(*eye), Gf.Vec3d(*target), Gf.Vec3d(0, 0, 1)).GetInverse()


def mesh(stage, path, points, faces, material=None):
    made = UsdGeom.Mesh.Define(stage, path)
    made.CreatePointsAttr(points)
    made.CreateFaceVertexCountsAttr([len(f) for f in faces])
    made.CreateFaceVertexIndicesAttr([i for f in faces for i in f])
    made.CreateSubdivisionSchemeAttr("none")
    if material:
        UsdShade.MaterialBindingAPI.Apply(made.GetPrim()).Bind(material)
    return made


def png(path, rows):
    """An image of 8 bits, rows of (red, green, blue) from the top."""
    raw = b"".join(b"\0" + bytes(x for pixel in row for x in pixel) for row in rows)
    head = struct.pack(">2I5B", len(rows[0]), len(rows), 8, 2, 0, 0, 0)
    chunks = [(b"IHDR", head), (b"IDAT", zlib.compress(raw)), (b"IEND", b"")]
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
        for name, data in chunks))


def squares(path):
    """Four colours, each a square of 32 x 32 pixels, so that filters do not show."""
    top = [[(220, 40, 40)] * 32 + [(40, 200, 60)] * 32] * 32
    png(path, top + [[(50, 60, 220)] * 32 + [(230, 220, 60)] * 32] * 32)


def card(stage):
    """A square with an image: its first corner shows the image's lower left one."""
    paint = UsdShade.Material.Define(stage, "/looks/paint")
    surface = UsdShade.Shader.Define(stage, "/looks/paint/surface")
    surface.CreateIdAttr("UsdPreviewSurface")
    image = UsdShade.Shader.Define(stage, "/looks/paint/image")
    image.CreateIdAttr("UsdUVTexture")
    image.CreateInput("file", Sdf.ValueTypeNames.Asset).Set("./squares.png")
    rgb = image.CreateOutput("rgb", Sdf.ValueTypeNames.Float3)
    surface.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).ConnectToSource(rgb)
    surface.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(0.9)
    paint.CreateSurfaceOutput().ConnectToSource(surface.ConnectableAPI(), "surface")
    corners = [(-160, -40, 10), (-100, -40, 10), (-100, -40, 70), (-160, -40, 70)]
    made = mesh(stage, "/card", corners, [(0, 1, 2, 3)], paint)
    st = UsdGeom.PrimvarsAPI(made).CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray, "faceVarying")
    st.Set([(0, 0), (1, 0), (1, 1), (0, 1)])


def square(half):
    return [(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)]


def write(path):
    """Centimetres, +Z up: y of the picture is z here, and z is -y."""
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    red = UsdShade.Material.Define(stage, "/looks/red")
    shader = UsdShade.Shader.Define(stage, "/looks/red/surface")
    shader.CreateIdAttr("UsdPreviewSurface")
    shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set((0.8, 0.2, 0.1))
    shader.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(0.3)
    red.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
    ground = mesh(stage, "/ground", square(200), [(0, 1, 2, 3)])
    ground.CreateDisplayColorAttr([(0.5, 0.5, 0.5)])
    # Left-handed, so that its corners run the other way.
    ground.CreateFaceVertexIndicesAttr([3, 2, 1, 0])
    ground.CreateOrientationAttr("leftHanded")
    UsdGeom.Xform.Define(stage, "/group").AddTranslateOp().Set((-50, 0, 30))
    block = UsdGeom.Cube.Define(stage, "/group/block")
    block.CreateSizeAttr(60)
    UsdShade.MaterialBindingAPI.Apply(block.GetPrim()).Bind(red)
    block.AddRotateZOp().Set(30)
    tiles = UsdGeom.PointInstancer.Define(stage, "/tiles")
    mesh(stage, "/tiles/tile", square(10), [(0, 1, 2, 3)], red)
    tiles.CreatePrototypesRel().SetTargets(["/tiles/tile"])
    tiles.CreatePositionsAttr([(30 + 30 * i, -50, 20 + 10 * i) for i in range(3)])
    tiles.CreateProtoIndicesAttr(Vt.IntArray([0, 0, 0]))
    card(stage)
    hidden = mesh(stage, "/hidden", square(500), [(0, 1, 2, 3)])
    hidden.MakeInvisible()
    bulb = UsdLux.SphereLight.Define(stage, "/bulb")
    bulb.CreateRadiusAttr(10)
    bulb.CreateColorAttr((1, 50 / 60, 40 / 60))
    bulb.CreateIntensityAttr(15)
    bulb.CreateExposureAttr(2)
    bulb.AddTranslateOp().Set((100, -100, 150))
    panel = UsdLux.RectLight.Define(stage, "/panel")
    panel.CreateWidthAttr(50)
    panel.CreateHeightAttr(80)
    panel.CreateNormalizeAttr(True)
    panel.CreateIntensityAttr(8 * 50 * 80)
    panel.AddTranslateOp().Set((-100, 0, 200))
    sun = UsdLux.DistantLight.Define(stage, "/sun")
    sun.CreateAngleAttr(5)
    sun.CreateIntensityAttr(30)
    sun.CreateColorAttr((1, 28 / 30, 20 / 30))
    # It shines along its own -z: from half up and in front.
    sun.AddRotateXOp().Set(60)
    dome = UsdLux.DomeLight.Define(stage, "/dome")
    dome.CreateColorAttr((0.1, 0.15, 0.2))
    camera = UsdGeom.Camera.Define(stage, "/eye")
    camera.AddTransformOp().Set(look_at((0, -500, 200), (0, 0, 20)))
    camera.CreateFocalLengthAttr(50)
    camera.CreateHorizontalApertureAttr(36)
    camera.CreateVerticalApertureAttr(27)
    stage.GetRootLayer().Save()


def picture(folder, text, rtr_dir, seed):
    """Red, green and blue [y, x, channel]."""
    pack, out = text.with_suffix(".pack"), text.with_suffix(".exr")
    subprocess.run([rtr_dir / "rtc", text, "-o", pack, "--no-cache"], check=True, cwd=folder)
    subprocess.run([rtr_dir / "rtr", pack, "--device", "cpu", "--quiet", "--size", "160x120", "--spp", "256", "--seed",
                    str(seed), "-o", out], check=True, cwd=folder)
    with OpenEXR.File(str(out), separate_channels=True) as file:
        return np.stack([file.channels()[c].pixels for c in "RGB"], axis=-1).astype(float)


def blocks(pictures, n=20):
    """Means of blocks of pixels [picture, block, channel]."""
    k, h, w, c = pictures.shape
    return pictures.reshape(k, h // n, n, w // n, n, c).mean(axis=(2, 4)).reshape(k, -1, c)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rtr-dir", type=lambda p: Path(p).resolve(), required=True)
    parser.add_argument("--look", type=Path, help="keep the files here")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = (args.look or Path(temporary)).resolve()
        stage, text, hand = folder / "stage.usda", folder / "stage.rts", folder / "hand.rts"
        stage.unlink(missing_ok=True)
        squares(folder / "squares.png")
        write(stage)
        subprocess.run([sys.executable, SCRIPT, stage, "-o", text], check=True)
        hand.write_text(BY_HAND + FILM)
        both = [np.array([picture(folder, t, args.rtr_dir, seed) for seed in range(1, 5)]) for t in (text, hand)]
    a, b = (blocks(pictures) for pictures in both)
    error = np.sqrt(a.var(axis=0, ddof=1) / len(a) + b.var(axis=0, ddof=1) / len(b))
    off = a.mean(axis=0) - b.mean(axis=0)
    relative = abs(off).max() / b.mean()
    # Blocks have few replicates: their errors are pooled.
    z = np.sqrt((off**2).sum() / (error**2).sum())
    print(f"{off.shape[0]} blocks: rms of z {z:.2f}, largest difference {100 * relative:.2f} % of the mean")
    if z > 1.5:
        sys.exit("error: the stage and the scene by hand differ")


if __name__ == "__main__":
    main()
