"""Rounds of one scene: every renderer in turn, for each of the times to be compared.

A round of a renderer is a process for each time, with as many samples as should take it. Two of these processes say
what a sample takes; what is left of the first is the start. Samples are whole, so a picture took a little less or
more than it should have: its error is multiplied by what it took over what it should have, as errors of independent
samples are.
"""

import statistics
from dataclasses import asdict, dataclass

import error
from references import Speed


@dataclass
class Round:
    """What one renderer did. `errors`: trimmed relMSE after each time; `samples`: a pixel; seconds. `start_wall` is
    `render_start` and what was done ahead."""

    wall: float
    cpu: float
    render_start: float
    start_wall: float
    start_cpu: float
    memory: int
    samples: list
    errors: list


def evaluate(compiled, runs, counts, judged, seconds):
    """`runs`: a process for each of `seconds`, with `counts` samples and errors `judged`."""
    first, last, more = runs[0], runs[-1], counts[-1] - counts[0]
    # Short runs on a busy machine may differ by less than nothing.
    wall = max(last.wall - first.wall, 1e-3) / more
    cpu = max(last.cpu - first.cpu, 1e-3) / more
    return Round(
        wall=wall,
        cpu=cpu,
        render_start=first.wall - counts[0] * wall,
        start_wall=compiled.wall + first.wall - counts[0] * wall,
        start_cpu=compiled.cpu + first.cpu - counts[0] * cpu,
        memory=max(r.memory for r in (compiled, *runs)),
        samples=counts,
        errors=[e * n * wall / t for e, n, t in zip(judged, counts, seconds)],
    )


def learn(speed, run, n, seconds):
    """The speed after `n` samples that should have taken `seconds`; one run says a factor of eight at most, and nothing
    where most of it was the start."""
    if seconds < 2 * speed.start:
        return speed
    return Speed(speed.start, max(run.wall - speed.start, seconds / 8) / n)


def one_round(renderers, scene, size, speeds, seconds, seed, reference, say):
    """A `Round` by renderer."""
    compiled = {r.key: r.compile(scene, size) for r in renderers}
    counts, runs, judged = ({r.key: [] for r in renderers} for _ in range(3))
    speeds = dict(speeds)
    for i, t in enumerate(seconds):
        for r in renderers:
            n = r.whole(speeds[r.key].samples(t))
            if n <= max(counts[r.key], default=0):
                # More than before in any case, or there would be nothing to tell the speed from.
                n = r.whole(2 * counts[r.key][-1])
            run, picture = r.render(scene, size, n, seed + i)
            say(f"{scene.name}: {r.key}: {n} samples for {t:g} s, {run.wall:.1f} s with the start, "
                f"{run.cpu / run.wall:.2f} threads busy")
            speeds[r.key] = learn(speeds[r.key], run, n, t)
            counts[r.key].append(n)
            runs[r.key].append(run)
            judged[r.key].append(error.judge(picture, reference))
    return {r.key: evaluate(compiled[r.key], runs[r.key], counts[r.key], judged[r.key], seconds) for r in renderers}


def rounds(renderers, scene, size, speeds, args, reference, say):
    """All rounds → the median of each number by renderer; the next round knows the speed of the last one."""
    found = []
    for k in range(args.rounds):
        say(f"{scene.name}: round {k + 1} of {args.rounds}")
        # Who comes first changes.
        turn = renderers[k % len(renderers):] + renderers[:k % len(renderers)]
        found.append(one_round(turn, scene, size, speeds, args.seconds, 1 + 10 * k, reference, say))
        speeds = {key: Speed(r.render_start, r.wall) if r.wall > 0 else speeds[key] for key, r in found[-1].items()}
    return {r.key: middle([asdict(f[r.key]) for f in found]) for r in renderers}


def middle(rows):
    """The median of each number of dictionaries, and of each entry of their lists."""
    out = {}
    for key, value in rows[0].items():
        if isinstance(value, list):
            out[key] = [statistics.median(row[key][i] for row in rows) for i in range(len(value))]
        else:
            out[key] = statistics.median(row[key] for row in rows)
    return out
