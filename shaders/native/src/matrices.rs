//! Matrices: every sum of products is written out, so that its order is the same in both precisions
//! and on every platform. Matrices are column-major, as in WGSL.

use crate::NativeError;
use crate::functions::FunctionWriter;
use crate::types::{LANES, column, matrix_of};
use naga::{BinaryOperator, Expression, Handle, MathFunction, TypeInner, VectorSize};

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
                    b.iter().map(|b| sum_of_products(&a, &lanes_of(b, columns))).collect();
                Ok(matrix_of(&products, rows))
            }
            (BinaryOperator::Multiply, Some((columns, rows)), None) => match self.ty(right) {
                TypeInner::Vector { .. } => {
                    let a = self.columns(left)?;
                    let v = self.lanes(right, columns as usize)?;
                    Ok(sum_of_products(&a, &v))
                }
                _ => {
                    let s = self.atom(right)?;
                    let scaled: Vec<String> =
                        self.columns(left)?.iter().map(|c| format!("{c} * {s}")).collect();
                    Ok(matrix_of(&scaled, rows))
                }
            },
            (BinaryOperator::Multiply, None, Some((_, rows))) => match self.ty(left) {
                TypeInner::Vector { .. } => {
                    let v = self.lanes(left, rows as usize)?;
                    let dots: Vec<String> = self
                        .columns(right)?
                        .iter()
                        .map(|c| sum_of_products(&v, &lanes_of(c, rows)))
                        .collect();
                    Ok(format!("Vec{}::new({})", dots.len(), dots.join(", ")))
                }
                _ => {
                    let s = self.atom(left)?;
                    let scaled: Vec<String> =
                        self.columns(right)?.iter().map(|c| format!("{c} * {s}")).collect();
                    Ok(matrix_of(&scaled, rows))
                }
            },
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

fn lanes_of(vector: &str, n: VectorSize) -> Vec<String> {
    LANES[..n as usize].iter().map(|lane| format!("{vector}.{lane}")).collect()
}

/// Expansion by minors along the first lane of each column.
fn determinant(columns: &[String]) -> String {
    fn minor(columns: &[&str], lanes: &[&str]) -> String {
        if let ([c], [lane]) = (columns, lanes) {
            return format!("{c}.{lane}");
        }
        let mut text = String::new();
        for (i, c) in columns.iter().enumerate() {
            let rest: Vec<&str> =
                columns.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, c)| *c).collect();
            let sign = match (i, i % 2) {
                (0, _) => "",
                (_, 0) => " + ",
                _ => " - ",
            };
            let inner = minor(&rest, &lanes[1..]);
            text.push_str(&format!("{sign}{c}.{} * ({inner})", lanes[0]));
        }
        text
    }
    let columns: Vec<&str> = columns.iter().map(String::as_str).collect();
    minor(&columns, &LANES[..columns.len()])
}
