//! Measured angles read from files: the class `Recording`.

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
use crate::arguments::{Argument, named, refused as refused_argument};
use crate::arrays::{frame, matrix, whole};
use crate::interrupts::on_own_thread;

/// Measured angles of links against time, as they were read from a file.
#[pyclass(frozen, module = "branched_pendulum.data")]
pub(crate) struct Recording {
    /// Times, s; ascending.
    #[pyo3(get)]
    t: Py<PyArray1<f64>>,
    /// Angles (rad, from the downward vertical, without jumps of a turn), one row per time; NaN if
    /// an angle is missing or marked.
    #[pyo3(get)]
    theta: Py<PyArray2<f64>>,
    /// True if an angle was measured but is not used: an outlier, or one whose points were detected
    /// with too small a likelihood.
    #[pyo3(get)]
    marked: Py<PyArray2<bool>>,
    /// Names of the links, taken from their columns or dots.
    #[pyo3(get)]
    names: Vec<String>,
    /// Statements about how the file was interpreted, each beginning with "detected", "assumed",
    /// "given", "marked" or "doubtful"; the doubtful ones come first.
    #[pyo3(get)]
    findings: Vec<String>,
    /// Usual time between two rows, s.
    #[pyo3(get)]
    interval: f64,
    /// Root mean square deviation of the times between rows from the usual one, without gaps, in s.
    #[pyo3(get)]
    jitter: f64,
    /// Gaps: pairs of times (s) between which rows are missing.
    #[pyo3(get)]
    gaps: Vec<(f64, f64)>,
    /// Mean distance between the two dots of each link, and its root mean square deviation, in the
    /// units of the file; `None` if angles were measured directly.
    #[pyo3(get)]
    dot_distances: Option<Vec<(f64, f64)>>,
}

/// Arrays, names and findings from which a recording is created.
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

    /// Returns the angles as a `pandas.DataFrame`, with one row per time (s) and one column per
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

    /// Compares two recordings; they are equal if their times and angles are.
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
    let refused = ReadError::new_err(text + &remedy(&error.kind));
    let place = error.place.as_ref();
    let value = refused.value(py);
    let reported = value
        .setattr("file", error.path.display().to_string())
        .and_then(|()| value.setattr("line", place.map(|place| place.line)))
        .and_then(|()| value.setattr("column", place.and_then(|place| place.column)))
        .and_then(|()| value.setattr("name", place.and_then(|place| place.name.as_deref())));
    match reported {
        Ok(()) => refused,
        Err(error) => error,
    }
}

/// Returns the arguments of `read` that resolve what a table leaves open.
fn remedy(kind: &ReadErrorKind) -> String {
    match kind {
        ReadErrorKind::TimeOrder { previous, time } if previous == time => {
            "; give drop_repeated=\"first\" or \"last\"".to_owned()
        }
        ReadErrorKind::RoundedTimes { rate, .. } => format!("; give frame_rate={rate}"),
        ReadErrorKind::Recordings { .. } => "; recording=1 reads the first".to_owned(),
        ReadErrorKind::FrameNumbers { .. } => "; give frame_rate=".to_owned(),
        ReadErrorKind::WholeTimes { name } => {
            format!("; give frame_rate=, or time=\"{name} [ms]\"")
        }
        ReadErrorKind::AngleUnit {
            counts: Some(counts),
            ..
        } => format!("; give unit=, of an encoder unit=\"counts:{counts}\""),
        ReadErrorKind::AngleUnit { counts: None, .. } => "; give unit=".to_owned(),
        _ => String::new(),
    }
}

/// Returns the choice that belongs to a word; raises an error if it is none of the accepted words.
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

/// Position of a pivot, in m or pixels.
pub(crate) struct Pivot([f64; 2]);

impl Argument<'_, '_> for Pivot {
    fn of(name: &str, object: &Bound<'_, PyAny>) -> PyResult<Self> {
        if let Ok(word) = <&str>::of(name, object) {
            let place = choice(name, Some(word), &[("origin", [0.0; 2])])?;
            return Ok(Self(place.unwrap_or_default()));
        }
        let place = <[f64; 2]>::of(name, object);
        let accepted = "\"origin\" or two numbers (x, y)";
        place
            .map(Self)
            .map_err(|_| refused_argument(name, accepted, object))
    }
}

/// How the direction of the downward vertical in a picture is determined.
pub(crate) struct Plumb(Gravity);

impl Argument<'_, '_> for Plumb {
    fn of(name: &str, object: &Bound<'_, PyAny>) -> PyResult<Self> {
        if let Ok(word) = <&str>::of(name, object) {
            let words = [("axis", Gravity::Axis), ("first link", Gravity::FirstLink)];
            let gravity = choice(name, Some(word), &words)?;
            return Ok(Self(gravity.unwrap_or_default()));
        }
        let direction = <[f64; 2]>::of(name, object);
        let accepted = "\"axis\", \"first link\" or the two numbers of a direction (x, y)";
        direction
            .map(|direction| Self(Gravity::Along(direction)))
            .map_err(|_| refused_argument(name, accepted, object))
    }
}

/// Reads measured angles from a file: columns of angles against time, or positions of dots that a
/// camera tracked, two per link, as Tracker and DeepLabCut write them.
///
/// How the file is written is detected: delimiter (else "," ";" "tab" or "space"), decimal mark
/// (else "." or ","), header, units. `time` is the name of the column of times, `frame_rate`
/// (Hz) is needed where rows are frames; of rows that repeat a time `drop_repeated` ("first" or
/// "last") counts; of a file in which the time starts again `recording` is the one that is read,
/// from 1. Of a spreadsheet (.xlsx, .xls, .xlsb, .ods) `sheet` is the name of the sheet, by default
/// the first one with numbers. Statements about what was detected and what assumed are in `findings`, those
/// that are doubtful first.
///
/// Of columns: `columns` are those of the links, the parent first, as the header has them, with
/// their units or without, by default all that may be angles; `unit` is "rad", "deg", "mrad",
/// "arcmin", "arcsec", "gon", "turn" or "counts:N" of an encoder, N a turn; `zero` is "down" or "up", the direction of angle 0;
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
    pivot = None, drop_repeated = None, recording = None, sheet = None))]
#[allow(clippy::too_many_arguments)]
pub(crate) fn read(
    py: Python<'_>,
    #[pyo3(from_py_with = named::path)] path: PathBuf,
    #[pyo3(from_py_with = named::columns)] columns: Option<Vec<String>>,
    #[pyo3(from_py_with = named::dots)] dots: Option<Vec<Vec<String>>>,
    #[pyo3(from_py_with = named::unit)] unit: Option<&str>,
    #[pyo3(from_py_with = named::zero)] zero: Option<&str>,
    #[pyo3(from_py_with = named::relative_to)] relative_to: Option<Vec<Option<i128>>>,
    #[pyo3(from_py_with = named::mirrored)] mirrored: bool,
    #[pyo3(from_py_with = named::time)] time: Option<String>,
    #[pyo3(from_py_with = named::frame_rate)] frame_rate: Option<f64>,
    #[pyo3(from_py_with = named::outliers)] outliers: Option<f64>,
    #[pyo3(from_py_with = named::likelihood)] likelihood: f64,
    #[pyo3(from_py_with = named::y_down)] y_down: Option<bool>,
    #[pyo3(from_py_with = named::gravity)] gravity: Option<Plumb>,
    #[pyo3(from_py_with = named::delimiter)] delimiter: Option<&str>,
    #[pyo3(from_py_with = named::decimal)] decimal: Option<&str>,
    #[pyo3(from_py_with = named::pivot)] pivot: Option<Pivot>,
    #[pyo3(from_py_with = named::drop_repeated)] drop_repeated: Option<&str>,
    #[pyo3(from_py_with = named::recording)] recording: Option<i128>,
    #[pyo3(from_py_with = named::sheet)] sheet: Option<String>,
) -> PyResult<Recording> {
    let clock = clock(time, frame_rate)?;
    let recording = recording.map(|number| whole("recording", number, 0_usize));
    let recording = recording.transpose()?;
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
        sheet,
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
        unit: unit.map(angle_unit).transpose()?,
        zero: choice("zero", zero, &zeros)?,
        tilt: 0.0,
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
        pivot: pivot.map(|Pivot(place)| place),
        gravity: gravity.map_or(Gravity::Axis, |Plumb(gravity)| gravity),
        y_down,
        mirrored,
        likelihood,
        outliers,
    };
    let angles = on_own_thread(py, move || {
        let mut table = Table::read(&path, &options)?;
        if let Some(number) = recording {
            table = table.recording(&clock, number)?;
        }
        if let Some(counts) = counts {
            table = table.without_repeated_times(&clock, counts)?;
        }
        read_angles(&table, &of_columns, &of_dots)
    })?;
    Recording::of(py, angles.map_err(|error| refused(py, error))?)
}

fn angle_unit(name: &str) -> PyResult<AngleUnit> {
    AngleUnit::named(name).ok_or_else(|| {
        let words = AngleUnit::ALL.map(|(word, _)| format!("{word:?}"));
        PyValueError::new_err(format!(
            "unit is {name:?}, must be {} or \"counts:N\" of an encoder, N a turn",
            words.join(" or ")
        ))
    })
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
