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

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leaf {
    pub weight: Real,
    pub count: u32,
}

impl Leaf {
    /// All members zero.
    pub const ZERO: Self = Leaf { weight: 0.0f32, count: 0u32 };
}

impl Default for Leaf {
    fn default() -> Self {
        Self::ZERO
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tree {
    pub left: Leaf,
    pub right: Leaf,
    pub table: [u32; 3],
    pub axis: Vec3,
}

impl Tree {
    /// All members zero.
    pub const ZERO: Self = Tree { left: Leaf::ZERO, right: Leaf::ZERO, table: [0u32; 3], axis: Vec3::ZERO };
}

impl Default for Tree {
    fn default() -> Self {
        Self::ZERO
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tree2 {
    pub gain: Real,
    pub offset: Vec3,
}

impl Tree2 {
    /// All members zero.
    pub const ZERO: Self = Tree2 { gain: 0.0f32, offset: Vec3::ZERO };
}

impl Default for Tree2 {
    fn default() -> Self {
        Self::ZERO
    }
}

pub const PRIMES: [u32; 5] = [2u32, 3u32, 5u32, 7u32, 11u32];
pub const CORNERS: [Vec2; 3] = [Vec2::new(0.0f32, 0.1f32), Vec2::new(1.0f32, 0.2f32), Vec2::new(2.0f32, 0.3f32)];
pub const STACK_SIZE: u32 = 8u32;

/// What the kernel reads and writes, one member a WGSL resource.
pub struct Bindings<'a> {
    pub frame_words: &'a [UVec4],
    pub node_words: &'a [UVec4],
    pub weights: &'a [Real],
    pub leaves: &'a [Leaf],
    pub film_words: &'a mut [UVec4],
    pub sums: &'a mut [Real],
    pub total: &'a mut Leaf,
    pub setting: &'a Tree2,
    pub points: &'a [Vec2],
    pub transforms: &'a [Mat4],
    pub grid: &'a mut [[Vec2; 2]],
    pub records: &'a mut [Leaf],
    pub scale: &'a Real,
}

/// The resources and the private variables of one invocation after another.
pub struct Kernel<'a> {
    pub frame_words: &'a [UVec4; 2],
    pub node_words: &'a [UVec4],
    pub weights: &'a [Real],
    pub leaves: &'a [Leaf],
    pub film_words: &'a mut [UVec4],
    pub sums: &'a mut [Real],
    pub total: &'a mut Leaf,
    pub setting: &'a Tree2,
    pub points: &'a [Vec2],
    pub stack: [u32; 8],
    pub top: u32,
    pub rng: UVec4,
    pub transforms: &'a [Mat4],
    pub grid: &'a mut [[Vec2; 2]],
    pub records: &'a mut [Leaf],
    pub scale: &'a Real,
    pub table: [[u32; 3]; 2],
}

impl<'a> Kernel<'a> {
    /// Binds the resources; the private variables get their initial values.
    pub fn new(bindings: Bindings<'a>) -> Self {
        Self {
            frame_words: bindings.frame_words.first_chunk().unwrap_or(&[UVec4::ZERO; 2]),
            node_words: bindings.node_words,
            weights: bindings.weights,
            leaves: bindings.leaves,
            film_words: bindings.film_words,
            sums: bindings.sums,
            total: bindings.total,
            setting: bindings.setting,
            points: bindings.points,
            stack: [0u32; 8],
            top: 3u32,
            rng: UVec4::new(1u32, 2u32, 3u32, 4u32),
            transforms: bindings.transforms,
            grid: bindings.grid,
            records: bindings.records,
            scale: bindings.scale,
            table: [[0u32; 3]; 2],
        }
    }

    pub fn render(&mut self, gid: UVec3) {
        self.stack = [0u32; 8];
        self.top = 3u32;
        self.rng = UVec4::new(1u32, 2u32, 3u32, 4u32);
        self.table = [[0u32; 3]; 2];
        let e2 = gid.x;
        if (e2 as usize) < self.film_words.len() {
            self.film_words[e2 as usize] = UVec4::new(self.top, self.stack[0], self.rng.w, gid.y);
        }
        self.top = self.top.wrapping_add(10u32);
        self.stack[0] = 77u32;
        self.rng = UVec4::splat(9u32);
    }

    /// WGSL line 35.
    #[inline]
    pub fn set_count(&mut self, leaf: &mut Leaf, count: u32) {
        leaf.count = count;
        leaf.weight = leaf.weight + 0.5f32;
    }

    /// WGSL line 40.
    #[inline]
    pub fn bump(&mut self, x: &mut u32) -> u32 {
        *x = (*x).wrapping_add(1u32);
        return *x;
    }

    /// WGSL line 45.
    #[inline]
    pub fn bump_twice(&mut self, x: &mut u32) {
        self.bump(&mut *x);
        self.bump(&mut *x);
    }

    /// WGSL line 50.
    #[inline]
    pub fn pointer_to_variable(&mut self) -> u32 {
        let mut x: u32 = 5u32;
        self.bump_twice(&mut x);
        x = x.wrapping_mul(2u32);
        return x;
    }

    /// WGSL line 59.
    #[inline]
    pub fn pointer_to_member(&mut self) -> u32 {
        let mut tree: Tree = Tree::ZERO;
        self.set_count(&mut tree.right, 4u32);
        self.bump_twice(&mut tree.left.count);
        tree.table[1] = 6u32;
        return tree.left.count.wrapping_mul(100u32).wrapping_add(tree.right.count.wrapping_mul(10u32)).wrapping_add(tree.table[1]);
    }

    /// WGSL line 68.
    #[inline]
    pub fn pointer_to_element(&mut self, i: u32) -> u32 {
        let mut list: [u32; 4] = [1u32, 2u32, 3u32, 4u32];
        self.bump_twice(&mut list[(i as usize).min(3)]);
        return list[0].wrapping_mul(1000u32).wrapping_add(list[1].wrapping_mul(100u32)).wrapping_add(list[2].wrapping_mul(10u32)).wrapping_add(list[3]);
    }

    /// WGSL line 75.
    #[inline]
    pub fn pointer_keeps_index(&mut self) -> u32 {
        let mut list: [u32; 3] = [0u32, 0u32, 0u32];
        let mut i: u32 = 1u32;
        let e7 = i;
        i = 2u32;
        if (e7 as usize) < 3 {
            list[e7 as usize] = 5u32;
        }
        return list[0].wrapping_mul(100u32).wrapping_add(list[1].wrapping_mul(10u32)).wrapping_add(list[2]);
    }

    /// WGSL line 84.
    #[inline]
    pub fn structs_are_values(&mut self) -> u32 {
        let mut a: Tree = Tree::ZERO;
        let mut b: Tree = Tree::ZERO;
        a.left.count = 1u32;
        b = a;
        b.left.count = 2u32;
        b.table[2] = 9u32;
        let c = b;
        b.left.count = 3u32;
        return a.left.count.wrapping_mul(1000u32).wrapping_add(b.left.count.wrapping_mul(100u32)).wrapping_add(c.left.count.wrapping_mul(10u32)).wrapping_add(a.table[2]);
    }

    /// WGSL line 95.
    #[inline]
    pub fn changed(&mut self, tree: Tree, count: u32) -> Tree {
        let mut result: Tree = Tree::ZERO;
        result = tree;
        result.left = Leaf { weight: 2.5f32, count: count };
        result.axis.y = 3.0f32;
        return result;
    }

    /// WGSL line 102.
    #[inline]
    pub fn structs_pass_by_value(&mut self) -> Real {
        let mut tree: Tree = Tree::ZERO;
        let e1 = tree;
        let after = self.changed(e1, 7u32);
        let e17 = after.axis;
        return (((tree.left.count as Real) + ((after.left.count as Real) * 10.0f32)) + after.left.weight) + e17.y;
    }

    /// WGSL line 108.
    #[inline]
    pub fn locals_start_zeroed(&mut self) -> u32 {
        let mut a: u32 = 0u32;
        let mut b: [u32; 40] = [0u32; 40];
        let mut c: Vec3 = Vec3::ZERO;
        let mut d: Tree = Tree::ZERO;
        let mut e: Mat3 = Mat3::ZERO;
        let mut f: bool = false;
        let mut g: BVec2 = BVec2::FALSE;
        return a.wrapping_add(b[39]).wrapping_add(wgsl::to_u32(c.z)).wrapping_add(d.table[2]).wrapping_add(wgsl::to_u32(e.z_axis.y)).wrapping_add(f as u32).wrapping_add(g.y as u32);
    }

    /// WGSL line 119.
    #[inline]
    pub fn constant_array(&mut self, i: u32) -> u32 {
        return (&PRIMES)[(i as usize).min(4)];
    }

    /// WGSL line 120.
    #[inline]
    pub fn constant_array_signed(&mut self, i: i32) -> u32 {
        return (&PRIMES)[(i as usize).min(4)];
    }

    /// WGSL line 121.
    #[inline]
    pub fn constant_corner(&mut self, i: u32) -> Vec2 {
        return (&CORNERS)[(i as usize).min(2)];
    }

    /// WGSL line 123.
    #[inline]
    pub fn local_constant_array(&mut self, i: u32) -> u32 {
        return (&[10u32, 20u32, 30u32])[(i as usize).min(2)];
    }

    /// WGSL line 128.
    #[inline]
    pub fn read_outside(&mut self, i: u32) -> u32 {
        let mut list: [u32; 3] = [10u32, 20u32, 30u32];
        return list[(i as usize).min(2)];
    }

    /// WGSL line 133.
    #[inline]
    pub fn write_outside(&mut self, i: u32) -> u32 {
        let mut list: [u32; 3] = [1u32, 2u32, 3u32];
        if (i as usize) < 3 {
            list[i as usize] = 9u32;
        }
        return list[0].wrapping_mul(100u32).wrapping_add(list[1].wrapping_mul(10u32)).wrapping_add(list[2]);
    }

    /// WGSL line 139.
    #[inline]
    pub fn write_outside_nested(&mut self, i: u32, j: u32) -> u32 {
        let mut grid: [[u32; 2]; 2] = [[0u32; 2]; 2];
        if (i as usize) < 2 && (j as usize) < 2 {
            grid[i as usize][j as usize] = 1u32;
        }
        return grid[0][0].wrapping_mul(1000u32).wrapping_add(grid[0][1].wrapping_mul(100u32)).wrapping_add(grid[1][0].wrapping_mul(10u32)).wrapping_add(grid[1][1]);
    }

    /// WGSL line 145.
    #[inline]
    pub fn lane_outside(&mut self, i: u32) -> Real {
        let mut v: Vec3 = Vec3::new(1.0f32, 2.0f32, 3.0f32);
        if (i as usize) < 3 {
            v[i as usize] = 5.0f32;
        }
        return ((v.x * 100.0f32) + (v.y * 10.0f32)) + v.z;
    }

    /// WGSL line 151.
    #[inline]
    pub fn lane_of_value(&mut self, v: UVec4, i: u32) -> u32 {
        return v[(i as usize).min(3)];
    }

    /// WGSL line 152.
    #[inline]
    pub fn lane_of_bools(&mut self, v: BVec3, i: u32) -> bool {
        let mut w: BVec3 = BVec3::FALSE;
        let mut local: bool = false;
        w = v;
        if (i as usize) < 3 {
            w.set(i as usize, !w.test((i as usize).min(2)));
        }
        if w.test((i as usize).min(2)) {
            local = !v.test((i as usize).min(2));
        } else {
            local = false;
        }
        return local;
    }

    /// WGSL line 158.
    #[inline]
    pub fn column_outside(&mut self, i: u32) -> Real {
        let mut m: Mat2 = Mat2::from_cols(Vec2::new(1.0f32, 2.0f32), Vec2::new(3.0f32, 4.0f32));
        if (i as usize) < 2 {
            *m.col_mut(i as usize) = Vec2::new(5.0f32, 6.0f32);
        }
        if (i as usize) < 2 {
            m.col_mut(i as usize).y = 7.0f32;
        }
        return (((m.x_axis.x * 1000.0f32) + (m.x_axis.y * 100.0f32)) + (m.y_axis.x * 10.0f32)) + m.y_axis.y;
    }

    /// WGSL line 165.
    #[inline]
    pub fn store_lane(&mut self) -> Vec4 {
        let mut v: Vec4 = Vec4::splat(0.0f32);
        v.z = 1.5f32;
        v.x = v.x + 2.0f32;
        v.w = v.z;
        return v;
    }

    /// WGSL line 173.
    #[inline]
    pub fn frame(&mut self, i: u32) -> UVec4 {
        let frame_words = self.frame_words;
        return frame_words[(i as usize).min(1)];
    }

    /// WGSL line 174.
    #[inline]
    pub fn frame_first(&mut self) -> u32 {
        let frame_words = self.frame_words;
        return frame_words[0].y.wrapping_add(frame_words[1].w);
    }

    /// WGSL line 175.
    #[inline]
    pub fn node(&mut self, i: u32) -> UVec4 {
        let node_words = self.node_words;
        return *wgsl::at(node_words, i as u32, &UVec4::ZERO);
    }

    /// WGSL line 176.
    #[inline]
    pub fn node_lane(&mut self, i: u32, lane: u32) -> u32 {
        let node_words = self.node_words;
        return wgsl::at(node_words, i as u32, &UVec4::ZERO)[(lane as usize).min(3)];
    }

    /// WGSL line 177.
    #[inline]
    pub fn node_floats(&mut self, i: u32) -> Vec3 {
        let node_words = self.node_words;
        let e3 = *wgsl::at(node_words, i as u32, &UVec4::ZERO);
        return Vec3::new(f32::from_bits(e3.y), f32::from_bits(e3.z), f32::from_bits(e3.w));
    }

    /// WGSL line 178.
    #[inline]
    pub fn node_count(&mut self) -> u32 {
        let node_words = self.node_words;
        return node_words.len() as u32;
    }

    /// WGSL line 179.
    #[inline]
    pub fn weight(&mut self, i: u32) -> Real {
        let weights = self.weights;
        return *wgsl::at(weights, i as u32, &0.0f32);
    }

    /// WGSL line 180.
    #[inline]
    pub fn leaf_count(&mut self, i: u32) -> u32 {
        let leaves = self.leaves;
        return wgsl::at(leaves, i as u32, &Leaf::ZERO).count;
    }

    /// WGSL line 181.
    #[inline]
    pub fn leaf_weight(&mut self, i: u32) -> Real {
        let leaves = self.leaves;
        return wgsl::at(leaves, i as u32, &Leaf::ZERO).weight;
    }

    /// WGSL line 182.
    #[inline]
    pub fn point(&mut self, i: u32) -> Vec2 {
        let points = self.points;
        return *wgsl::at(points, i as u32, &Vec2::ZERO);
    }

    /// WGSL line 183.
    #[inline]
    pub fn point_y(&mut self, i: u32) -> Real {
        let points = self.points;
        return wgsl::at(points, i as u32, &Vec2::ZERO).y;
    }

    /// WGSL line 184.
    #[inline]
    pub fn gain(&mut self) -> Real {
        let setting = self.setting;
        return setting.gain + setting.offset.z;
    }

    /// WGSL line 186.
    #[inline]
    pub fn film_write(&mut self, i: u32, value: UVec4) {
        if (i as usize) < self.film_words.len() {
            self.film_words[i as usize] = value;
        }
    }

    /// WGSL line 187.
    #[inline]
    pub fn film_lane(&mut self, i: u32, value: u32) {
        if (i as usize) < self.film_words.len() {
            self.film_words[i as usize].z = value;
        }
    }

    /// WGSL line 188.
    #[inline]
    pub fn film_read(&mut self, i: u32) -> UVec4 {
        return *wgsl::at(&*self.film_words, i as u32, &UVec4::ZERO);
    }

    /// WGSL line 189.
    #[inline]
    pub fn film_size(&mut self) -> u32 {
        return self.film_words.len() as u32;
    }

    /// WGSL line 191.
    #[inline]
    pub fn add_sum(&mut self, i: u32, x: Real) -> Real {
        if (i as usize) < self.sums.len() {
            self.sums[i as usize] = (*wgsl::at(&*self.sums, i as u32, &0.0f32)) + x;
        }
        self.total.weight = self.total.weight + x;
        self.total.count = self.total.count.wrapping_add(1u32);
        return self.total.weight;
    }

    /// WGSL line 198.
    #[inline]
    pub fn push(&mut self, value: u32) {
        let e3 = self.top;
        if (e3 as usize) < 8 {
            self.stack[e3 as usize] = value;
        }
        self.top = self.top.wrapping_add(1u32);
    }

    /// WGSL line 203.
    #[inline]
    pub fn push_and_peek(&mut self, a: u32, b: u32) -> u32 {
        self.top = 0u32;
        self.push(a);
        self.push(b);
        return self.stack[0].wrapping_mul(100u32).wrapping_add(self.stack[1].wrapping_mul(10u32)).wrapping_add(self.top);
    }

    /// WGSL line 210.
    #[inline]
    pub fn next_random(&mut self) -> u32 {
        self.rng = self.rng.wrapping_mul(UVec4::splat(1664525u32)).wrapping_add(UVec4::splat(1013904223u32));
        self.rng.x = self.rng.x.wrapping_add(self.rng.y.wrapping_mul(self.rng.w));
        return self.rng.x;
    }

    /// WGSL line 223.
    #[inline]
    pub fn transform(&mut self, i: u32, p: Vec4) -> Vec4 {
        let transforms = self.transforms;
        let scale = self.scale;
        let e4 = *wgsl::at(transforms, i as u32, &Mat4::ZERO);
        return (e4.w_axis * p.w + e4.z_axis * p.z + e4.y_axis * p.y + e4.x_axis * p.x) * (*scale);
    }

    /// WGSL line 224.
    #[inline]
    pub fn transform_column(&mut self, i: u32, c: u32) -> Vec4 {
        let transforms = self.transforms;
        return wgsl::at(transforms, i as u32, &Mat4::ZERO).col((c as usize).min(3));
    }

    /// WGSL line 225.
    #[inline]
    pub fn grid_set(&mut self, i: u32, j: u32, x: Real) -> Real {
        if (i as usize) < self.grid.len() && (j as usize) < 2 {
            self.grid[i as usize][j as usize].y = x;
        }
        if (i as usize) < self.grid.len() && (j as usize) < 2 {
            self.grid[i as usize][j as usize] = wgsl::at(&*self.grid, i as u32, &[Vec2::ZERO; 2])[(j as usize).min(1)] + Vec2::new(0.5f32, 0.0f32);
        }
        return wgsl::at(&*self.grid, i as u32, &[Vec2::ZERO; 2])[(j as usize).min(1)].x + wgsl::at(&*self.grid, i as u32, &[Vec2::ZERO; 2])[(j as usize).min(1)].y;
    }

    /// WGSL line 230.
    #[inline]
    pub fn record_set(&mut self, i: u32, weight: Real) -> Real {
        let before = *wgsl::at(&*self.records, i as u32, &Leaf::ZERO);
        if (i as usize) < self.records.len() {
            self.records[i as usize] = Leaf { weight: before.weight + weight, count: before.count.wrapping_add(1u32) };
        }
        return wgsl::at(&*self.records, i as u32, &Leaf::ZERO).weight;
    }

    /// WGSL line 235.
    #[inline]
    pub fn table_set(&mut self, i: u32, j: u32) -> u32 {
        if (i as usize) < 2 && (j as usize) < 3 {
            self.table[i as usize][j as usize] = self.table[(i as usize).min(1)][(j as usize).min(2)].wrapping_add(3u32);
        }
        return self.table[(i as usize).min(1)][(j as usize).min(2)].wrapping_add(self.table[1][2]);
    }
}
