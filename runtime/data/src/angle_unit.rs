//! The unit of columns of angles.

use std::f64::consts::TAU;

use super::error::{ReadError, ReadErrorKind};
use super::finding::{Basis, Finding};
use super::table::Table;
use super::units::{AngleUnit, Unit};

/// Determines the unit of columns: the given one, or that of the header, or radians if the values
/// allow no other conclusion.
pub(crate) fn read(
    given: Option<AngleUnit>,
    table: &Table,
    columns: &[usize],
    findings: &mut Vec<Finding>,
) -> Result<AngleUnit, ReadError> {
    let (basis, unit) = match given {
        // A header is seldom wrong about its unit.
        Some(unit) => match named(table, columns) {
            Ok(Some(own)) if own != unit => {
                let text = format!(
                    "angles in {}, as the option says, though their columns name {}",
                    unit.word(),
                    own.word()
                );
                findings.push(Finding::new(Basis::Doubtful, text));
                return Ok(unit);
            }
            _ => (Basis::Given, unit),
        },
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

/// Returns the error that the unit of a column is not a unit of angles.
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
            let what = format!("columns of angles in {a} and in {b}");
            return Err(table.refused(ReadErrorKind::Option { what }));
        }
        found = Some(unit);
    }
    Ok(found)
}

/// Returns how certain it is that values are radians. An error if they hardly are: beyond a turn,
/// or varying by more than one, or all in tenths.
fn by_values(table: &Table, columns: &[usize]) -> Result<Basis, ReadError> {
    let (mut largest, mut of) = (0.0, 0);
    let mut widest = 0.0_f64;
    let (mut in_tenths, mut jumps) = (true, false);
    let mut are_counts = true;
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
            are_counts &= value.fract() == 0.0 && value >= 0.0;
            jumps |= before.is_some_and(|b| ((b - value).abs() - TAU).abs() < 0.1 * TAU);
            before = Some(value);
        }
        widest = widest.max(most - least);
    }
    // Rounded to five digits, π is larger than it is.
    let turn = 1.001 * TAU;
    if largest > turn || widest > turn || in_tenths && largest > 0.0 {
        let name = table.columns()[of].name.clone();
        let counts = are_counts.then(|| counts_a_turn(largest)).flatten();
        return Err(table.refused(ReadErrorKind::AngleUnit {
            name,
            largest,
            counts,
        }));
    }
    Ok(if jumps {
        Basis::Assumed
    } else {
        Basis::Doubtful
    })
}

/// Returns the number of counts per turn, a power of two, that an encoder with this largest count
/// probably has. `None` unless the largest count exceeds 360 (it could be degrees otherwise) and is
/// more than half of this number.
fn counts_a_turn(largest: f64) -> Option<u32> {
    const BITS: std::ops::RangeInclusive<u32> = 9..=24;
    let bits = (largest + 1.0).log2().ceil() as u32;
    BITS.contains(&bits).then(|| 1 << bits)
}
