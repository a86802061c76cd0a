//! Lines above the numbers: names, units, tracks.

use super::error::{Place, ReadErrorKind};
use super::format::TextLine;
use super::names::is_time;
use super::track::{Track, tracks};
use super::units::{Unit, bare};
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

/// Names above the numbers.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Header {
    pub(crate) kind: FileKind,
    pub(crate) columns: Vec<Column>,
    /// The names as they stand in the file, units included.
    pub(crate) written: Vec<String>,
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
        let above = above.iter().filter(|line| !is_note_on_format(line));
        let above: &[TextLine] = &above.map(trimmed).collect::<Vec<_>>();
        let wide = |names: Vec<(Column, String)>, preamble: &[TextLine]| {
            Self::new(FileKind::Wide, names, preamble.len())
        };
        let as_written = |name: &String| (column(name), name.clone());
        let header = match above {
            [] => {
                let names = (1..=width).map(|i| format!("column {i}"));
                wide(
                    names.map(|n| (Column::new(n.clone(), ""), n)).collect(),
                    &[],
                )
            }
            _ if above.iter().any(|line| starts(line, "scorer")) => {
                let start = above.iter().position(|line| starts(line, "scorer"));
                let start = start.unwrap_or_default();
                Self::deep_lab_cut(&above[start..], width, start)?
            }
            [rest @ .., tracks, quantities] if is_tracker(tracks, quantities) => {
                let multi = rest.iter().any(|line| starts(line, "#multi:"));
                Self::tracker(tracks, quantities, rest.len() - usize::from(multi))
            }
            [rest @ .., names, units]
                if is_units(units) && names.cells.len() == units.cells.len() =>
            {
                let names = names.cells.iter().zip(&units.cells);
                let names = names.map(|(n, unit)| (Column::new(n, bare(unit)), n.clone()));
                wide(names.collect(), rest)
            }
            [rest @ .., names] => wide(names.cells.iter().map(as_written).collect(), rest),
        };
        match above.last() {
            Some(line) if header.columns.len() != width => Err(wrong_width(line, width)),
            _ => {
                header.check_names(above)?;
                Ok(header)
            }
        }
    }

    /// Columns with their names as they are written. Where two names differ in their units
    /// alone, the units are parts of the names.
    fn new(kind: FileKind, named: Vec<(Column, String)>, preamble: usize) -> Self {
        let (mut columns, written): (Vec<Column>, Vec<String>) = named.into_iter().unzip();
        let names: Vec<String> = columns.iter().map(|column| column.name.clone()).collect();
        for (index, column) in columns.iter_mut().enumerate() {
            let mut others = names.iter().zip(&written).enumerate();
            let is_shared = others.any(|(other, (name, text))| {
                other != index && *name == names[index] && *text != written[index]
            });
            if is_shared {
                column.name.clone_from(&written[index]);
            } else if column.name.is_empty() && names[..index].iter().any(String::is_empty) {
                column.name = format!("column {}", index + 1);
            }
        }
        Self {
            kind,
            tracks: tracks(&columns),
            columns,
            written,
            preamble,
        }
    }

    /// A name stands above the first of its track's columns; the time has none.
    fn tracker(tracks: &TextLine, quantities: &TextLine, preamble: usize) -> Self {
        let mut names = tracks.cells.iter().filter(|cell| !cell.is_empty());
        let single = names.next().filter(|_| names.next().is_none());
        // A single name may stand above the time.
        let mut track = single.map_or("", String::as_str);
        let named = quantities
            .cells
            .iter()
            .enumerate()
            .map(|(index, quantity)| {
                let above = tracks.cells.get(index).map_or("", String::as_str);
                if !above.is_empty() {
                    track = above;
                }
                let own = column(quantity);
                if is_time(&own.name) || track.is_empty() {
                    return (own, quantity.clone());
                }
                let track = track.trim_start_matches('#');
                let name = format!("{} {}", track.replace('_', " "), own.name);
                (Column::new(name, own.unit), format!("{track} {quantity}"))
            });
        Self::new(FileKind::Tracker, named.collect(), preamble)
    }

    /// Rows `scorer`, `individuals` (where there are several), `bodyparts`, `coords`. Columns
    /// without a coordinate name folders, but for the last of them, which is the frame's.
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
        let leading = coordinates.cells.iter().skip(1);
        let leading = leading.take_while(|cell| cell.is_empty()).count();
        let named = (0..width).map(|index| {
            let (name, unit) = match index {
                _ if index < leading => (format!("folder {}", index + 1), ""),
                _ if index == leading => ("frame".to_owned(), ""),
                _ => {
                    let animal = individuals.map_or("", |line| &line.cells[index]);
                    let coordinate = coordinates.cells[index].as_str();
                    let unit = if coordinate == "likelihood" { "" } else { "px" };
                    let name = format!("{animal} {} {coordinate}", parts.cells[index]);
                    (name.trim_start().to_owned(), unit)
                }
            };
            (Column::new(name.clone(), unit), name)
        });
        Ok(Self::new(FileKind::DeepLabCut, named.collect(), preamble))
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
    let skip = usize::from(cells.first().is_some_and(|cell| cell == "#" || cell == "%"));
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

/// Tracks stand over quantities, of which the first is the time. A single name at the start
/// of its line is a title, unless the coordinates of a point are below.
fn is_tracker(tracks: &TextLine, quantities: &TextLine) -> bool {
    let Some((first, rest)) = quantities.cells.split_first() else {
        return false;
    };
    let names = tracks.cells.iter().filter(|cell| !cell.is_empty()).count();
    let has = |axis: &str| rest.iter().any(|cell| column(cell).name == axis);
    is_time(&column(first).name)
        && rest.iter().any(|cell| !cell.is_empty())
        && names >= 1
        && (tracks.cells[0].is_empty() || names == 1 && has("x") && has("y"))
}

/// Lines above the names that only say how the file is written: `sep=;`.
fn is_note_on_format(line: &TextLine) -> bool {
    let first = line.cells.first().map_or("", String::as_str);
    first.to_ascii_lowercase().starts_with("sep=")
}

fn is_unit(text: &str) -> bool {
    Unit::named(text).is_some()
}

fn is_units(line: &TextLine) -> bool {
    let mut cells = line.cells.iter().filter(|cell| !cell.is_empty()).peekable();
    cells.peek().is_some() && cells.all(|cell| is_unit(cell))
}

/// A name with its unit: `theta [rad]`, `theta (rad)`, `theta/rad`, `theta_rad`, `theta, rad`.
/// Braces behind `_` are those of a subscript: `v_{x}` is `v_x`.
fn column(text: &str) -> Column {
    let text = text.trim().trim_start_matches(['#', '%']).trim();
    if let Some((name, rest)) = text.split_once("_{")
        && let Some((subscript, rest)) = rest.split_once('}')
    {
        return column(&format!("{name}_{subscript}{rest}"));
    }
    for (open, close) in [('[', ']'), ('(', ')'), ('{', '}')] {
        if let Some((name, rest)) = text.rsplit_once(open)
            && let Some(unit) = rest.trim_end().strip_suffix(close)
            && !name.trim().is_empty()
            // Longer words in parentheses belong to the name: `theta (left)`.
            && (open == '[' || is_unit(unit) || unit.chars().count() < 3)
        {
            return Column::new(name.trim(), bare(unit));
        }
    }
    // The unit behind a slash may hold one itself: `omega/rad/s`.
    let slashes = text.match_indices('/').map(|(at, _)| (at, '/'));
    let others = [',', '_', ' '];
    let others = others
        .iter()
        .filter_map(|&mark| Some((text.rfind(mark)?, mark)));
    for (at, mark) in slashes.chain(others) {
        let (name, unit) = (text[..at].trim(), bare(&text[at + 1..]));
        let is_clear = mark == '/' || is_no_word(&unit) || is_time(name);
        if is_unit(&unit) && is_clear && !name.is_empty() {
            return Column::new(name, unit);
        }
    }
    Column::new(text, "")
}

/// Returns true for units that nobody takes for a part of a name: `x_m` is a name, `x_mm`
/// one in millimetres; `theta_min` is the least one.
fn is_no_word(unit: &str) -> bool {
    let words = ["min", "turn", "turns", "rev", "revs"];
    (unit.chars().count() > 1 || unit == "°") && !words.contains(&unit)
}
