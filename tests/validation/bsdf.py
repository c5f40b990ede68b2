"""Scattering models for Mitsuba whose masking is height-correlated.

Mitsuba's own `roughconductor` and `roughdielectric` use Smith's separable masking, G1(wi) G1(wo). The
renderer under test uses the height-correlated form, 1 / (1 + L(wi) + L(wo)) with L = 1 / G1 - 1 (Heitz
2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2)). Here the
masking is the only thing that is ours to write: the density of normals, the one-sided masking, the
samples and their density are Mitsuba's `MicrofacetDistribution`. With `masking = "separable"` the same
class must give what Mitsuba's own plugin gives; `validate.py` looks at that before anything else.

Mitsuba calls the direction to the camera `wi` and the other `wo`.
"""

import drjit as dr
import mitsuba as mi


def masked(distribution, masking, wi, wo, m):
    """The unmasked share of the normals `m` seen from both directions."""
    a, b = distribution.smith_g1(wi, m), distribution.smith_g1(wo, m)
    if masking == "separable":
        return a * b
    both = a * b / (a + b - a * b)
    return dr.select((a > 0) & (b > 0), both, 0)


def schlick(f0, c):
    """Schlick 1994; `c`: cosine to the microfacet."""
    return f0 + (1 - f0) * dr.power(dr.clip(1 - c, 0, 1), 5)


class Conductor(mi.BSDF):
    """GGX with Schlick's Fresnel; `color` at normal incidence, `alpha` the width itself."""

    def __init__(self, props):
        mi.BSDF.__init__(self, props)
        self.color = mi.Color3f(props["color"])
        self.alpha = props["alpha"]
        self.masking = props.get("masking", "correlated")
        self.m_flags = mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide
        self.m_components = [self.m_flags]

    def distribution(self):
        return mi.MicrofacetDistribution(mi.MicrofacetType.GGX, self.alpha, True)

    def sample(self, ctx, si, sample1, sample2, active=True):
        m, _ = self.distribution().sample(si.wi, sample2)
        wo = mi.reflect(si.wi, m)
        value, pdf = self.eval_pdf(ctx, si, wo, active)
        active = mi.Bool(active) & (pdf > 0)
        bs = dr.zeros(mi.BSDFSample3f)
        bs.wo, bs.pdf, bs.eta = wo, dr.select(active, pdf, 0), 1
        bs.sampled_type, bs.sampled_component = mi.UInt32(+mi.BSDFFlags.GlossyReflection), 0
        return bs, dr.select(active, value / pdf, 0)

    def eval(self, ctx, si, wo, active=True):
        return self.eval_pdf(ctx, si, wo, active)[0]

    def pdf(self, ctx, si, wo, active=True):
        return self.eval_pdf(ctx, si, wo, active)[1]

    def eval_pdf(self, ctx, si, wo, active=True):
        cos_i, cos_o = mi.Frame3f.cos_theta(si.wi), mi.Frame3f.cos_theta(wo)
        active = mi.Bool(active) & (cos_i > 0) & (cos_o > 0)
        m = dr.normalize(si.wi + wo)
        d = self.distribution()
        g = masked(d, self.masking, si.wi, wo, m)
        lobe = d.eval(m) * g / (4 * cos_i)
        value = schlick(self.color, dr.dot(si.wi, m)) * lobe
        pdf = d.pdf(si.wi, m) / (4 * dr.dot(wo, m))
        return dr.select(active, value, 0), dr.select(active, pdf, 0)


def register():
    """Makes the models known to `mi.load_dict`; after the variant has been chosen."""
    mi.register_bsdf("correlated_conductor", Conductor)


def deviation(mine, theirs, refracts):
    """Largest relative difference of eval and pdf over random pairs of directions."""
    n = 100_000
    rng = mi.PCG32(size=n)
    points = [mi.Point2f(rng.next_float32(), rng.next_float32()) for _ in range(2)]
    warp = mi.warp.square_to_uniform_sphere if refracts else mi.warp.square_to_uniform_hemisphere
    wi, wo = warp(points[0]), warp(points[1])
    si = dr.zeros(mi.SurfaceInteraction3f, n)
    si.wi = wi
    worst = 0
    for get in (lambda b: b.eval(mi.BSDFContext(), si, wo).x, lambda b: b.pdf(mi.BSDFContext(), si, wo)):
        a, b = get(mine), get(theirs)
        worst = max(worst, dr.max(dr.abs(a - b) / (1e-6 + dr.maximum(a, b)))[0])
    return worst


def self_check():
    """What the separable form of each model differs by from Mitsuba's own; raises where it does."""
    white = {"type": "rgb", "value": [1, 1, 1]}
    found = []
    for alpha in (0.05, 0.3, 0.9):
        mine = mi.load_dict({"type": "correlated_conductor", "color": white, "alpha": alpha,
                             "masking": "separable"})
        theirs = mi.load_dict({"type": "roughconductor", "material": "none", "distribution": "ggx",
                               "alpha": alpha})
        found.append(deviation(mine, theirs, refracts=False))
    if max(found) > 1e-3:
        raise RuntimeError(f"the conductor is not Mitsuba's: {found}")
    return f"largest relative difference {max(found):.0e}"
