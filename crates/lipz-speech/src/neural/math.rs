//! The arithmetic of the network: matrix products, and functions of numbers.
//!
//! Sums are added in a fixed order, and functions come from `libm` or this crate, so results are the same on every
//! machine. The code is structured so that the compiler can emit vector code.

use crate::model::exp;

/// The number of columns that are computed together, and of rows.
const COLUMNS: usize = 8;
const ROWS: usize = 4;

/// The right-hand side of a matrix product: its columns in groups of eight, row by row. The last group is padded with
/// zeros.
#[derive(Clone, Debug)]
pub(super) struct Matrix {
    rows: usize,
    columns: usize,
    groups: Vec<[f32; COLUMNS]>,
}

impl Matrix {
    /// Returns a matrix with these values, row by row.
    pub(super) fn new(rows: usize, columns: usize, numbers: &[f32]) -> Matrix {
        Matrix::of(rows, columns, |row, column| numbers.get(row * columns + column).copied().unwrap_or(0.0))
    }

    /// Returns a matrix whose values are `number(row, column)`.
    pub(super) fn of(rows: usize, columns: usize, number: impl Fn(usize, usize) -> f32) -> Matrix {
        let mut groups = Vec::with_capacity(columns.div_ceil(COLUMNS) * rows);
        for first in (0..columns).step_by(COLUMNS) {
            for row in 0..rows {
                let column = |at: usize| if first + at < columns { number(row, first + at) } else { 0.0 };
                groups.push(std::array::from_fn(column));
            }
        }
        Matrix { rows, columns, groups }
    }

    /// Returns the product of `left` and this matrix, row by row. The rows of `left` have as many values as this matrix
    /// has rows.
    pub(super) fn product(&self, left: &[f32]) -> Vec<f32> {
        let count = left.len() / self.rows.max(1);
        let mut product = vec![0.0; count * self.columns];
        for (number, group) in self.groups.chunks_exact(self.rows.max(1)).enumerate() {
            let first = number * COLUMNS;
            let width = COLUMNS.min(self.columns - first);
            for row in (0..count).step_by(ROWS) {
                let line = |at: usize| {
                    let at = (row + at).min(count - 1);
                    left.get(at * self.rows..(at + 1) * self.rows).unwrap_or_default()
                };
                let sums = products([line(0), line(1), line(2), line(3)], group);
                for (at, sums) in sums.iter().enumerate().take(count - row) {
                    let start = (row + at) * self.columns + first;
                    product[start..start + width].copy_from_slice(&sums[..width]);
                }
            }
        }
        product
    }
}

/// Returns the products of four rows and eight columns.
fn products(lines: [&[f32]; ROWS], group: &[[f32; COLUMNS]]) -> [[f32; COLUMNS]; ROWS] {
    let mut sums = [[0.0; COLUMNS]; ROWS];
    let [one, two, three, four] = lines;
    for ((((columns, one), two), three), four) in group.iter().zip(one).zip(two).zip(three).zip(four) {
        for (sums, number) in sums.iter_mut().zip([one, two, three, four]) {
            for (sum, column) in sums.iter_mut().zip(columns) {
                *sum += number * column;
            }
        }
    }
    sums
}

/// Adds `bias` to each row.
pub(super) fn add_bias(rows: &mut [f32], bias: &[f32]) {
    for row in rows.chunks_exact_mut(bias.len().max(1)) {
        row.iter_mut().zip(bias).for_each(|(number, bias)| *number += bias);
    }
}

/// Adds `share` times the values of `other`.
pub(super) fn add(rows: &mut [f32], other: &[f32], share: f32) {
    rows.iter_mut().zip(other).for_each(|(number, other)| *number += share * other);
}

/// Normalises each row to mean 0 and variance 1, then multiplies by `scale` and adds `shift`.
pub(super) fn normalised(rows: &[f32], scale: &[f32], shift: &[f32]) -> Vec<f32> {
    let mut out = rows.to_vec();
    for row in out.chunks_exact_mut(scale.len().max(1)) {
        let count = row.len() as f32;
        let mean = row.iter().sum::<f32>() / count;
        let variance = row.iter().map(|number| (number - mean) * (number - mean)).sum::<f32>() / count;
        let factor = 1.0 / (variance + 1e-5).sqrt();
        for ((number, scale), shift) in row.iter_mut().zip(scale).zip(shift) {
            *number = (*number - mean) * factor * scale + shift;
        }
    }
    out
}

/// Converts logarithms to shares whose sum is 1.
pub(super) fn softmax(row: &mut [f32]) {
    let best = row.iter().copied().fold(f32::MIN, f32::max);
    let mut sum = 0.0;
    for number in row.iter_mut() {
        *number = exp(*number - best);
        sum += *number;
    }
    row.iter_mut().for_each(|number| *number /= sum);
}

/// Returns 1 / (1 + e⁻ˣ).
pub(super) fn sigmoid(x: f32) -> f32 {
    let small = exp(-x.abs());
    (if x < 0.0 { small } else { 1.0 }) / (1.0 + small)
}

/// Returns `x` times its sigmoid.
pub(super) fn silu(x: f32) -> f32 {
    x * sigmoid(x)
}

/// Returns `x` times the probability that a normally distributed number is below it.
pub(super) fn gelu(x: f32) -> f32 {
    0.5 * x * (1.0 + libm::erff(x * std::f32::consts::FRAC_1_SQRT_2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_are_those_of_the_definition() {
        for (count, rows, columns) in [(1, 1, 1), (3, 5, 8), (4, 7, 9), (9, 16, 23)] {
            let left: Vec<f32> = (0..count * rows).map(|at| (at % 7) as f32 - 3.0).collect();
            let right: Vec<f32> = (0..rows * columns).map(|at| (at % 5) as f32 - 2.0).collect();
            let product = Matrix::new(rows, columns, &right).product(&left);
            assert_eq!(product.len(), count * columns);
            for (at, &number) in product.iter().enumerate() {
                let (line, column) = (at / columns, at % columns);
                let expected: f32 = (0..rows).map(|row| left[line * rows + row] * right[row * columns + column]).sum();
                assert_eq!(number, expected);
            }
        }
    }

    #[test]
    fn functions_are_those_of_the_definition() {
        for x in [-30.0_f32, -2.0, -0.1, 0.0, 0.5, 3.0, 40.0] {
            assert!((sigmoid(x) - 1.0 / (1.0 + (-x).exp())).abs() < 1e-5, "{x}");
        }
        assert!((gelu(1.0) - 0.841_345).abs() < 1e-5);
        let mut row = [1.0, 2.0, 3.0];
        softmax(&mut row);
        assert!((row.iter().sum::<f32>() - 1.0).abs() < 1e-6 && (row[2] / row[1] - std::f32::consts::E).abs() < 1e-4);
        let rows = normalised(&[1.0, 3.0, 5.0, 5.0], &[2.0, 2.0], &[0.0, 1.0]);
        assert!((rows[0] + 2.0).abs() < 1e-3 && (rows[1] - 3.0).abs() < 1e-3 && rows[2..] == [0.0, 1.0], "{rows:?}");
    }
}
