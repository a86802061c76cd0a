use std::error::Error;
use std::fmt;
use std::io;
use std::path::PathBuf;

/// Why a chart could not be drawn or written.
#[derive(Debug)]
#[non_exhaustive]
pub enum ChartError {
    /// The chart has no panel, or the panel of this index has no series.
    Empty {
        /// Index of the empty panel, counted from the top; `None` where the
        /// chart has no panel at all.
        panel: Option<usize>,
    },
    /// A series has different numbers of x and y values.
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
    NothingToDraw {
        /// Label of the series.
        series: String,
        /// Number of samples that the series has.
        samples: usize,
    },
    /// An axis cannot span this range: a given range is empty, not finite or
    /// not positive on a logarithmic axis, or the span of a linear axis lies
    /// outside 1e-290 to 1e290 or vanishes beside the magnitude of its ends.
    Range {
        /// Label of the axis.
        axis: String,
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
    },
    /// A marker line cannot stand at this value of its axis.
    MarkerLine {
        /// Label of the marker line, or of its axis where it has none.
        label: String,
        /// Value asked for.
        value: f64,
    },
    /// Width, height (px) or scale of the output is not usable.
    Size {
        /// Width in px.
        width: f64,
        /// Height in px.
        height: f64,
        /// Pixels of the PNG per px.
        scale: f64,
    },
    /// Axis labels and legend leave no room for the panels.
    NoRoom {
        /// Width in px.
        width: f64,
        /// Width in px that would be left for a panel.
        left: f64,
    },
    /// The embedded font cannot be read, which is a defect of this crate.
    Font,
    /// The PNG encoder failed.
    Encode(Box<dyn Error + Send + Sync>),
    /// A file could not be written.
    Io {
        /// The file.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
}

impl fmt::Display for ChartError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty { panel: None } => write!(f, "the chart has no panel"),
            Self::Empty { panel: Some(panel) } => {
                write!(f, "panel {panel} of the chart has no series")
            }
            Self::LengthMismatch { series, x, y } => {
                write!(f, "series `{series}` has {x} x values and {y} y values")
            }
            Self::NothingToDraw { series, samples } => write!(
                f,
                "none of the {samples} samples of series `{series}` can be \
                 drawn: they must be finite, and positive on a logarithmic axis"
            ),
            Self::Range { axis, low, high } => {
                write!(f, "axis `{axis}` cannot span {low:e} to {high:e}")
            }
            Self::MarkerLine { label, value } => {
                write!(f, "marker line `{label}` cannot stand at {value:e}")
            }
            Self::Size {
                width,
                height,
                scale,
            } => write!(
                f,
                "a chart of {width} x {height} px at scale {scale} cannot be \
                 drawn: the least size is 320 x 200, the PNG's sides may have \
                 16384 pixels"
            ),
            Self::NoRoom { width, left } => write!(
                f,
                "labels leave {left:.0} of {width:.0} px for the panels; \
                 shorten them or widen the chart"
            ),
            Self::Font => write!(f, "the embedded font cannot be read"),
            Self::Encode(_) => write!(f, "cannot encode the PNG"),
            Self::Io { path, source: _ } => write!(f, "cannot write {}", path.display()),
        }
    }
}

impl Error for ChartError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Encode(source) => Some(source.as_ref()),
            Self::Io { source, .. } => Some(source),
            _ => None,
        }
    }
}
