//! Points that a camera followed.

use std::collections::BTreeMap;

use super::names::{ANGLE, coordinate, words};
use super::units::Unit;
use super::write::Column;

/// A point that a camera tracked: the indices of its columns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Track {
    /// Name.
    pub name: String,
    /// Column of the coordinate that points to the right.
    pub x: usize,
    /// Column of the other coordinate.
    pub y: usize,
    /// Column of the likelihood, if there is one.
    pub likelihood: Option<usize>,
}

/// Finds the measured points of a table: pairs of columns that contain the two coordinates of a
/// point.
pub(crate) fn tracks(columns: &[Column]) -> Vec<Track> {
    let is_length =
        |column: &&Column| matches!(Unit::named(&column.unit), None | Some(Unit::Length));
    let coordinate = |column| {
        Some(column)
            .filter(is_length)
            .and_then(|c| coordinate(&c.name))
    };
    let coordinates: Vec<_> = columns.iter().map(coordinate).collect();
    // The first column of each coordinate.
    let mut places: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for (index, coordinate) in coordinates.iter().enumerate() {
        if let Some((point, axis)) = coordinate {
            places.entry((point, axis)).or_insert(index);
        }
    }
    let find = |point: &str, axis: &str| places.get(&(point, axis)).copied();
    let rates = [
        "v",
        "vel",
        "velocity",
        "speed",
        "acc",
        "accel",
        "acceleration",
        "force",
    ];
    let has_rates = coordinates.iter().flatten().any(|(point, _)| {
        words(point)
            .last()
            .is_some_and(|word| rates.contains(&word.as_str()))
    });
    let tracks = coordinates
        .iter()
        .enumerate()
        .filter_map(|(x, coordinate)| {
            let (name, "x") = coordinate.as_ref()? else {
                return None;
            };
            // Components of velocities and of rotations are no points, nor an `a` beside the former.
            let last = words(name).pop().unwrap_or_default();
            let is_letter = name.rsplit([' ', '_']).next() == Some("a");
            let last = last.as_str();
            if rates.contains(&last) || ANGLE.contains(&last) || has_rates && is_letter {
                return None;
            }
            Some(Track {
                name: name.clone(),
                x,
                y: find(name, "y")?,
                likelihood: find(name, "likelihood"),
            })
        });
    tracks.collect()
}
