#!/usr/bin/env python3
"""Renders one scene of 1.5 million triangles with `rtr`, Mitsuba 3 and Blender's Cycles, and compares cost and error.

    python3 -m venv venv && venv/bin/pip install mitsuba==3.9.1 bpy==5.0.1 numpy
    cargo build --release -p compiler -p runtime
    venv/bin/python tests/peers/peers.py --rtr-dir target/release

writes `docs/peers.md` and `docs/peers.png`. `--spp 4 20 --look FOLDER` is for a look: it writes there. All run on
the CPU with the same number of threads, one after the other, in rounds. Mitsuba's `llvm_ad_rgb` needs LLVM's
shared library (Debian: `libllvm19`).
"""

import argparse
import dataclasses
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import mitsuba as mi
import numpy as np

import meadow

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rtr-dir", default=ROOT / "target/release", type=Path)
    parser.add_argument("--spp", nargs=2, type=int, default=[16, 64], help="two sample counts")
    parser.add_argument("--rounds", type=int, default=3, help="odd; medians are shown")
    parser.add_argument("--threads", type=int, default=os.cpu_count())
    parser.add_argument("--variant", default="llvm_ad_rgb", help="variant of Mitsuba")
    parser.add_argument("--look", type=Path, default=ROOT / "docs", help="where the page goes")
    return parser.parse_args()


@dataclasses.dataclass
class Run:
    """What a process took: seconds of the clock and of all its threads, greatest memory in bytes."""

    wall: float
    cpu: float
    memory: int


def run(command, threads):
    """Runs a program to its end."""
    env = {**os.environ, "PYTHONPATH": str(HERE), "DRJIT_NUM_THREADS": str(threads)}
    start = time.monotonic()
    with tempfile.TemporaryFile() as said:
        child = subprocess.Popen([str(c) for c in command], env=env, stdout=said, stderr=said)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode:
            said.seek(0)
            sys.exit(said.read().decode() + f"\n{command} failed")
    wall = time.monotonic() - start
    return Run(wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024)


def read(path):
    if path.suffix == ".npy":
        return np.load(path).astype(np.float64)
    return np.array(mi.Bitmap(str(path)), dtype=np.float64)[:, :, :3]


class Ours:
    """`rtc`, then `rtr`."""

    def __init__(self, args, work):
        self.rtc, self.rtr = args.rtr_dir / "rtc", args.rtr_dir / "rtr"
        self.args, self.work = args, work
        said = subprocess.run([self.rtr, "--version"], check=True, capture_output=True, text=True)
        self.name = f"`{said.stdout.strip()}`"

    def compile(self):
        """From nothing: no tree is kept."""
        command = [self.rtc, self.work / "meadow.rts", "-o", self.work / "meadow.pack", "--no-cache"]
        return run(command, self.args.threads)

    def render(self, spp, seed):
        out = self.work / "ours.exr"
        command = [self.rtr, self.work / "meadow.pack", "--device", "cpu", "--quiet", "--threads",
                   self.args.threads, "--spp", spp, "--seed", seed, "-o", out]
        return run(command, self.args.threads), read(out)


class Peer:
    """A Python script."""

    def __init__(self, args, work, name, script, suffix, last):
        self.name, self.args, self.last = name, args, last
        self.work, self.script, self.out = work, HERE / script, work / f"{script}{suffix}"

    def compile(self):
        return None

    def render(self, spp, seed):
        command = [sys.executable, self.script, self.work, spp, seed, self.out, self.last]
        return run(command, self.args.threads), read(self.out)


def measure(renderer, args):
    """All runs of one round: compiling, few samples, many samples with two seeds."""
    compiled = renderer.compile()
    few, _ = renderer.render(args.spp[0], 0)
    many, one = renderer.render(args.spp[1], 1)
    _, other = renderer.render(args.spp[1], 2)
    return compiled, few, many, one, other


def row(name, rounds, args):
    """A line of the table, and the mean picture."""
    few, many = args.spp
    middle = lambda f: statistics.median(f(r) for r in rounds)
    each = {t: middle(lambda r: (getattr(r[2], t) - getattr(r[1], t)) / (many - few))
            for t in ("cpu", "wall")}
    start = {t: middle(lambda r: getattr(r[1], t) + (getattr(r[0], t) if r[0] else 0)) - few * each[t]
             for t in ("cpu", "wall")}
    memory = max(run.memory for r in rounds for run in r[:3] if run)
    one, other = rounds[0][3], rounds[0][4]
    picture = (one + other) / 2
    # Two independent pictures differ by twice the variance of one.
    error = np.mean((one - other) ** 2) / 2 / np.mean(picture) ** 2
    cells = [name, f"{start['cpu']:.1f}", f"{start['wall']:.1f}", f"{each['cpu']:.2f}",
             f"{each['wall']:.2f}", f"{memory / 1e9:.2f}", f"{np.mean(picture):.4f}",
             f"{np.sqrt(error):.3f}", f"{np.sqrt(error * many * each['cpu'] / 60):.3f}"]
    return cells, picture


PAGE = """# Beside other renderers

Made by `tests/peers/peers.py`; edit the program, not this page. One scene for all: hills under 390,000 blades of
grass, {count:,} triangles, a round lamp, a grey sky, diffuse surfaces, {width} x {height} pixels, paths of {depth}
vertices at most, a box filter of one pixel, {threads} threads of one CPU. Each has its own sampler (Mitsuba
`multijitter`, as the others stratify, too) and ends paths by its own roulette. Rounds of all renderers took turns; medians of {rounds}.

- **start**: from the start of the process to the first sample: reading the meshes, building the tree, compiling the
  kernel; ours is `rtc --no-cache` and opening the pack. Whole-process time at {few} samples, less those samples.
- **a sample**: time of {many} samples less that of {few}, over the difference.
- **error**: root mean square of the noise over the mean of the picture, from two independent pictures of {many}
  samples; then what it is after a minute of CPU time without the start.

| renderer | start, CPU s | wall s | one sample a pixel, CPU s | wall s | memory, GB | mean | error at {many} | after 60 CPU s |
|---|---|---|---|---|---|---|---|---|
{rows}

![{caption}](peers.png)
<sub>{caption}</sub>
"""


def main():
    args = arguments()
    mi.set_variant("scalar_rgb")
    with tempfile.TemporaryDirectory() as work:
        work = Path(work)
        count = meadow.write(work)
        renderers = [
            Ours(args, work),
            Peer(args, work, f"Mitsuba {mi.__version__}, `{args.variant}`", "with_mitsuba.py", ".npy",
                 args.variant),
            Peer(args, work, "Blender 5.0.1, Cycles", "with_cycles.py", ".exr", args.threads),
        ]
        rounds = {r.name: [] for r in renderers}
        for _ in range(args.rounds):
            for renderer in renderers:
                rounds[renderer.name].append(measure(renderer, args))
        found = [row(r.name, rounds[r.name], args) for r in renderers]
    lines = ["| " + " | ".join(cells) + " |" for cells, _ in found]
    text = PAGE.format(
        count=count, width=meadow.SIZE[0], height=meadow.SIZE[1], depth=meadow.DEPTH, rows="\n".join(lines),
        threads=args.threads, rounds=args.rounds, few=args.spp[0], many=args.spp[1],
        caption="From left to right: " + ", ".join(r.name.replace("`", "") for r in renderers))
    args.look.mkdir(parents=True, exist_ok=True)
    (args.look / "peers.md").write_text(text)
    strip = np.concatenate([picture for _, picture in found], axis=1)
    shown = np.clip(strip, 0, 1) ** (1 / 2.2)
    mi.Bitmap((shown * 255).astype(np.uint8)).write(str(args.look / "peers.png"))
    print(text)


main()
