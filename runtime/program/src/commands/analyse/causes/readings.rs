//! Changes in the interpretation of a table: its unit, its directions, the order of its columns or
//! dots.

use branched_pendulum_data::{AngleUnit, FileKind, Table};

use super::change::{Change, Kind};
use super::marks;
use super::{Node, Unclosed, stretches_in_words};
use crate::measured_file::{MeasuredFile, Zero};

/// A right angle, degrees.
const RIGHT: f64 = 90.0;

impl Unclosed<'_> {
    /// Returns the changes that are possible in an interpretation.
    pub(super) fn readings(&self, node: &Node) -> Vec<Change> {
        let file = &node.file;
        let mut changes = match file.is_of_dots(self.table) {
            true => self.of_dots(file),
            false => self.of_columns(file, &node.source.links),
        };
        changes.extend(sides(file));
        changes.extend(self.release(file));
        changes.extend(lost(self.table, file));
        changes
    }

    fn of_columns(&self, file: &MeasuredFile, names: &[String]) -> Vec<Change> {
        let mut changes = units(self.table, file, names);
        for (zero, words, option) in [
            (
                Zero::Up,
                "angles count from the upward vertical",
                "--zero up",
            ),
            (
                Zero::Down,
                "angles count from the downward vertical",
                "--zero down",
            ),
        ] {
            changes.push(change(file, Kind::Vertical, words, option, |file| {
                file.zero = Some(zero);
            }));
        }
        // A list cannot name what has a comma in it.
        let is_listed = names.iter().all(|name| !name.contains(','));
        for first in (1..names.len()).filter(|_| is_listed) {
            let mut columns = names.to_vec();
            let name = columns.remove(first);
            columns.insert(0, name);
            let words = format!(
                "`{}` is the first link, on which the rest hangs",
                columns[0]
            );
            let option = format!("--columns {}", shell(&columns.join(",")));
            changes.push(change(file, Kind::Links, words, option, |file| {
                file.columns = columns;
            }));
        }
        let (words, option) = match file.relative {
            false => (
                "later angles are counted from the links above",
                "--relative",
            ),
            true => ("all angles are counted from the vertical", "no --relative"),
        };
        changes.push(change(file, Kind::Relative, words, option, |file| {
            file.relative = !file.relative;
        }));
        changes
    }

    fn of_dots(&self, file: &MeasuredFile) -> Vec<Change> {
        let y_down = file.y_down || !file.y_up && self.table.kind() == FileKind::DeepLabCut;
        let (words, option) = match y_down {
            true => (
                "y points upwards, or all links' dots are the other way round",
                "--y-up",
            ),
            false => (
                "y points downwards, or all links' dots are the other way round",
                "--y-down",
            ),
        };
        let mut changes = vec![change(file, Kind::Y, words, option, |file| {
            (file.y_down, file.y_up) = (!y_down, y_down);
        })];
        let dots = file.dots_of(self.table);
        let mut add = |kind, words: String, dots: Vec<(String, String)>| {
            let list = dots.iter().map(|(upper, lower)| format!("{upper}:{lower}"));
            let option = format!("--dots {}", shell(&list.collect::<Vec<_>>().join(",")));
            changes.push(change(file, kind, words, option, |file| {
                (file.dots, file.pivot) = (dots, None);
            }));
        };
        for first in 1..dots.len() {
            let mut dots = dots.clone();
            let link = dots.remove(first);
            let (upper, lower) = &link;
            let words =
                format!("`{upper}` to `{lower}` is the first link, on which the rest hangs");
            dots.insert(0, link);
            add(Kind::Links, words, dots);
        }
        for (index, (upper, lower)) in dots.iter().enumerate() {
            let words = format!("`{lower}` is the upper end of the link to `{upper}`");
            let mut dots = dots.clone();
            dots[index] = (lower.clone(), upper.clone());
            add(Kind::Ends, words, dots);
        }
        let turned = || {
            dots.iter()
                .map(|(upper, lower)| (lower.clone(), upper.clone()))
        };
        let words = "the dots are listed from the free end to the pivot".to_owned();
        add(Kind::Dots, words, turned().rev().collect());
        if let [(top, first), (middle, second)] = &dots[..]
            && first == middle
        {
            let words = format!("`{first}` is the free end, on `{second}`");
            let dots = [[top, second], [second, first]];
            let dots = dots.map(|[upper, lower]| (upper.clone(), lower.clone()));
            add(Kind::Dots, words, dots.to_vec());
        }
        changes
    }

    /// Returns the change to a release that is later than the given beginning.
    fn release(&self, file: &MeasuredFile) -> Option<Change> {
        let without = MeasuredFile {
            from: None,
            ..file.clone()
        };
        let release = without.angles(self.table, self.hung).ok()?.release?;
        if file.from.is_none_or(|from| from >= release) {
            return None;
        }
        let words = format!("the links are held until {release} s");
        let option = format!("--from {release}");
        Some(change(file, Kind::Release, words, option, |file| {
            file.from = Some(release);
        }))
    }
}

/// Returns the changes of the unit of angles, if no column of these links names its unit.
pub(super) fn units(table: &Table, file: &MeasuredFile, names: &[String]) -> Vec<Change> {
    let names_unit = |name: &String| {
        let column = table.column(name).ok();
        column.is_some_and(|column| !table.columns()[column].unit.is_empty())
    };
    // Their size distinguishes counts from angles.
    let is_known = matches!(file.unit, Some(AngleUnit::Counts(_))) || names.iter().any(names_unit);
    if is_known {
        return Vec::new();
    }
    let units = [
        (AngleUnit::Degrees, "angles are degrees", "--unit deg"),
        (AngleUnit::Radians, "angles are radians", "--unit rad"),
    ];
    let units = units.map(|(unit, words, option)| {
        change(file, Kind::Unit, words, option, |file| {
            file.unit = Some(unit);
        })
    });
    units.into()
}

/// Returns the change that leaves out rows in which a dot was lost, detected by the marks that
/// programs write.
pub(super) fn lost(table: &Table, file: &MeasuredFile) -> Option<Change> {
    let stretches = marks::lost(table, file)?;
    let words = format!(
        "dots are lost {}, where they have a mark or stay in one place",
        stretches_in_words(&stretches)
    );
    Some(leaving_out(file, Kind::Lost, words, &stretches))
}

/// Returns the change that leaves out time intervals (s).
pub(super) fn leaving_out(
    file: &MeasuredFile,
    kind: Kind,
    words: String,
    stretches: &[[f64; 2]],
) -> Change {
    let all = [&file.leave_out[..], stretches].concat();
    let list = all.iter().map(|[from, to]| format!("{from}:{to}"));
    let option = format!("--leave-out {}", list.collect::<Vec<_>>().join(","));
    change(file, kind, words, option, |file| file.leave_out = all)
}

/// Returns the changes to angles measured from the horizontal, to either side.
fn sides(file: &MeasuredFile) -> Vec<Change> {
    let own = file.tilt.unwrap_or(0.0);
    let sides = [-RIGHT, RIGHT].into_iter().map(|side| {
        // Within half a turn, as the option has it.
        let tilt = (own + side + 180.0).rem_euclid(360.0) - 180.0;
        let words = format!("links at rest show {tilt}°, as angles from a horizontal axis do");
        let mut change = change(file, Kind::Side, words, format!("--tilt {tilt}"), |file| {
            file.tilt = Some(tilt);
        });
        if !file.y_down && !file.y_up && file.dots.is_empty() && file.pivot.is_none() {
            change.file.zero = Some(Zero::Down);
            change.options.push("--zero down".to_owned());
        }
        change
    });
    sides.collect()
}

/// A change of a reading.
pub(super) fn change(
    file: &MeasuredFile,
    kind: Kind,
    words: impl Into<String>,
    option: impl Into<String>,
    read: impl FnOnce(&mut MeasuredFile),
) -> Change {
    let mut file = file.clone();
    read(&mut file);
    Change {
        kind,
        words: words.into(),
        options: vec![option.into()],
        file,
    }
}

/// Quotes the value of an option for the shell.
fn shell(value: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "_-.,:/".contains(c);
    match value.chars().all(is_plain) {
        true => value.to_owned(),
        false => format!("'{}'", value.replace('\'', r"'\''")),
    }
}
