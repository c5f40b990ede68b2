// Generated from WGSL by the crate `native`. Do not edit.

/// WGSL's `f32`.
pub type Real = f32;
pub type Vec2 = glam::Vec2;
pub type Vec3 = glam::Vec3;
pub type Vec4 = glam::Vec4;
pub type Mat2 = glam::Mat2;
pub type Mat3 = glam::Mat3;
pub type Mat4 = glam::Mat4;
pub use glam::{BVec2, BVec3, BVec4, IVec2, IVec3, IVec4, UVec2, UVec3, UVec4};


/// What the kernel reads and writes, one member a WGSL resource.
pub struct Bindings<'a> {
    pub unused: core::marker::PhantomData<&'a ()>,
}

/// The resources and the private variables of one invocation after another.
pub struct Kernel<'a> {
    pub trace: u32,
    pub unused: core::marker::PhantomData<&'a ()>,
}

impl<'a> Kernel<'a> {
    /// Binds the resources; the private variables get their initial values.
    pub fn new(bindings: Bindings<'a>) -> Self {
        Self {
            trace: 0u32,
            unused: bindings.unused,
        }
    }

    /// WGSL line 5.
    #[inline]
    pub fn note(&mut self, digit: u32) -> bool {
        self.trace = self.trace.wrapping_mul(10u32).wrapping_add(digit);
        return digit > 4u32;
    }

    /// WGSL line 11.
    #[inline]
    pub fn break_in_switch(&mut self, n: u32) -> u32 {
        let mut sum: u32 = 0u32;
        let mut i: u32 = 0u32;
        'repeat1: loop {
            if !(i < n) {
                break 'repeat1;
            }
            {
                'switch2: {
                    match i {
                        1u32 => {
                            if i == 1u32 {
                                break 'switch2;
                            }
                            sum = sum.wrapping_add(1000u32);
                        }
                        2u32 | 3u32 => {
                            sum = sum.wrapping_add(10u32);
                        }
                        _ => {
                            sum = sum.wrapping_add(1u32);
                        }
                    }
                }
                sum = sum.wrapping_add(100u32);
            }
            i = i.wrapping_add(1u32);
        }
        return sum;
    }

    /// WGSL line 27.
    #[inline]
    pub fn switch_default_first(&mut self, x: i32) -> i32 {
        match x {
            -7i32 => {
                return 1i32;
            }
            3i32 => {
                return 2i32;
            }
            _ => {
                return 0i32;
            }
        }
    }

    /// WGSL line 35.
    #[inline]
    pub fn switch_default_shared(&mut self, x: u32) -> u32 {
        let mut r: u32 = 7u32;
        match x {
            4u32 => {
                r = 1u32;
            }
            _ => {
                r = 2u32;
            }
        }
        return r;
    }

    /// WGSL line 45.
    #[inline]
    pub fn continue_in_switch(&mut self, n: u32) -> u32 {
        let mut sum: u32 = 0u32;
        let mut i: u32 = 0u32;
        'repeat1: loop {
            'next2: {
                if !(i < n) {
                    break 'repeat1;
                }
                {
                    match wgsl::rem_u32(i, 3u32) {
                        0u32 => {
                            break 'next2;
                        }
                        _ => {
                        }
                    }
                    sum = sum.wrapping_add(i);
                }
            }
            i = i.wrapping_add(1u32);
        }
        return sum;
    }

    /// WGSL line 57.
    #[inline]
    pub fn continue_runs_continuing(&mut self, n: u32) -> u32 {
        let mut i: u32 = 0u32;
        let mut odd: u32 = 0u32;
        'repeat1: loop {
            let mut next: u32 = 0u32;
            'next2: {
                if i >= n {
                    break 'repeat1;
                }
                next = i.wrapping_add(1u32);
                if wgsl::rem_u32(i, 2u32) == 0u32 {
                    break 'next2;
                }
                odd = odd.wrapping_add(i);
            }
            i = next;
        }
        return odd;
    }

    /// WGSL line 70.
    #[inline]
    pub fn break_if(&mut self, n: i32) -> i32 {
        let mut i: i32 = 0i32;
        let mut sum: i32 = 0i32;
        'repeat1: loop {
            'next2: {
                sum = sum.wrapping_add(i);
                if sum == 3i32 {
                    break 'next2;
                }
                sum = sum.wrapping_add(100i32);
            }
            i = i.wrapping_add(1i32);
            let e18 = i >= n;
            if e18 {
                break 'repeat1;
            }
        }
        return sum;
    }

    /// WGSL line 85.
    #[inline]
    pub fn nested_loops(&mut self, n: u32) -> u32 {
        let mut count: u32 = 0u32;
        let mut i: u32 = 0u32;
        let mut j: u32 = 0u32;
        let mut k: u32 = 0u32;
        'repeat1: loop {
            if !(i < n) {
                break 'repeat1;
            }
            {
                j = 0u32;
                'repeat2: loop {
                    'next3: {
                        if !(j < n) {
                            break 'repeat2;
                        }
                        {
                            if j > i {
                                break 'repeat2;
                            }
                            if wgsl::rem_u32(i.wrapping_add(j), 2u32) == 1u32 {
                                break 'next3;
                            }
                            k = 0u32;
                            'repeat4: loop {
                                if !(true) {
                                    break 'repeat4;
                                }
                                {
                                    k = k.wrapping_add(1u32);
                                    if k == 3u32 {
                                        break 'repeat4;
                                    }
                                }
                            }
                            count = count.wrapping_add(k);
                        }
                    }
                    j = j.wrapping_add(1u32);
                }
                count = count.wrapping_add(100u32);
            }
            i = i.wrapping_add(1u32);
        }
        return count;
    }

    /// WGSL line 103.
    #[inline]
    pub fn while_loop(&mut self, start: u32) -> u32 {
        let mut x: u32 = 0u32;
        let mut steps: u32 = 0u32;
        let mut local: bool = false;
        x = start;
        'repeat1: loop {
            if x != 1u32 {
                local = steps < 200u32;
            } else {
                local = false;
            }
            if !(local) {
                break 'repeat1;
            }
            {
                x = if wgsl::rem_u32(x, 2u32) == 0u32 { wgsl::div_u32(x, 2u32) } else { 3u32.wrapping_mul(x).wrapping_add(1u32) };
                steps = steps.wrapping_add(1u32);
            }
        }
        return steps;
    }

    /// WGSL line 113.
    #[inline]
    pub fn early_return(&mut self, values: [u32; 4], wanted: u32) -> i32 {
        let mut i: i32 = 0i32;
        'repeat1: loop {
            if !(i < 4i32) {
                break 'repeat1;
            }
            {
                if values[(i as usize).min(3)] == wanted {
                    return i;
                }
            }
            i = i.wrapping_add(1i32);
        }
        return -1i32;
    }

    /// WGSL line 121.
    #[inline]
    pub fn zeroed_in_loop(&mut self, n: u32) -> u32 {
        let mut last: u32 = 0u32;
        let mut i: u32 = 0u32;
        let mut fresh: u32 = 0u32;
        let mut list: [u32; 3] = [0u32; 3];
        'repeat1: loop {
            if !(i < n) {
                break 'repeat1;
            }
            {
                fresh = 0u32;
                list = [0u32; 3];
                fresh = fresh.wrapping_add(1u32);
                let e16 = wgsl::rem_u32(i, 3u32);
                if (e16 as usize) < 3 {
                    list[e16 as usize] = list[(e16 as usize).min(2)].wrapping_add(fresh);
                }
                last = fresh.wrapping_mul(10u32).wrapping_add(list[0]).wrapping_add(list[1]).wrapping_add(list[2]);
            }
            i = i.wrapping_add(1u32);
        }
        return last;
    }

    /// WGSL line 133.
    #[inline]
    pub fn and_evaluates_left_first(&mut self, a: u32, b: u32) -> u32 {
        let mut local: bool = false;
        self.trace = 0u32;
        let e4 = self.note(a);
        if e4 {
            let e7 = self.note(b);
            local = e7;
        } else {
            local = false;
        }
        if local {
            return self.trace.wrapping_add(1000u32);
        }
        return self.trace;
    }

    /// WGSL line 139.
    #[inline]
    pub fn or_evaluates_left_first(&mut self, a: u32, b: u32) -> u32 {
        let mut local: bool = false;
        self.trace = 0u32;
        let e4 = self.note(a);
        if !e4 {
            let e8 = self.note(b);
            local = e8;
        } else {
            local = true;
        }
        if local {
            return self.trace.wrapping_add(1000u32);
        }
        return self.trace;
    }

    /// WGSL line 146.
    #[inline]
    pub fn load_before_store(&mut self) -> u32 {
        let mut x: u32 = 1u32;
        let before = x;
        x = 5u32;
        let after = x;
        x = before;
        return before.wrapping_mul(100u32).wrapping_add(after.wrapping_mul(10u32)).wrapping_add(x);
    }

    /// WGSL line 155.
    #[inline]
    pub fn call_between_loads(&mut self) -> u32 {
        self.trace = 3u32;
        let before = self.trace;
        let high = self.note(9u32);
        let after = self.trace;
        return before.wrapping_mul(1000u32).wrapping_add(after).wrapping_add(if high { 500u32 } else { 0u32 });
    }

    /// WGSL line 163.
    #[inline]
    pub fn else_if_chain(&mut self, x: Real) -> u32 {
        if x < 0.0f32 {
            return 0u32;
        } else {
            if x < 1.0f32 {
                return 1u32;
            } else {
                if x < 2.0f32 {
                    return 2u32;
                }
            }
        }
        return 3u32;
    }

    /// WGSL line 168.
    #[inline]
    pub fn only_else(&mut self, x: bool) -> u32 {
        let mut r: u32 = 1u32;
        if !(x) {
            r = 2u32;
        }
        return r;
    }

    /// WGSL line 174.
    #[inline]
    pub fn shadowed(&mut self, x: u32) -> u32 {
        let mut y: u32 = 0u32;
        let mut y_: u32 = 7u32;
        y = x;
        {
            y_ = y_.wrapping_add(1u32);
            {
            }
        }
        let z = y.wrapping_add(1u32);
        {
            y = y.wrapping_add(9u32);
        }
        return y.wrapping_add(z);
    }

    /// WGSL line 187.
    #[inline]
    pub fn deep(&mut self, n: u32) -> u32 {
        let mut sum: u32 = 0u32;
        let mut i: u32 = 0u32;
        let mut seen: [u32; 4] = [0u32, 0u32, 0u32, 0u32];
        let mut k: u32 = 0u32;
        'repeat1: loop {
            let mut e15: u32 = 0u32;
            let mut step: u32 = 0u32;
            'next2: {
                if i >= n {
                    break 'repeat1;
                }
                e15 = wgsl::rem_u32(i, 4u32);
                step = i.wrapping_add(1u32);
                'switch3: {
                    match wgsl::rem_u32(i, 4u32) {
                        0u32 | 1u32 => {
                            'switch4: {
                                match wgsl::rem_u32(i, 2u32) {
                                    0u32 => {
                                        if i > 4u32 {
                                            break 'switch4;
                                        }
                                        sum = sum.wrapping_add(1u32);
                                        break 'next2;
                                    }
                                    _ => {
                                        sum = sum.wrapping_add(10u32);
                                        break 'switch4;
                                    }
                                }
                            }
                            sum = sum.wrapping_add(100u32);
                        }
                        2u32 => {
                            break 'next2;
                        }
                        _ => {
                            if i == 7u32 {
                                break 'switch3;
                            }
                            sum = sum.wrapping_add(1000u32);
                        }
                    }
                }
                sum = sum.wrapping_add(10000u32);
            }
            k = 0u32;
            'repeat5: loop {
                if !(k < step) {
                    break 'repeat5;
                }
                {
                    if k == 2u32 {
                        break 'repeat5;
                    }
                    if (e15 as usize) < 4 {
                        seen[e15 as usize] = seen[(e15 as usize).min(3)].wrapping_add(1u32);
                    }
                }
                k = k.wrapping_add(1u32);
            }
            i = step;
        }
        return sum.wrapping_add(1000000u32.wrapping_mul(seen[0].wrapping_add(seen[1]).wrapping_add(seen[2]).wrapping_add(seen[3])));
    }

    /// WGSL line 218.
    #[inline]
    pub fn loops_and_returns(&mut self, n: u32) -> u32 {
        let mut a: u32 = 0u32;
        let mut b: u32 = 0u32;
        let mut c: u32 = 0u32;
        a = n;
        'repeat1: loop {
            'next2: {
                if !(a > 0u32) {
                    break 'repeat1;
                }
                {
                    c = a;
                    'repeat3: loop {
                        if c < 3u32 {
                            break 'repeat3;
                        }
                        c = c.wrapping_sub(3u32);
                        b = b.wrapping_add(1u32);
                        if b > 50u32 {
                            return 1000u32.wrapping_add(a);
                        }
                    }
                    if c == 1u32 {
                        break 'next2;
                    }
                    b = b.wrapping_add(100u32.wrapping_mul(c));
                }
            }
            a = wgsl::div_u32(a, 2u32);
        }
        return b;
    }
}
