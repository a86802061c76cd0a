//! Two bodies that are one: mass, centre of mass and inertia combined exactly.

use super::bodies::Body;
use super::template::Template;
use super::{Offset, Quantity};
use crate::exact::{ExactError, Rational};

/// A point of a link that is turned by `angle` about `pivot`, seen from the link that
/// it hangs from.
pub(super) fn turned(point: &Offset, angle: &Rational, pivot: &Offset) -> Offset {
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

/// The body of `parent` and all copies of `link` that are fixed to it at `angle`.
///
/// # Errors
/// Numbers that become too long.
pub(super) fn weld(parent: &Body, link: &Template, angle: &Rational) -> Result<Body, ExactError> {
    let added = link.body.mass.times(link.copies);
    let at = turned(&link.body.com, angle, &link.pivot);
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
    // Steiner for both at once: the reduced mass, about the common centre.
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
