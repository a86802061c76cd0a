//! Checks of a model's parameters, which the constructors of emitted models call.

use alloc::vec::Vec;

use crate::model::ParameterError;

/// Checks that a parameter is finite.
///
/// # Errors
/// [`ParameterError`] if `what` is infinite or NaN.
pub fn require_finite(what: &'static str, value: f64) -> Result<(), ParameterError> {
    require(what, value, "finite", true)
}

/// Condition on the gravity of a hanging tree, for messages.
const HANGING: &str = "finite and not negative: for a tree that stands up write `gravity = -g`";

/// Condition on the gravity of an upright tree, for messages.
const STANDING: &str = "finite and not positive: for a tree that hangs write `gravity = g`";

/// Checks the gravity of a hanging tree, which must be finite and at least zero.
///
/// # Errors
/// [`ParameterError`] if `what` is negative, infinite or NaN.
pub fn require_downward(what: &'static str, value: f64) -> Result<(), ParameterError> {
    require(what, value, HANGING, value >= 0.0)
}

/// Checks the gravity of an upright tree, which must be finite and at most zero.
///
/// # Errors
/// [`ParameterError`] if `what` is positive, infinite or NaN.
pub fn require_upward(what: &'static str, value: f64) -> Result<(), ParameterError> {
    require(what, value, STANDING, value <= 0.0)
}

/// Checks that a parameter is finite and at least zero.
///
/// # Errors
/// [`ParameterError`] if `what` is negative, infinite or NaN.
pub fn require_non_negative(what: &'static str, value: f64) -> Result<(), ParameterError> {
    require(what, value, "finite and not negative", value >= 0.0)
}

/// Checks that a parameter is finite and positive.
///
/// # Errors
/// [`ParameterError`] if `what` is not positive and finite.
pub fn require_positive(what: &'static str, value: f64) -> Result<(), ParameterError> {
    require(what, value, "finite and positive", value > 0.0)
}

/// Checks that a parameter is 0, or has a magnitude between two limits. `requirement` states this
/// condition in words.
///
/// # Errors
/// [`ParameterError`] if `what` has another magnitude.
pub fn require_magnitude(
    what: &'static str,
    value: f64,
    [least, largest]: [f64; 2],
    requirement: &'static str,
) -> Result<(), ParameterError> {
    let met = value == 0.0 || (least..=largest).contains(&value.abs());
    require(what, value, requirement, met)
}

fn require(
    what: &'static str,
    value: f64,
    requirement: &'static str,
    met: bool,
) -> Result<(), ParameterError> {
    if met && value.is_finite() {
        return Ok(());
    }
    Err(ParameterError {
        what,
        value,
        requirement,
    })
}

/// Mass properties of a link, in SI units, for [`require_regular`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkBody {
    /// Quantity to name in the message if the link can turn without kinetic energy.
    pub what: &'static str,
    /// Index of the parent, which comes before the link.
    pub parent: Option<usize>,
    /// Mass, in kg.
    pub mass: f64,
    /// Moment of inertia about the centre of mass, in kg m².
    pub inertia: f64,
    /// Centre of mass relative to the link's pivot, along and across the link, in m.
    pub com: [f64; 2],
    /// Pivot relative to the parent's pivot, along and across the parent, in m.
    pub pivot: [f64; 2],
}

/// Checks that the mass matrix of a tree is regular at all angles.
///
/// # Errors
/// [`ParameterError`] if a link can turn without kinetic energy ([`free_link`]): its moment of inertia
/// is zero.
pub fn require_regular(links: &[LinkBody], negligible: [f64; 3]) -> Result<(), ParameterError> {
    match free_link(links, negligible).and_then(|index| links.get(index)) {
        None => Ok(()),
        Some(link) => Err(ParameterError {
            what: link.what,
            value: 0.0,
            requirement: "positive",
        }),
    }
}

/// Returns the last link that, in some configuration, can turn about its pivot at rest without
/// kinetic energy, if there is one. The mass matrix is singular in that configuration.
///
/// Such a link has no inertia and no mass off its pivot, and each of its children hangs from the
/// link's pivot or can yield: the child's pivot can move without kinetic energy in some
/// configuration. Masses, lengths and moments of inertia below those in `negligible` count as zero.
/// O(links).
pub fn free_link(links: &[LinkBody], negligible: [f64; 3]) -> Option<usize> {
    let [least_mass, least_length, least_inertia] = negligible;
    let near = |place: [f64; 2], other: [f64; 2]| {
        let [x, y] = place;
        let [to_x, to_y] = other;
        (x - to_x).abs() < least_length && (y - to_y).abs() < least_length
    };
    let origin = [0.0, 0.0];
    // Pivots of the children that do not yield.
    let mut firm = alloc::vec![Vec::new(); links.len()];
    for (index, link) in links.iter().enumerate().rev() {
        let pivots: Vec<[f64; 2]> = firm.get_mut(index).map(core::mem::take)?;
        let free = link.inertia < least_inertia;
        let massless = link.mass < least_mass;
        let at = |place: [f64; 2]| pivots.iter().all(|pivot| near(*pivot, place));
        if free && (massless || near(link.com, origin)) && at(origin) {
            return Some(index);
        }
        let centre = match massless {
            true => pivots.last().copied(),
            false => Some(link.com),
        };
        let about = centre.is_some_and(|centre| !near(centre, origin) && at(centre));
        let unburdened = massless && pivots.is_empty();
        if let (false, Some(parent)) = (unburdened || (free && about), link.parent) {
            firm.get_mut(parent)?.push(link.pivot);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn body(parent: Option<usize>, mass: f64, inertia: f64, com: f64, pivot: f64) -> LinkBody {
        LinkBody {
            what: "moment of inertia",
            parent,
            mass,
            inertia,
            com: [com, 0.0],
            pivot: [pivot, 0.0],
        }
    }

    fn check(links: &[LinkBody]) -> Result<(), ParameterError> {
        require_regular(links, [1e-60, 1e-30, 1e-120])
    }

    #[test]
    fn massless_leaves_are_refused() {
        let root = body(None, 1.0, 0.1, 0.5, 0.0);
        assert!(check(&[root, body(Some(0), 0.0, 0.0, 0.1, 1.0)]).is_err());
        assert!(check(&[root, body(Some(0), 1.0, 0.0, 0.0, 1.0)]).is_err());
        assert!(check(&[root, body(Some(0), 1.0, 0.0, 0.1, 1.0)]).is_ok());
        assert!(check(&[root, body(Some(0), 0.0, 1e-9, 0.1, 1.0)]).is_ok());
    }

    #[test]
    fn negligible_values_count_as_zero() {
        let root = body(None, 1.0, 0.1, 0.5, 0.0);
        assert!(check(&[root, body(Some(0), 1e-61, 0.0, 0.1, 1.0)]).is_err());
        assert!(check(&[root, body(Some(0), 1.0, 0.0, 1e-31, 1.0)]).is_err());
        assert!(check(&[root, body(Some(0), 0.0, 1e-121, 0.1, 1.0)]).is_err());
        assert!(check(&[root, body(Some(0), 1e-59, 0.0, 1e-29, 1.0)]).is_ok());
        assert!(check(&[root, body(Some(0), 0.0, 1e-119, 0.1, 1.0)]).is_ok());
    }

    /// Checks two massless rods with one bob: if the rods are in line, one velocity has no energy.
    #[test]
    fn a_bob_on_two_massless_rods_is_refused() {
        let rods = [
            body(None, 0.0, 0.0, 0.0, 0.0),
            body(Some(0), 1.0, 0.0, 0.3, 1.0),
        ];
        assert!(check(&rods).is_err());
        let heavy = [body(None, 1.0, 0.0, 0.2, 0.0), rods[1]];
        assert!(check(&heavy).is_ok());
    }
}
