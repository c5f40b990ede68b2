#!/usr/bin/env python3
"""Compares `rtr` with Mitsuba 3 on scenes that both can render, and writes what it finds.

    python3 -m venv venv && venv/bin/pip install mitsuba==3.9.1 numpy
    cargo build --release -p compiler -p runtime
    venv/bin/python tests/validation/validate.py --rtr-dir target/release

writes `docs/validation.md`, `docs/validation/*.png`, `tests/validation/scenes/*.rts` and
`tests/validation/reference/*.txt`. `--only NAME` and `--scale 0.1` are for a look: they print, and
write the scenes only. Mitsuba's `llvm_ad_rgb` needs LLVM's shared library (Debian: `libllvm19`).
"""

import argparse
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
    parser.add_argument("--threads", type=int, default=2, help="threads of rtr")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="variant of Mitsuba")
    return parser.parse_args()


def main():
    args = arguments()
    mi.set_variant(args.variant)
    # These need the variant.
    import bsdf, catalog, compare, peer, report, rts

    bsdf.register()
    masking = bsdf.self_check()
    print(f"plug-ins with separable masking: {masking}")
    chosen = [s for s in catalog.ALL if not args.only or s.name in args.only]
    whole = len(chosen) == len(catalog.ALL) and args.scale == 1
    versions = ["", f"Mitsuba {mi.__version__}, `{args.variant}`"]
    rows, failed = [], 0
    for folder in (HERE / "scenes", HERE / "reference", ROOT / "docs/validation"):
        folder.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as work:
        ours = rts.Renderer(args.rtr_dir, work, args.threads)
        versions[0] = f"`{ours.version()}`, CPU kernel"
        for scene in chosen:
            path = HERE / "scenes" / f"{scene.name}.rts"
            ours.write(scene, path)
            # Our samples come in batches of sixteen.
            spp = max(16, round(scene.spp * args.scale / args.replicates / 16) * 16)
            mine, seconds = ours.pictures(path, args.replicates, spp)
            others, other_seconds = peer.pictures(scene, args.replicates, spp)
            found = compare.compare(mine, others)
            failed += not found.passed(len(catalog.ALL))
            print(report.line(scene, found, len(catalog.ALL)),
                  f" {seconds:.0f} s / {other_seconds:.0f} s", flush=True)
            total = spp * args.replicates
            rows.append(report.row(scene, found, total, (seconds, other_seconds), len(catalog.ALL)))
            means = mine.mean(axis=0), others.mean(axis=0)
            if whole:
                report.statistics(HERE / "reference" / f"{scene.name}.txt", scene, others, versions[1])
                report.strip(ROOT / "docs/validation" / f"{scene.name}.png", *means)
            else:
                report.strip(Path(f"/tmp/{scene.name}.png"), *means)
    if whole:
        command = "python tests/validation/validate.py --rtr-dir target/release"
        text = report.page(rows, versions, command, args.replicates, chosen, masking)
        (ROOT / "docs/validation.md").write_text(text)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
