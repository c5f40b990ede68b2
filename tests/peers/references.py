"""Long renders of each renderer in a folder: made once, taken up again by the next run.

A picture is kept under the digest of its scene, renderer and length, so that another one is never taken. What the
digest does not know is how a scene is written for a renderer: empty the folder after a change of that.
"""

import hashlib
import json
from dataclasses import asdict, dataclass, replace

import numpy as np

import error

# Times as long for these. Cycles' box is 0.42 % too dark with 5 samples, 0.15 % with 15 and 0.04 % with 64, whatever
# the seed. That of the slab dates from when Mitsuba's references took `multijitter`, and was 1.4 % too dark with 6.
LONGER = {"box": 12, "slab": 3}


@dataclass
class Speed:
    """Seconds of a process: from its start to the first sample, and for each sample of all pixels."""

    start: float
    sample: float

    def samples(self, seconds):
        return seconds / self.sample


def pilot(renderer, scene, size, enough):
    """A first guess of the speed from runs that differ by `enough` seconds; the clock of a busy machine will do."""
    few, _ = renderer.render(scene, size, 1, 0)
    n = 9
    while (many := renderer.render(scene, size, n, 0)[0]).wall - few.wall < enough and n < 9000:
        n *= 9
    sample = max(many.wall - few.wall, 1e-3) / (n - 1)
    return Speed(few.wall - sample, sample)


class Shelf:
    """The folder. `seconds`: of all pictures of most scenes and a renderer; how much those differ gives all errors."""

    def __init__(self, folder, seconds, replicates, say):
        self.folder, self.seconds, self.replicates, self.say = folder, seconds, replicates, say

    def seconds_of(self, scene):
        return self.seconds * LONGER.get(scene.name, 1)

    def at(self, renderer, scene, size):
        # How much means may differ says nothing of the picture.
        said = repr((replace(scene, allowed=0), size, renderer.reference_name, self.seconds_of(scene), self.replicates))
        return self.folder / f"{scene.name}-{renderer.key}-{hashlib.sha256(said.encode()).hexdigest()[:12]}"

    def speed(self, renderer, scene, size):
        path = self.at(renderer, scene, size) / "speed.json"
        if not path.exists():
            self.say(f"{scene.name}: {renderer.key}: how long a sample takes")
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(json.dumps(asdict(pilot(renderer, scene, size, self.seconds / 48))))
        return Speed(**json.loads(path.read_text()))

    def pictures(self, renderer, scene, size):
        """All long pictures of a renderer, [replicate, y, x, channel]."""
        speed = self.speed(renderer, scene, size)
        n = renderer.whole(speed.samples(self.seconds_of(scene) / self.replicates))
        pictures = []
        for k in range(self.replicates):
            path = self.at(renderer, scene, size) / f"{k}.npy"
            if not path.exists():
                self.say(f"{scene.name}: {renderer.key}: reference {k + 1} of {self.replicates}, {n} samples")
                picture = renderer.reference(scene, size, n, k, self.replicates)
                half = path.with_suffix(".half.npy")
                np.save(half, picture)
                half.rename(path)
            pictures.append(np.load(path))
        return np.array(pictures)


def collect(shelf, renderers, scene, size):
    """Stacks by renderer, the joint reference."""
    stacks = {r.key: shelf.pictures(r, scene, size) for r in renderers}
    return stacks, error.join(list(stacks.values()))
