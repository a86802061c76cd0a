//! Charts from one description, as SVG, PNG and PDF, and films of trees, as SVG and PNG.
//!
//! A [`Chart`] is a title, a shared x axis and one or more [`Panel`]s, above each
//! other or in columns; a panel holds [`Series`] (lines, symbols, bands, the cells
//! of a map), marker lines and a y axis. Maps whose colour is a value share a scale of
//! colours, which stands at the right as a bar.
//!
//! ```no_run
//! use branched_pendulum_charts::{Axis, Chart, ChartError, Panel};
//!
//! # fn main() -> Result<(), ChartError> {
//! let time = [0.0, 0.1, 0.2, 0.3];
//! let h_d = [0.0, 1.0e-3, 2.5e-3, 2.0e-3];
//! let w = [0.0, 1.2e-2, 5.0e-3, -9.0e-3];
//! let chart = Chart::new("Energy of the antiphase mode", Axis::linear("t (s)"))
//!     .panel(Panel::new(Axis::linear("H_d (J)")).line("H_d", &time, &h_d))
//!     .panel(
//!         Panel::new(Axis::linear("W (W)"))
//!             .line("W exact", &time, &w)
//!             .zero_line(),
//!     );
//! chart.write_svg("energy.svg")?;
//! chart.write_png("energy.png")?;
//! // For a column of a paper: 85 mm wide, labels of 7 and 8 points.
//! chart.figure(85.0).write_pdf("energy.pdf")?;
//! # Ok(())
//! # }
//! ```
//!
//! # Labels
//! In every label `_` lowers and `^` raises the next character, or the group
//! in braces that follows: `θ_d`, `f_+`, `10^{−3}`. A backslash takes the
//! meaning from the character after it (`mid\_range`), and [`verbatim`] does so for a whole
//! name; a `_` or `^` with
//! nothing to act on, or with a brace that is never closed, stands for itself.
//! Line feeds and other control characters become spaces. A character that
//! the embedded font lacks (it has Latin, Greek, Cyrillic and common
//! mathematics) is a hollow box in PNG and PDF; the SVG leaves it to the viewer.
//!
//! # Samples
//! A sample whose x or y is not finite, or not positive on a logarithmic axis,
//! breaks the line: nothing is drawn across the gap, and a sample alone between
//! two gaps is a dot. A series without a single drawable sample is an error.
//! Runs of samples within one pixel column are reduced to the first, the
//! lowest, the highest and the last of them, so that files stay small and no
//! extreme is lost; of symbols that fall on the same pixel one is drawn.
//!
//! # Layout
//! The legend stands outside the panels, at the right where it fits and below
//! otherwise; long text wraps. Panels never become lower than a legible
//! minimum: where title and legend leave less, the chart grows in height.
//! Series take colours, dashes and symbols in turn; a line that turns more
//! than 200 times is solid unless its dash is given. The same description
//! gives the same bytes.
//!
//! # Why not a plotting library
//! kuva, plotive, plotkit and ruviz were tried on work-precision data and plotters
//! read: none of them sets `θ_d` and `W_K`, keeps errors of 1e-14 on a logarithmic
//! axis and compiles with this crate's oldest compiler. So layout is ours, while
//! paths are filled by tiny-skia and glyphs read by ttf-parser. The crate is
//! finished: for other kinds of charts write tables and draw them elsewhere.

mod areas;
mod arrange;
mod axis;
mod beyond;
mod cells;
mod clip;
mod color_bar;
mod compose;
mod decimal;
mod decimate;
mod description;
mod drawing;
mod error;
mod error_bars;
mod film;
mod font;
mod guides;
mod label;
mod legend;
mod output;
mod pdf;
mod png;
mod scale;
mod shades;
mod sizes;
mod style;
mod svg;
#[cfg(test)]
mod tests;
mod ticks;

pub use description::{Axis, Chart, Panel, Series};
pub use error::ChartError;
pub use film::{Film, FilmLink, FilmPoint};
pub use label::verbatim;
pub use style::{Color, Dash, Symbol};
