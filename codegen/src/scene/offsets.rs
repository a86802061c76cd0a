//! Centres of mass and pivots beside a link's axis, in the equations of loops.
//!
//! A point at d along and e across a link is at d **u** + e **v** from its pivot
//! and moves with ω (d **v** − e **u**), **u** = (sin θ, −cos θ), **v** = (cos θ,
//! sin θ). With the unit of length λ and (p, q) = (d, e) / λ this is λ times
//! **u**, **v** turned by the angle of (p, q) and stretched to its length: the
//! equations of a straight link hold for the place of its children's pivots, and
//! for a leaf's centre of mass, as soon as sine and cosine are turned and
//! stretched so.

use super::link_constants::product;
use super::{Link, Offset, Quantity, Scene};
use crate::exact::ExactError;

/// The names of the columns: direction of the children's pivots (of a leaf: of its
/// centre of mass) in the unit of length; first moment across it.
pub(super) const COLUMNS: [&str; 3] = ["along", "across", "lateral"];

/// The place of the column `moment`.
const MOMENT: usize = 2;

/// Whether any centre of mass or pivot is beside a link's axis.
pub(super) fn is_lateral(scene: &Scene) -> bool {
    let beside = |offset: &Offset| !offset.lateral.is_zero();
    let mut links = scene.links.iter();
    links.any(|link| beside(&link.com) || beside(&link.pivot))
}

/// The unit of length for a point: its distance along the link, or across it where
/// that is zero, or may be because a parameter decides.
pub(super) fn unit(point: &Offset) -> &Quantity {
    let known = |value: &Quantity| value.exact().is_some() && !value.is_zero();
    let Offset { along, lateral } = point;
    if along.is_zero() || (!known(along) && known(lateral)) {
        lateral
    } else {
        along
    }
}

/// Adds the columns of a link whose children's pivots are there, of a leaf where
/// there are none; `moment` is that along these columns' direction then.
pub(super) fn add_offsets(
    row: &mut Vec<Quantity>,
    link: &Link,
    lever: Option<&Offset>,
) -> Result<(), ExactError> {
    let columns = match lever {
        None => leaf_columns(&link.com)?,
        Some(lever) => {
            let (moment, columns) = inner_columns(link, lever)?;
            if let Some(place) = row.get_mut(MOMENT) {
                *place = moment;
            }
            columns
        }
    };
    row.extend(columns);
    Ok(())
}

/// The columns of a leaf.
pub(super) fn leaf_columns(com: &Offset) -> Result<[Quantity; 3], ExactError> {
    let [along, across] = direction(com)?;
    Ok([along, across, Quantity::zero()])
}

/// First moment along the direction of the children's pivots, for the column
/// `moment`, and the columns of a link with children.
///
/// (d + i e) = (p + i q)(ℓ + i w) gives m λ² p and m λ² q.
fn inner_columns(link: &Link, lever: &Offset) -> Result<(Quantity, [Quantity; 3]), ExactError> {
    let [along, across] = direction(lever)?;
    let (com, unit) = (&link.com, unit(lever));
    let length = Quantity::sum([product([&along, &along]), product([&across, &across])]);
    // m λ times the components of the centre of mass in these directions.
    let moment = |parts: [Quantity; 2]| {
        let sum = product([&link.mass, unit, &Quantity::sum(parts)]);
        sum.divided_by(length.clone())
    };
    let main = moment([
        product([&com.along, &along]),
        product([&com.lateral, &across]),
    ])?;
    let lateral = moment([
        product([&com.lateral, &along]),
        product([&com.along, &across]).negative(),
    ])?;
    Ok((main, [along, across, lateral]))
}

/// A point in its unit of length; a pivot's own place has any direction.
fn direction(point: &Offset) -> Result<[Quantity; 2], ExactError> {
    let unit = unit(point);
    if unit.is_zero() {
        return Ok([Quantity::integer(1), Quantity::zero()]);
    }
    let over = |value: &Quantity| value.clone().divided_by(unit.clone());
    Ok([over(&point.along)?, over(&point.lateral)?])
}
