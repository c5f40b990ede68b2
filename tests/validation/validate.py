#!/usr/bin/env python3
"""Compares `rtr` with Mitsuba 3 on scenes that both can render, and writes what it finds.

    python3 -m venv venv && venv/bin/pip install mitsuba==3.9.1 numpy
    cargo build --release -p compiler -p runtime
    venv/bin/python tests/validation/validate.py --rtr-dir target/release

writes `docs/validation.md`, `docs/validation/*.png`, `tests/validation/scenes/*` and
`tests/validation/reference/*`. `--only NAME` renews one scene of these; `--scale 0.1` is for a look:
it prints, and writes the scene and its picture only. Mitsuba's `llvm_ad_rgb` needs LLVM's shared
library (Debian: `libllvm19`).
"""

import argparse
import dataclasses
import json
import sys
import tempfile
from pathlib import Path

import mitsuba as mi

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rtr-dir", default=ROOT / "target/release", help="where rtc and rtr are")
    parser.add_argument("--only", action="append", help="compare this scene only; may be repeated")
    parser.add_argument("--scale", type=float, default=1, help="factor on the samples")
    parser.add_argument("--replicates", type=int, default=64, help="independent pictures a side")
    parser.add_argument("--look", default=".", help="where pictures go when --scale is not 1")
    parser.add_argument("--threads", type=int, default=2, help="threads of rtr")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="variant of Mitsuba")
    return parser.parse_args()


def main():
    args = arguments()
    mi.set_variant(args.variant)
    # These need the variant.
    import bsdf, catalog, compare, files, peer, report, rts

    bsdf.register()
    masking = bsdf.self_check()
    print(f"plug-ins with separable masking: {masking}")
    chosen = [s for s in catalog.ALL if not args.only or s.name in args.only]
    reference, pictures = HERE / "reference", ROOT / "docs/validation"
    for folder in (HERE / "scenes", reference, pictures):
        folder.mkdir(exist_ok=True)
    stored = reference / "summary.json"
    found = json.loads(stored.read_text()) if stored.exists() else {}
    theirs = f"Mitsuba {mi.__version__}, `{args.variant}`"
    agree = True
    with tempfile.TemporaryDirectory() as work:
        renderer = rts.Renderer(args.rtr_dir, work, args.threads)
        for scene in chosen:
            path = HERE / "scenes" / f"{scene.name}.rts"
            files.write(scene, path.parent)
            renderer.write(scene, path)
            # Our samples come in batches of sixteen.
            spp = max(16, round(scene.spp * args.scale / args.replicates / 16) * 16)
            mine, seconds = renderer.pictures(path, args.replicates, spp)
            others, other_seconds = peer.pictures(scene, path.parent, args.replicates, spp)
            summary = compare.compare(
                mine, others, spp * args.replicates, [seconds, other_seconds])
            agree &= summary.passed(len(catalog.ALL))
            print(report.line(scene, summary, len(catalog.ALL)), flush=True)
            to = pictures if args.scale == 1 else Path(args.look)
            report.strip(to / f"{scene.name}.png", mine.mean(axis=0), others.mean(axis=0))
            if args.scale == 1:
                report.statistics(reference / f"{scene.name}.txt", scene, others, theirs)
                found[scene.name] = dataclasses.asdict(summary)
        ours = f"`{renderer.version()}`, CPU kernel"
    if args.scale == 1:
        found = {s.name: found[s.name] for s in catalog.ALL if s.name in found}
        stored.write_text(json.dumps(found, indent=1) + "\n")
        scenes = [s for s in catalog.ALL if s.name in found]
        rows = [report.row(s, compare.Summary(**found[s.name]), len(scenes)) for s in scenes]
        text = report.page(rows, (ours, theirs), args.replicates, scenes, masking)
        (ROOT / "docs/validation.md").write_text(text)
    return 0 if agree else 1


if __name__ == "__main__":
    sys.exit(main())
