use std::error::Error;
use std::io;
use std::path::PathBuf;

/// Error of a chart that could not be drawn or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ChartError {
    /// The chart has no panel, or the panel of this index has no series; or a film has no tree, no
    /// links or no pictures.
    #[error("{}", empty(.panel))]
    Empty {
        /// Index of the empty panel, counted from the top; `None` if the chart has no panel at all.
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
    /// A series has no sample that can be drawn: all samples are missing, not finite, or not
    /// positive on a logarithmic axis.
    #[error(
        "none of the {samples} samples of series `{series}` can be drawn: they must be \
         finite, and positive on a logarithmic axis"
    )]
    NothingToDraw {
        /// Label of the series.
        series: String,
        /// Number of samples of the series.
        samples: usize,
    },
    /// An axis cannot span this range: a given range is empty, not finite or
    /// not positive on a logarithmic axis, or the span of a linear axis lies
    /// outside 1e-290 to 1e290 or vanishes compared with the magnitude of its ends.
    #[error(
        "axis `{axis}` cannot span {low:e} to {high:e}: the ends must be finite and different, and positive on a logarithmic axis"
    )]
    Range {
        /// Label of the axis.
        axis: String,
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
    },
    /// A marker line has a value that its axis cannot show.
    #[error(
        "marker line `{label}` is at {value:e}: this must be finite, and positive on a logarithmic axis"
    )]
    MarkerLine {
        /// Label of the marker line, or of its axis if the line has none.
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
    /// The labels of the axes and the legend leave too little width for the panels.
    #[error(
        "labels leave {left:.0} of {width:.0} px for the panels; shorten them or widen the chart"
    )]
    NoRoom {
        /// Width in px.
        width: f64,
        /// Width in px that is left for a panel.
        left: f64,
    },
    /// A link of a film does not hang from an earlier link, or its position is not finite.
    #[error(
        "link {link} of a film is invalid: its parent must come before it in the list, and its points must be finite"
    )]
    Link {
        /// Index of the link.
        link: usize,
    },
    /// The number of angles in a picture of a film differs from the number of links, or an angle is
    /// not finite.
    #[error(
        "picture {picture} of a film has {found} angles: it needs one finite angle for each of \
         {links} links"
    )]
    Picture {
        /// Number of the picture, from 0.
        picture: usize,
        /// Number of angles in the picture.
        found: usize,
        /// Number of links.
        links: usize,
    },
    /// The embedded font cannot be read, which is a defect of this crate.
    #[error("the embedded font cannot be read: this is a bug of the program, please report it")]
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
