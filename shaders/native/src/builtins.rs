//! WGSL's built-in functions. What IEEE 754 fixes, or what is a fixed sequence of such operations,
//! has the same bits as on a GPU that does the same; `sin`, `exp`, `pow` and their kin have not.

use crate::NativeError;
use crate::functions::FunctionWriter;
use crate::matrices::sum_of_products;
use crate::text::{call, wrap};
use crate::types::vector_name;
use naga::{Expression, Handle, MathFunction, ScalarKind, TypeInner};

/// A call of a built-in on its way to Rust.
struct Builtin<'e> {
    handle: Handle<Expression>,
    fun: MathFunction,
    arguments: &'e [Handle<Expression>],
}

impl FunctionWriter<'_> {
    /// A built-in function.
    pub(crate) fn math(
        &mut self,
        handle: Handle<Expression>,
        fun: MathFunction,
        arguments: &[Handle<Expression>],
    ) -> Result<String, NativeError> {
        let float = self.scalar_kind(arguments[0]) == Some(ScalarKind::Float);
        let builtin = Builtin { handle, fun, arguments };
        if let Some(rule) = if float { float_rule(fun) } else { None } {
            return self.lanewise(handle, arguments, |x| rule.apply(x));
        }
        if let Some(rule) = integer_rule(fun, self.scalar_kind(arguments[0])) {
            return self.lanewise(handle, arguments, |x| rule.apply(x));
        }
        match fun {
            MathFunction::Dot | MathFunction::Length | MathFunction::Distance => {
                self.product(&builtin)
            }
            MathFunction::Cross
            | MathFunction::Normalize
            | MathFunction::FaceForward
            | MathFunction::Reflect
            | MathFunction::Refract => self.geometry(&builtin),
            MathFunction::Transpose | MathFunction::Determinant => {
                self.matrix_math(handle, fun, arguments[0])
            }
            MathFunction::Modf | MathFunction::Frexp => self.decompose(&builtin),
            MathFunction::Pack4x8snorm
            | MathFunction::Pack4x8unorm
            | MathFunction::Pack2x16snorm
            | MathFunction::Pack2x16unorm
            | MathFunction::Pack2x16float
            | MathFunction::Pack4xI8
            | MathFunction::Pack4xU8
            | MathFunction::Pack4xI8Clamp
            | MathFunction::Pack4xU8Clamp => self.pack(&builtin),
            MathFunction::Unpack4x8snorm
            | MathFunction::Unpack4x8unorm
            | MathFunction::Unpack2x16snorm
            | MathFunction::Unpack2x16unorm
            | MathFunction::Unpack2x16float
            | MathFunction::Unpack4xI8
            | MathFunction::Unpack4xU8 => self.unpack(&builtin),
            MathFunction::Dot4I8Packed | MathFunction::Dot4U8Packed => self.packed_dot(&builtin),
            _ => Err(self.refuse(handle, &format!("the function {fun:?}"))),
        }
    }

    /// `dot(x, y)` as text, of scalars the plain product.
    fn dot_text(
        &mut self,
        left: Handle<Expression>,
        right: Handle<Expression>,
    ) -> Result<String, NativeError> {
        let TypeInner::Vector { size, scalar } = *self.ty(left) else {
            let (left, right) = (self.atom(left)?, self.atom(right)?);
            return Ok(format!("{left} * {right}"));
        };
        let (a, b) = (self.lanes(left, size as usize)?, self.lanes(right, size as usize)?);
        if scalar.kind == ScalarKind::Float {
            return Ok(sum_of_products(&a, &b));
        }
        let mut sum = String::new();
        for (a, b) in a.iter().zip(&b) {
            let product = format!("{a}.wrapping_mul({b})");
            sum = if sum.is_empty() { product } else { format!("{sum}.wrapping_add({product})") };
        }
        Ok(sum)
    }

    fn product(&mut self, builtin: &Builtin) -> Result<String, NativeError> {
        let first = builtin.arguments[0];
        let scalar = matches!(self.ty(first), TypeInner::Scalar(_));
        match (builtin.fun, builtin.arguments) {
            (MathFunction::Dot, &[left, right]) => self.dot_text(left, right),
            (MathFunction::Length, _) if scalar => Ok(format!("{}.abs()", self.operand(first)?)),
            (MathFunction::Length, _) => Ok(format!("({}).sqrt()", self.dot_text(first, first)?)),
            (MathFunction::Distance, &[left, right]) => {
                let difference = format!("{} - {}", self.operand(left)?, self.operand(right)?);
                if scalar {
                    return Ok(format!("({difference}).abs()"));
                }
                let d = self.temporary(&difference);
                let lanes = crate::types::LANES[..self.vector_size(left) as usize]
                    .iter()
                    .map(|lane| format!("{d}.{lane}"))
                    .collect::<Vec<_>>();
                Ok(format!("({}).sqrt()", sum_of_products(&lanes, &lanes)))
            }
            _ => Err(self.refuse(builtin.handle, "this product")),
        }
    }

    /// Names a text.
    fn temporary(&mut self, text: &str) -> String {
        self.n_temporaries += 1;
        let name = self.names.add_numbered("t", self.n_temporaries);
        self.out.line(&format!("let {name} = {text};"));
        name
    }

    fn geometry(&mut self, builtin: &Builtin) -> Result<String, NativeError> {
        match (builtin.fun, builtin.arguments) {
            (MathFunction::Cross, &[left, right]) => {
                let (a, b) = (self.lanes(left, 3)?, self.lanes(right, 3)?);
                let lane =
                    |i: usize, j: usize| format!("{} * {} - {} * {}", a[i], b[j], a[j], b[i]);
                Ok(format!("Vec3::new({}, {}, {})", lane(1, 2), lane(2, 0), lane(0, 1)))
            }
            (MathFunction::Normalize, &[v]) => {
                let name = self.atom(v)?;
                Ok(format!("{name} / ({}).sqrt()", self.dot_text(v, v)?))
            }
            (MathFunction::FaceForward, &[n, incident, reference]) => {
                let n = self.atom(n)?;
                let d = self.dot_text(incident, reference)?;
                Ok(format!("if {d} < 0.0 {{ {n} }} else {{ -{n} }}"))
            }
            (MathFunction::Reflect, &[incident, normal]) => {
                let (i, n) = (self.atom(incident)?, self.atom(normal)?);
                let d = self.dot_text(normal, incident)?;
                Ok(format!("{i} - {n} * (2.0 * ({d}))"))
            }
            (MathFunction::Refract, &[incident, normal, ratio]) => {
                let (i, n, eta) = (self.atom(incident)?, self.atom(normal)?, self.atom(ratio)?);
                let d = self.dot_text(normal, incident)?;
                let d = self.temporary(&d);
                let k = self.temporary(&format!("1.0 - {eta} * ({eta} * (1.0 - {d} * {d}))"));
                let zero = self.zero_of(builtin.handle)?;
                Ok(format!(
                    "if {k} < 0.0 {{ {zero} }} else {{ {i} * {eta} - {n} * ({eta} * {d} + {k}.sqrt()) }}"
                ))
            }
            _ => Err(self.refuse(builtin.handle, "this geometry")),
        }
    }

    fn decompose(&mut self, builtin: &Builtin) -> Result<String, NativeError> {
        let Some(ty) = self.info[builtin.handle].ty.handle() else {
            return Err(self.refuse(builtin.handle, &format!("{:?}", builtin.fun)));
        };
        let argument = builtin.arguments[0];
        let (lanes, size) = match *self.ty(argument) {
            TypeInner::Vector { size, .. } => (self.lanes(argument, size as usize)?, Some(size)),
            _ => (vec![self.atom(argument)?], None),
        };
        let gather = |kind: ScalarKind, f: fn(&String) -> String| {
            let texts: Vec<String> = lanes.iter().map(f).collect();
            match size {
                Some(size) => call(&format!("{}::new", vector_name(size, kind)), &texts),
                None => texts.concat(),
            }
        };
        let parts = if builtin.fun == MathFunction::Modf {
            [
                gather(ScalarKind::Float, |x| format!("{x} - {x}.trunc()")),
                gather(ScalarKind::Float, |x| format!("{x}.trunc()")),
            ]
        } else {
            [
                gather(ScalarKind::Float, |x| format!("wgsl::frexp({x}).0")),
                gather(ScalarKind::Sint, |x| format!("wgsl::frexp({x}).1")),
            ]
        };
        self.cx.compose(ty, &parts, self.span_of(builtin.handle)).map_err(|e| self.place(e))
    }

    fn pack(&mut self, builtin: &Builtin) -> Result<String, NativeError> {
        let n = self.vector_size(builtin.arguments[0]) as usize;
        let x = self.lanes(builtin.arguments[0], n)?;
        let each = |f: &dyn Fn(&str) -> String| x.iter().map(|lane| f(lane)).collect::<Vec<_>>();
        let halves =
            |h: Vec<String>| format!("({} & 0xffff) | ({} << 16)", wrap(&h[0]), wrap(&h[1]));
        let bytes = |b: Vec<String>| call("wgsl::join_bytes", &b);
        Ok(match builtin.fun {
            MathFunction::Pack4x8snorm => bytes(each(&|x| format!("wgsl::pack_snorm({x}, 127.0)"))),
            MathFunction::Pack4x8unorm => bytes(each(&|x| format!("wgsl::pack_unorm({x}, 255.0)"))),
            MathFunction::Pack2x16snorm => {
                halves(each(&|x| format!("wgsl::pack_snorm({x}, 32767.0)")))
            }
            MathFunction::Pack2x16unorm => {
                halves(each(&|x| format!("wgsl::pack_unorm({x}, 65535.0)")))
            }
            MathFunction::Pack2x16float => halves(each(&|x| format!("wgsl::f16_from({x} as f32)"))),
            MathFunction::Pack4xI8Clamp => {
                bytes(each(&|x| format!("{x}.max(-128).min(127) as u32")))
            }
            MathFunction::Pack4xU8Clamp => bytes(each(&|x| format!("{x}.min(255)"))),
            _ => bytes(each(&|x| format!("{x} as u32"))),
        })
    }

    fn unpack(&mut self, builtin: &Builtin) -> Result<String, NativeError> {
        let x = self.atom(builtin.arguments[0])?;
        let (name, n, lane): (&str, u32, fn(&str, u32) -> String) = match builtin.fun {
            MathFunction::Unpack4x8snorm => ("Vec4", 4, |x, i| {
                format!("wgsl::max(wgsl::byte_i32({x}, {i}) as Real / 127.0, -1.0)")
            }),
            MathFunction::Unpack4x8unorm => {
                ("Vec4", 4, |x, i| format!("wgsl::byte_u32({x}, {i}) as Real / 255.0"))
            }
            MathFunction::Unpack2x16snorm => ("Vec2", 2, |x, i| {
                format!("wgsl::max(wgsl::half_i32({x}, {i}) as Real / 32767.0, -1.0)")
            }),
            MathFunction::Unpack2x16unorm => {
                ("Vec2", 2, |x, i| format!("(({x} >> {}) & 0xffff) as Real / 65535.0", 16 * i))
            }
            MathFunction::Unpack2x16float => {
                ("Vec2", 2, |x, i| format!("Real::from(wgsl::f16_to({x} >> {}))", 16 * i))
            }
            MathFunction::Unpack4xI8 => ("IVec4", 4, |x, i| format!("wgsl::byte_i32({x}, {i})")),
            _ => ("UVec4", 4, |x, i| format!("wgsl::byte_u32({x}, {i})")),
        };
        let lanes: Vec<String> = (0..n).map(|i| lane(&x, i)).collect();
        Ok(call(&format!("{name}::new"), &lanes))
    }

    fn packed_dot(&mut self, builtin: &Builtin) -> Result<String, NativeError> {
        let &[a, b] = builtin.arguments else {
            return Err(self.refuse(builtin.handle, "this product"));
        };
        let byte = if builtin.fun == MathFunction::Dot4I8Packed { "byte_i32" } else { "byte_u32" };
        let (a, b) = (self.atom(a)?, self.atom(b)?);
        let products: Vec<String> =
            (0..4).map(|i| format!("wgsl::{byte}({a}, {i}) * wgsl::{byte}({b}, {i})")).collect();
        Ok(products.join(" + "))
    }
}

/// How a lane-by-lane function is written.
enum Rule {
    /// `f(x, y, …)`.
    Call(&'static str),
    /// `x.f(y, …)`.
    Method(&'static str),
    /// The pieces between the arguments `x`, `y`, `z`.
    Formula(fn(&[String]) -> String),
}

impl Rule {
    fn apply(&self, x: &[String]) -> String {
        match self {
            Self::Call(name) => call(name, x),
            Self::Method(name) => call(&format!("{}.{name}", wrap(&x[0])), &x[1..]),
            Self::Formula(f) => f(x),
        }
    }
}

/// Functions of floats, lane by lane.
fn float_rule(fun: MathFunction) -> Option<Rule> {
    use MathFunction as F;
    Some(match fun {
        F::Abs => Rule::Method("abs"),
        F::Min => Rule::Call("wgsl::min"),
        F::Max => Rule::Call("wgsl::max"),
        F::Clamp => Rule::Call("wgsl::clamp"),
        F::Saturate => Rule::Formula(|x| {
            call("wgsl::clamp", &[x[0].clone(), "0.0".to_owned(), "1.0".to_owned()])
        }),
        F::Cos => Rule::Method("cos"),
        F::Cosh => Rule::Method("cosh"),
        F::Sin => Rule::Method("sin"),
        F::Sinh => Rule::Method("sinh"),
        F::Tan => Rule::Method("tan"),
        F::Tanh => Rule::Method("tanh"),
        F::Acos => Rule::Method("acos"),
        F::Asin => Rule::Method("asin"),
        F::Atan => Rule::Method("atan"),
        F::Atan2 => Rule::Method("atan2"),
        F::Asinh => Rule::Method("asinh"),
        F::Acosh => Rule::Method("acosh"),
        F::Atanh => Rule::Method("atanh"),
        F::Radians => Rule::Method("to_radians"),
        F::Degrees => Rule::Method("to_degrees"),
        F::Ceil => Rule::Method("ceil"),
        F::Floor => Rule::Method("floor"),
        F::Round => Rule::Method("round_ties_even"),
        F::Fract => Rule::Call("wgsl::fract"),
        F::Trunc => Rule::Method("trunc"),
        F::Ldexp => Rule::Call("wgsl::ldexp"),
        F::Exp => Rule::Method("exp"),
        F::Exp2 => Rule::Method("exp2"),
        F::Log => Rule::Method("ln"),
        F::Log2 => Rule::Method("log2"),
        F::Pow => Rule::Method("powf"),
        F::Sign => Rule::Call("wgsl::sign"),
        F::Fma => Rule::Formula(|x| format!("{} * {} + {}", x[0], x[1], x[2])),
        F::Mix => Rule::Call("wgsl::mix"),
        F::Step => Rule::Call("wgsl::step"),
        F::SmoothStep => Rule::Call("wgsl::smoothstep"),
        F::Sqrt => Rule::Method("sqrt"),
        F::InverseSqrt => Rule::Formula(|x| format!("1.0 / {}.sqrt()", x[0])),
        F::QuantizeToF16 => Rule::Call("wgsl::quantize_f16"),
        _ => return None,
    })
}

/// Functions of integers, lane by lane.
fn integer_rule(fun: MathFunction, kind: Option<ScalarKind>) -> Option<Rule> {
    use MathFunction as F;
    let signed = match kind {
        Some(ScalarKind::Sint) => true,
        Some(ScalarKind::Uint) => false,
        _ => return None,
    };
    let pick = |s: &'static str, u: &'static str| Rule::Call(if signed { s } else { u });
    Some(match fun {
        F::Abs if signed => Rule::Method("wrapping_abs"),
        F::Abs => Rule::Formula(|x| x[0].clone()),
        F::Min => Rule::Method("min"),
        F::Max => Rule::Method("max"),
        F::Clamp => Rule::Formula(|x| format!("{}.max({}).min({})", x[0], x[1], x[2])),
        F::Sign if signed => Rule::Method("signum"),
        F::CountTrailingZeros if signed => {
            Rule::Formula(|x| format!("{}.trailing_zeros() as i32", x[0]))
        }
        F::CountTrailingZeros => Rule::Method("trailing_zeros"),
        F::CountLeadingZeros if signed => {
            Rule::Formula(|x| format!("{}.leading_zeros() as i32", x[0]))
        }
        F::CountLeadingZeros => Rule::Method("leading_zeros"),
        F::CountOneBits if signed => Rule::Formula(|x| format!("{}.count_ones() as i32", x[0])),
        F::CountOneBits => Rule::Method("count_ones"),
        F::ReverseBits => Rule::Method("reverse_bits"),
        F::ExtractBits => pick("wgsl::extract_i32", "wgsl::extract_u32"),
        F::InsertBits => pick("wgsl::insert_i32", "wgsl::insert_u32"),
        F::FirstTrailingBit => pick("wgsl::first_trailing_i32", "wgsl::first_trailing_u32"),
        F::FirstLeadingBit => pick("wgsl::first_leading_i32", "wgsl::first_leading_u32"),
        _ => return None,
    })
}
