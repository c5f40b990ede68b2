#!/usr/bin/env python3
"""Renders each model of a folder with `rtr` and with Blender's Cycles, and compares the pictures tile by tile.

    python3 -m venv venv && venv/bin/pip install bpy==5.0.1 numpy OpenEXR
    cargo build --release -p compiler -p runtime
    venv/bin/python tests/models/against_cycles.py FOLDER --hdr SKY.hdr --rtr-dir target/release > docs/models.md

Models are glTF, OBJ, PLY and STL; all have the same sky, and a camera that shows all of it from one side. `--look
FOLDER` keeps the pictures.
"""

import argparse
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import OpenEXR

HERE = Path(__file__).resolve().parent
SIZE, TILE = (320, 240), 40
FOV, DEPTH = 35.0, 12
FORMATS = {".glb": "gltf", ".gltf": "gltf", ".obj": "obj", ".ply": "ply", ".stl": "stl"}
# The crease angle of `rtc`, degrees: normals of files without them are smooth across flatter edges.
CREASE = 60
# Above this share of the light of a tile, on average, the page says why.
LIMIT = 0.05
ROUGH_METAL = "rough metal, see below"
# By name of the model.
REASONS = {
    "GolfBall": "its coat has a normal map of its own, which is not used here",
    "box_sparse": ROUGH_METAL,
    "hp-mixed-reality": "black plastic, see below",
    "pico-4u": "noise in both: smooth surfaces reflect the sun onto each other",
    "sphere": ROUGH_METAL,
    "torus": ROUGH_METAL,
    "cornellbox_suzanne": "its material library is not there: grey of 0.5 here, white in Blender",
    "cakeBirthday": ROUGH_METAL,
    "fuze": "`Ks 1` doubles the reflectance at normal incidence in Blender (Specular IOR Level 1); here it is that of index 1.5",
}

PAGE = """# Models beside Cycles

<!-- Printed by `tests/models/against_cycles.py`. -->

Each model as it is, in `rtr` and in Blender {blender}'s Cycles: same sky, same camera, {size[0]} x {size[1]} pixels, {spp}
samples, paths of {depth} segments. What has no material is a diffuse grey of 0.5 in both, in glTF the white rough metal
of the specification; rigs stand as they are stored. The models are in no repository.

{table}

- **Mean, largest difference**: of the luminance of tiles of {tile} x {tile} pixels, over that of the tile in Cycles. Only
  tiles that show the model count.
- **Noise**: the mean difference that noise alone would give.
- Dark plastic is darker here: its gloss follows Schlick's formula, as glTF specifies, and not Fresnel's. Of light that comes
  at 60 degrees a refractive index of 1.5 reflects 7.0 % here and 8.9 % in Cycles.
- Rough metal, glTF's default: light that facets reflect more than once has a lobe of its own here (Kulla & Conty
  2017); Cycles makes the first reflection stronger. Beside light that walks from facet to facet (Heitz et al. 2016) the
  former is 2 % to 8 % off, the latter 10 % to 31 %: `cargo test -p tests --test scattering facets -- --nocapture`.

## Decoders

Files are read with these crates: written in Rust alone, so that no build needs another compiler, and tried with damaged
files, which `cargo test` repeats on small ones. A decoder that fails on a damaged file costs that file, not the program.

| crate | reads | seen | verdict |
| --- | --- | --- | --- |
| `draco-core` 2.3.3 | Draco | no unsafe code, ceilings on points, faces and bytes. Reads streams of Google's encoder; no panic on damaged ones | used |
| `draco-oxide-decoder` 0.1.0-alpha.12 | Draco | 50 more crates; a small damaged stream makes it ask for more memory than there is, which ends the process | not sound |
| `draco_decoder` 0.0.31, `draco-rs` 0.1.3 | Draco | bindings | need a C++ compiler |
| `basisu` 0.1.0 | KTX2 of Basis Universal | the texels of Binomial's transcoder. Damaged files can overflow an offset of the header, which is checked before; otherwise no panic | used without its Zstandard |
| `basis-universal` 0.3.1, `basisu_c_sys` 0.9.1 | KTX2 of Basis Universal | bindings | need a C++ compiler |
| `ktx2` 0.5.0 | the container of KTX2 | decodes no texels | of no use alone |
| `ruzstd` 0.9.1 | Zstandard | a limit on the window, and one block at a time, so that a small frame cannot become gigabytes, as it can in the 0.7 that `basisu` would take | used |
| `zstd` 0.14.4 | Zstandard | bindings | needs a C compiler |
| `meshoptimizer-rs` 0.2.17 | meshopt | limits on bytes and work | used |
| `image` 0.25 | WebP | limits on memory | used |
"""


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--hdr", type=Path, required=True, help="the sky, a lat-long image")
    parser.add_argument("--rtr-dir", type=lambda p: Path(p).resolve(), required=True)
    parser.add_argument("--spp", type=int, default=128)
    parser.add_argument("--seeds", type=int, default=3, help="pictures of each, two or more")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--only", nargs="+", help="models with these names")
    parser.add_argument("--look", type=Path, help="keep the pictures here")
    args = parser.parse_args()
    if not args.folder.is_dir():
        parser.error(f"{args.folder} is no folder")
    if not args.hdr.is_file():
        parser.error(f"there is no file {args.hdr}")
    return args


def luminance(path):
    with OpenEXR.File(str(path), separate_channels=True) as file:
        # Blender's has a prefix; of layers only the picture counts.
        found = {name.removeprefix("ViewLayer.Combined."): channel.pixels for name, channel in file.channels().items()}
    return sum(weight * found[c].astype(float) for c, weight in zip("RGB", (0.2126, 0.7152, 0.0722)))


class Refused(Exception):
    """A model that one of the two does not read, and what it says."""


def checked(command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise Refused((done.stderr.strip() or f"{command[0]} failed").splitlines()[0])
    return done


def scene(model, hdr, camera):
    """The scene around a model."""
    kind = FORMATS[model.suffix.lower()]
    unit = "" if kind == "gltf" else ", unit: m"
    return (f'rts 1\nasset model = {kind}("{model}"{unit})\ninstance all {{ shape = model }}\n'
            f'sky around: image {{ file = "{hdr}" }}\n{camera}\n'
            f"film picture {{ size = ({SIZE[0]}, {SIZE[1]})px }}\n"
            f"render main: path {{ camera = eye, film = picture, samples = 16, depth = {DEPTH} }}\n")


def view(model, hdr, args, work):
    """A camera from one side that sees all of the model."""
    text = work / "bounds.rts"
    text.write_text(scene(model, hdr, "camera eye: perspective { from = (0, 0, 9)m, to = (0, 0, 0)m }"))
    said = checked([args.rtr_dir / "rtc", "show", "--bounds", text])
    line = next(line for line in said.stdout.splitlines() if line.startswith("instance all"))
    ends = [np.array([float(x) for x in part.split(",")]) for part in re.findall(r"\(([^)]*)\)m", line)[:2]]
    middle, radius = (ends[0] + ends[1]) / 2, np.linalg.norm(ends[1] - ends[0]) / 2
    side = np.array([0.6, 0.4, 1.0])
    eye = middle + side / np.linalg.norm(side) * radius / np.sin(np.radians(FOV / 2))
    return eye.tolist(), middle.tolist()


def ours(model, args, eye, to, work):
    three = lambda p: "(" + ", ".join(f"{x:.9g}" for x in p) + ")m"  # noqa: E731
    text = work / "model.rts"
    text.write_text(scene(model, args.hdr.resolve(),
                          f"camera eye: perspective {{ from = {three(eye)}, to = {three(to)}, fov.vertical = {FOV}deg }}"))
    pack = work / "model.pack"
    said = checked([args.rtr_dir / "rtc", text, "-o", pack]).stderr
    pictures = []
    for seed in range(args.seeds):
        out = work / f"ours{seed}.exr"
        checked([args.rtr_dir / "rtr", pack, "--device", "cpu", "--quiet", "--threads", str(args.threads), "--spp",
                 str(args.spp), "--seed", str(seed), "--layers", "depth", "-o", out])
        pictures.append(luminance(out))
    return np.array(pictures), shows(out), said


def shows(path):
    """Where the model is: nothing else is near."""
    with OpenEXR.File(str(path), separate_channels=True) as file:
        return next(channel.pixels for name, channel in file.channels().items() if name.endswith("Depth.Z")) < 1e9


def theirs(model, args, eye, to, work):
    job, log = work / "job.json", work / "cycles.log"
    job.write_text(json.dumps({"model": str(model), "hdr": str(args.hdr.resolve()), "from": eye, "to": to, "fov": FOV,
                               "size": SIZE, "spp": args.spp, "seeds": args.seeds, "threads": args.threads,
                               "depth": DEPTH, "crease": CREASE,
                               "is_gltf": FORMATS[model.suffix.lower()] == "gltf", "out": str(work / "cycles")}))
    with open(log, "w") as file:
        done = subprocess.run([sys.executable, HERE / "in_cycles.py", job], stdout=file, stderr=file)
    if done.returncode:
        said = [line for line in log.read_text().splitlines() if "Error" in line] or ["it failed"]
        raise Refused(f"Blender: {said[-1].removeprefix('RuntimeError: ').removeprefix('Error: ')}")
    return np.array([luminance(work / f"cycles{seed}.exr") for seed in range(args.seeds)])


def tiles(pictures):
    """Means [picture, tile]."""
    k, h, w = pictures.shape
    return pictures.reshape(k, h // TILE, TILE, w // TILE, TILE).mean(axis=(2, 4)).reshape(k, -1)


def compare(model, args, work):
    """The row of a model."""
    hdr = args.hdr.resolve()
    eye, to = view(model, hdr, args, work)
    mine, seen, said = ours(model, args, eye, to, work)
    other = theirs(model, args, eye, to, work)
    shown = tiles(seen[None].astype(float))[0] > 0.1
    if not shown.any():
        raise Refused("no tile shows it: all of it is black, or too thin")
    a, b = tiles(mine)[:, shown], tiles(other)[:, shown]
    off = abs(a.mean(axis=0) - b.mean(axis=0)) / b.mean(axis=0)
    spread = np.sqrt((a.var(axis=0, ddof=1) + b.var(axis=0, ddof=1)) / args.seeds) / b.mean(axis=0)
    total = mine[:, seen].mean() / other[:, seen].mean() - 1
    mean = off.mean()
    reason = REASONS.get(model.stem, "")
    if mean > LIMIT and not reason:
        reason = "not known"
    warnings = len(re.findall(r"^warning", said, re.MULTILINE))
    return [f"`{model.name}`", f"{shown.sum()}", f"{100 * total:+.2f} %", f"{100 * mean:.2f} %", f"{100 * off.max():.1f} %",
            f"{100 * np.sqrt(2 / np.pi) * spread.mean():.2f} %", str(warnings), reason]


def main():
    args = arguments()
    models = sorted(p.resolve() for p in args.folder.iterdir() if p.suffix.lower() in FORMATS)
    rows = [["model", "tiles", "all of it", "mean difference", "largest", "noise", "warnings of `rtc`", "why"]]
    rows.append(["---"] * len(rows[0]))
    for model in models:
        if args.only and model.stem not in args.only:
            continue
        print(f"{model.name}", file=sys.stderr, flush=True)
        with tempfile.TemporaryDirectory() as temporary:
            work = Path(temporary) if args.look is None else args.look / model.stem
            work.mkdir(parents=True, exist_ok=True)
            try:
                rows.append(compare(model, args, work))
            except Refused as error:
                said = str(error).replace(f"{model.parent}/", "")
                rows.append([f"`{model.name}`", *["-"] * (len(rows[0]) - 2), said])
    import bpy

    table = "\n".join("| " + " | ".join(row) + " |" for row in rows)
    print(PAGE.format(blender=bpy.app.version_string, size=SIZE, spp=args.spp, depth=DEPTH, tile=TILE, table=table), end="")


if __name__ == "__main__":
    main()
