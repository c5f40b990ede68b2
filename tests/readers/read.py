"""Reads a picture with all layers back with OpenEXR, OpenImageIO and Blender, compares, and writes docs/layers.md.

    python tests/readers/read.py --rtr-dir target/release --blender PYTHON

It runs where `OpenEXR`, `OpenImageIO` and `numpy` are; PYTHON is an interpreter with `bpy`, which needs an older numpy
than OpenImageIO does. `.ci/readers` makes both. Where Open Image Denoise is found, the pictures are denoised as well. A
difference ends it with a message and exit code 1, and nothing is written.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from importlib.metadata import version
from pathlib import Path

import numpy as np
import OpenEXR
import OpenImageIO as oiio

HERE = Path(__file__).resolve().parent
PAGE = HERE.parent.parent / "docs" / "layers.md"
LAYERS = "albedo,normal,depth,position,uv,object,instance,material,crypto,samples,alpha"
SIZE = (96, 72)
NAMES = ["Cube", "crumbs", "pane"]
MATTES = ["CryptoObject", "CryptoInstance", "CryptoMaterial"]
# Layer, its components there, and the plain names of them.
ROWS = [
    ("Combined", "RGBA", ["R", "G", "B", "A"]),
    ("Denoising Albedo", "RGB", ["albedo.R", "albedo.G", "albedo.B"]),
    ("Denoising Normal", "XYZ", ["N.X", "N.Y", "N.Z"]),
    ("Depth", "Z", ["Z"]),
    ("Position", "XYZ", ["P.X", "P.Y", "P.Z"]),
    ("UV", "UVA", ["uv.U", "uv.V", "uv.A"]),
    ("Object Index", "X", ["object"]),
    ("Instance Index", "X", ["instance"]),
    ("Material Index", "X", ["material"]),
    ("Debug Sample Count", "X", ["samples"]),
] + [
    (f"{matte}{level:02}", "rgba", [f"{matte}{level:02}.{c}" for c in "rgba"]) for matte in MATTES for level in range(3)
]
NOISY = ("Noisy Image", "RGB", ["noisy.R", "noisy.G", "noisy.B"])


def check(what: str, ok: bool) -> None:
    """Ends the program when something is not as it should be."""
    if not ok:
        sys.exit(f"error: {what}")


def bits(plane: np.ndarray) -> np.ndarray:
    """Floats as whole numbers: those of Cryptomatte are no numbers to compare."""
    return np.ascontiguousarray(plane, dtype=np.float32).view(np.uint32)


def with_openexr(path: Path) -> tuple[dict, dict]:
    """Channels and texts."""
    file = OpenEXR.File(str(path), separate_channels=True)
    check(f"{path} has {len(file.parts)} parts", len(file.parts) == 1)
    planes = {name: channel.pixels for name, channel in file.channels().items()}
    return planes, {key: value for key, value in file.header().items() if isinstance(value, str)}


def with_oiio(path: Path) -> tuple[dict, dict]:
    """The same by OpenImageIO."""
    file = oiio.ImageInput.open(str(path))
    spec = file.spec()
    pixels = file.read_image("unknown")
    formats = spec.channelformats or [spec.format] * spec.nchannels
    names = spec.channelnames
    if len(set(map(str, formats))) > 1:
        planes = {n: file.read_image(0, 0, i, i + 1, formats[i])[:, :, 0] for i, n in enumerate(names)}
    else:
        planes = {name: pixels[:, :, i] for i, name in enumerate(names)}
    texts = {attribute.name: attribute.value for attribute in spec.extra_attribs}
    file.close()
    return planes, texts


def murmur3(text: str) -> int:
    """MurmurHash3_x86_32 with seed 0."""
    data, mask = text.encode(), 0xFFFFFFFF

    def scrambled(word: int) -> int:
        word = word * 0xCC9E2D51 & mask
        return (word << 15 | word >> 17) * 0x1B873593 & mask

    h, n = 0, len(data) // 4 * 4
    for i in range(0, n, 4):
        h ^= scrambled(int.from_bytes(data[i : i + 4], "little"))
        h = (h << 13 | h >> 19) & mask
        h = (h * 5 + 0xE6546B64) & mask
    h ^= scrambled(int.from_bytes(data[n:], "little")) ^ len(data)
    h = (h ^ h >> 16) * 0x85EBCA6B & mask
    h = (h ^ h >> 13) * 0xC2B2AE35 & mask
    return h ^ h >> 16


def number(name: str) -> int:
    """What stands for a name in Cryptomatte: its hash, as bits of a normal float."""
    h = murmur3(name)
    return h ^ 1 << 23 if h >> 23 & 0xFF in (0, 0xFF) else h


def coverage(planes: dict, layer: str, wanted: int | None = None) -> np.ndarray:
    """Sum of the shares of a name, or of all, in each pixel."""
    total = np.zeros(SIZE[::-1], dtype=np.float64)
    for level in range(3):
        for name, share in ("rg", "ba"):
            here = planes[f"{layer}{level:02}.{share}"].astype(np.float64)
            is_it = True if wanted is None else bits(planes[f"{layer}{level:02}.{name}"]) == np.uint32(wanted)
            total += np.where(is_it, here, 0.0)
    return total


def cryptomatte(planes: dict, texts: dict, prefix: str, alpha: str) -> int:
    """Checks what readers of Cryptomatte rely on; how many names the manifests have."""
    n = 0
    for matte in MATTES:
        layer = prefix + matte
        key = f"cryptomatte/{number(layer):08x}"[: len("cryptomatte/") + 7]
        said = [texts.get(f"{key}/{what}") for what in ("name", "hash", "conversion")]
        check(f"{key}: {said}", said == [layer, "MurmurHash3_32", "uint32_to_float32"])
        manifest = json.loads(texts[f"{key}/manifest"])
        check(f"{layer}: hashes of names", all(int(h, 16) == number(name) for name, h in manifest.items()))
        ids = {int(h, 16) for h in manifest.values()} | {0}
        for level in range(3):
            for c in "rb":
                found = set(np.unique(bits(planes[f"{layer}{level:02}.{c}"])).tolist())
                check(f"{layer}{level:02}.{c}: ids beside the manifest", found <= ids)
        error = np.abs(coverage(planes, layer) - planes[alpha]).max()
        check(f"{layer}: coverage is {error} from alpha", error < 1e-6)
        n += len(manifest)
    check("the hash of Cube", f"{number('Cube'):08x}" == "a8fce865")
    return n


def in_blender(python: str, path: Path, prefix: str, planes: dict, rows: list, plain: bool) -> dict:
    """What Blender reads, compared with `planes`; the names it gives to passes."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        wanted = f"{prefix}CryptoObject:{','.join(NAMES)}"
        command = [python, str(HERE / "blender.py"), str(path), wanted, name, json.dumps(SIZE)]
        run = subprocess.run(command, capture_output=True, text=True)
        check(f"Blender: {run.stdout}{run.stderr}", (folder / "blender.json").is_file())
        found = json.loads((folder / "blender.json").read_text())
        check(f"Blender takes it for {found['type']}", found["type"] == "MULTILAYER")
        read = {}
        for part in OpenEXR.File(str(folder / "passes.exr"), separate_channels=True).parts:
            read |= {channel: plane.pixels for channel, plane in part.channels.items()}
        for layer, components, names in rows:
            title = {"R": "Combined", "Z": "Depth"}.get(names[0], names[0].split(".")[0]) if plain else layer
            own = names if plain else [f"ViewLayer.{layer}.{c}" for c in components]
            ends = {1: "V", 3: "XYZ" if f"{title}.X" in read else "RGB", 4: "RGBA"}[len(own)]
            ends = components if components == "rgba" else ends
            for mine, end in zip(own, ends):
                check(f"Blender has no {title}.{end}", f"{title}.{end}" in read)
                same = np.array_equal(bits(read[f"{title}.{end}"]), bits(planes[mine]))
                check(f"Blender reads other values of {mine}", same)
        for name in NAMES:
            matte = OpenEXR.File(str(folder / f"{name}.exr"), separate_channels=True).parts[0].channels
            matte = matte["Matte.V"].pixels
            share = coverage(planes, prefix + "CryptoObject", number(name))
            check(f"Blender's matte of {name}", np.abs(matte - share).max() < 1e-6 and share.max() == 1.0)
        return found


def render(tools: Path, folder: Path, style: str) -> Path:
    """A picture with all layers; denoised, if that can be."""
    path = folder / f"{style}.exr"
    command = [tools / "rtr", folder / "room.pack", "--device", "cpu", "--layers", LAYERS, "--layer-names", style]
    command += ["-o", path, "--quiet"]
    denoised = subprocess.run([*command, "--denoise"], capture_output=True, text=True)
    if denoised.returncode != 0:
        print(denoised.stderr.strip())
        subprocess.run(command, check=True)
    return path


HEAD = """# Layers in other programs

Made by `.ci/readers`; edit `tests/readers/read.py`, not this page.

`rtr` writes `tests/readers/room.rts` with all [layers](guide.md#layers), in both styles of names; other programs read \
the files. What is not as it should be ends the command, and this page stays as it was. `cargo test --workspace \
--test layers --test denoise` reads such files with the crate `exr`, which also writes them.

| style | reader | channels | what was compared |
|---|---|---|---|
"""


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--rtr-dir", type=Path, required=True, help="folder of rtc and rtr")
    parser.add_argument("--blender", required=True, help="python with bpy")
    args = parser.parse_args()
    tools = args.rtr_dir.resolve()
    text, passes = HEAD, {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        subprocess.run([tools / "rtc", HERE / "room.rts", "-o", folder / "room.pack"], check=True, capture_output=True)
        for style, prefix in (("blender", "ViewLayer."), ("plain", "")):
            plain = style == "plain"
            path = render(tools, folder, style)
            planes, texts = with_openexr(path)
            denoiser = texts.get("denoiser")
            rows = ROWS + [NOISY] if denoiser else ROWS
            expected = {
                n for layer, cs, names in rows for n in (names if plain else [f"ViewLayer.{layer}.{c}" for c in cs])
            }
            check(f"OpenEXR: other channels: {expected ^ planes.keys()}", expected == planes.keys())
            n = cryptomatte(planes, texts, prefix, f"{prefix}{'A' if plain else 'Combined.A'}")
            alpha = planes["A" if plain else "ViewLayer.Combined.A"]
            check("alpha has no edges", alpha.min() == 0.0 and alpha.max() == 1.0 and len(np.unique(alpha)) > 4)
            own = (
                f"names of all channels; {n} names in the manifests: hashes, keys, numbers in the pixels; "
                "coverage adds up to alpha within 1e-6"
            )
            text += f"| {style} | OpenEXR {version('OpenEXR')} | {len(planes)} | {own} |\n"
            others, their_texts = with_oiio(path)
            check(f"OpenImageIO: other channels: {expected ^ others.keys()}", expected == others.keys())
            same = all(np.array_equal(bits(planes[c]), bits(others[c])) for c in expected)
            check("OpenImageIO reads other values than OpenEXR", same)
            cryptomatte(others, their_texts, prefix, f"{prefix}{'A' if plain else 'Combined.A'}")
            own = "the same, and every bit of every channel"
            text += f"| | OpenImageIO {version('OpenImageIO')} | {len(others)} | {own} |\n"
            found = in_blender(args.blender, path, prefix, planes, rows, plain)
            passes[style] = found["passes"]
            mattes = ", ".join(f"`{name}`" for name in NAMES)
            own = (
                f"{len(found['passes'])} passes of the multilayer reader, every bit of every channel; mattes of "
                f"{mattes} by the Cryptomatte node, within 1e-6 of the coverage"
            )
            text += f"| | Blender {found['version']} | {len(planes)} | {own} |\n"
    text += f"\nDenoised by {denoiser}.\n" if denoiser else "\nWithout a denoiser.\n"
    text += "\nPasses in Blender:\n\n"
    text += "".join(f"- {style}: {', '.join(f'`{p}`' for p in names)}\n" for style, names in passes.items())
    print(text)
    PAGE.write_text(text)


main()
