"""Comparisons → the page, the strips of pictures, and the statistics that the Rust test reads."""

import math
import struct
import zlib

import numpy as np

import compare
from model import SIZE

# Gain on the signed difference in the strips.
GAIN = 20


def write_png(path, rgb):
    """An 8-bit RGB PNG of values in 0 ..= 1, already coded for the screen."""
    pixels = (np.clip(rgb, 0, 1) * 255 + 0.5).astype(np.uint8)
    height, width = pixels.shape[:2]
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
                     + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def srgb(linear):
    c = np.clip(linear, 0, 1)
    return np.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - 0.055)


def strip(path, ours, theirs, scale=2):
    """Ours, theirs, and half grey plus GAIN times the difference over the mean radiance."""
    level = theirs.mean()
    difference = 0.5 + GAIN * (ours - theirs) / level * 0.5
    row = np.concatenate([srgb(ours), srgb(theirs), difference], axis=1)
    write_png(path, np.kron(row, np.ones((scale, scale, 1))))


def statistics(path, scene, pictures, version):
    """The block means of their picture, for the test that runs without them."""
    mean, variance = compare.estimate(compare.blocks(pictures))
    columns, rows = compare.BLOCKS
    lines = [f"# {scene.name}: {version}, {len(pictures)} replicates, {scene.spp} samples a pixel.",
             "# Written by `tests/validation/validate.py`; row, column, mean and standard error of "
             "red, green and blue.",
             f"blocks {columns} {rows}"]
    for y in range(rows):
        for x in range(columns):
            values = [f"{mean[y, x, k]:.6e} {math.sqrt(variance[y, x, k]):.2e}" for k in range(3)]
            lines.append(f"{y} {x}  " + "  ".join(values))
    path.write_text("\n".join(lines) + "\n")


def per_channel(values, form):
    return " ".join(format(v, form) for v in values)


def row(scene, c, spp, seconds, scenes):
    (ours, var_ours), (theirs, var_theirs) = c.ours, c.theirs
    relative = 100 * (ours - theirs) / theirs
    error = 100 * np.sqrt(var_ours + var_theirs) / theirs
    means = "<br>".join(f"{m:.5f} ± {math.sqrt(v):.5f}" for m, v in zip(ours, var_ours))
    others = "<br>".join(f"{m:.5f} ± {math.sqrt(v):.5f}" for m, v in zip(theirs, var_theirs))
    off = "<br>".join(f"{r:+.3f} ± {e:.3f}" for r, e in zip(relative, error))
    z = "<br>".join(f"{v:+.2f}" for v in c.mean_z)
    verdict = "agree" if c.passed(scenes) else "**differ**"
    return (f"| `{scene.name}` | {scene.tests} | {means} | {others} | {off} | {z} | "
            f"{100 * c.share:.2f} | {c.spread:.3f} | {c.worst_block:.1f} | {spp} | "
            f"{seconds[0]:.0f} / {seconds[1]:.0f} | {verdict} |")


def line(scene, c, scenes):
    """One line for the terminal."""
    relative = 100 * (c.ours[0] - c.theirs[0]) / c.theirs[0]
    error = 100 * np.sqrt(c.ours[1] + c.theirs[1]) / c.theirs[0]
    return (f"{scene.name:18} off % {per_channel(relative, '+.3f')} +- {per_channel(error, '.3f')}"
            f"  z {per_channel(c.mean_z, '+.2f')}  pixels {100 * c.share:.2f} %"
            f"  rms z {c.spread:.3f}  block {c.worst_block:.2f}"
            f"  {'agree' if c.passed(scenes) else 'DIFFER'}")


def page(rows, versions, command, replicates, scenes, masking):
    """`docs/validation.md`."""
    n = len(scenes)
    pixels = SIZE[0] * SIZE[1]
    several = 3 * compare.BLOCKS[0] * compare.BLOCKS[1] * n
    strips = "\n".join(f"| `{s.name}` | ![]({'validation/' + s.name + '.png'}) |" for s in scenes)
    return TEMPLATE.format(
        ours=versions[0], theirs=versions[1], command=command, replicates=replicates,
        width=SIZE[0], height=SIZE[1], share=100 * compare.SHARE, pixel_bound=compare.sidak(pixels),
        mean_bound=compare.sidak(3 * n), block_bound=compare.sidak(several), columns=compare.BLOCKS[0],
        rows=compare.BLOCKS[1], table="\n".join(rows), gain=GAIN, strips=strips, masking=masking)


TEMPLATE = """# Validation against Mitsuba 3

<!-- Written by `tests/validation/validate.py`. -->

Each scene is described once, in `tests/validation/catalog.py`. The script writes it as `.rts` for `rtc`
and as a dictionary for Mitsuba, renders both, and compares: the same camera, box filter and longest
path on both sides, {width} x {height} pixels, {replicates} independent replicates a side, from whose
spread all errors come.

    {command}

Ours: {ours}. Theirs: {theirs}.

| scene | what it tests | our mean, red green blue | their mean | difference in % | z | pixels in % | rms z | block | spp | seconds | verdict |
|---|---|---|---|---|---|---|---|---|---|---|---|
{table}

- *z* is the difference over its standard error, as the normal deviate of the same chance as Student's
  quotient with Welch's degrees of freedom. The scenes agree where every |z| of a mean is below
  {mean_bound:.2f}: level 0.01 for all channels of all scenes together (Šidák).
- *pixels* is the rule of Mitsuba's own tests: at least {share:.2f} % of the pixels and channels pass a
  two-sided test at level 0.01, corrected for the number of pixels (Šidák, |z| < {pixel_bound:.2f}).
- *rms z* is the root mean square of the z of all pixels and channels: 1 where only noise differs.
- *block* is the largest |z| of {columns} x {rows} blocks and three channels; below {block_bound:.2f}
  (level 0.01 over all scenes).
- *seconds* are ours and theirs, on a machine that did other things too: no benchmark.

## Where the models differ by intent

Mitsuba masks GGX microfacets separably, G1(wi) G1(wo); `rtr` with Smith's height-correlated form. So on
Mitsuba's side the rough materials are small plug-ins (`tests/validation/bsdf.py`) made of Mitsuba's own
normal distribution, one-sided masking, sampling and density, in which only the product is replaced.
With the separable product the plug-in must be Mitsuba's own material, and the script stops where it is
not: {masking}.

## Pictures

Ours, theirs, and half grey plus {gain} times half the difference over the mean radiance.

| scene | |
|---|---|
{strips}

The test `tests/tests/validation.rs` renders the same `.rts` files with few samples and compares them with
block means of Mitsuba's pictures that are stored in `tests/validation/reference/`. It needs no Mitsuba.
"""
