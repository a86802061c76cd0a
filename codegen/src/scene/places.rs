//! Tables of links that carry children at several places, or in their own pivot.

use std::collections::BTreeMap;

use super::link_constants::{Turning, product};
use super::offsets::{is_lateral, leaf_columns};
use super::{Forces, Link, Offset, Quantity, Scene, Table};
use crate::exact::ExactError;

/// What a link is to its parent: the columns that the runtime's `PlacedTable` has
/// for that.
pub(super) const HANGING: [&str; 6] = ["square", "ratio", "reach", "rest", "along", "across"];

/// Whether a link has children at several places, or one in its own pivot: then
/// no distance of its children can be its unit of length.
pub(super) fn has_places(scene: &Scene) -> bool {
    let mut places: BTreeMap<usize, &Offset> = BTreeMap::new();
    scene.links.iter().any(|link| {
        let Some(parent) = link.parent else {
            return false;
        };
        let Offset { along, lateral } = &link.pivot;
        let first = *places.entry(parent.0).or_insert(&link.pivot);
        first != &link.pivot || (along.is_zero() && lateral.is_zero())
    })
}

/// The columns of a link's own constants.
pub fn columns(forces: Forces) -> Vec<&'static str> {
    let columns = forces.columns().into_iter();
    let hanging = |column: &&str| !HANGING[..4].contains(column);
    columns.filter(hanging).collect()
}

/// The constants of a scene's links, lengths in metres.
///
/// # Errors
/// [`ExactError`] where a number gets too long, or a leaf has no inertia about its
/// pivot.
pub(super) fn placed(scene: &Scene) -> Result<Table, ExactError> {
    let (forces, links) = (Forces::of(scene), &scene.links);
    let mut carries = vec![false; links.len()];
    for parent in links.iter().filter_map(|link| link.parent) {
        if let Some(carries) = carries.get_mut(parent.0) {
            *carries = true;
        }
    }
    let lateral = is_lateral(scene);
    let (mut motion, mut hanging) = (Vec::new(), Vec::new());
    for (link, carries) in links.iter().zip(carries) {
        let body = Turning::of(link)?;
        let mut row = own_row(link, &body, carries, lateral)?;
        row.extend(forces.values(link));
        motion.push(row);
        hanging.push(hanging_row(link, &body, carries)?);
    }
    Ok(Table {
        motion,
        energy: Vec::new(),
        hanging: Some(hanging),
        root: scene.gravity.clone().negative(),
        per_lever: scene.drive.as_ref().map(|_| Quantity::integer(1)),
    })
}

/// Moment of inertia (of a leaf one over it) and first moments.
fn own_row(
    link: &Link,
    body: &Turning,
    carries: bool,
    lateral: bool,
) -> Result<Vec<Quantity>, ExactError> {
    let (one, zero) = (Quantity::integer(1), Quantity::zero());
    if !carries {
        let mut row = vec![one.divided_by(body.inertia.clone())?, zero];
        if lateral {
            row.extend(leaf_columns(&link.com)?);
        }
        return Ok(row);
    }
    let moment = product([&link.mass, &link.com.along]);
    let mut row = vec![body.inertia.clone(), moment];
    if lateral {
        let sideways = product([&link.mass, &link.com.lateral]);
        row.extend([one, zero, sideways]);
    }
    Ok(row)
}

/// A leaf pulls at its pivot with Φ = m I/J + (m² d²/J) u uᵀ, other links with
/// Φ = m + what they answer.
fn hanging_row(link: &Link, body: &Turning, carries: bool) -> Result<[Quantity; 6], ExactError> {
    let Offset { along, lateral } = &link.pivot;
    if link.parent.is_none() {
        return Ok(std::array::from_fn(|_| Quantity::zero()));
    }
    let [square, ratio, reach, rest] = if carries {
        let one = || Quantity::integer(1);
        [one(), one(), one(), body.mass.clone()]
    } else {
        let over = |value: Quantity| value.divided_by(body.inertia.clone());
        [
            over(product([&body.moment, &body.moment]))?,
            body.moment.clone(),
            over(body.moment.clone())?,
            over(product([&body.mass, &link.inertia]))?,
        ]
    };
    Ok([square, ratio, reach, rest, along.clone(), lateral.clone()])
}
