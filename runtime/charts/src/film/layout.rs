//! Positions of the trees in a film.

use super::{Film, Tree};
use crate::drawing::{LARGEST_SIDE, Point};
use crate::error::ChartError;

/// Space around the trees, and height of the caption below each tree, in px.
const MARGIN: f64 = 14.0;
const LABEL: f64 = 22.0;

/// Positions of the trees, px.
pub(super) struct Layout {
    /// Pixels in a metre.
    pub(super) scale: f64,
    /// Pivots of the trees' roots.
    pub(super) roots: Vec<Point>,
    pub(super) width: f64,
    pub(super) height: f64,
    /// Anchors of the labels.
    pub(super) labels: Vec<Point>,
}

impl Film {
    pub(super) fn layout(&self) -> Result<Layout, ChartError> {
        let count = self.pictures();
        if count == 0 || self.trees.iter().any(|tree| tree.links.is_empty()) {
            return Err(ChartError::Empty { panel: None });
        }
        // Left, top, right and bottom of all trees at all times, m.
        let mut bounds = [0.0_f64; 4];
        for tree in &self.trees {
            for picture in 0..count {
                for [x, y] in tree.segments(picture).into_iter().flatten() {
                    bounds = [
                        bounds[0].min(x),
                        bounds[1].min(y),
                        bounds[2].max(x),
                        bounds[3].max(y),
                    ];
                }
            }
        }
        let [left, top, right, bottom] = bounds;
        let columns = self.columns.min(self.trees.len());
        let cell = self.width / columns as f64;
        let scale = (cell - 2.0 * MARGIN) / (right - left).max(bottom - top);
        let labelled = self.trees.iter().any(|tree| !tree.label.is_empty());
        let row = scale * (bottom - top) + 2.0 * MARGIN + if labelled { LABEL } else { 0.0 };
        let height = row * self.trees.len().div_ceil(columns) as f64;
        if !(scale.is_finite() && scale > 0.0 && height <= LARGEST_SIDE) {
            return Err(ChartError::Size {
                width: self.width,
                height,
                scale: 1.0,
            });
        }
        let cells = (0..self.trees.len()).map(|index| {
            let (column, line) = (index % columns, index / columns);
            (cell * column as f64, row * line as f64)
        });
        let centre = (cell - scale * (left + right)) / 2.0;
        let (roots, labels) = cells
            .map(|(x, y)| {
                let root = (x + centre, y + MARGIN - scale * top);
                (root, (x + cell / 2.0, y + row - MARGIN / 2.0))
            })
            .unzip();
        Ok(Layout {
            scale,
            roots,
            width: self.width,
            height,
            labels,
        })
    }
}

impl Tree {
    /// Returns both ends of every link in a picture, in m from the root's pivot; x points to the
    /// right, y downwards.
    pub(super) fn segments(&self, picture: usize) -> Vec<[[f64; 2]; 2]> {
        let angles = &self.pictures[picture];
        let turned = |[along, across]: [f64; 2], angle: f64| {
            let (s, c) = angle.sin_cos();
            [along * s + across * c, along * c - across * s]
        };
        let mut pivots: Vec<[f64; 2]> = Vec::new();
        let mut segments = Vec::new();
        for (link, &angle) in self.links.iter().zip(angles) {
            let [x, y] = link.parent.map_or([0.0; 2], |parent| {
                let [dx, dy] = turned(link.pivot, angles[parent]);
                [pivots[parent][0] + dx, pivots[parent][1] + dy]
            });
            let [dx, dy] = turned(link.end, angle);
            pivots.push([x, y]);
            segments.push([[x, y], [x + dx, y + dy]]);
        }
        segments
    }
}
