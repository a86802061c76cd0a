//! Reading of the header: the lines above the numbers, with names, units and tracks.

use std::collections::{BTreeMap, BTreeSet};

use super::error::ReadErrorKind;
use super::format::{Delimiter, TextLine, used};
use super::names::is_time;
use super::place::Place;
use super::track::{Track, tracks};
use super::units::{Unit, bare};
use super::write::Column;

/// Kind of a table, recognised by its header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// Plain table, with one row of column names or without names.
    Wide,
    /// Text export of Tracker: a row of tracks above a row of quantities.
    Tracker,
    /// Table of DeepLabCut: rows of the scorer, of the individuals (if there are several), of body
    /// parts and of coordinates.
    DeepLabCut,
}

/// Names above the numbers.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Header {
    pub(crate) kind: FileKind,
    pub(crate) columns: Vec<Column>,
    /// Names of the columns as in the file, including units.
    pub(crate) written: Vec<String>,
    pub(crate) tracks: Vec<Track>,
    /// Number of lines above the names.
    pub(crate) preamble: usize,
    /// Separator of the names, if it differs from that of the rows.
    pub(crate) delimiter: Option<Delimiter>,
}

/// Reason why a header is rejected, and the position.
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
    /// Reads the header: the lines above the first row of numbers, which has `width` cells
    /// separated by `delimiter`.
    pub(crate) fn read(
        above: &[TextLine],
        width: usize,
        delimiter: Delimiter,
    ) -> Result<Self, Refused> {
        let above = above.iter().filter(|line| !is_note_on_format(line));
        let mut above: Vec<TextLine> = above.map(trimmed).collect();
        let is_apart = |names: &&mut TextLine| {
            let mut but_last = names.cells.iter().take(width.saturating_sub(1));
            names.cells.len() != width
                || delimiter == Delimiter::Spaces && but_last.all(|name| name.ends_with([',', ';']))
        };
        let names = above.last_mut().filter(is_apart);
        let own = names.and_then(|names| separate(names, width, delimiter));
        let mut header = Self::of_lines(&above, width)?;
        header.delimiter = own;
        Ok(header)
    }

    fn of_lines(above: &[TextLine], width: usize) -> Result<Self, Refused> {
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

    /// Creates the header from columns with their names as in the file. If two names differ only in
    /// their units, the units are kept as parts of the names.
    fn new(kind: FileKind, named: Vec<(Column, String)>, preamble: usize) -> Self {
        let (mut columns, written): (Vec<Column>, Vec<String>) = named.into_iter().unzip();
        // The texts under which each name is written.
        let mut texts: BTreeMap<String, BTreeSet<&str>> = BTreeMap::new();
        for (column, text) in columns.iter().zip(&written) {
            texts.entry(column.name.clone()).or_default().insert(text);
        }
        let mut has_nameless = false;
        for (index, column) in columns.iter_mut().enumerate() {
            let is_nameless = column.name.is_empty();
            if texts.get(&column.name).is_some_and(|texts| texts.len() > 1) {
                column.name.clone_from(&written[index]);
            } else if is_nameless && has_nameless {
                column.name = format!("column {}", index + 1);
            }
            has_nameless |= is_nameless;
        }
        Self {
            kind,
            tracks: tracks(&columns),
            columns,
            written,
            preamble,
            delimiter: None,
        }
    }

    /// Reads the header of Tracker. A name is above the first column of its track; the time has no
    /// name.
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

    /// Reads the header of DeepLabCut, with rows `scorer`, `individuals` (if there are several),
    /// `bodyparts`, `coords`. Columns without a coordinate name folders, except the last of them,
    /// which is the frame.
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
        let mut names = BTreeSet::new();
        for (index, column) in self.columns.iter().enumerate() {
            let name = &column.name;
            let place = || {
                let line = above.last().map_or(1, |line| line.number);
                Some(Place::cell(line, index, None))
            };
            if !names.insert(name) {
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

/// Splits a line of names at a separator other than that of the rows, if this gives one name per
/// column. Returns that separator.
fn separate(names: &mut TextLine, width: usize, delimiter: Delimiter) -> Option<Delimiter> {
    let text = names.cells.join(delimiter.text());
    let is_name = |name: &str| !name.starts_with(|c: char| c.is_ascii_digit());
    for other in Delimiter::ALL.into_iter().filter(|own| *own != delimiter) {
        let cells = other.split(&text);
        if cells.len() == width && cells.iter().all(|name| !name.is_empty() && is_name(name)) {
            names.cells = cells.into_iter().map(str::to_owned).collect();
            return Some(other);
        }
    }
    None
}

/// Returns a line without empty cells at its end, and without a lone comment mark at its start.
fn trimmed(line: &TextLine) -> TextLine {
    let cells = &line.cells[..used(&line.cells)];
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

/// Returns true if the lines are a header of Tracker: tracks above quantities, of which the first
/// is the time. A single name at the start of its line is a title, unless the coordinates of a
/// point are below it.
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

/// Returns true for a line above the names that only describes the format: `sep=;`.
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

/// Separates a name from its unit: `theta [rad]`, `theta (rad)`, `theta/rad`, `theta_rad`, `theta,
/// rad`. Braces after `_` are those of a subscript: `v_{x}` is `v_x`.
pub(crate) fn column(text: &str) -> Column {
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

/// Returns true for units that cannot be mistaken for a part of a name: `x_m` is a name, `x_mm` is
/// one in millimetres; `theta_min` is a minimum.
fn is_no_word(unit: &str) -> bool {
    let words = ["min", "turn", "turns", "rev", "revs"];
    (unit.chars().count() > 1 || unit == "°") && !words.contains(&unit)
}
