#!/usr/bin/env python3
"""Renders the same scenes with two builds of rtc and rtr, and compares what equal error costs.

    python3 -m venv venv && venv/bin/pip install numpy OpenEXR
    cargo build --release -p compiler -p runtime
    venv/bin/python tests/peers/builds.py OLD_FOLDER target/release [SCENE.rts ...] > docs/builds.md

prints a page. The scenes are those of `scenes.py`, those of `builds/`, and all that are named. The builds take turns on
the same machine. The noise of each is estimated from its own pictures of several seeds, so that models may have changed
in between.
"""

import argparse
import statistics
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import OpenEXR

import error
import scenes
import to_rts
from page import digits, processor, table
from processes import HERE, run

PAGE = """# Against an earlier build

<!-- Printed by `tests/peers/builds.py`. -->

What equal error costs now and before. The builds take turns on one machine with the same texts. The
noise of each is estimated from its own pictures of several seeds, so that models may have changed in between.

Old: {old}. New: {new}. {spp} samples a pixel, {seeds} pictures of each; {threads} threads of {machine}.

{table}

- **CPU s a sample**: user and system time of all threads for one sample of every pixel, without the start: medians.
- **relMSE**: the variance of a pixel's luminance Y over Y^2 + e^2, where e is a hundredth of the mean of the picture;
  the worst 0.1 % of the pixels are left out, the others averaged.
- **CPU s for equal error**: cost times relMSE, as errors of independent samples go. Sobol's fall a little faster, so a
  gain in noise is worth slightly more than shown.
"""


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("old", type=Path, help="where the older rtc and rtr are")
    parser.add_argument("new", type=Path, help="where the newer ones are")
    parser.add_argument("scenes", nargs="*", type=Path, help="more scenes, as text")
    parser.add_argument("--old-name", default="an earlier build", help="what the page calls the older one")
    parser.add_argument("--new-name", default="this one", help="what the page calls the newer one")
    parser.add_argument("--only", nargs="+", help="only scenes with these names")
    parser.add_argument("--size", default="320x180", metavar="WxH", help="of pictures of scenes that are named")
    parser.add_argument("--spp", type=int, default=16, help="samples of a picture")
    parser.add_argument("--seeds", type=int, default=8, help="pictures of each build, three or more")
    parser.add_argument("--threads", type=int, default=2)
    args = parser.parse_args()
    if args.seeds < 3 or args.spp < 2:
        parser.error("--seeds: three or more; --spp: two or more")
    return args


@dataclass
class Build:
    """A build, and what it has done of the scene at hand: luminance of pictures, CPU seconds of pictures and of such
    of one sample."""

    folder: Path
    pack: Path
    more: list = field(default_factory=list)
    pictures: list = field(default_factory=list)
    many: list = field(default_factory=list)
    one: list = field(default_factory=list)

    def compile(self, scene, work):
        run([self.folder / "rtc", scene.resolve(), "-o", self.pack, "--no-cache"], work)

    def render(self, args, spp, seed, work):
        """CPU seconds, luminance."""
        out = work / "picture.exr"
        took = run([self.folder / "rtr", self.pack, "--device", "cpu", "--quiet", "--threads", args.threads, "--spp",
                    spp, "--seed", seed, "-o", out, *self.more], work)
        return took.cpu, luminance(out)

    def round(self, args, seed, work):
        cpu, picture = self.render(args, args.spp, seed, work)
        self.pictures.append(picture)
        self.many.append(cpu)
        self.one.append(self.render(args, 1, seed, work)[0])

    def sample(self, spp):
        """CPU seconds of a sample of every pixel, without the start."""
        return (statistics.median(self.many) - statistics.median(self.one)) / (spp - 1)

    def noise(self):
        """The trimmed relMSE of a picture against the mean of endlessly many."""
        pictures = np.array(self.pictures)
        scale = error.Reference(pictures.mean(axis=0), 0).scale()
        found = (pictures.var(axis=0, ddof=1) / scale).ravel()
        return found[error.least(found)].mean()


def luminance(path):
    with OpenEXR.File(str(path), separate_channels=True) as file:
        channels = file.channels()
        return error.luminance(np.stack([channels[c].pixels for c in "RGB"], axis=-1))


def written(args, work):
    """The scenes asked for, by name: those of all renderers at half their size, and those that exist as text."""
    texts = [*sorted((HERE / "builds").glob("*.rts")), *args.scenes]
    found = {name: work / f"{name}.rts" for name in scenes.ALL} | {path.stem: path for path in texts}
    if args.only:
        if unknown := set(args.only) - found.keys():
            sys.exit(f"--only: no scene is named {', '.join(sorted(unknown))}; there are {', '.join(found)}")
        found = {name: path for name, path in found.items() if name in args.only}
    for name in found.keys() & scenes.ALL:
        scene = scenes.ALL[name]
        to_rts.write(work, scene, [n // 2 for n in scene.size])
    return found


def compiled(name, scene, args, work):
    """Both builds, with the scene compiled by each."""
    more = ["--size", args.size] if scene in args.scenes else []
    builds = [Build(folder, work / f"{name}.{age}.pack", more) for folder, age in [(args.old, "old"), (args.new, "new")]]
    for b in builds:
        b.compile(scene, work)
    return builds


def compare(name, builds, args, work):
    """The row of a scene."""
    for seed in range(args.seeds):
        print(f"{name}: {seed + 1} of {args.seeds}", file=sys.stderr, flush=True)
        for b in builds if seed % 2 == 0 else reversed(builds):
            b.round(args, seed, work)
    old, new = builds
    cost = [b.sample(args.spp) for b in builds]
    noise = [b.noise() for b in builds]
    return [f"`{name}`", *map(digits, cost), f"{cost[0] / cost[1]:.2f}x", *map(digits, noise),
            f"{noise[0] / noise[1]:.2f}x", f"**{cost[0] * noise[0] / (cost[1] * noise[1]):.2f}x**"]


def main():
    args = arguments()
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        # All first: a text that one of them refuses is not found out after minutes.
        builds = {name: compiled(name, path, args, work) for name, path in written(args, work).items()}
        rows = [compare(name, both, args, work) for name, both in builds.items()]
    head = ["scene", "CPU s a sample, old", "new", "old / new", "relMSE, old", "new", "old / new",
            "CPU s for equal error, old / new"]
    print(PAGE.format(old=args.old_name, new=args.new_name, spp=args.spp, seeds=args.seeds, threads=args.threads,
                      machine=processor(), table=table(head, rows)), end="")


if __name__ == "__main__":
    main()
