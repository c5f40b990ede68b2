"""Comparisons → the page, the strips of pictures, and the statistics that the Rust test reads."""

import math

import numpy as np

import compare
import files
from model import SIZE

# Gain on the signed difference in the strips.
GAIN = 40
# Side in pixels of the cells of the difference.
CELL = 5


def srgb(linear):
    c = np.clip(linear, 0, 1)
    return np.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - 0.055)


def strip(path, ours, theirs, scale=2):
    """Ours, theirs, and half grey plus GAIN times half the difference over the mean radiance, averaged
    over cells: single pixels would show their noise."""
    off = GAIN * (ours - theirs) / theirs.mean() / 2
    height, width = off.shape[:2]
    cells = off.reshape(height // CELL, CELL, width // CELL, CELL, 3).mean(axis=(1, 3))
    row = np.concatenate(
        [srgb(ours), srgb(theirs), 0.5 + np.kron(cells, np.ones((CELL, CELL, 1)))], axis=1)
    pixels = np.clip(row, 0, 1) * 255 + 0.5
    files.write_png(path, np.kron(pixels, np.ones((scale, scale, 1))))


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


def row(scene, s, scenes):
    """One row of the table; its verdict is that among `scenes` scenes."""
    def channels(values):
        return "<br>".join(values)

    ours = channels(f"{m:.5f} ± {e:.5f}" for m, e in zip(s.ours, s.ours_error))
    theirs = channels(f"{m:.5f} ± {e:.5f}" for m, e in zip(s.theirs, s.theirs_error))
    off = channels(f"{r:+.3f} ± {e:.3f}" for r, e in s.relative())
    z = channels(f"{z:+.2f}" for z in s.z)
    verdict = "agree" if s.passed(scenes) else "**differ**"
    return (f"| `{scene.name}` | {scene.tests} | {ours} | {theirs} | {off} | {z} | {100 * s.share:.2f} | "
            f"{s.spread:.3f} | {s.block:.2f} | {s.spp} | {s.seconds[0]:.0f} / {s.seconds[1]:.0f} | "
            f"{verdict} |")


def line(scene, s, scenes):
    """One line for the terminal."""
    off = " ".join(f"{r:+.3f}±{e:.3f}" for r, e in s.relative())
    z = " ".join(f"{z:+.2f}" for z in s.z)
    return (f"{scene.name:16} off % {off}  z {z}  pixels {100 * s.share:.2f} %  rms z {s.spread:.3f}  "
            f"block {s.block:.2f}  {s.seconds[0]:.0f} s / {s.seconds[1]:.0f} s  "
            f"{'agree' if s.passed(scenes) else 'DIFFER'}")


def page(rows, versions, replicates, scenes, masking):
    """`docs/validation.md`."""
    n = len(scenes)
    pixels = SIZE[0] * SIZE[1]
    several = 3 * compare.BLOCKS[0] * compare.BLOCKS[1] * n
    strips = "\n".join(f"| `{s.name}` | ![]({'validation/' + s.name + '.png'}) |" for s in scenes)
    return TEMPLATE.format(
        ours=versions[0], theirs=versions[1], replicates=replicates,
        width=SIZE[0], height=SIZE[1], share=100 * compare.SHARE, pixel_bound=compare.sidak(pixels),
        mean_bound=compare.sidak(3 * n), block_bound=compare.sidak(several), columns=compare.BLOCKS[0],
        rows=compare.BLOCKS[1], table="\n".join(rows), gain=GAIN, cell=CELL, strips=strips, masking=masking)


TEMPLATE = """# Validation against Mitsuba 3

<!-- Written by `tests/validation/validate.py`. -->

Each scene is described once, in `tests/validation/catalog.py`. The script writes it as `.rts` for `rtc`
and as a dictionary for Mitsuba, renders both, and compares: the same camera, box filter and longest
path on both sides, {width} x {height} pixels, {replicates} independent replicates a side, from whose
spread all errors come.

    python tests/validation/validate.py --rtr-dir target/release

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

Mitsuba masks GGX microfacets separably, G1(wi) G1(wo); `rtr` masks reflection with Smith's
height-correlated form. So on Mitsuba's side the rough materials are small plug-ins
(`tests/validation/bsdf.py`) made of Mitsuba's own normal distribution, one-sided masking, sampling and
density, in which only that product is replaced. With the separable product the plug-in must be
Mitsuba's own material, and the script stops where it is not: {masking}.

Scenes with media use Mitsuba's `volpath`. Its `volpathmis` gives the slab over the floor 0.2 to 0.6 % less
light, most in the densest colour: the weights of roulette go into `p_over_f` and not into `p_over_f_nee`
(`src/integrators/volpathmis.cpp`). With `rr_depth` = 100000 it agrees with `volpath` and with us.

## Pictures

Ours, theirs, and half grey plus {gain} times half the difference over the mean radiance, averaged over
{cell} x {cell} pixels.

| scene | |
|---|---|
{strips}

The test `tests/tests/validation.rs` renders the same `.rts` files with few samples and compares them with
block means of Mitsuba's pictures that are stored in `tests/validation/reference/`. It needs no Mitsuba.
"""
