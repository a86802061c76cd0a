//! Measured angles out of files: the class `Recording`.

use std::io;
use std::path::PathBuf;

use branched_pendulum_data::{
    AngleColumns, AngleUnit, AngleZero, Clock, DecimalMark, Delimiter, Gravity, LinkMarkers,
    Markers, ReadErrorKind, Recording as Angles, Repeated, Sample, Table, TableOptions,
    read_angles,
};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::ReadError;
use crate::arrays::{frame, matrix, whole};
use crate::interrupts::on_own_thread;

/// Measured angles of links against time, as they were read from a file.
#[pyclass(frozen, module = "branched_pendulum.data")]
pub(crate) struct Recording {
    /// Times, s; ascending.
    #[pyo3(get)]
    t: Py<PyArray1<f64>>,
    /// Angles (rad, from the downward vertical, without jumps of a turn), a row for each
    /// time; NaN where there is none, and where one is marked.
    #[pyo3(get)]
    theta: Py<PyArray2<f64>>,
    /// True where an angle was measured and is not used: an outlier, or one whose points were
    /// found with too small a likelihood.
    #[pyo3(get)]
    marked: Py<PyArray2<bool>>,
    /// Names of the links: those of their columns or dots.
    #[pyo3(get)]
    names: Vec<String>,
    /// Statements about how the file was read, each beginning with "detected", "assumed",
    /// "given", "marked" or "doubtful"; the doubtful ones come first.
    #[pyo3(get)]
    findings: Vec<String>,
    /// Usual time from one row to the next, s.
    #[pyo3(get)]
    interval: f64,
    /// Root mean square deviation from that, but for gaps, s.
    #[pyo3(get)]
    jitter: f64,
    /// Times (s) between which rows are missing.
    #[pyo3(get)]
    gaps: Vec<(f64, f64)>,
    /// Mean distance of the two dots of each link and its root mean square deviation, in the
    /// units of the file; None for angles that were measured as such.
    #[pyo3(get)]
    dot_distances: Option<Vec<(f64, f64)>>,
}

/// Arrays, names and findings of a recording.
type Arrays = (
    Py<PyArray1<f64>>,
    Py<PyArray2<f64>>,
    Py<PyArray2<bool>>,
    Vec<String>,
    Vec<String>,
);

#[pymethods]
impl Recording {
    fn __len__(&self, py: Python<'_>) -> usize {
        self.t.bind(py).len()
    }

    /// Returns the angles as a `pandas.DataFrame`, a row for each time (s), a column for each
    /// link.
    fn frame<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        frame(py, &self.t, &self.theta, self.names.clone())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let make = py.get_type::<Self>().getattr("_of")?;
        let (names, findings) = (self.names.clone(), self.findings.clone());
        let arrays = (&self.t, &self.theta, &self.marked, names, findings);
        let numbers = (self.interval, self.jitter, self.gaps.clone());
        let state = (arrays, numbers, self.dot_distances.clone());
        Ok((make, state).into_pyobject(py)?.into_any())
    }

    #[staticmethod]
    fn _of(
        arrays: Arrays,
        numbers: (f64, f64, Vec<(f64, f64)>),
        dot_distances: Option<Vec<(f64, f64)>>,
    ) -> Self {
        let (t, theta, marked, names, findings) = arrays;
        let (interval, jitter, gaps) = numbers;
        Self {
            t,
            theta,
            marked,
            names,
            findings,
            interval,
            jitter,
            gaps,
            dot_distances,
        }
    }

    /// Recordings of the same times and angles are equal.
    fn __eq__(&self, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        let py = other.py();
        let Ok(other) = other.cast::<Self>() else {
            return Ok(false);
        };
        let other = other.get();
        let missing = PyDict::new(py);
        missing.set_item("equal_nan", true)?;
        let same = py.import("numpy")?.getattr("array_equal")?;
        let [times, angles] = [
            same.call1((&self.t, &other.t))?.is_truthy()?,
            same.call((&self.theta, &other.theta), Some(&missing))?
                .is_truthy()?,
        ];
        Ok(times && angles && self.names == other.names)
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        let (names, times) = (self.names.join(", "), self.__len__(py));
        format!("Recording of {names} at {times} times")
    }
}

impl Recording {
    fn of(py: Python<'_>, angles: Angles) -> PyResult<Self> {
        let links = angles.links.len();
        let times = 0..angles.times.len();
        let samples: Vec<Sample> = times
            .flat_map(|time| angles.links.iter().map(move |link| link.samples[time]))
            .collect();
        let angle = |sample: &Sample| match sample {
            Sample::Measured(angle) => *angle,
            _ => f64::NAN,
        };
        let is_marked =
            |sample: &Sample| matches!(sample, Sample::Outlier(_) | Sample::Unlikely(_));
        let marked: Vec<bool> = samples.iter().map(is_marked).collect();
        let distances = angles.links.iter().map(|link| {
            let [mean, deviation] = link.marker_distance?;
            Some((mean, deviation))
        });
        Ok(Self {
            theta: matrix(py, samples.iter().map(angle).collect(), links)?.unbind(),
            marked: marked
                .into_pyarray(py)
                .reshape([angles.times.len(), links])?
                .unbind(),
            dot_distances: distances.collect(),
            names: angles.links.iter().map(|link| link.name.clone()).collect(),
            findings: angles.findings.iter().map(ToString::to_string).collect(),
            interval: angles.timing.interval,
            jitter: angles.timing.jitter,
            gaps: angles
                .timing
                .gaps
                .iter()
                .map(|gap| (gap.start, gap.end))
                .collect(),
            t: angles.times.into_pyarray(py).unbind(),
        })
    }
}

fn refused(py: Python<'_>, error: branched_pendulum_data::ReadError) -> PyErr {
    let text = error.to_string();
    if let ReadErrorKind::Io(source) = &*error.kind {
        return io::Error::new(source.kind(), format!("{text}: {source}")).into();
    }
    let refused = ReadError::new_err(text);
    let place = error.place.as_ref();
    let value = refused.value(py);
    let told = value
        .setattr("file", error.path.display().to_string())
        .and_then(|()| value.setattr("line", place.map(|place| place.line)))
        .and_then(|()| value.setattr("column", place.and_then(|place| place.column)))
        .and_then(|()| value.setattr("name", place.and_then(|place| place.name.as_deref())));
    match told {
        Ok(()) => refused,
        Err(error) => error,
    }
}

/// One of some words, by its place among them.
fn choice<T: Copy>(name: &str, word: Option<&str>, choices: &[(&str, T)]) -> PyResult<Option<T>> {
    let Some(word) = word else { return Ok(None) };
    let found = choices.iter().find(|(own, _)| *own == word);
    let found = found.map(|(_, value)| *value);
    let words = || choices.iter().map(|(own, _)| format!("{own:?}"));
    found.map(Some).ok_or_else(|| {
        let words: Vec<String> = words().collect();
        PyValueError::new_err(format!(
            "{name} is {word:?}, must be {}",
            words.join(" or ")
        ))
    })
}

/// A place: two numbers, or "origin".
#[derive(FromPyObject)]
pub(crate) enum Pivot {
    Place([f64; 2]),
    Word(String),
}

impl Pivot {
    fn place(self) -> PyResult<Option<[f64; 2]>> {
        match self {
            Self::Place(place) => Ok(Some(place)),
            Self::Word(word) => choice("pivot", Some(&word), &[("origin", [0.0; 2])]),
        }
    }
}

/// Where a picture's downward vertical comes from.
#[derive(FromPyObject)]
pub(crate) enum Plumb {
    Direction([f64; 2]),
    Word(String),
}

impl Plumb {
    fn gravity(self) -> PyResult<Gravity> {
        let word = match self {
            Self::Direction(direction) => return Ok(Gravity::Along(direction)),
            Self::Word(word) => word,
        };
        let words = [("axis", Gravity::Axis), ("first link", Gravity::FirstLink)];
        Ok(choice("gravity", Some(&word), &words)?.unwrap_or_default())
    }
}

/// Reads measured angles from a file: columns of angles against time, or dots that a camera
/// followed, two a link, as Tracker and DeepLabCut write them.
///
/// How the file is written is detected: delimiter (else "," ";" "tab" or "space"), decimal mark
/// (else "." or ","), header, units. `time` is the name of the column of times, `frame_rate`
/// (Hz) is needed where rows are frames; of rows that repeat a time `drop_repeated` ("first" or
/// "last") counts. Statements about what was detected and what assumed are in `findings`, those
/// that are doubtful first.
///
/// Of columns: `columns` are those of the links, the parent first, as the header has them, with
/// their units or without, by default all that may be angles; `unit` is "rad", "deg", "mrad",
/// "arcmin", "arcsec", "gon" or "turn", `zero` is "down" or "up", the direction of angle 0;
/// `relative_to` has for each link the index of the one that its angle is measured from, None
/// for the vertical. Of dots: `dots` has a pair of names for each link, the one nearer to its
/// pivot first, which may be a place that does not move, "origin" or "x,y"; `pivot` is the place,
/// (x, y) or "origin", of a pivot without a dot, from which the dots of the file are the ends of
/// a chain of links; `y_down=True` where y grows downwards; `gravity` is "axis" (the camera is
/// level), "first link" (its mean direction), or a direction x, y; `likelihood` is the
/// smallest that is used. `mirrored=True` turns angles round. `outliers` is the deviation from
/// neighbours, in usual ones, beyond which samples are marked, by default 25; None marks none.
///
/// A file that is not understood raises `ReadError` with `file`, `line`, `column` and `name`
/// of the place.
#[pyfunction]
#[pyo3(signature = (path, *, columns = None, dots = None, unit = None, zero = None,
    relative_to = None, mirrored = false, time = None, frame_rate = None, outliers = Some(25.0),
    likelihood = 0.9, y_down = None, gravity = None, delimiter = None, decimal = None,
    pivot = None, drop_repeated = None))]
#[allow(clippy::too_many_arguments)]
pub(crate) fn read(
    py: Python<'_>,
    path: PathBuf,
    columns: Option<Vec<String>>,
    dots: Option<Vec<Vec<String>>>,
    unit: Option<&str>,
    zero: Option<&str>,
    relative_to: Option<Vec<Option<i128>>>,
    mirrored: bool,
    time: Option<String>,
    frame_rate: Option<f64>,
    outliers: Option<f64>,
    likelihood: f64,
    y_down: Option<bool>,
    gravity: Option<Plumb>,
    delimiter: Option<&str>,
    decimal: Option<&str>,
    pivot: Option<Pivot>,
    drop_repeated: Option<&str>,
) -> PyResult<Recording> {
    let clock = clock(time, frame_rate)?;
    let delimiters = [
        (",", Delimiter::Comma),
        (";", Delimiter::Semicolon),
        ("tab", Delimiter::Tab),
        ("space", Delimiter::Spaces),
    ];
    let marks = [(".", DecimalMark::Point), (",", DecimalMark::Comma)];
    let options = TableOptions {
        delimiter: choice("delimiter", delimiter, &delimiters)?,
        decimal: choice("decimal", decimal, &marks)?,
    };
    let counts = [("first", Repeated::First), ("last", Repeated::Last)];
    let counts = choice("drop_repeated", drop_repeated, &counts)?;
    let zeros = [("down", AngleZero::Down), ("up", AngleZero::Up)];
    let relative_to = relative_to.into_iter().flatten();
    let relative_to =
        relative_to.map(|link| link.map(|link| whole("relative_to", link, 0)).transpose());
    let of_columns = AngleColumns {
        clock: clock.clone(),
        columns: columns.unwrap_or_default(),
        unit: choice("unit", unit, &AngleUnit::ALL)?,
        zero: choice("zero", zero, &zeros)?,
        relative_to: relative_to.collect::<PyResult<_>>()?,
        mirrored,
        outliers,
    };
    if dots.is_some() && !of_columns.columns.is_empty() {
        let text = "angles come from dots or from columns: give dots= or columns=";
        return Err(PyValueError::new_err(text));
    }
    let of_dots = Markers {
        clock: clock.clone(),
        links: link_markers(dots.unwrap_or_default())?,
        pivot: pivot.map(Pivot::place).transpose()?.flatten(),
        gravity: gravity.map_or(Ok(Gravity::Axis), Plumb::gravity)?,
        y_down,
        mirrored,
        likelihood,
        outliers,
    };
    let angles = on_own_thread(py, move || {
        let mut table = Table::read(&path, &options)?;
        if let Some(counts) = counts {
            table = table.without_repeated_times(&clock, counts)?;
        }
        read_angles(&table, &of_columns, &of_dots)
    })?;
    Recording::of(py, angles.map_err(|error| refused(py, error))?)
}

fn clock(time: Option<String>, frame_rate: Option<f64>) -> PyResult<Clock> {
    match (time, frame_rate) {
        (Some(_), Some(_)) => {
            let text = "times come from a column or from a frame rate: give time= or frame_rate=";
            Err(PyValueError::new_err(text))
        }
        (Some(column), None) => Ok(Clock::Column(column)),
        (None, Some(rate)) => Ok(Clock::FrameRate(rate)),
        (None, None) => Ok(Clock::Detect),
    }
}

fn link_markers(dots: Vec<Vec<String>>) -> PyResult<Vec<LinkMarkers>> {
    let of_link = |pair: Vec<String>| match <[String; 2]>::try_from(pair) {
        Ok([upper, lower]) => Ok(LinkMarkers { upper, lower }),
        Err(pair) => Err(PyValueError::new_err(format!(
            "dots must have a pair of names for each link, got {}",
            pair.len()
        ))),
    };
    dots.into_iter().map(of_link).collect()
}
