"""Replicates of one picture from two renderers → what they say about each other.

Both sides come as [replicate, y, x, channel]. All spreads are those of replicates, so nothing is
assumed about how a renderer spreads its samples within one picture.
"""

import math
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np

# Chance that one family of tests rejects although both renderers are right, and the share of pixels
# and channels that must pass: the rule of Mitsuba's own `test_renders.py`.
SIGNIFICANCE = 0.01
SHARE = 0.9975
# Blocks of the stored statistics, along x and along y.
BLOCKS = (8, 6)
# Both films add up in single precision somewhere: relative error that is no difference.
ROUNDING = 2e-6


def sidak(tests, significance=SIGNIFICANCE):
    """Two-sided bound on |z| of each of `tests` independent tests."""
    level = -math.expm1(math.log1p(-significance) / tests)
    return NormalDist().inv_cdf(1 - level / 2)


def estimate(replicates):
    """Mean and squared standard error over the first axis."""
    mean = replicates.mean(axis=0)
    variance = replicates.var(axis=0, ddof=1) / len(replicates)
    return mean, variance + (ROUNDING * mean) ** 2


def normal_score(a, b, replicates):
    """z of the difference of two estimates, as a normal deviate.

    The variances are estimated, so the quotient has Student's distribution with Welch's degrees of
    freedom; Wallace 1959, "Bounds on normal approximations to Student's and the chi-square
    distributions", eq. 3.3 turns it into the normal deviate of the same chance.
    """
    (mean_a, var_a), (mean_b, var_b) = a, b
    total = var_a + var_b
    exact = total <= 0
    total = np.where(exact, 1, total)
    t = np.where(exact, 0, (mean_a - mean_b) / np.sqrt(total))
    freedom = np.where(exact, 1, total**2 * (replicates - 1) / np.where(exact, 1, var_a**2 + var_b**2))
    scale = (8 * freedom + 1) / (8 * freedom + 3)
    z = np.sign(t) * scale * np.sqrt(freedom * np.log1p(t**2 / freedom))
    return np.where(exact & (mean_a != mean_b), np.inf, z)


def blocks(pictures):
    """Means of blocks, [replicate, block row, block column, channel]."""
    n, height, width, channels = pictures.shape
    rows, columns = height // BLOCKS[1], width // BLOCKS[0]
    split = pictures.reshape(n, BLOCKS[1], rows, BLOCKS[0], columns, channels)
    return split.mean(axis=(2, 4))


@dataclass
class Summary:
    """Ours against theirs, one entry a channel. `spread`: root mean square of the pixels' z, 1 where
    nothing but noise differs; `block`: largest |z| of a block and channel; `spp`: samples of a pixel in
    all replicates; `seconds`: ours and theirs."""

    ours: list
    ours_error: list
    theirs: list
    theirs_error: list
    z: list
    share: float
    spread: float
    block: float
    spp: int
    seconds: list

    def passed(self, scenes):
        """Whether means, pixels and blocks agree; `scenes` are one family of tests."""
        means = max(abs(z) for z in self.z) < sidak(3 * scenes)
        blocks = self.block < sidak(3 * BLOCKS[0] * BLOCKS[1] * scenes)
        return means and self.share >= SHARE and blocks

    def relative(self):
        """Differences over their means in percent, and the standard errors of that."""
        rows = zip(self.ours, self.ours_error, self.theirs, self.theirs_error)
        return [(100 * (a - b) / b, 100 * math.hypot(e, f) / b) for a, e, b, f in rows]


def compare(ours, theirs, spp, seconds):
    n = len(ours)
    assert len(theirs) == n, "one number of replicates for both"
    means = [estimate(p.mean(axis=(1, 2))) for p in (ours, theirs)]
    z = normal_score(*[estimate(p) for p in (ours, theirs)], n)
    height, width = z.shape[:2]
    (mean, variance), (other, other_variance) = means
    return Summary(
        ours=mean.tolist(),
        ours_error=np.sqrt(variance).tolist(),
        theirs=other.tolist(),
        theirs_error=np.sqrt(other_variance).tolist(),
        z=normal_score(*means, n).tolist(),
        share=float((np.abs(z) < sidak(height * width)).mean()),
        spread=float(np.sqrt((z**2).mean())),
        block=float(np.abs(normal_score(*[estimate(blocks(p)) for p in (ours, theirs)], n)).max()),
        spp=spp,
        seconds=seconds,
    )
