//! Names of links, and dashed lines between points of them.

use super::layout::Layout;
use super::{Film, Tree};
use crate::drawing::{Anchor, Mark, Point, Text};
use crate::label::Label;
use crate::style::{Color, Dash};

/// A point of a tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FilmPoint {
    /// A point of a link.
    Link {
        /// Index of the link.
        link: usize,
        /// Position on the link (along it, across it), in m.
        at: [f64; 2],
    },
    /// A fixed point: x, and y upwards, relative to the root's pivot, in m.
    Ground([f64; 2]),
}

/// Colour, thickness (px) and dashes of lines between points.
const TIE: (Color, f64, Dash) = (Color::rgb(90, 90, 90), 1.5, Dash::Dashed);

/// Font size of names, and their distance from the middle of the link, in px.
const NAME_SIZE: f64 = 12.0;
const NAME_DISTANCE: f64 = 8.0;

impl Film {
    /// Writes names next to the links of the last tree, in their order. They are left out of the
    /// SVG of a film with several pictures.
    #[must_use]
    pub fn names<S: Into<String>>(mut self, names: impl IntoIterator<Item = S>) -> Self {
        if let Some(tree) = self.trees.last_mut() {
            tree.names = names.into_iter().map(Into::into).collect();
        }
        self
    }

    /// Draws a dashed line between two points of the last tree, for example for a spring. A point
    /// of a link that does not exist is ignored. The line is left out of the SVG of a film with
    /// several pictures.
    #[must_use]
    pub fn tie(mut self, ends: [FilmPoint; 2]) -> Self {
        if let Some(tree) = self.trees.last_mut() {
            tree.ties.push(ends);
        }
        self
    }
}

impl Tree {
    /// Returns the marks of names and lines in a picture, with the root's pivot at `root` (px).
    pub(super) fn still_marks(&self, layout: &Layout, root: Point, picture: usize) -> Vec<Mark> {
        let place = |[x, y]: [f64; 2]| (root.0 + layout.scale * x, root.1 + layout.scale * y);
        let segments = self.segments(picture);
        let angles = &self.pictures[picture];
        let point = |point: FilmPoint| match point {
            FilmPoint::Ground([x, y]) => Some([x, -y]),
            FilmPoint::Link {
                link,
                at: [along, across],
            } => {
                let ([[x, y], _], (s, c)) = (segments.get(link)?, angles.get(link)?.sin_cos());
                Some([x + along * s + across * c, y + along * c - across * s])
            }
        };
        let lines = self.ties.iter().filter_map(|[from, to]| {
            let [from, to] = [point(*from)?, point(*to)?].map(place);
            Some(vec![from, to])
        });
        let lines: Vec<Vec<Point>> = lines.collect();
        let (color, width, dash) = TIE;
        let mut marks = Vec::new();
        if !lines.is_empty() {
            marks.push(Mark::Lines {
                lines,
                color,
                width,
                dash,
            });
        }
        let names = self.names.iter().zip(&segments);
        marks.extend(names.map(|(name, [from, to])| {
            let middle = place([0, 1].map(|k| 0.5 * (from[k] + to[k])));
            // Towards the middle, so that nothing is cut off at the sides.
            let (side, anchor) = match middle.0 <= root.0 {
                true => (NAME_DISTANCE, Anchor::Start),
                false => (-NAME_DISTANCE, Anchor::End),
            };
            Mark::Text(Text {
                label: Label::parse(name),
                at: (middle.0 + side, middle.1 + 0.35 * NAME_SIZE),
                anchor,
                size: NAME_SIZE,
                upwards: false,
            })
        }));
        marks
    }
}
