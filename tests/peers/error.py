"""How wrong a picture is against a reference that is itself a little wrong: the trimmed relMSE of docs/error.md.

Of the luminance Y: (Y - R)^2 / (R^2 + e^2) of each pixel, where R is the reference and e a hundredth of its mean; the
worst 0.1 % of the pixels are left out, the others averaged. What the noise of the reference adds is known from its
replicates and taken off.
"""

from dataclasses import dataclass

import numpy as np

# The share of the pixels that is left out.
TRIM = 0.001


def luminance(picture):
    """Of linear Rec. 709, over the last axis."""
    return np.asarray(picture, dtype=np.float64) @ (0.2126, 0.7152, 0.0722)


@dataclass
class Reference:
    """Luminance [y, x], and the variance that it has itself."""

    mean: np.ndarray
    variance: np.ndarray

    def scale(self):
        """What squares of differences are divided by."""
        return self.mean**2 + (0.01 * self.mean.mean()) ** 2


def least(values, share=TRIM):
    """Which pixels are kept."""
    order = np.argsort(values, axis=None)
    return order[:len(order) - int(np.ceil(share * len(order)))]


def judge(picture, reference):
    """The trimmed relMSE of a picture [y, x, channel]."""
    scale = reference.scale()
    off = ((luminance(picture) - reference.mean) ** 2 / scale).ravel()
    kept = least(off)
    return float((off - (reference.variance / scale).ravel())[kept].mean())


def join(stacks):
    """Independent pictures [replicate, y, x, channel] of each renderer → one reference of all.

    Each renderer counts with the inverse of its noise, so that the joint reference is better than the best of them.
    A weight is one number a renderer: weights of pixels would favour what happens to be dark.
    """
    lights = [luminance(s) for s in stacks]
    means = np.array([v.mean(axis=0) for v in lights])
    variances = np.array([v.var(axis=0, ddof=1) / len(v) for v in lights])
    scale = Reference(means.mean(axis=0), 0).scale()
    noise = [v[least(v)].mean() for v in ((v / scale).ravel() for v in variances)]
    weights = 1 / np.array(noise)
    weights /= weights.sum()
    return Reference(np.tensordot(weights, means, 1), np.tensordot(weights**2, variances, 1))
