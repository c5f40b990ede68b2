// Generated from WGSL by the crate `native`. Do not edit.
use crate::scalar as scalar;

#[derive(Clone, Copy, Debug)]
pub struct Pair {
    pub a: v::F,
    pub n: v::U,
    pub v: v::V3<v::F>,
    pub odd: v::B,
}

impl Pair {
    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn zero() -> Self {
        Self {
            a: v::f(0.0),
            n: v::u(0),
            v: v::V3 { x: v::f(0.0), y: v::f(0.0), z: v::f(0.0) },
            odd: v::b(false),
        }
    }
    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn select(m: v::B, yes: &Self, no: &Self) -> Self {
        Self {
            a: v::select_f(m, yes.a, no.a),
            n: v::select_u(m, yes.n, no.n),
            v: v::V3 { x: v::select_f(m, yes.v.x, no.v.x), y: v::select_f(m, yes.v.y, no.v.y), z: v::select_f(m, yes.v.z, no.v.z) },
            odd: v::select_b(m, yes.odd, no.odd),
        }
    }
    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn lane(&self, k: usize) -> scalar::Pair {
        scalar::Pair {
            a: v::f_to(self.a)[k % v::LANES],
            n: v::u_to(self.n)[k % v::LANES],
            v: glam::Vec3::new(v::f_to(self.v.x)[k % v::LANES], v::f_to(self.v.y)[k % v::LANES], v::f_to(self.v.z)[k % v::LANES]),
            odd: v::b_to(self.odd)[k % v::LANES],
        }
    }
    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn of(x: &[scalar::Pair; 8]) -> Self {
        Self {
            a: v::f_of([x[0].a, x[1].a, x[2].a, x[3].a, x[4].a, x[5].a, x[6].a, x[7].a]),
            n: v::u_of([x[0].n, x[1].n, x[2].n, x[3].n, x[4].n, x[5].n, x[6].n, x[7].n]),
            v: v::V3 { x: v::f_of([x[0].v.x, x[1].v.x, x[2].v.x, x[3].v.x, x[4].v.x, x[5].v.x, x[6].v.x, x[7].v.x]), y: v::f_of([x[0].v.y, x[1].v.y, x[2].v.y, x[3].v.y, x[4].v.y, x[5].v.y, x[6].v.y, x[7].v.y]), z: v::f_of([x[0].v.z, x[1].v.z, x[2].v.z, x[3].v.z, x[4].v.z, x[5].v.z, x[6].v.z, x[7].v.z]) },
            odd: v::b_of([x[0].odd, x[1].odd, x[2].odd, x[3].odd, x[4].odd, x[5].odd, x[6].odd, x[7].odd]),
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub struct Pairs {
    pub first: Pair,
    pub second: Pair,
}

impl Pairs {
    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn zero() -> Self {
        Self {
            first: Pair::zero(),
            second: Pair::zero(),
        }
    }
    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn select(m: v::B, yes: &Self, no: &Self) -> Self {
        Self {
            first: Pair::select(m, &yes.first, &no.first),
            second: Pair::select(m, &yes.second, &no.second),
        }
    }
    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn lane(&self, k: usize) -> scalar::Pairs {
        scalar::Pairs {
            first: self.first.lane(k),
            second: self.second.lane(k),
        }
    }
    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn of(x: &[scalar::Pairs; 8]) -> Self {
        Self {
            first: Pair::of(&[x[0].first, x[1].first, x[2].first, x[3].first, x[4].first, x[5].first, x[6].first, x[7].first]),
            second: Pair::of(&[x[0].second, x[1].second, x[2].second, x[3].second, x[4].second, x[5].second, x[6].second, x[7].second]),
        }
    }
}

/// The resources of one group of invocations after another.
pub struct Kernel<'a> {
    pub given: &'a [glam::UVec4],
    pub found: &'a mut [glam::UVec4],
}

impl<'a> Kernel<'a> {
    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn main(&mut self, mut mask: v::B, id: v::V3<v::U>) {
        let i = id.x;
        let word = v::at(self.given, i, mask);
        let e5 = word.z;
        let x = v::f_bits_u(e5);
        let e7 = word.w;
        let y = v::f_bits_u(e7);
        let e9 = word.x;
        let t = v::u(77u32);
        let e11 = v::eq_u(e9, t);
        let mut m = v::and_b(mask, e11);
        if v::any(m) {
            m = v::b(false);
        }
        let mut m_ = v::but_b(mask, e11);
        mask = v::or_b(m, m_);
        if v::any(mask) {
            let t_ = v::u(10u32);
            let at = v::mul_u(i, t_);
            let e16 = word.x;
            let e17 = word.y;
            let t__ = v::u(9u32);
            let e19 = v::rem_u(e17, t__);
            let e20 = self.parting(mask, e16, e19);
            let e21 = word.x;
            let t___ = v::u(9u32);
            let e23 = v::rem_u(e21, t___);
            let e24 = self.turns(mask, e23);
            let e25 = word.x;
            let e26 = self.anew(mask, e25);
            let e27 = word.y;
            let e28 = self.kept(mask, e27);
            let e29 = v::V4 { x: e20, y: e24, z: e26, w: e28 };
            v::put(self.found, at, e29, mask);
            let t____ = v::u(1u32);
            let e32 = v::add_u(at, t____);
            let e34 = self.guarded(mask, x);
            let e35 = v::u_bits_f(e34);
            let e36 = self.guarded(mask, y);
            let e37 = v::u_bits_f(e36);
            let t_____ = v::u(0u32);
            let e39 = v::V4 { x: e35, y: e37, z: i, w: t_____ };
            v::put(self.found, e32, e39, mask);
            let t______ = v::u(2u32);
            let e42 = v::add_u(at, t______);
            let e44 = word.x;
            let e45 = self.pointed(mask, x, e44);
            let e46 = v::V4 { x: v::u_bits_f(e45.x), y: v::u_bits_f(e45.y), z: v::u_bits_f(e45.z), w: v::u_bits_f(e45.w) };
            v::put(self.found, e42, e46, mask);
            let t_______ = v::u(3u32);
            let e49 = v::add_u(at, t_______);
            let e51 = word.y;
            let e52 = v::i_bits_u(e51);
            let e53 = self.indexed(mask, e52, x);
            let e54 = v::V4 { x: v::u_bits_f(e53.x), y: v::u_bits_f(e53.y), z: v::u_bits_f(e53.z), w: v::u_bits_f(e53.w) };
            v::put(self.found, e49, e54, mask);
            let t________ = v::u(4u32);
            let e57 = v::add_u(at, t________);
            let e59 = word.x;
            let e60 = word.y;
            let e61 = v::i_bits_u(e60);
            let e62 = self.integers(mask, e59, e61);
            v::put(self.found, e57, e62, mask);
            let t_________ = v::u(5u32);
            let e65 = v::add_u(at, t_________);
            let e67 = self.floats(mask, x, y);
            let e68 = v::V4 { x: v::u_bits_f(e67.x), y: v::u_bits_f(e67.y), z: v::u_bits_f(e67.z), w: v::u_bits_f(e67.w) };
            v::put(self.found, e65, e68, mask);
            let t__________ = v::u(6u32);
            let e71 = v::add_u(at, t__________);
            let e73 = word.y;
            let e74 = self.conversions(mask, e73, x);
            v::put(self.found, e71, e74, mask);
            let t___________ = v::u(7u32);
            let e77 = v::add_u(at, t___________);
            let e81 = v::at_same(self.given, 2);
            let e84 = v::at_same(self.given, 3);
            let e85 = v::V4 { x: e84.w, y: e84.z, z: e84.y, w: e84.x };
            let e86 = v::V4 { x: v::add_u(e81.x, e85.x), y: v::add_u(e81.y, e85.y), z: v::add_u(e81.z, e85.z), w: v::add_u(e81.w, e85.w) };
            v::put(self.found, e77, e86, mask);
            let t____________ = v::u(8u32);
            let e89 = v::add_u(at, t____________);
            let e92 = word.x;
            let e93 = v::xor_u(i, e92);
            let e95 = v::at(self.given, e93, mask);
            let e97 = word.x;
            let t_____________ = v::u(11u32);
            let e99 = v::rem_u(e97, t_____________);
            let e101 = v::at(self.given, e99, mask);
            let e102 = v::V4 { x: v::add_u(e95.x, e101.x), y: v::add_u(e95.y, e101.y), z: v::add_u(e95.z, e101.z), w: v::add_u(e95.w, e101.w) };
            v::put(self.found, e89, e102, mask);
            let t______________ = v::f(2.0f32);
            let e105 = v::V3 { x: x, y: t______________, z: y };
            let e106 = word.x;
            let t_______________ = v::u(1u32);
            let e108 = v::and_u(e106, t_______________);
            let t________________ = v::u(1u32);
            let e110 = v::eq_u(e108, t________________);
            let second = Pair { a: y, n: v::u(3u32), v: e105, odd: e110 };
            let e112 = word.y;
            let t_________________ = v::f(1.0f32);
            let e114 = v::V3 { x: y, y: x, z: t_________________ };
            let e116 = Pair { a: x, n: e112, v: e114, odd: v::b(true) };
            let pairs = Pairs { first: e116, second: second };
            let t__________________ = v::u(9u32);
            let e120 = v::add_u(at, t__________________);
            let e122 = word.x;
            let e123 = self.exchanged(mask, &pairs, e122);
            let e124 = v::V4 { x: v::u_bits_f(e123.x), y: v::u_bits_f(e123.y), z: v::u_bits_f(e123.z), w: v::u_bits_f(e123.w) };
            v::put(self.found, e120, e124, mask);
        }
    }

    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn parting(&mut self, mut mask: v::B, kind: v::U, n: v::U) -> v::U {
        let mut sum: v::U = v::u(1u32);
        let mut i: v::U = v::u(0u32);
        let mut result: v::U = v::u(0);
        let t = v::u(5u32);
        let e5 = v::rem_u(kind, t);
        let mut broken = v::b(false);
        let mut m = v::and_b(mask, v::eq_u(e5, v::u(0)));
        if v::any(m) {
            let mut m_ = m;
            let mut broken_ = v::b(false);
            loop {
                let mut waiting = v::b(false);
                let e8 = i;
                let e9 = v::lt_u(e8, n);
                let mut m__ = v::and_b(m_, e9);
                let mut m___ = v::but_b(m_, e9);
                if v::any(m___) {
                    broken_ = v::or_b(broken_, m___);
                    m___ = v::b(false);
                }
                m_ = v::or_b(m__, m___);
                if v::any(m_) {
                    {
                        let e10 = sum;
                        let t_ = v::u(3u32);
                        let e12 = v::mul_u(e10, t_);
                        let e13 = i;
                        let e14 = v::add_u(e12, e13);
                        sum = v::select_u(m_, e14, sum);
                        let e15 = sum;
                        let t__ = v::u(7u32);
                        let e17 = v::rem_u(e15, t__);
                        let t___ = v::u(3u32);
                        let e19 = v::eq_u(e17, t___);
                        let mut m____ = v::and_b(m_, e19);
                        if v::any(m____) {
                            let e20 = sum;
                            result = v::select_u(m____, e20, result);
                            m____ = v::b(false);
                        }
                        let mut m_____ = v::but_b(m_, e19);
                        m_ = v::or_b(m____, m_____);
                    }
                }
                m_ = v::or_b(m_, waiting);
                let e22 = i;
                let t____ = v::u(1u32);
                let e23 = v::add_u(e22, t____);
                i = v::select_u(m_, e23, i);
                if !v::any(m_) {
                    break;
                }
            }
            m = broken_;
            if v::any(m) {
                let e24 = sum;
                let t_____ = v::u(1000u32);
                let e26 = v::add_u(e24, t_____);
                sum = v::select_u(m, e26, sum);
            }
        }
        let mut m______ = v::and_b(mask, v::or_b(v::eq_u(e5, v::u(1)), v::eq_u(e5, v::u(2))));
        if v::any(m______) {
            let t______ = v::u(3u32);
            let e28 = v::rem_u(n, t______);
            let t_______ = v::u(1u32);
            let e30 = v::eq_u(e28, t_______);
            let mut m_______ = v::and_b(m______, e30);
            if v::any(m_______) {
                broken = v::or_b(broken, m_______);
                m_______ = v::b(false);
            }
            let mut m________ = v::but_b(m______, e30);
            m______ = v::or_b(m_______, m________);
            if v::any(m______) {
                let e31 = sum;
                let t________ = v::u(20u32);
                let e33 = v::add_u(e31, t________);
                sum = v::select_u(m______, e33, sum);
            }
        }
        let mut m_________ = v::and_b(mask, v::eq_u(e5, v::u(3)));
        if v::any(m_________) {
            let t_________ = v::u(7u32);
            result = v::select_u(m_________, t_________, result);
            m_________ = v::b(false);
        }
        let mut m__________ = v::but_b(mask, v::or_b(v::or_b(v::or_b(v::eq_u(e5, v::u(0)), v::eq_u(e5, v::u(1))), v::eq_u(e5, v::u(2))), v::eq_u(e5, v::u(3))));
        if v::any(m__________) {
            let e35 = sum;
            let t__________ = v::u(30u32);
            let e37 = v::add_u(e35, t__________);
            sum = v::select_u(m__________, e37, sum);
        }
        mask = v::or_b(v::or_b(v::or_b(v::or_b(broken, m), m______), m_________), m__________);
        if v::any(mask) {
            let e38 = sum;
            let e39 = v::add_u(e38, kind);
            result = v::select_u(mask, e39, result);
        }
        result
    }

    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn turns(&mut self, mut mask: v::B, n: v::U) -> v::U {
        let mut sum: v::U = v::u(0u32);
        let mut i: v::U = v::u(0u32);
        let mut inner: v::U;
        let mut result: v::U = v::u(0);
        let mut m = mask;
        let mut broken = v::b(false);
        loop {
            let mut waiting = v::b(false);
            let e5 = i;
            let e6 = v::ge_u(e5, n);
            let mut m_ = v::and_b(m, e6);
            if v::any(m_) {
                broken = v::or_b(broken, m_);
                m_ = v::b(false);
            }
            let mut m__ = v::but_b(m, e6);
            m = v::or_b(m_, m__);
            if v::any(m) {
                inner = v::u(0u32);
                let mut m___ = m;
                let mut broken_ = v::b(false);
                loop {
                    let mut waiting_ = v::b(false);
                    let e9 = inner;
                    let t = v::u(1u32);
                    let e11 = v::add_u(e9, t);
                    inner = v::select_u(m___, e11, inner);
                    let e12 = inner;
                    let e13 = i;
                    let e14 = v::gt_u(e12, e13);
                    let mut m____ = v::and_b(m___, e14);
                    if v::any(m____) {
                        broken_ = v::or_b(broken_, m____);
                        m____ = v::b(false);
                    }
                    let mut m_____ = v::but_b(m___, e14);
                    m___ = v::or_b(m____, m_____);
                    if v::any(m___) {
                        let e15 = inner;
                        let t_ = v::u(1u32);
                        let e17 = v::and_u(e15, t_);
                        let t__ = v::u(0u32);
                        let e19 = v::eq_u(e17, t__);
                        let mut m______ = v::and_b(m___, e19);
                        if v::any(m______) {
                            waiting_ = v::or_b(waiting_, m______);
                            m______ = v::b(false);
                        }
                        let mut m_______ = v::but_b(m___, e19);
                        m___ = v::or_b(m______, m_______);
                        if v::any(m___) {
                            let e20 = sum;
                            let e21 = inner;
                            let e22 = v::add_u(e20, e21);
                            sum = v::select_u(m___, e22, sum);
                        }
                    }
                    m___ = v::or_b(m___, waiting_);
                    let e23 = sum;
                    let t___ = v::u(1u32);
                    let e25 = v::add_u(e23, t___);
                    sum = v::select_u(m___, e25, sum);
                    let e26 = inner;
                    let t____ = v::u(5u32);
                    let e28 = v::eq_u(e26, t____);
                    broken_ = v::or_b(broken_, v::and_b(m___, e28));
                    m___ = v::but_b(m___, e28);
                    if !v::any(m___) {
                        break;
                    }
                }
                let e29 = i;
                let t_____ = v::u(1u32);
                let e31 = v::add_u(e29, t_____);
                i = v::select_u(m, e31, i);
                let e32 = i;
                let t______ = v::u(4u32);
                let e34 = v::rem_u(e32, t______);
                let t_______ = v::u(2u32);
                let e36 = v::eq_u(e34, t_______);
                let mut m________ = v::and_b(m, e36);
                if v::any(m________) {
                    waiting = v::or_b(waiting, m________);
                    m________ = v::b(false);
                }
                let mut m_________ = v::but_b(m, e36);
                m = v::or_b(m________, m_________);
                if v::any(m) {
                    let e37 = sum;
                    let t________ = v::u(60u32);
                    let e39 = v::gt_u(e37, t________);
                    let mut m__________ = v::and_b(m, e39);
                    if v::any(m__________) {
                        let e40 = sum;
                        let t_________ = v::u(500u32);
                        let e42 = v::add_u(e40, t_________);
                        result = v::select_u(m__________, e42, result);
                        m__________ = v::b(false);
                    }
                    let mut m___________ = v::but_b(m, e39);
                    m = v::or_b(m__________, m___________);
                    if v::any(m) {
                        let e43 = sum;
                        let t__________ = v::u(2u32);
                        let e45 = v::add_u(e43, t__________);
                        sum = v::select_u(m, e45, sum);
                    }
                }
            }
            m = v::or_b(m, waiting);
            if !v::any(m) {
                break;
            }
        }
        mask = broken;
        if v::any(mask) {
            let e46 = sum;
            result = v::select_u(mask, e46, result);
        }
        result
    }

    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn guarded(&mut self, mut mask: v::B, x: v::F) -> v::F {
        let mut y: v::F;
        y = x;
        let t = v::f(0.0f32);
        let e3 = v::gt_f(x, t);
        let mut m = v::and_b(mask, e3);
        if v::any(m) {
            let e4 = v::sqrt_f(x);
            let e5 = v::div_f(e4, x);
            y = v::select_f(m, e5, y);
        }
        let mut m_ = v::but_b(mask, e3);
        if v::any(m_) {
            let t_ = v::f(-1.0f32);
            let e7 = v::lt_f(x, t_);
            let mut m__ = v::and_b(m_, e7);
            if v::any(m__) {
                let e8 = v::neg_f(x);
                let e9 = v::sqrt_f(e8);
                let t__ = v::f(1.0f32);
                let e11 = v::div_f(t__, x);
                let e12 = v::sub_f(e9, e11);
                y = v::select_f(m__, e12, y);
            }
        }
        let e13 = y;
        return e13;
    }

    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn change(&mut self, mut mask: v::B, pair: &mut Pair, x: v::F) -> v::B {
        let mut result: v::B = v::b(false);
        let t = v::f(0.0f32);
        let e3 = v::lt_f(x, t);
        let mut m = v::and_b(mask, e3);
        if v::any(m) {
            let e5 = (*pair).n;
            let t_ = v::u(5u32);
            let e7 = v::add_u(e5, t_);
            (*pair).n = v::select_u(m, e7, (*pair).n);
            let t__ = v::b(false);
            result = v::select_b(m, t__, result);
            m = v::b(false);
        }
        let mut m_ = v::but_b(mask, e3);
        mask = v::or_b(m, m_);
        if v::any(mask) {
            (*pair).v.y = v::select_f(mask, x, (*pair).v.y);
            let e12 = (*pair).a;
            let t___ = v::f(2.0f32);
            let e14 = v::mul_f(e12, t___);
            (*pair).a = v::select_f(mask, e14, (*pair).a);
            let e16 = (*pair).odd;
            result = v::select_b(mask, e16, result);
        }
        result
    }

    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn pointed(&mut self, mut mask: v::B, x: v::F, n: v::U) -> v::V4<v::F> {
        let t = v::f(3.0f32);
        let mut other: Pair = Pair { a: v::f(1.0f32), n: v::u(2u32), v: v::V3 { x: t, y: t, z: t }, odd: v::b(false) };
        let mut sum: v::F = v::f(0.0f32);
        let t_ = v::f(1.0f32);
        let t__ = v::f(2.0f32);
        let e4 = v::V3 { x: x, y: t_, z: t__ };
        let t___ = v::u(1u32);
        let e6 = v::and_u(n, t___);
        let t____ = v::u(1u32);
        let e8 = v::eq_u(e6, t____);
        let mut pair: Pair;
        pair = Pair { a: x, n: n, v: e4, odd: e8 };
        let t_____ = v::f(3.0f32);
        let e13 = v::V3 { x: t_____, y: t_____, z: t_____ };
        let e16 = Pair { a: v::f(1.0f32), n: v::u(2u32), v: e13, odd: v::b(false) };
        let t______ = v::u(3u32);
        let e21 = v::rem_u(n, t______);
        let t_______ = v::u(0u32);
        let e23 = v::eq_u(e21, t_______);
        let mut m = v::and_b(mask, e23);
        if v::any(m) {
            let e24 = self.change(m, &mut pair, x);
            let mut m_ = v::and_b(m, e24);
            if v::any(m_) {
                let t________ = v::f(10.0f32);
                sum = v::select_f(m_, t________, sum);
            }
        }
        let mut m__ = v::but_b(mask, e23);
        if v::any(m__) {
            let t_________ = v::u(3u32);
            let e27 = v::rem_u(n, t_________);
            let t__________ = v::u(1u32);
            let e29 = v::eq_u(e27, t__________);
            let mut m___ = v::and_b(m__, e29);
            if v::any(m___) {
                let e30 = pair;
                other = Pair::select(m___, &e30, &other);
                let e31 = sum;
                let e32 = v::neg_f(x);
                let e33 = self.change(m___, &mut other, e32);
                let t___________ = v::f(2.0f32);
                let t____________ = v::f(1.0f32);
                let e36 = v::select_f(e33, t___________, t____________);
                let e37 = v::add_f(e31, e36);
                sum = v::select_f(m___, e37, sum);
                let e40 = other.v;
                let t_____________ = v::f(2.0f32);
                let e42 = v::V3 { x: v::mul_f(e40.x, t_____________), y: v::mul_f(e40.y, t_____________), z: v::mul_f(e40.z, t_____________) };
                pair.v = v::V3 { x: v::select_f(m___, e42.x, pair.v.x), y: v::select_f(m___, e42.y, pair.v.y), z: v::select_f(m___, e42.z, pair.v.z) };
            }
        }
        let e44 = pair.v;
        let e45 = sum;
        let e47 = pair.a;
        let e48 = v::add_f(e45, e47);
        let e50 = other.a;
        let e51 = v::add_f(e48, e50);
        let e53 = pair.n;
        let e55 = other.n;
        let e56 = v::add_u(e53, e55);
        let e57 = v::f_from_u(e56);
        let e58 = v::add_f(e51, e57);
        let e59 = v::V4 { x: e44.x, y: e44.y, z: e44.z, w: e58 };
        return e59;
    }

    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn exchanged(&mut self, mut mask: v::B, p: &Pairs, n: v::U) -> v::V4<v::F> {
        let mut q: Pair;
        q = (*p).second;
        let t = v::u(3u32);
        let e5 = v::rem_u(n, t);
        let t_ = v::u(0u32);
        let e7 = v::ne_u(e5, t_);
        let mut m = v::and_b(mask, e7);
        if v::any(m) {
            let e10 = q.v.y;
            let e12 = q.n;
            let e14 = (*p).first.n;
            let e15 = v::add_u(e12, e14);
            let e17 = q.a;
            let e19 = (*p).first.v;
            let e20 = e19.x;
            let e23 = q.v.z;
            let e24 = v::V3 { x: e17, y: e20, z: e23 };
            let e26 = q.odd;
            let e27 = v::not_b(e26);
            q.a = v::select_f(m, e10, q.a);
            q.n = v::select_u(m, e15, q.n);
            q.v = v::V3 { x: v::select_f(m, e24.x, q.v.x), y: v::select_f(m, e24.y, q.v.y), z: v::select_f(m, e24.z, q.v.z) };
            q.odd = v::select_b(m, e27, q.odd);
        }
        let e30 = q.v;
        let e32 = q.a;
        let e34 = q.n;
        let e35 = v::f_from_u(e34);
        let e36 = v::add_f(e32, e35);
        let e38 = q.odd;
        let t__ = v::f(0.5f32);
        let t___ = v::f(0.0f32);
        let e41 = v::select_f(e38, t__, t___);
        let e42 = v::add_f(e36, e41);
        let e43 = v::V4 { x: e30.x, y: e30.y, z: e30.z, w: e42 };
        return e43;
    }

    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn anew(&mut self, mut mask: v::B, n: v::U) -> v::U {
        let mut sum: v::U = v::u(0u32);
        let mut i: v::U = v::u(0u32);
        let mut part: v::V2<v::U>;
        let mut m = mask;
        let mut broken = v::b(false);
        loop {
            let mut waiting = v::b(false);
            let e5 = i;
            let t = v::u(6u32);
            let e7 = v::lt_u(e5, t);
            let mut m_ = v::and_b(m, e7);
            let mut m__ = v::but_b(m, e7);
            if v::any(m__) {
                broken = v::or_b(broken, m__);
                m__ = v::b(false);
            }
            m = v::or_b(m_, m__);
            if v::any(m) {
                {
                    part = v::V2 { x: v::u(0), y: v::u(0) };
                    let e10 = i;
                    let e11 = v::V2 { x: e10, y: n };
                    part = e11;
                    let e12 = i;
                    let e13 = v::add_u(n, e12);
                    let t_ = v::u(3u32);
                    let e15 = v::rem_u(e13, t_);
                    let t__ = v::u(0u32);
                    let e17 = v::eq_u(e15, t__);
                    let mut m___ = v::and_b(m, e17);
                    if v::any(m___) {
                        waiting = v::or_b(waiting, m___);
                        m___ = v::b(false);
                    }
                    let mut m____ = v::but_b(m, e17);
                    m = v::or_b(m___, m____);
                    if v::any(m) {
                        let e19 = part.x;
                        let t___ = v::u(7u32);
                        let e21 = v::add_u(e19, t___);
                        part.x = e21;
                        let e22 = i;
                        let e23 = v::xor_u(n, e22);
                        let t____ = v::u(5u32);
                        let e25 = v::rem_u(e23, t____);
                        let t_____ = v::u(0u32);
                        let e27 = v::eq_u(e25, t_____);
                        let mut m_____ = v::and_b(m, e27);
                        if v::any(m_____) {
                            broken = v::or_b(broken, m_____);
                            m_____ = v::b(false);
                        }
                        let mut m______ = v::but_b(m, e27);
                        m = v::or_b(m_____, m______);
                        if v::any(m) {
                            let e29 = part.y;
                            let e30 = i;
                            let e31 = v::add_u(e29, e30);
                            part.y = e31;
                            let e32 = sum;
                            let t______ = v::u(5u32);
                            let e34 = v::mul_u(e32, t______);
                            let e36 = part.x;
                            let e37 = v::add_u(e34, e36);
                            let e39 = part.y;
                            let e40 = v::add_u(e37, e39);
                            sum = v::select_u(m, e40, sum);
                        }
                    }
                }
            }
            m = v::or_b(m, waiting);
            let e42 = i;
            let t_______ = v::u(1u32);
            let e43 = v::add_u(e42, t_______);
            i = v::select_u(m, e43, i);
            if !v::any(m) {
                break;
            }
        }
        let e44 = sum;
        return e44;
    }

    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn kept(&mut self, mut mask: v::B, n: v::U) -> v::U {
        let mut last: v::U;
        let mut sum: v::U = v::u(0u32);
        let mut i: v::U = v::u(0u32);
        last = n;
        let mut m = mask;
        let mut broken = v::b(false);
        loop {
            let mut waiting = v::b(false);
            let e6 = i;
            let t = v::u(6u32);
            let e8 = v::lt_u(e6, t);
            let mut m_ = v::and_b(m, e8);
            let mut m__ = v::but_b(m, e8);
            if v::any(m__) {
                broken = v::or_b(broken, m__);
                m__ = v::b(false);
            }
            m = v::or_b(m_, m__);
            if v::any(m) {
                {
                    let e9 = i;
                    let e10 = v::add_u(n, e9);
                    let t_ = v::u(2u32);
                    let e12 = v::rem_u(e10, t_);
                    let t__ = v::u(0u32);
                    let e14 = v::eq_u(e12, t__);
                    let mut m___ = v::and_b(m, e14);
                    if v::any(m___) {
                        waiting = v::or_b(waiting, m___);
                        m___ = v::b(false);
                    }
                    let mut m____ = v::but_b(m, e14);
                    m = v::or_b(m___, m____);
                    if v::any(m) {
                        let e15 = sum;
                        let e16 = last;
                        let e17 = v::add_u(e15, e16);
                        sum = v::select_u(m, e17, sum);
                        let e18 = i;
                        let t___ = v::u(3u32);
                        let e20 = v::mul_u(e18, t___);
                        last = v::select_u(m, e20, last);
                    }
                }
            }
            m = v::or_b(m, waiting);
            let e22 = i;
            let t____ = v::u(1u32);
            let e23 = v::add_u(e22, t____);
            i = v::select_u(m, e23, i);
            if !v::any(m) {
                break;
            }
        }
        let e24 = sum;
        let t_____ = v::u(8u32);
        let e26 = v::mul_u(e24, t_____);
        let e27 = last;
        let e28 = v::add_u(e26, e27);
        return e28;
    }

    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn indexed(&mut self, mut mask: v::B, n: v::I, x: v::F) -> v::V4<v::F> {
        let mut list: [v::F; 4];
        let mut v_: v::V3<v::F>;
        let e5 = [x, v::f(2.0f32), v::f(3.0f32), v::f(4.0f32)];
        list = e5;
        let t = v::f(5.0f32);
        let t_ = v::f(6.0f32);
        let e9 = v::V3 { x: x, y: t, z: t_ };
        v_ = e9;
        let t__ = v::i(6i32);
        let i = v::rem_i(n, t__);
        let e13 = v::u_from_i(i);
        let t___ = v::u(4u32);
        let e15 = v::rem_u(e13, t___);
        let e17 = v::pick_f(&[list[0], list[1], list[2], list[3]], e15);
        let t____ = v::f(10.0f32);
        let e19 = v::add_f(e17, t____);
        list[0] = v::select_f(v::and_b(mask, v::eq_u(e15, v::u(0))), e19, list[0]);
        list[1] = v::select_f(v::and_b(mask, v::eq_u(e15, v::u(1))), e19, list[1]);
        list[2] = v::select_f(v::and_b(mask, v::eq_u(e15, v::u(2))), e19, list[2]);
        list[3] = v::select_f(v::and_b(mask, v::eq_u(e15, v::u(3))), e19, list[3]);
        let t_____ = v::f(0.5f32);
        let e21 = v::gt_f(x, t_____);
        let mut m = v::and_b(mask, e21);
        if v::any(m) {
            let e22 = v::u_from_i(n);
            let t______ = v::u(3u32);
            let e24 = v::rem_u(e22, t______);
            let e26 = v::neg_f(x);
            v_.x = v::select_f(v::and_b(m, v::eq_u(e24, v::u(0))), e26, v_.x);
            v_.y = v::select_f(v::and_b(m, v::eq_u(e24, v::u(1))), e26, v_.y);
            v_.z = v::select_f(v::and_b(m, v::eq_u(e24, v::u(2))), e26, v_.z);
        }
        let e28 = v::pick_f(&[list[0], list[1], list[2], list[3]], v::u_bits_i(i));
        let e29 = v::u_from_i(n);
        let t_______ = v::u(3u32);
        let e31 = v::and_u(e29, t_______);
        let e33 = v::pick_f(&[v_.x, v_.y, v_.z], e31);
        let e35 = list[0];
        let e37 = list[3];
        let e38 = v::add_f(e35, e37);
        let e40 = v_.z;
        let e41 = v::V4 { x: e28, y: e33, z: e38, w: e40 };
        return e41;
    }

    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn integers(&mut self, mut mask: v::B, a: v::U, b: v::I) -> v::V4<v::U> {
        let c = v::i_bits_u(a);
        let d = v::u_bits_i(b);
        let e4 = v::div_u(a, d);
        let e5 = v::rem_u(a, d);
        let e6 = v::xor_u(e4, e5);
        let e7 = v::reverse_u(a);
        let e8 = v::xor_u(e6, e7);
        let t = v::u(31u32);
        let e10 = v::and_u(d, t);
        let e11 = v::shl_u(a, e10);
        let e12 = v::xor_u(e8, e11);
        let t_ = v::u(40u32);
        let e14 = v::rem_u(d, t_);
        let e15 = v::shr_u(a, e14);
        let e16 = v::xor_u(e12, e15);
        let e17 = v::div_i(c, b);
        let e18 = v::rem_i(c, b);
        let e19 = v::xor_i(e17, e18);
        let t__ = v::u(31u32);
        let e21 = v::and_u(d, t__);
        let e22 = v::shr_i(c, e21);
        let e23 = v::xor_i(e19, e22);
        let e24 = v::neg_i(b);
        let e25 = v::xor_i(e23, e24);
        let e26 = v::abs_i(c);
        let e27 = v::xor_i(e25, e26);
        let e28 = v::u_bits_i(e27);
        let e29 = v::lt_u(a, d);
        let e30 = v::select_u(e29, d, a);
        let e33 = v::lt_i(c, b);
        let t___ = v::u(2u32);
        let t____ = v::u(1u32);
        let e34 = v::select_u(e33, t___, t____);
        let e35 = v::xor_u(e30, e34);
        let e36 = v::min_u(a, d);
        let e37 = v::xor_u(e35, e36);
        let e38 = v::max_u(a, d);
        let t_____ = v::u(3u32);
        let e40 = v::mul_u(e38, t_____);
        let e41 = v::xor_u(e37, e40);
        let e42 = v::not_u(a);
        let e43 = v::xor_u(e41, e42);
        let e44 = v::min_i(c, b);
        let t______ = v::i(3i32);
        let e46 = v::max_i(c, t______);
        let e47 = v::sub_i(e44, e46);
        let e48 = v::u_bits_i(e47);
        let e51 = v::ge_u(a, d);
        let t_______ = v::u(8u32);
        let t________ = v::u(4u32);
        let e52 = v::select_u(e51, t_______, t________);
        let e53 = v::xor_u(e48, e52);
        let e56 = v::ge_i(c, b);
        let t_________ = v::u(32u32);
        let t__________ = v::u(16u32);
        let e57 = v::select_u(e56, t_________, t__________);
        let e58 = v::xor_u(e53, e57);
        let e59 = v::V4 { x: e16, y: e28, z: e43, w: e58 };
        return e59;
    }

    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn floats(&mut self, mut mask: v::B, x: v::F, y: v::F) -> v::V4<v::F> {
        let e2 = v::min_f(x, y);
        let e3 = v::floor_f(x);
        let e4 = v::ceil_f(y);
        let e5 = v::mul_f(e3, e4);
        let e6 = v::add_f(e2, e5);
        let e7 = v::trunc_f(x);
        let e8 = v::sub_f(e6, e7);
        let e9 = v::max_f(x, y);
        let t = v::f(-1.0f32);
        let e11 = v::clamp_f(x, t, y);
        let e12 = v::sub_f(e9, e11);
        let e13 = v::fract_f(y);
        let e14 = v::add_f(e12, e13);
        let e15 = v::u_from_f(x);
        let e16 = v::f_from_u(e15);
        let e17 = v::i_from_f(y);
        let e18 = v::f_from_i(e17);
        let e19 = v::add_f(e16, e18);
        let e20 = v::abs_f(x);
        let e21 = v::sub_f(e19, e20);
        let e22 = v::round_f(y);
        let e23 = v::add_f(e21, e22);
        let t_ = v::f(1.0f32);
        let e25 = v::V3 { x: x, y: y, z: t_ };
        let t__ = v::f(2.0f32);
        let e27 = v::V3 { x: y, y: x, z: t__ };
        let t___ = v::f(1.0f32);
        let e29 = v::V3 { x: t___, y: x, z: y };
        let e30 = v::V3 { x: v::sub_f(v::mul_f(e27.y, e29.z), v::mul_f(e27.z, e29.y)), y: v::sub_f(v::mul_f(e27.z, e29.x), v::mul_f(e27.x, e29.z)), z: v::sub_f(v::mul_f(e27.x, e29.y), v::mul_f(e27.y, e29.x)) };
        let e31 = v::add_f(v::add_f(v::mul_f(e25.x, e30.x), v::mul_f(e25.y, e30.y)), v::mul_f(e25.z, e30.z));
        let e32 = v::V4 { x: e8, y: e14, z: e23, w: e31 };
        return e32;
    }

    #[inline]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    pub fn conversions(&mut self, mut mask: v::B, a: v::U, x: v::F) -> v::V4<v::U> {
        let bytes = v::V4 { x: v::and_u(v::shr_u(a, v::u(0)), v::u(255)), y: v::and_u(v::shr_u(a, v::u(8)), v::u(255)), z: v::and_u(v::shr_u(a, v::u(16)), v::u(255)), w: v::and_u(v::shr_u(a, v::u(24)), v::u(255)) };
        let t = v::u(5u32);
        let e4 = v::gt_u(a, t);
        let t_ = v::f(0.0f32);
        let e6 = v::gt_f(x, t_);
        let t__ = v::u(2u32);
        let e8 = v::and_u(a, t__);
        let t___ = v::u(2u32);
        let e10 = v::eq_u(e8, t___);
        let truth = v::V3 { x: e4, y: e6, z: e10 };
        let e12 = v::f_from_u(a);
        let e13 = v::u_bits_f(e12);
        let e14 = v::i_bits_u(a);
        let e15 = v::f_from_i(e14);
        let e16 = v::u_bits_f(e15);
        let e17 = v::u_from_f(x);
        let e18 = v::i_from_f(x);
        let e19 = v::u_bits_i(e18);
        let e20 = v::xor_u(e17, e19);
        let e21 = bytes.x;
        let e22 = bytes.y;
        let t____ = v::u(3u32);
        let e24 = v::mul_u(e22, t____);
        let e25 = v::add_u(e21, e24);
        let e26 = bytes.w;
        let t_____ = v::u(5u32);
        let e28 = v::mul_u(e26, t_____);
        let e29 = v::add_u(e25, e28);
        let e30 = v::and_b(v::and_b(truth.x, truth.y), truth.z);
        let e31 = v::u_from_b(e30);
        let e32 = v::add_u(e29, e31);
        let e33 = v::or_b(v::or_b(truth.x, truth.y), truth.z);
        let e34 = v::u_from_b(e33);
        let e35 = v::add_u(e32, e34);
        let e36 = truth.z;
        let e37 = v::u_from_b(e36);
        let e38 = v::add_u(e35, e37);
        let e39 = v::V4 { x: e13, y: e16, z: e20, w: e38 };
        return e39;
    }
}
