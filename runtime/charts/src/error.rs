use std::error::Error;
use std::io;
use std::path::PathBuf;

/// Why a chart could not be drawn or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ChartError {
    /// The chart has no panel, or the panel of this index has no series; or the film has
    /// no tree, no links or no pictures.
    #[error("{}", empty(.panel))]
    Empty {
        /// Index of the empty panel, counted from the top; `None` where the
        /// chart has no panel at all.
        panel: Option<usize>,
    },
    /// A series has different numbers of x and y values.
    #[error("series `{series}` has {x} x values and {y} y values")]
    LengthMismatch {
        /// Label of the series.
        series: String,
        /// Number of x values.
        x: usize,
        /// Number of y values.
        y: usize,
    },
    /// No sample of a series can be drawn: there is none, or none is finite
    /// (and positive, where an axis is logarithmic).
    #[error(
        "none of the {samples} samples of series `{series}` can be drawn: they must be \
         finite, and positive on a logarithmic axis"
    )]
    NothingToDraw {
        /// Label of the series.
        series: String,
        /// Number of samples that the series has.
        samples: usize,
    },
    /// An axis cannot span this range: a given range is empty, not finite or
    /// not positive on a logarithmic axis, or the span of a linear axis lies
    /// outside 1e-290 to 1e290 or vanishes beside the magnitude of its ends.
    #[error("axis `{axis}` cannot span {low:e} to {high:e}")]
    Range {
        /// Label of the axis.
        axis: String,
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
    },
    /// A marker line cannot stand at this value of its axis.
    #[error("marker line `{label}` cannot stand at {value:e}")]
    MarkerLine {
        /// Label of the marker line, or of its axis where it has none.
        label: String,
        /// Value asked for.
        value: f64,
    },
    /// Width, height (px) or scale of the output is not usable.
    #[error(
        "a chart of {width} x {height} px at scale {scale} cannot be drawn: the least size \
         is 320 x 200, the PNG's sides may have 16384 pixels"
    )]
    Size {
        /// Width in px.
        width: f64,
        /// Height in px.
        height: f64,
        /// Pixels of the PNG per px.
        scale: f64,
    },
    /// Axis labels and legend leave no room for the panels.
    #[error(
        "labels leave {left:.0} of {width:.0} px for the panels; shorten them or widen the chart"
    )]
    NoRoom {
        /// Width in px.
        width: f64,
        /// Width in px that would be left for a panel.
        left: f64,
    },
    /// A link of a film does not hang from a link before it, or not at a finite place.
    #[error("link {link} of a film must hang from a link before it, at finite places")]
    Link {
        /// Index of the link.
        link: usize,
    },
    /// A picture of a film has no finite angle for some link.
    #[error(
        "picture {picture} of a film has {found} angles: it needs a finite one for each of \
         {links} links"
    )]
    Picture {
        /// Number of the picture, from 0.
        picture: usize,
        /// Number of angles that it has.
        found: usize,
        /// Number of links.
        links: usize,
    },
    /// The embedded font cannot be read, which is a defect of this crate.
    #[error("the embedded font cannot be read")]
    Font,
    /// The PNG encoder failed.
    #[error("cannot encode the PNG")]
    Encode(#[source] Box<dyn Error + Send + Sync>),
    /// A file could not be written.
    #[error("cannot write {}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
}

fn empty(panel: &Option<usize>) -> String {
    match panel {
        None => "the chart has no panel".to_owned(),
        Some(panel) => format!("panel {panel} of the chart has no series"),
    }
}
