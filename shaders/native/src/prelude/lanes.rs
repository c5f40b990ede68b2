// What operations on lanes are made of other ones, however many lanes there are: pasted behind the text of an
// instruction set, which has `LANES`, the types and the macro.

/// Two of a kind.
#[derive(Clone, Copy, Debug)]
pub struct V2<T> {
    pub x: T,
    pub y: T,
}
/// Three of a kind.
#[derive(Clone, Copy, Debug)]
pub struct V3<T> {
    pub x: T,
    pub y: T,
    pub z: T,
}
/// Four of a kind.
#[derive(Clone, Copy, Debug)]
pub struct V4<T> {
    pub x: T,
    pub y: T,
    pub z: T,
    pub w: T,
}

lanes! {
    // Lanes in memory, and back.
    fn f_of(x: [f32; LANES]) -> F { F(bytemuck::cast(x)) }
    fn u_of(x: [u32; LANES]) -> U { U(bytemuck::cast(x)) }
    fn i_of(x: [i32; LANES]) -> I { I(bytemuck::cast(x)) }
    fn f_to(x: F) -> [f32; LANES] { bytemuck::cast(x.0) }
    fn u_to(x: U) -> [u32; LANES] { bytemuck::cast(x.0) }
    fn i_to(x: I) -> [i32; LANES] { bytemuck::cast(x.0) }
    /// Which lane each is.
    fn lane() -> U { u_of(core::array::from_fn(|k| k as u32)) }

    fn rem_f(a: F, b: F) -> F { sub_f(a, mul_f(b, trunc_f(div_f(a, b)))) }
    fn fract_f(a: F) -> F { sub_f(a, floor_f(a)) }
    fn div_u(a: U, b: U) -> U { each_u(a, b, |a, b| if b == 0 { a } else { a / b }) }
    fn rem_u(a: U, b: U) -> U { each_u(a, b, |a, b| if b == 0 { 0 } else { a % b }) }
    fn div_i(a: I, b: I) -> I { each_i(a, b, |a, b| if b == 0 { a } else { a.wrapping_div(b) }) }
    fn rem_i(a: I, b: I) -> I { each_i(a, b, |a, b| if b == 0 { 0 } else { a.wrapping_rem(b) }) }
    fn shl_i(a: I, n: U) -> I { I(shl_u(U(a.0), n).0) }
    fn ne_b(a: B, b: B) -> B { xor_b(a, b) }

    fn b_from_f(a: F) -> B { ne_f(a, f(0.0)) }
    fn b_from_u(a: U) -> B { ne_u(a, u(0)) }
    fn b_from_i(a: I) -> B { ne_i(a, i(0)) }
    fn i_bits_u(a: U) -> I { I(a.0) }
    fn u_bits_i(a: I) -> U { U(a.0) }
    fn i_from_u(a: U) -> I { I(a.0) }
    fn u_from_i(a: I) -> U { U(a.0) }

    /// Element `index` of a slice, lane by lane; outside the last one, of nothing zero. Lanes outside `m` read what the
    /// first inside reads.
    fn at(array: &[UVec4], index: U, m: B) -> V4<U> {
        let first = from_lane(index, bits(m).trailing_zeros());
        let index = select_u(m, index, u(first));
        if any(ne_u(index, u(first))) { gather(array, index) } else { at_same(array, first) }
    }

    /// The same element in all lanes.
    fn at_same(array: &[UVec4], index: u32) -> V4<U> {
        let row = match array.get(index as usize) {
            Some(element) => *element,
            None => array.last().copied().unwrap_or(UVec4::ZERO),
        };
        V4 { x: u(row.x), y: u(row.y), z: u(row.z), w: u(row.w) }
    }

    /// Writes element `index` in the lanes of `m`, the lowest first; outside nothing.
    fn put(array: &mut [UVec4], index: U, value: V4<U>, m: B) -> () {
        let (index, [x, y, z, w]) =
            (u_to(index), [u_to(value.x), u_to(value.y), u_to(value.z), u_to(value.w)]);
        for lane in (0..LANES).filter(|lane| bits(m) >> lane & 1 == 1) {
            if let Some(element) = array.get_mut(index[lane] as usize) {
                *element = UVec4::new(x[lane], y[lane], z[lane], w[lane]);
            }
        }
    }

    fn pick_f(array: &[F], index: U) -> F {
        let mut picked = array[0];
        let mut k = 1;
        while k < array.len() {
            picked = select_f(ge_u(index, u(k as u32)), array[k], picked);
            k += 1;
        }
        picked
    }
    fn pick_u(array: &[U], index: U) -> U {
        let mut picked = array[0];
        let mut k = 1;
        while k < array.len() {
            picked = select_u(ge_u(index, u(k as u32)), array[k], picked);
            k += 1;
        }
        picked
    }
    fn pick_i(array: &[I], index: U) -> I {
        let mut picked = array[0];
        let mut k = 1;
        while k < array.len() {
            picked = select_i(ge_u(index, u(k as u32)), array[k], picked);
            k += 1;
        }
        picked
    }
    fn pick_b(array: &[B], index: U) -> B {
        let mut picked = array[0];
        let mut k = 1;
        while k < array.len() {
            picked = select_b(ge_u(index, u(k as u32)), array[k], picked);
            k += 1;
        }
        picked
    }

    fn each_u(a: U, b: U, f: fn(u32, u32) -> u32) -> U {
        let (mut a, b) = (u_to(a), u_to(b));
        for (a, b) in a.iter_mut().zip(b) {
            *a = f(*a, b);
        }
        u_of(a)
    }
    fn each_i(a: I, b: I, f: fn(i32, i32) -> i32) -> I {
        let (mut a, b) = (i_to(a), i_to(b));
        for (a, b) in a.iter_mut().zip(b) {
            *a = f(*a, b);
        }
        i_of(a)
    }
}
