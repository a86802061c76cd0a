//! The unit of columns of angles.

use std::f64::consts::TAU;

use super::error::{ReadError, ReadErrorKind};
use super::finding::{Basis, Finding};
use super::table::Table;
use super::units::{AngleUnit, Unit};

/// The unit of columns: the given one, or that of the header, or radians where the values
/// allow no other guess.
pub(crate) fn read(
    given: Option<AngleUnit>,
    table: &Table,
    columns: &[usize],
    findings: &mut Vec<Finding>,
) -> Result<AngleUnit, ReadError> {
    let (basis, unit) = match given {
        Some(unit) => (Basis::Given, unit),
        None => match named(table, columns)? {
            Some(unit) => (Basis::Detected, unit),
            None => (by_values(table, columns)?, AngleUnit::Radians),
        },
    };
    let mut text = format!("angles in {}", unit.word());
    if basis == Basis::Doubtful {
        text += ", since no column names a unit and none leaves a turn; a swing of a few \
                 degrees looks alike: say the unit";
    }
    findings.push(Finding::new(basis, text));
    Ok(unit)
}

/// Refuses a column by its unit.
pub(crate) fn refused(table: &Table, column: usize) -> ReadError {
    let own = &table.columns()[column];
    table.refused(ReadErrorKind::Unit {
        name: own.name.clone(),
        unit: own.unit.clone(),
        quantity: "an angle",
    })
}

fn named(table: &Table, columns: &[usize]) -> Result<Option<AngleUnit>, ReadError> {
    let mut found: Option<AngleUnit> = None;
    for &column in columns {
        let unit = match table.columns()[column].unit.as_str() {
            "" => continue,
            text => match Unit::named(text) {
                Some(Unit::Angle(unit)) => unit,
                _ => return Err(refused(table, column)),
            },
        };
        if let Some(other) = found.filter(|other| *other != unit) {
            let (a, b) = (other.word(), unit.word());
            let what = format!("columns of angles in {a} beside some in {b}");
            return Err(table.refused(ReadErrorKind::Option { what }));
        }
        found = Some(unit);
    }
    Ok(found)
}

/// How sure it is that values are radians, refused where they are hardly: beyond a turn, or
/// to and fro by more than one, or all in tenths.
fn by_values(table: &Table, columns: &[usize]) -> Result<Basis, ReadError> {
    let (mut largest, mut of) = (0.0, 0);
    let mut widest = 0.0_f64;
    let (mut in_tenths, mut jumps) = (true, false);
    for &column in columns {
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut before: Option<f64> = None;
        for &value in table.values(column)?.iter().flatten() {
            if value.abs() > largest {
                (largest, of) = (value.abs(), column);
            }
            (least, most) = (least.min(value), most.max(value));
            let tenths = 10.0 * value;
            in_tenths &= (tenths - tenths.round()).abs() < 1e-9;
            jumps |= before.is_some_and(|b| ((b - value).abs() - TAU).abs() < 0.1 * TAU);
            before = Some(value);
        }
        widest = widest.max(most - least);
    }
    // Rounded to five digits, π is larger than it is.
    let turn = 1.001 * TAU;
    if largest > turn || widest > turn || in_tenths && largest > 0.0 {
        let name = table.columns()[of].name.clone();
        return Err(table.refused(ReadErrorKind::AngleUnit { name, largest }));
    }
    Ok(if jumps {
        Basis::Assumed
    } else {
        Basis::Doubtful
    })
}
