use super::label::Label;
use super::style::{Color, Dash, Symbol};

/// Longest side of a canvas in px, and of a PNG in pixels.
pub(super) const LARGEST_SIDE: f64 = 16384.0;

/// A point of the canvas in px, y down.
pub(super) type Point = (f64, f64);

/// What both file formats draw, in this order, on white.
#[derive(Debug)]
pub(super) struct Drawing {
    pub(super) width: f64,
    pub(super) height: f64,
    /// Title without markup, for screen readers.
    pub(super) title: String,
    pub(super) marks: Vec<Mark>,
}

#[derive(Debug)]
pub(super) enum Mark {
    Lines {
        lines: Vec<Vec<Point>>,
        color: Color,
        width: f64,
        dash: Dash,
    },
    Symbols {
        symbol: Symbol,
        at: Vec<Point>,
        radius: f64,
        color: Color,
    },
    Text(Text),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

impl Anchor {
    /// Part of the width that lies before the anchor.
    pub(super) const fn before(self) -> f64 {
        match self {
            Self::Start => 0.0,
            Self::Middle => 0.5,
            Self::End => 1.0,
        }
    }
}

/// One line of text.
#[derive(Clone, Debug)]
pub(super) struct Text {
    pub(super) label: Label,
    /// The anchor, on the baseline.
    pub(super) at: Point,
    pub(super) anchor: Anchor,
    pub(super) size: f64,
    /// Reads upwards instead of to the right.
    pub(super) upwards: bool,
}
