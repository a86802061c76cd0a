//! Lines above the numbers: names, units, tracks.

use super::error::{Place, ReadErrorKind};
use super::format::TextLine;
use super::write::Column;

/// Programs whose tables are known by their headers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// Columns under one row of names, or under none.
    Wide,
    /// A text export of Tracker: a row of tracks above a row of quantities.
    Tracker,
    /// DeepLabCut's table: rows of the scorer, of the individuals where there are several, of
    /// body parts and of coordinates.
    DeepLabCut,
}

/// A point that a camera followed: indices of its columns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Track {
    /// Name.
    pub name: String,
    /// Column of the coordinate to the right.
    pub x: usize,
    /// Column of the other coordinate.
    pub y: usize,
    /// Column of the likelihood, where there is one.
    pub likelihood: Option<usize>,
}

/// Names above the numbers.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Header {
    pub(crate) kind: FileKind,
    pub(crate) columns: Vec<Column>,
    pub(crate) tracks: Vec<Track>,
    /// Number of lines above the names.
    pub(crate) preamble: usize,
}

/// Why a header is refused, and where.
#[derive(Debug)]
pub(crate) struct Refused {
    pub(crate) kind: Box<ReadErrorKind>,
    pub(crate) place: Option<Place>,
}

impl Refused {
    fn new(kind: ReadErrorKind, place: Option<Place>) -> Self {
        Self {
            kind: Box::new(kind),
            place,
        }
    }
}

impl Header {
    /// Reads the lines above the first row of `width` cells with numbers.
    pub(crate) fn read(above: &[TextLine], width: usize) -> Result<Self, Refused> {
        let above: &[TextLine] = &above.iter().map(trimmed).collect::<Vec<_>>();
        if let Some(start) = above.iter().position(|line| starts(line, "scorer")) {
            return Self::deep_lab_cut(&above[start..], width, start);
        }
        let header = match above {
            [] => Self::wide(
                (1..=width).map(|i| Column::new(format!("column {i}"), "")),
                0,
            ),
            [.., tracks, quantities] if is_tracker(tracks, quantities) => {
                let preamble = above.len() - 2;
                let multi = above.iter().any(|line| starts(line, "#multi:"));
                Self::tracker(
                    tracks,
                    quantities,
                    preamble - usize::from(multi && preamble > 0),
                )
            }
            [rest @ .., names, units]
                if is_units(units) && names.cells.len() == units.cells.len() =>
            {
                let columns = names.cells.iter().zip(&units.cells);
                let columns = columns.map(|(name, unit)| Column::new(name, bare(unit)));
                Self::wide(columns, rest.len())
            }
            [rest @ .., names] => {
                Self::wide(names.cells.iter().map(|name| column(name)), rest.len())
            }
        };
        match above.last() {
            Some(line) if header.columns.len() != width => Err(wrong_width(line, width)),
            _ => {
                header.check_names(above)?;
                Ok(header)
            }
        }
    }

    fn wide(columns: impl IntoIterator<Item = Column>, preamble: usize) -> Self {
        let columns: Vec<Column> = columns.into_iter().collect();
        Self {
            kind: FileKind::Wide,
            tracks: tracks_by_suffix(&columns),
            columns,
            preamble,
        }
    }

    /// A name stands above the first of its track's columns; the time has none.
    fn tracker(tracks: &TextLine, quantities: &TextLine, preamble: usize) -> Self {
        let single = tracks.cells.iter().filter(|cell| !cell.is_empty()).count() == 1;
        let mut track = String::new();
        let mut columns: Vec<Column> = Vec::new();
        for (index, quantity) in quantities.cells.iter().enumerate() {
            let above = tracks.cells.get(index).map_or("", String::as_str);
            if !above.is_empty() {
                track = above.trim_start_matches('#').replace('_', " ");
            } else if single && index == 1 && track.is_empty() {
                track = tracks
                    .cells
                    .iter()
                    .find(|cell| !cell.is_empty())
                    .cloned()
                    .unwrap_or_default();
            }
            let Column { name, unit } = column(quantity);
            columns.push(match is_time(&name) || track.is_empty() {
                true => Column { name, unit },
                false => Column {
                    name: format!("{track} {name}"),
                    unit,
                },
            });
        }
        Self {
            kind: FileKind::Tracker,
            tracks: tracks_by_suffix(&columns),
            columns,
            preamble,
        }
    }

    /// Rows `scorer`, `individuals` (where there are several), `bodyparts`, `coords`.
    fn deep_lab_cut(above: &[TextLine], width: usize, preamble: usize) -> Result<Self, Refused> {
        let row = |word: &str| above.iter().find(|line| starts(line, word));
        let needed = |word: &str| {
            row(word).ok_or_else(|| {
                let what = format!("DeepLabCut's header has no row `{word}`");
                let place = above.first().map(|line| Place::line(line.number));
                Refused::new(ReadErrorKind::Header { what }, place)
            })
        };
        let (parts, coordinates) = (needed("bodyparts")?, needed("coords")?);
        let individuals = row("individuals");
        for line in [Some(parts), Some(coordinates), individuals]
            .into_iter()
            .flatten()
        {
            if line.cells.len() != width {
                return Err(wrong_width(line, width));
            }
        }
        let mut columns = vec![Column::new("frame", "")];
        for index in 1..width {
            let mut name = String::new();
            if let Some(individuals) = individuals {
                name = format!("{} ", individuals.cells[index]);
            }
            let unit = match coordinates.cells[index].as_str() {
                "likelihood" => "",
                _ => "px",
            };
            name += &format!("{} {}", parts.cells[index], coordinates.cells[index]);
            columns.push(Column::new(name, unit));
        }
        let header = Self {
            kind: FileKind::DeepLabCut,
            tracks: tracks_by_suffix(&columns),
            columns,
            preamble,
        };
        header.check_names(above)?;
        Ok(header)
    }

    fn check_names(&self, above: &[TextLine]) -> Result<(), Refused> {
        for (index, column) in self.columns.iter().enumerate() {
            let name = &column.name;
            let place = || {
                let line = above.last().map_or(1, |line| line.number);
                Some(Place::cell(line, index, None))
            };
            if self.columns[..index]
                .iter()
                .any(|other| other.name == *name)
            {
                let name = name.clone();
                return Err(Refused::new(
                    ReadErrorKind::DuplicateColumn { name },
                    place(),
                ));
            }
        }
        Ok(())
    }
}

/// A line without empty cells at its end, nor the mark of a comment alone at its start.
fn trimmed(line: &TextLine) -> TextLine {
    let used = line.cells.iter().rposition(|cell| !cell.is_empty());
    let cells = &line.cells[..used.map_or(0, |last| last + 1)];
    let skip = usize::from(cells.first().is_some_and(|cell| cell == "#"));
    TextLine {
        number: line.number,
        cells: cells[skip..].to_vec(),
    }
}

fn wrong_width(line: &TextLine, width: usize) -> Refused {
    let kind = ReadErrorKind::Header {
        what: format!("{} names above rows of {width} cells", line.cells.len()),
    };
    Refused::new(kind, Some(Place::line(line.number)))
}

fn starts(line: &TextLine, word: &str) -> bool {
    line.cells
        .first()
        .is_some_and(|cell| cell.eq_ignore_ascii_case(word))
}

/// Tracks stand over quantities, of which the first is the time and another an x.
fn is_tracker(tracks: &TextLine, quantities: &TextLine) -> bool {
    let Some((first, rest)) = quantities.cells.split_first() else {
        return false;
    };
    let names = tracks.cells.iter().filter(|cell| !cell.is_empty()).count();
    is_time(&column(first).name)
        && rest.iter().any(|cell| !cell.is_empty())
        && names >= 1
        && (names == 1 || tracks.cells[0].is_empty())
}

/// Returns true for names of the time.
pub(crate) fn is_time(name: &str) -> bool {
    let name = name.trim().to_ascii_lowercase();
    matches!(
        name.as_str(),
        "t" | "time" | "zeit" | "temps" | "tiempo" | "timestamp" | "seconds"
    )
}

/// Returns true for names of the number of a frame.
pub(crate) fn is_frame(name: &str) -> bool {
    let name = name.trim().to_ascii_lowercase();
    matches!(
        name.as_str(),
        "frame"
            | "frames"
            | "step"
            | "index"
            | "sample"
            | "n"
            | "i"
            | "frame number"
            | "frame_number"
            | ""
    )
}

const UNITS: [&str; 22] = [
    "s", "ms", "µs", "us", "min", "sec", "seconds", "rad", "radians", "mrad", "deg", "degrees",
    "degree", "°", "rad/s", "deg/s", "m", "mm", "cm", "px", "pixel", "pixels",
];

fn is_unit(text: &str) -> bool {
    UNITS.contains(&bare(text).as_str())
}

fn is_units(line: &TextLine) -> bool {
    let mut cells = line.cells.iter().filter(|cell| !cell.is_empty()).peekable();
    cells.peek().is_some() && cells.all(|cell| is_unit(cell))
}

/// A unit without its brackets.
fn bare(unit: &str) -> String {
    let unit = unit.trim().trim_matches(['[', ']', '(', ')']);
    // The sign of micro and the Greek letter look alike.
    unit.replace('μ', "µ")
}

/// A name with its unit: `theta [rad]`, `theta (rad)`, `theta/rad`, `theta_rad`, `theta, rad`.
fn column(text: &str) -> Column {
    let text = text.trim().trim_start_matches('#').trim();
    for (open, close) in [('[', ']'), ('(', ')'), ('{', '}')] {
        if let Some((name, rest)) = text.split_once(open)
            && let Some(unit) = rest.trim_end().strip_suffix(close)
            && !name.trim().is_empty()
        {
            return Column::new(name.trim(), bare(unit));
        }
    }
    for mark in ['/', ',', '_', ' '] {
        if let Some((name, unit)) = text.rsplit_once(mark)
            && is_unit(unit)
            // `x_m` is a name; `x_mm` is one in millimetres.
            && (mark == '/' || bare(unit).chars().count() > 1)
            && !name.trim().is_empty()
        {
            return Column::new(name.trim(), bare(unit));
        }
    }
    Column::new(text, "")
}

/// Tracks whose columns are `NAME x` and `NAME y`, with `_` or `.` between as well.
fn tracks_by_suffix(columns: &[Column]) -> Vec<Track> {
    let find = |name: &str, suffix: &str| {
        columns.iter().position(|column| {
            split_suffix(&column.name)
                .is_some_and(|(track, quantity)| track == name && quantity == suffix)
        })
    };
    let tracks = columns.iter().enumerate().filter_map(|(x, column)| {
        let (name, quantity) = split_suffix(&column.name)?;
        if quantity != "x" {
            return None;
        }
        Some(Track {
            name: name.to_owned(),
            x,
            y: find(name, "y")?,
            likelihood: find(name, "likelihood"),
        })
    });
    tracks.collect()
}

fn split_suffix(name: &str) -> Option<(&str, &str)> {
    let at = name.rfind([' ', '_', '.'])?;
    Some((name[..at].trim_end(), &name[at + 1..]))
}
