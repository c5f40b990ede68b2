#!/usr/bin/env python3
"""Renders the same scenes with `rtr`, Mitsuba 3 and Blender's Cycles, and compares errors at equal time.

    python3 -m venv venv && venv/bin/pip install mitsuba==3.9.1 bpy==5.0.1 numpy
    cargo build --release -p compiler -p runtime
    venv/bin/python tests/peers/peers.py --rtr-dir target/release --references FOLDER

writes `docs/peers.md` and `docs/peers.png`. `--only-references` renders the references first, which needs no quiet
machine; what is in the folder already is not made again. `--smoke --look FOLDER` tries everything with tiny pictures.
Mitsuba's `llvm_ad_rgb` needs LLVM's shared library (Debian: `libllvm19`).
"""

import argparse
import json
import sys
import tempfile
import time
from dataclasses import asdict
from pathlib import Path

import mitsuba as mi

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent
# For the statistics of means.
sys.path.append(str(HERE.parent / "validation"))

import agreement  # noqa: E402
import measure  # noqa: E402
import page  # noqa: E402
import references  # noqa: E402
import renderers  # noqa: E402
import scenes  # noqa: E402


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rtr-dir", default=ROOT / "target/release", type=Path, help="where rtc and rtr are")
    parser.add_argument("--scenes", nargs="+", choices=scenes.ALL, default=list(scenes.ALL))
    parser.add_argument("--seconds", nargs="+", type=float, default=[4, 16], help="two or more, rising")
    parser.add_argument("--rounds", type=int, default=2, help="medians are shown")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--variant", default="llvm_ad_rgb", help="variant of Mitsuba")
    parser.add_argument("--references", type=Path, help="folder of references and of what was measured")
    parser.add_argument("--reference-seconds", type=float, default=48, help="for each scene and renderer")
    parser.add_argument("--replicates", type=int, default=8, help="pictures that a reference is made of")
    parser.add_argument("--only-references", action="store_true", help="make references and compare means")
    parser.add_argument("--resume", action="store_true", help="do not measure again what the folder has")
    parser.add_argument("--look", type=Path, default=ROOT / "docs", help="where the page goes")
    parser.add_argument("--smoke", action="store_true", help="a look: tiny pictures, short times, one round")
    args = parser.parse_args()
    if args.smoke:
        args.seconds, args.rounds, args.reference_seconds, args.replicates = [0.2, 0.8], 1, 2, 3
    if len(args.seconds) < 2 or sorted(args.seconds) != args.seconds:
        parser.error("--seconds: two or more, rising")
    return args


BEGAN = time.monotonic()


def say(line):
    """Progress."""
    print(f"{time.monotonic() - BEGAN:6.0f} s  {line}", file=sys.stderr, flush=True)


def one(scene, args, work, shelf, all_renderers):
    """Everything about one scene, as it goes into the page; its pictures."""
    size = [n // 8 for n in scene.size] if args.smoke else list(scene.size)
    kept = shelf.folder / f"measured-{scene.name}.json"
    renderers.prepare(scene, work)
    for r in all_renderers:
        r.compile(scene, size)
    stacks, reference = references.collect(shelf, all_renderers, scene, size)
    pictures = [s.mean(axis=0) for s in stacks.values()]
    found = agreement.agreement(stacks, scene.allowed, len(scenes.ALL))
    say(f"{scene.name}: {'means agree' if found.agree else 'MEANS DIFFER'}: z {found.z:.2f}, "
        f"{100 * found.relative:.3f} %")
    if args.only_references:
        return None, pictures
    if args.resume and kept.exists():
        return json.loads(kept.read_text()) | {"agreement": asdict(found)}, pictures
    speeds = {r.key: shelf.speed(r, scene, size) for r in all_renderers}
    result = {"shows": scene.shows, "size": size, "depth": scene.depth, "agreement": asdict(found),
              "rounds": measure.rounds(all_renderers, scene, size, speeds, args, reference, say)}
    kept.write_text(json.dumps(result))
    return result, pictures


def main():
    args = arguments()
    mi.set_variant("scalar_rgb")
    with tempfile.TemporaryDirectory() as work:
        work = Path(work)
        folder = args.references or work / "references"
        folder.mkdir(parents=True, exist_ok=True)
        shelf = references.Shelf(folder, args.reference_seconds, args.replicates, say)
        all_renderers = [r(args, work) for r in renderers.ALL]
        found = {name: one(scenes.ALL[name], args, work, shelf, all_renderers) for name in args.scenes}
    args.look.mkdir(parents=True, exist_ok=True)
    mi.Bitmap(page.strip([pictures for _, pictures in found.values()])).write(str(args.look / "peers.png"))
    if args.only_references:
        return
    results = {name: result for name, (result, _) in found.items()}
    names = {r.key: r.name for r in all_renderers}
    text = page.text(results, names, args, agreement.bound(len(names), len(scenes.ALL)))
    (args.look / "peers.md").write_text(text)
    print(text)


main()
