//! The grid of a panel whose samples fill cells.

use crate::description::Panel;
use crate::scale::{coordinate, drawable};

/// Distinct coordinates (values, or their logarithms to base 10) of all cells of a panel,
/// ascending.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Grid {
    x: Vec<f64>,
    y: Vec<f64>,
}

/// Fraction of the span of a grid's coordinates below which two of them count as equal: samples of
/// one column may differ by rounding.
const EQUAL: f64 = 1e-9;

impl Grid {
    pub(crate) fn of(panel: &Panel, x_log: bool) -> Self {
        let cells = || panel.series.iter().filter(|series| series.cells);
        let x = cells().flat_map(|series| &series.x);
        let y = cells().flat_map(|series| &series.y);
        Self {
            x: distinct(x, x_log),
            y: distinct(y, panel.y.log),
        }
    }

    /// Returns the left and right edge of the cell about an x coordinate.
    pub(crate) fn across(&self, at: f64) -> (f64, f64) {
        edges(&self.x, at)
    }

    /// Returns the lower and upper edge of the cell about a y coordinate.
    pub(crate) fn up(&self, at: f64) -> (f64, f64) {
        edges(&self.y, at)
    }

    /// Returns the outermost edges of all columns and of all rows; `None` without cells.
    pub(crate) fn extent(&self) -> Option<[(f64, f64); 2]> {
        let ends = |all: &[f64]| {
            let (first, last) = (*all.first()?, *all.last()?);
            Some((edges(all, first).0, edges(all, last).1))
        };
        Some([ends(&self.x)?, ends(&self.y)?])
    }
}

fn distinct<'a>(values: impl Iterator<Item = &'a f64>, log: bool) -> Vec<f64> {
    let drawable = values.copied().filter(|value| drawable(log, *value));
    let mut all: Vec<f64> = drawable.map(|value| coordinate(log, value)).collect();
    all.sort_by(f64::total_cmp);
    let span = all.last().zip(all.first()).map_or(0.0, |(b, a)| b - a);
    all.dedup_by(|b, a| *b - *a <= EQUAL * span);
    all
}

/// Returns the edges of the cell about `at`, half way to its neighbours in `all`. If a neighbour is
/// missing on one side, the cell extends as far there as on the other side; a single cell extends
/// by one half.
fn edges(all: &[f64], at: f64) -> (f64, f64) {
    let nearest = (0..all.len()).min_by(|&a, &b| {
        let distance = |index: usize| (all[index] - at).abs();
        distance(a).total_cmp(&distance(b))
    });
    let Some(index) = nearest else {
        return (at - 0.5, at + 0.5);
    };
    let middle = all[index];
    let below = index
        .checked_sub(1)
        .map(|below| (middle - all[below]) / 2.0);
    let above = all.get(index + 1).map(|above| (above - middle) / 2.0);
    let low = below.or(above).unwrap_or(0.5);
    let high = above.or(below).unwrap_or(0.5);
    (middle - low, middle + high)
}

#[cfg(test)]
mod tests {
    use super::edges;

    #[test]
    fn cells_meet_half_way() {
        let all = [1.0, 2.0, 4.0];
        assert_eq!(edges(&all, 1.0), (0.5, 1.5));
        assert_eq!(edges(&all, 2.0), (1.5, 3.0));
        assert_eq!(edges(&all, 4.0), (3.0, 5.0));
        assert_eq!(edges(&[7.0], 7.0), (6.5, 7.5));
    }
}
