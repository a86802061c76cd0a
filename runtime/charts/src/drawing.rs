use crate::label::Label;
use crate::style::{Color, Dash, Fill, Symbol};

/// Longest side of a canvas in px, and of a PNG in pixels.
pub(crate) const LARGEST_SIDE: f64 = 16384.0;

/// A point of the canvas in px; y points downwards.
pub(crate) type Point = (f64, f64);

/// Marks that all file formats draw in this order on a white background.
#[derive(Debug)]
pub(crate) struct Drawing {
    pub(crate) width: f64,
    pub(crate) height: f64,
    /// Title without markup, for screen readers.
    pub(crate) title: String,
    pub(crate) marks: Vec<Mark>,
}

#[derive(Debug)]
pub(crate) enum Mark {
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
    /// Filled polygons.
    Areas {
        polygons: Vec<Vec<Point>>,
        color: Color,
        fill: Fill,
    },
    Text(Text),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

impl Anchor {
    /// Returns the fraction of the text's width that lies before the anchor.
    pub(crate) const fn before(self) -> f64 {
        match self {
            Self::Start => 0.0,
            Self::Middle => 0.5,
            Self::End => 1.0,
        }
    }
}

/// One line of text.
#[derive(Clone, Debug)]
pub(crate) struct Text {
    pub(crate) label: Label,
    /// The anchor, on the baseline.
    pub(crate) at: Point,
    pub(crate) anchor: Anchor,
    pub(crate) size: f64,
    /// True if the text reads upwards instead of to the right.
    pub(crate) upwards: bool,
}
