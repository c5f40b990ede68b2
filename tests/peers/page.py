"""What was measured → the page and its strip of pictures."""

import platform
from pathlib import Path

import numpy as np

from references import LONGER

# Width in pixels of a picture of the strip.
THUMB = 200


def processor():
    """What the machine calls itself."""
    path = Path("/proc/cpuinfo")
    lines = path.read_text().splitlines() if path.exists() else []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or "unknown processor"


def digits(value):
    """Three significant digits, without an exponent."""
    return f"{value:#.3g}".rstrip(".") if 1e-4 < value < 1000 else f"{value:.1e}"


def bold(values):
    """Cells, the smallest one in bold."""
    return [f"**{digits(v)}**" if v == min(values) else digits(v) for v in values]


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(row) + " |" for row in lines)


def no_time(agreement):
    return f"means differ: z {agreement['z']:.1f}, {100 * agreement['relative']:.2f} %"


def equal_time(results, names, seconds):
    """The table that decides."""
    head = ["scene"]
    for t in seconds:
        head += [f"{names[0]}, {t:g} s", *(f"{n}" for n in names[1:])]
    head += [f"ours / best other, {t:g} s" for t in seconds]
    rows = []
    for name, r in results.items():
        cells, ratios = [], []
        for i in range(len(seconds)):
            errors = [r["rounds"][k]["errors"][i] for k in r["rounds"]]
            cells += bold(errors)
            ratios.append(digits(errors[0] / min(errors[1:])))
        if not r["agreement"]["agree"]:
            cells, ratios = [no_time(r["agreement"])] + ["-"] * (len(cells) - 1), ["-"] * len(ratios)
        rows.append([f"`{name}`", *cells, *ratios])
    return table(head, rows)


def cost(results, names):
    """Samples, starts and memory: one row a scene and renderer."""
    head = ["scene", "renderer", "a sample, s", "CPU s", "start, s", "CPU s", "memory, GB"]
    rows = []
    for name, r in results.items():
        for title, m in zip(names, r["rounds"].values()):
            each = [digits(m["wall"]), digits(m["cpu"])] if r["agreement"]["agree"] else ["-", "-"]
            rows.append([f"`{name}`", title, *each, f"{m['start_wall']:.2f}", f"{m['start_cpu']:.2f}",
                         f"{m['memory'] / 1e9:.2f}"])
    return table(head, rows)


def means(results, names):
    """Whether the renderers show the same."""
    head = ["scene", "", "pixels", "segments", *names, "largest z", "largest difference", "blocks", "allowed"]
    rows = []
    for name, r in results.items():
        a = r["agreement"]
        cells = ["<br>".join(f"{m:.5f} ± {e:.5f}" for m, e in zip(a["means"][k], a["errors"][k])) for k in a["means"]]
        rows.append([f"`{name}`", r["shows"], " x ".join(map(str, r["size"])), str(r["depth"]), *cells,
                     f"{a['z']:.2f}", f"{100 * a['relative']:.3f} %",
                     f"{a['blocks']:.2f}", f"{100 * a['allowed']:.1f} %" if a["allowed"] else ""])
    return table(head, rows)


def thumb(picture):
    """Pixels averaged over cells, at most THUMB wide, as eight bits."""
    cell = max(1, -(-picture.shape[1] // THUMB))
    height, width = (n // cell * cell for n in picture.shape[:2])
    small = picture[:height, :width].reshape(height // cell, cell, width // cell, cell, 3).mean(axis=(1, 3))
    c = np.clip(small, 0, 1)
    return np.round(255 * np.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - 0.055)).astype(np.uint8)


def strip(rows):
    """One row a scene, one column a renderer; `rows`: pictures [y, x, channel] by scene."""
    lines = [np.concatenate([thumb(p) for p in pictures], axis=1) for pictures in rows]
    width = max(line.shape[1] for line in lines)
    gap = [(0, 2), None, (0, 0)]
    return np.concatenate([np.pad(x, [gap[0], (0, width - x.shape[1]), gap[2]]) for x in lines])


def text(results, names, args, bound):
    """`docs/peers.md`."""
    short = [names["rtr"].strip("`").split()[0], "Mitsuba", "Cycles"]
    times = " and ".join(f"{t:g} s" for t in args.seconds)
    return TEMPLATE.format(
        machine=f"{platform.machine()} {platform.system().lower()}, {processor()}", threads=args.threads,
        renderers="; ".join(names.values()), times=times, rounds=args.rounds, bound=bound,
        replicates=args.replicates, reference=args.reference_seconds,
        longer=", ".join(f"`{name}` {n} times that" for name, n in LONGER.items()),
        decides=equal_time(results, short, args.seconds), cost=cost(results, short), means=means(results, short),
        caption="From left to right: " + ", ".join(short) + "; the scenes from top to bottom as in the tables")


TEMPLATE = """# Beside other renderers

<!-- Written by `tests/peers/peers.py`. -->

Each scene is described once, in `tests/peers/scenes.py`, and written for each renderer. All render it on {threads}
threads of one CPU with the same camera, box filter of one pixel and longest path; each has its own sampler and ends
paths by its own roulette. Nothing is clamped, filtered, guided or denoised.

    python tests/peers/peers.py --rtr-dir target/release --references FOLDER

{renderers}. Machine: {machine}.

## Error at equal time

Trimmed relMSE of the picture after {times} of rendering, without the start. Less is better: half as much is the
same error in about half the time.

{decides}

- **Error**: of each pixel's luminance `(Y - R)^2 / (R^2 + e^2)`, with `e` a hundredth of the mean of the reference `R`;
  the worst 0.1 % of the pixels are left out, the others averaged ([error.md](error.md) calls its root `ref_rel_trim`).
- **Reference**: {replicates} pictures of each renderer, {reference:g} s in all for each ({longer}), joined with the
  inverse of their noise as weights. Ours have seeds of their own, and so have Mitsuba's, which take the sampler
  `independent`: the means of `multijitter` depend on how many samples there are. Those of Cycles are parts of one
  picture, because its pictures of few samples are too dark, whatever the seeds. The reference favours no renderer where
  the means agree, and is less noisy than the best of the three. How noisy it still is, is known from the pictures it
  is made of, and taken off the error. What stays is that `R` is too low where light is rare and has not been met
  often: errors of scenes with bright specks come out some percent too high, all renderers' by the same factor.
- **Equal time**: samples of a pixel are whole, so each picture has as many as fit, and its error is multiplied by the
  seconds they took over those they should have taken.
- The renderers took turns, who is first changed; medians of rounds: {rounds}.

## Samples, start, memory

{cost}

- **A sample**: of all pixels; from two runs of each round, so that nothing of the start is in it.
- **Start**: from the start of the process to the first sample, and from the last one to its end: reading meshes,
  building trees, compiling kernels, writing the picture. Ours is `rtc --no-cache` and `rtr`; Mitsuba has no compiled
  kernels of an earlier run; importing Blender's module is in its start.
- **Memory**: the most that a process held, of `rtc` and `rtr` the greater.

## Whether they show the same

Means of red, green and blue and their standard errors, from the {replicates} pictures of the references. `z` is the
largest difference of two renderers in a channel over its standard error, as a normal deviate. Below {bound:.2f} (level
0.01 for all pairs, channels and scenes together, Šidák) the means agree; where they do not, no time is shown.
*Blocks* is the root mean square of the z of 6 x 8 blocks of the picture for all pairs: 1 where only noise differs.
*Allowed* is a difference that has a known reason: Mitsuba lifts rays off surfaces by 9e-5 of one plus the largest
coordinate, 3 mm at the far end of the meadow, a sixth of the width of a blade. It shows 0.15 % more light there, and
0.7 % more when the scene is moved 100 m away.

{means}

![{caption}](peers.png)
<sub>{caption}.</sub>

## How the same is said to each

- **Path length**: segments from the camera to the light. Cycles counts bounces, two less. Surfaces of index 1 around a
  medium end no path in any of them.
- **Metal**: GGX without colour and Fresnel, one bounce (`conductor` with `compensation = off`, `roughconductor`,
  Glossy). Mitsuba masks microfacets separably, the others by the height-correlated form
  ([validation.md](validation.md)); up to the roughness of 0.32 that is used here the difference does not show.
- **Lights**: radiance. Cycles takes watts: pi times area times radiance. Its lamps stop no light, so a black body
  stands in each, as those of the others stop it. Their soft falloff is off, and the camera sees them.
- **Spheres** are exact in `rtr` and Mitsuba; Cycles has 81,920 triangles with the normals of the sphere.
- **Media**: coefficients in 1/m. Mitsuba's integrator is `volpath`, and `path` where there is no medium.
- **Cycles**: no clamping, `blur_glossy` 0, caustics on, no adaptive sampling; every limit of bounces is the same.
"""
