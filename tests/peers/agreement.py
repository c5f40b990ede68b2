"""Whether renderers show the same, by the spread of independent pictures of each."""

import itertools
from dataclasses import dataclass

import numpy as np

import error
from compare import estimate, normal_score, sidak

# Rows and columns of blocks.
BLOCKS = (6, 8)


@dataclass
class Agreement:
    """Means of red, green and blue of each renderer with their standard errors; the largest difference of two
    renderers in one channel over its standard error, as a normal deviate, and over the mean; the root mean square of
    these deviates in blocks of the picture, 1 where only noise differs; the difference that is allowed in any case."""

    means: dict
    errors: dict
    z: float
    relative: float
    blocks: float
    allowed: float
    agree: bool


def bound(renderers, scenes):
    """What |z| is below where the means agree: level 0.01 for all pairs, channels and scenes together."""
    return sidak(3 * renderers * (renderers - 1) // 2 * scenes)


def blocks(stack):
    """Luminance of blocks, [replicate, row, column]."""
    light = error.luminance(stack)
    n, height, width = light.shape
    rows, columns = height // BLOCKS[0], width // BLOCKS[1]
    whole = light[:, :rows * BLOCKS[0], :columns * BLOCKS[1]]
    return whole.reshape(n, BLOCKS[0], rows, BLOCKS[1], columns).mean(axis=(2, 4))


def scores(estimates, replicates):
    """z of each pair of estimates."""
    return np.array([normal_score(a, b, replicates) for a, b in itertools.combinations(estimates, 2)])


def agreement(stacks, allowed, scenes):
    """`stacks`: pictures [replicate, y, x, channel] by renderer; `scenes`: how many scenes are one family of tests."""
    n = len(next(iter(stacks.values())))
    found = {key: estimate(s.mean(axis=(1, 2), dtype=np.float64)) for key, s in stacks.items()}
    z = float(np.abs(scores(found.values(), n)).max())
    bright = itertools.combinations((mean for mean, _ in found.values()), 2)
    relative = max(float(np.abs(a / b - 1).max()) for a, b in bright)
    local = scores([estimate(blocks(s)) for s in stacks.values()], n)
    return Agreement(
        means={key: mean.tolist() for key, (mean, _) in found.items()},
        errors={key: np.sqrt(variance).tolist() for key, (_, variance) in found.items()},
        z=z,
        relative=relative,
        blocks=float(np.sqrt(np.mean(local**2))),
        allowed=allowed,
        agree=z < bound(len(stacks), scenes) or relative < allowed,
    )
