//! Choice between angles read from columns and angles computed from points.

use super::angles::AngleColumns;
use super::error::{ReadError, ReadErrorKind};
use super::header::FileKind;
use super::markers::Markers;
use super::names::{Meaning, quoted};
use super::recording::Recording;
use super::table::Table;

/// Reads the angles of a table, from its columns or its points. If `columns` or `markers` sets more
/// than the clock, the sense of angles and the rule for outliers, that one is used. Otherwise it
/// uses points if the table has them.
///
/// # Errors
/// Errors of [`AngleColumns::read`] and [`Markers::read`]; [`ReadErrorKind::Option`] if both set
/// more, or if neither does and the table has angles as well as points.
pub fn read_angles(
    table: &Table,
    columns: &AngleColumns,
    markers: &Markers,
) -> Result<Recording, ReadError> {
    let refused = |what| Err(table.refused(ReadErrorKind::Option { what }));
    match (columns.is_asked_for(), markers.is_asked_for()) {
        (true, true) => refused(
            "columns of angles (their names, unit, zero) and points (their names, pivot, \
             vertical) are asked for together; angles come from one of them"
                .to_owned(),
        ),
        (true, false) => columns.read(table),
        (false, true) => markers.read(table),
        (false, false) if table.tracks().is_empty() => columns.read(table),
        (false, false) => {
            let angles = marked_angle_columns(table);
            if angles.is_empty() {
                return markers.read(table);
            }
            let points: Vec<&str> = table.tracks().iter().map(|t| t.name.as_str()).collect();
            refused(format!(
                "there are columns of angles ({}) and points ({}); name the ones or the others",
                quoted(&angles),
                quoted(&points)
            ))
        }
    }
}

/// Returns the names of columns whose name or unit marks them as angles; those of Tracker belong to
/// its points and are left out.
fn marked_angle_columns(table: &Table) -> Vec<&str> {
    let all = table.columns();
    let is_angle = |column: &&_| Meaning::of(column, all) == Meaning::Angle;
    let angles = all.iter().filter(is_angle);
    let angles = angles.filter(|_| table.kind() != FileKind::Tracker);
    angles.map(|column| column.name.as_str()).collect()
}
