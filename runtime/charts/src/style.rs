/// A colour, sRGB.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Color {
    /// Red.
    pub red: u8,
    /// Green.
    pub green: u8,
    /// Blue.
    pub blue: u8,
}

impl Color {
    /// Creates a colour from its sRGB components.
    pub const fn rgb(red: u8, green: u8, blue: u8) -> Self {
        Self { red, green, blue }
    }

    /// Returns the default colour of the series with this index.
    pub const fn of_series(index: usize) -> Self {
        PALETTE[index % PALETTE.len()]
    }
}

/// Background of charts.
pub(crate) const WHITE: Color = Color::rgb(255, 255, 255);

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Dash {
    /// Without gaps.
    Solid,
    /// Long dashes.
    Dashed,
    /// Dashes and dots by turns.
    DashDot,
    /// Dots.
    Dotted,
}

impl Dash {
    /// Returns the lengths in px of strokes and gaps, alternating; empty for a solid line.
    pub(crate) const fn pattern(self) -> &'static [f32] {
        match self {
            Self::Solid => &[],
            Self::Dashed => &[7.0, 3.0],
            Self::DashDot => &[8.0, 2.5, 2.0, 2.5],
            Self::Dotted => &[2.0, 2.2],
        }
    }
}

/// Shape of the symbol at a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Symbol {
    /// A disc.
    Circle,
    /// A square.
    Square,
    /// A triangle, point up.
    Triangle,
    /// A square on its corner.
    Diamond,
    /// A triangle, point down.
    TriangleDown,
    /// An upright cross.
    Plus,
    /// A diagonal cross.
    Cross,
}

impl Symbol {
    /// Returns the corners of a symbol of radius 1, y down; empty for the disc. The sizes differ so
    /// that the areas look equal.
    pub(crate) const fn corners(self) -> &'static [(f64, f64)] {
        // Half the thickness of a bar of the crosses, and that bar turned by
        // 45 degrees.
        const B: f64 = 0.36;
        const P: f64 = 1.15;
        const Q: f64 = 1.02;
        const R: f64 = 0.51;
        match self {
            Self::Circle => &[],
            Self::Square => &[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
            Self::Triangle => &[(0.0, -1.25), (1.15, 0.8), (-1.15, 0.8)],
            Self::Diamond => &[(0.0, -1.3), (1.3, 0.0), (0.0, 1.3), (-1.3, 0.0)],
            Self::TriangleDown => &[(0.0, 1.25), (1.15, -0.8), (-1.15, -0.8)],
            Self::Plus => &[
                (-B, -P),
                (B, -P),
                (B, -B),
                (P, -B),
                (P, B),
                (B, B),
                (B, P),
                (-B, P),
                (-B, B),
                (-P, B),
                (-P, -B),
                (-B, -B),
            ],
            Self::Cross => &[
                (-Q, -R),
                (-R, -Q),
                (0.0, -R),
                (R, -Q),
                (Q, -R),
                (R, 0.0),
                (Q, R),
                (R, Q),
                (0.0, R),
                (-R, Q),
                (-Q, R),
                (-R, 0.0),
            ],
        }
    }
}

/// Style of a series, by which it differs from the others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Style {
    pub(crate) color: Color,
    /// Dash pattern of the line; `None` if the samples are not joined.
    pub(crate) dash: Option<Dash>,
    pub(crate) symbol: Option<Symbol>,
    /// Radius of the symbol, px.
    pub(crate) radius: f64,
    pub(crate) fill: Option<Fill>,
}

/// Radius of symbols, and radius of dots, in px.
pub(crate) const RADIUS: f64 = 4.0;
pub(crate) const DOT: f64 = 1.6;

/// How an area is filled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fill {
    /// Half transparent, so that marks behind it show through.
    Sheer,
    /// Opaque and without smoothed edges, which would be visible between neighbouring cells.
    Crisp,
}

impl Fill {
    /// Returns the opacity, from 0 to 1.
    pub(crate) const fn opacity(self) -> f64 {
        match self {
            Self::Sheer => 0.35,
            Self::Crisp => 1.0,
        }
    }
}

/// Returns `count` colours from low to high: from blue over grey to yellow, in equal steps of
/// lightness for all common forms of colour vision (cividis: J. R. Nuñez, C. R. Anderton and R. S.
/// Renslow, PLoS ONE 13 (2018) e0199239).
pub(crate) fn ramp(count: usize) -> Vec<Color> {
    const STOPS: [(f64, f64, f64); 5] = [
        (0.0, 34.0, 78.0),
        (66.0, 78.0, 108.0),
        (125.0, 124.0, 120.0),
        (187.0, 173.0, 108.0),
        (254.0, 232.0, 56.0),
    ];
    let mix = |a: f64, b: f64, part: f64| (a + part * (b - a)).round() as u8;
    let color = |index: usize| {
        let place = index as f64 / (count.max(2) - 1) as f64 * (STOPS.len() - 1) as f64;
        let below = (place as usize).min(STOPS.len() - 2);
        let (part, a, b) = (place - below as f64, STOPS[below], STOPS[below + 1]);
        Color::rgb(
            mix(a.0, b.0, part),
            mix(a.1, b.1, part),
            mix(a.2, b.2, part),
        )
    };
    (0..count).map(color).collect()
}

/// Colours that can be distinguished without one of the three kinds of cones, and in a grey print:
/// their lightness differs by at least 16 (of 100) among the first four and 9 among all, and for
/// eyes without green cones every pair differs by at least 23 (CIE 1976).
const PALETTE: [Color; 7] = [
    Color::rgb(6, 30, 177),
    Color::rgb(183, 98, 42),
    Color::rgb(0, 0, 0),
    Color::rgb(99, 181, 131),
    Color::rgb(172, 33, 76),
    Color::rgb(103, 206, 213),
    Color::rgb(48, 10, 95),
];

const DASHES: [Dash; 4] = [Dash::Solid, Dash::Dashed, Dash::DashDot, Dash::Dotted];

const SYMBOLS: [Symbol; 7] = [
    Symbol::Circle,
    Symbol::Square,
    Symbol::Triangle,
    Symbol::Diamond,
    Symbol::TriangleDown,
    Symbol::Plus,
    Symbol::Cross,
];

/// Returns colour, dash pattern and symbol of the `index`-th series. There are seven colours and
/// four dash patterns, and the symbol advances by one when the colours begin again: the first 28
/// lines differ pairwise, as do the first 49 kinds of points.
pub(crate) fn automatic(index: usize) -> (Color, Dash, Symbol) {
    (
        Color::of_series(index),
        DASHES[index % DASHES.len()],
        SYMBOLS[(index + index / PALETTE.len()) % SYMBOLS.len()],
    )
}
