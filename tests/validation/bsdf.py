"""Scattering models for Mitsuba that are masked by the height-correlated form.

Mitsuba's own `roughconductor` and `roughdielectric` use Smith's separable masking, G1(wi) G1(wo). The
renderer under test uses the height-correlated form for reflection and refraction, 1 / (1 + L(wi) + L(wo))
with L = 1 / G1 - 1 (Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs",
JCGT 3(2)). Here the masking is the only thing that is ours to write: the density of normals, the one-sided masking, the samples and their density are Mitsuba's
`MicrofacetDistribution`. With `masking = "separable"` the same class must give what Mitsuba's own plugin
gives; `validate.py` looks at that before anything else.

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
        d = self.distribution()
        m, _ = d.sample(si.wi, sample2)
        wo = mi.reflect(si.wi, m)
        pdf = self.pdf(ctx, si, wo, active)
        active = mi.Bool(active) & (pdf > 0)
        bs = dr.zeros(mi.BSDFSample3f)
        bs.wo, bs.pdf, bs.eta = wo, dr.select(active, pdf, 0), 1
        bs.sampled_type, bs.sampled_component = mi.UInt32(+mi.BSDFFlags.GlossyReflection), 0
        # The density of normals cancels; what is left is the masking given visibility.
        weight = masked(d, self.masking, si.wi, wo, m) / d.smith_g1(si.wi, m)
        return bs, dr.select(active, schlick(self.color, dr.dot(si.wi, m)) * weight, 0)

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


class Dielectric(mi.BSDF):
    """A GGX interface with the exact Fresnel term; `eta`: index inside over outside.

    Reflection and refraction: Walter et al. 2007, "Microfacet Models for Refraction through Rough
    Surfaces", eq. 20 and 21, with the radiance scaled at refraction as Mitsuba does.
    """

    def __init__(self, props):
        mi.BSDF.__init__(self, props)
        self.eta = props["eta"]
        self.alpha = props["alpha"]
        self.masking = props.get("masking", "correlated")
        sides = mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide
        reflection = mi.BSDFFlags.GlossyReflection | sides
        transmission = mi.BSDFFlags.GlossyTransmission | sides | mi.BSDFFlags.NonSymmetric
        self.m_components = [reflection, transmission]
        self.m_flags = reflection | transmission

    def distribution(self):
        return mi.MicrofacetDistribution(mi.MicrofacetType.GGX, self.alpha, True)

    def sample(self, ctx, si, sample1, sample2, active=True):
        d = self.distribution()
        m, _ = d.sample(dr.mulsign(si.wi, mi.Frame3f.cos_theta(si.wi)), sample2)
        f, cos_t, eta_it, eta_ti = mi.fresnel(dr.dot(si.wi, m), self.eta)
        reflected = sample1 <= f
        wo = dr.select(reflected, mi.reflect(si.wi, m), mi.refract(si.wi, m, cos_t, eta_ti))
        pdf = self.pdf(ctx, si, wo, active)
        active = mi.Bool(active) & (pdf > 0)
        bs = dr.zeros(mi.BSDFSample3f)
        bs.wo, bs.pdf = wo, dr.select(active, pdf, 0)
        bs.eta = dr.select(reflected, 1, eta_it)
        bs.sampled_type = dr.select(reflected, mi.UInt32(+mi.BSDFFlags.GlossyReflection),
                                    mi.UInt32(+mi.BSDFFlags.GlossyTransmission))
        bs.sampled_component = dr.select(reflected, mi.UInt32(0), mi.UInt32(1))
        # Fresnel and the density of normals cancel; what is left is the masking given visibility.
        weight = masked(d, self.masking, si.wi, wo, m) / d.smith_g1(si.wi, m)
        weight *= dr.select(reflected, 1, dr.square(eta_ti))
        return bs, dr.select(active, mi.Color3f(weight), 0)

    def eval(self, ctx, si, wo, active=True):
        return self.eval_pdf(ctx, si, wo, active)[0]

    def pdf(self, ctx, si, wo, active=True):
        return self.eval_pdf(ctx, si, wo, active)[1]

    def eval_pdf(self, ctx, si, wo, active=True):
        cos_i, cos_o = mi.Frame3f.cos_theta(si.wi), mi.Frame3f.cos_theta(wo)
        reflected = cos_i * cos_o > 0
        eta = dr.select(cos_i > 0, mi.Float(self.eta), mi.Float(1 / self.eta))
        m = dr.normalize(si.wi + wo * dr.select(reflected, 1, eta))
        m = dr.mulsign(m, mi.Frame3f.cos_theta(m))
        wi_m, wo_m = dr.dot(si.wi, m), dr.dot(wo, m)
        active = mi.Bool(active) & (wi_m * cos_i > 0) & (wo_m * cos_o > 0)
        d = self.distribution()
        f, _, _, _ = mi.fresnel(wi_m, self.eta)
        lobe = d.eval(m) * masked(d, self.masking, si.wi, wo, m)
        # Half vector over outgoing direction, per solid angle.
        spread = dr.abs(eta * eta * wo_m) / dr.square(wi_m + eta * wo_m)
        value = dr.select(reflected, f * lobe / (4 * dr.abs(cos_i)),
                          (1 - f) * lobe * spread * dr.abs(wi_m / cos_i) / dr.square(eta))
        upper = dr.mulsign(si.wi, cos_i)
        pdf = d.pdf(upper, m) * dr.select(reflected, f / (4 * dr.abs(wo_m)), (1 - f) * spread)
        return dr.select(active, mi.Color3f(value), 0), dr.select(active, pdf, 0)


def register():
    """Makes the models known to `mi.load_dict`; after the variant has been chosen."""
    mi.register_bsdf("correlated_conductor", Conductor)
    mi.register_bsdf("correlated_dielectric", Dielectric)


def deviation(mine, theirs, refracts):
    """Largest relative difference of values, densities and weights of samples over random directions."""
    n = 100_000
    rng = mi.PCG32(size=n)
    first, second = (mi.Point2f(rng.next_float32(), rng.next_float32()) for _ in range(2))
    choice = rng.next_float32()
    warp = mi.warp.square_to_uniform_sphere if refracts else mi.warp.square_to_uniform_hemisphere
    ctx, wo = mi.BSDFContext(), warp(second)
    si = dr.zeros(mi.SurfaceInteraction3f, n)
    si.wi = warp(first)
    worst = 0
    for get in (lambda b: b.eval(ctx, si, wo).x, lambda b: b.pdf(ctx, si, wo),
                lambda b: b.sample(ctx, si, choice, second)[1].x,
                lambda b: b.sample(ctx, si, choice, second)[0].eta,
                lambda b: b.sample(ctx, si, choice, second)[0].wo.z):
        a, b = get(mine), get(theirs)
        off = dr.abs(a - b) / (1e-3 + dr.maximum(dr.abs(a), dr.abs(b)))
        worst = max(worst, dr.max(off)[0])
    return worst


def self_check():
    """What the separable form of each model differs by from Mitsuba's own; raises where it does."""
    white = {"type": "rgb", "value": [1, 1, 1]}
    found = []
    for alpha in (0.05, 0.3, 0.9):
        ggx = {"distribution": "ggx", "alpha": alpha}
        mine = {"alpha": alpha, "masking": "separable"}
        pairs = [
            ({"type": "correlated_conductor", "color": white, **mine},
             {"type": "roughconductor", "material": "none", **ggx}, False),
            ({"type": "correlated_dielectric", "eta": 1.5, **mine},
             {"type": "roughdielectric", "int_ior": 1.5, "ext_ior": 1.0, **ggx}, True),
        ]
        found += [deviation(mi.load_dict(a), mi.load_dict(b), c) for a, b, c in pairs]
    if max(found) > 1e-3:
        raise RuntimeError(f"a plug-in is not Mitsuba's model: {found}")
    return f"largest relative difference {max(found):.0e}"
