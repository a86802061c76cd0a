//! Combines two bodies that are fixed to each other into one, with exact mass, centre of mass and
//! inertia.

use super::bodies::Body;
use super::template::Template;
use super::{Offset, Quantity};
use crate::exact::{ExactError, Rational};

/// Converts a point of a link to the frame of its parent; the link is fixed at `angle` (rad) and
/// hangs at `pivot`.
pub(super) fn in_parent_frame(point: &Offset, angle: &Rational, pivot: &Offset) -> Offset {
    let (sine, cosine) = angle.sine_and_cosine();
    let (sine, cosine) = (Quantity::number(sine), Quantity::number(cosine));
    let times = |a: &Quantity, b: &Quantity| Quantity::product([a.clone(), b.clone()]);
    let Offset { along, lateral } = point;
    Offset {
        along: Quantity::sum([
            pivot.along.clone(),
            times(along, &cosine),
            times(lateral, &sine).negative(),
        ]),
        lateral: Quantity::sum([
            pivot.lateral.clone(),
            times(along, &sine),
            times(lateral, &cosine),
        ]),
    }
}

/// Returns the combined body of `parent` and all copies of `link`, which are fixed to the parent at
/// `angle` (rad).
///
/// # Errors
/// Fails if an exact number becomes too long.
pub(super) fn weld(parent: &Body, link: &Template, angle: &Rational) -> Result<Body, ExactError> {
    let added = link.body.mass.times(link.copies);
    let at = in_parent_frame(&link.body.com, angle, &link.pivot);
    let mass = Quantity::sum([parent.mass.clone(), added.clone()]);
    let inertia = Quantity::sum([parent.inertia.clone(), link.body.inertia.times(link.copies)]);
    let joint = parent.joint.clone();
    if mass.is_zero() {
        return Ok(Body {
            mass,
            inertia,
            com: parent.com.clone(),
            joint,
        });
    }
    let product = |a: &Quantity, b: &Quantity| Quantity::product([a.clone(), b.clone()]);
    let centre = |first: &Quantity, second: &Quantity| {
        Quantity::sum([product(&parent.mass, first), product(&added, second)])
            .divided_by(mass.clone())
    };
    let difference = |first: &Quantity, second: &Quantity| {
        Quantity::sum([second.clone(), first.clone().negative()])
    };
    let along = difference(&parent.com.along, &at.along).power(2)?;
    let lateral = difference(&parent.com.lateral, &at.lateral).power(2)?;
    // Parallel-axis theorem for both bodies at once: the reduced mass, about the common centre of
    // mass.
    let reduced = product(&parent.mass, &added).divided_by(mass.clone())?;
    let apart = Quantity::product([reduced, Quantity::sum([along, lateral])]);
    Ok(Body {
        com: Offset {
            along: centre(&parent.com.along, &at.along)?,
            lateral: centre(&parent.com.lateral, &at.lateral)?,
        },
        inertia: Quantity::sum([inertia, apart]),
        mass,
        joint,
    })
}
