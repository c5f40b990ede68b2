//! Matrices: every sum of products is written out, so that its order is the same in both precisions
//! and on every platform. Matrices are column-major, as in WGSL.

use crate::NativeError;
use crate::functions::FunctionWriter;
use crate::types::{LANES, column, matrix_of};
use naga::{BinaryOperator, Expression, Handle, MathFunction, TypeInner, VectorSize};

/// The sum of a matrix's columns times the lanes of a vector, last to first: the order of Mesa.
fn sum_of_columns(columns: &[String], lanes: &[String]) -> String {
    let products: Vec<String> =
        columns.iter().zip(lanes).rev().map(|(a, b)| format!("{a} * {b}")).collect();
    products.join(" + ")
}

/// The sum of products of two lists, in their order.
pub(crate) fn sum_of_products(left: &[String], right: &[String]) -> String {
    let products: Vec<String> = left.iter().zip(right).map(|(a, b)| format!("{a} * {b}")).collect();
    products.join(" + ")
}

impl FunctionWriter<'_> {
    fn shape(&self, handle: Handle<Expression>) -> Option<(VectorSize, VectorSize)> {
        match *self.ty(handle) {
            TypeInner::Matrix { columns, rows, .. } => Some((columns, rows)),
            _ => None,
        }
    }

    /// The columns of a matrix, or a vector as the only one.
    fn columns(&mut self, handle: Handle<Expression>) -> Result<Vec<String>, NativeError> {
        let name = self.atom(handle)?;
        Ok(match self.shape(handle) {
            Some((columns, rows)) => {
                (0..columns as usize).map(|i| column(&name, i, columns == rows)).collect()
            }
            None => vec![name],
        })
    }

    /// `f` of each column.
    pub(crate) fn columnwise(
        &mut self,
        matrix: Handle<Expression>,
        f: impl Fn(&str) -> String,
    ) -> Result<String, NativeError> {
        let Some((_, rows)) = self.shape(matrix) else {
            return Err(self.refuse(matrix, "this matrix"));
        };
        let columns: Vec<String> = self.columns(matrix)?.iter().map(|c| f(c)).collect();
        Ok(matrix_of(&columns, rows))
    }

    /// A binary operator with at least one matrix.
    pub(crate) fn matrix_binary(
        &mut self,
        handle: Handle<Expression>,
        op: BinaryOperator,
        left: Handle<Expression>,
        right: Handle<Expression>,
    ) -> Result<String, NativeError> {
        let (shape_left, shape_right) = (self.shape(left), self.shape(right));
        match (op, shape_left, shape_right) {
            (BinaryOperator::Add, Some((_, rows)), Some(_)) => {
                self.pairwise("+", left, right, rows)
            }
            (BinaryOperator::Subtract, Some((_, rows)), Some(_)) => {
                self.pairwise("-", left, right, rows)
            }
            (BinaryOperator::Multiply, Some((columns, rows)), Some(_)) => {
                let a = self.columns(left)?;
                let b = self.columns(right)?;
                let products: Vec<String> =
                    b.iter().map(|b| sum_of_columns(&a, &lanes_of(b, columns))).collect();
                Ok(matrix_of(&products, rows))
            }
            (BinaryOperator::Multiply, Some((columns, rows)), None) => {
                let a = self.columns(left)?;
                if let TypeInner::Vector { .. } = self.ty(right) {
                    let v = self.lanes(right, columns as usize)?;
                    return Ok(sum_of_columns(&a, &v));
                }
                let s = self.atom(right)?;
                Ok(scaled(&a, &s, rows))
            }
            (BinaryOperator::Multiply, None, Some((_, rows))) => {
                let a = self.columns(right)?;
                if let TypeInner::Vector { .. } = self.ty(left) {
                    let v = self.lanes(left, rows as usize)?;
                    let dots: Vec<String> =
                        a.iter().map(|c| sum_of_products(&v, &lanes_of(c, rows))).collect();
                    return Ok(format!("Vec{}::new({})", dots.len(), dots.join(", ")));
                }
                let s = self.atom(left)?;
                Ok(scaled(&a, &s, rows))
            }
            _ => Err(self.refuse(handle, &format!("{op:?} of matrices"))),
        }
    }

    fn pairwise(
        &mut self,
        op: &str,
        left: Handle<Expression>,
        right: Handle<Expression>,
        rows: VectorSize,
    ) -> Result<String, NativeError> {
        let (a, b) = (self.columns(left)?, self.columns(right)?);
        let sums: Vec<String> = a.iter().zip(&b).map(|(a, b)| format!("{a} {op} {b}")).collect();
        Ok(matrix_of(&sums, rows))
    }

    /// `transpose`, `determinant`, `outer`.
    pub(crate) fn matrix_math(
        &mut self,
        handle: Handle<Expression>,
        fun: MathFunction,
        argument: Handle<Expression>,
    ) -> Result<String, NativeError> {
        let Some((columns, rows)) = self.shape(argument) else {
            return Err(self.refuse(handle, &format!("{fun:?}")));
        };
        match fun {
            MathFunction::Transpose => {
                let from = self.columns(argument)?;
                let list: Vec<String> = LANES[..rows as usize]
                    .iter()
                    .map(|lane| {
                        let row: Vec<String> = from.iter().map(|c| format!("{c}.{lane}")).collect();
                        format!("Vec{}::new({})", from.len(), row.join(", "))
                    })
                    .collect();
                Ok(matrix_of(&list, columns))
            }
            MathFunction::Determinant if columns == rows => {
                let c = self.columns(argument)?;
                Ok(determinant(&c))
            }
            _ => Err(self.refuse(handle, &format!("{fun:?}"))),
        }
    }
}

/// Every column times a scalar.
fn scaled(columns: &[String], scalar: &str, rows: VectorSize) -> String {
    let columns: Vec<String> = columns.iter().map(|c| format!("{c} * {scalar}")).collect();
    matrix_of(&columns, rows)
}

fn lanes_of(vector: &str, n: VectorSize) -> Vec<String> {
    LANES[..n as usize].iter().map(|lane| format!("{vector}.{lane}")).collect()
}

/// Expansion by minors along the first column, in the order of Mesa.
fn determinant(columns: &[String]) -> String {
    let lanes = &LANES[..columns.len()];
    match columns {
        [a, b] => format!("{a}.x * {b}.y - {a}.y * {b}.x"),
        [a, b, c] => determinant_of_three([a, b, c], [lanes[0], lanes[1], lanes[2]]),
        [a, b, c, d] => {
            let minor = |i: usize| {
                let rest: Vec<&str> = (0..4).filter(|j| *j != i).map(|j| lanes[j]).collect();
                let inner = determinant_of_three([b, c, d], [rest[0], rest[1], rest[2]]);
                format!("{a}.{} * ({inner})", lanes[i])
            };
            format!("({} - {}) + ({} - {})", minor(0), minor(1), minor(2), minor(3))
        }
        _ => String::new(),
    }
}

fn determinant_of_three([a, b, c]: [&String; 3], [x, y, z]: [&str; 3]) -> String {
    let term =
        |x: &str, y: &str, z: &str| format!("{a}.{x} * ({b}.{y} * {c}.{z} - {b}.{z} * {c}.{y})");
    format!("{} + {} + {}", term(x, y, z), term(y, z, x), term(z, x, y))
}
