//! Requirements on the parameters of a model: emitted constructors check them.

use alloc::vec::Vec;

use crate::model::ParameterError;

/// Passes a finite value.
///
/// # Errors
/// The error that `what` is not finite.
pub fn require_finite(what: &'static str, value: f64) -> Result<(), ParameterError> {
    require(what, value, "finite", true)
}

/// Condition on gravity of a tree that hangs.
const HANGING: &str = "finite and not negative: for a tree that stands up write `gravity = -g`";

/// Condition on gravity of a tree that stands.
const STANDING: &str = "finite and not positive: for a tree that hangs write `gravity = g`";

/// Passes finite gravity of a tree that hangs.
///
/// # Errors
/// The error that `what` is negative or not finite.
pub fn require_downward(what: &'static str, value: f64) -> Result<(), ParameterError> {
    require(what, value, HANGING, value >= 0.0)
}

/// Passes finite gravity of a tree that stands.
///
/// # Errors
/// The error that `what` is positive or not finite.
pub fn require_upward(what: &'static str, value: f64) -> Result<(), ParameterError> {
    require(what, value, STANDING, value <= 0.0)
}

/// Passes a finite value that is not negative.
///
/// # Errors
/// The error that `what` is negative or not finite.
pub fn require_non_negative(what: &'static str, value: f64) -> Result<(), ParameterError> {
    require(what, value, "finite and not negative", value >= 0.0)
}

/// Passes a finite positive value.
///
/// # Errors
/// The error that `what` is not positive or not finite.
pub fn require_positive(what: &'static str, value: f64) -> Result<(), ParameterError> {
    require(what, value, "finite and positive", value > 0.0)
}

/// Passes 0 and a value of a magnitude between two, which the requirement states in words.
///
/// # Errors
/// The error that `what` has another one.
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

/// A link as [`require_regular`] sees it. SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkBody {
    /// Name of the quantity that is zero where the link turns without energy, for the
    /// message.
    pub what: &'static str,
    /// Index of the parent, which stands before the link.
    pub parent: Option<usize>,
    /// Mass.
    pub mass: f64,
    /// Moment of inertia about the centre of mass.
    pub inertia: f64,
    /// Centre of mass from the link's pivot, along and across.
    pub com: [f64; 2],
    /// Pivot on the parent from the parent's pivot, along and across.
    pub pivot: [f64; 2],
}

/// Passes a tree whose mass matrix is regular for all angles.
///
/// # Errors
/// The error that the moment of inertia of a [free link](free_link) is zero.
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

/// Returns the last link that can turn about its resting pivot without kinetic energy in
/// some configuration, if there is one: the mass matrix is singular there.
///
/// Such a link has no inertia, no mass off its pivot, and every child hangs from the
/// pivot or yields: lets its own pivot move without energy in some configuration.
/// A mass, a length and a moment of inertia below the `negligible` ones count as zero.
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

    /// Two rods without mass and one bob: in line, one velocity has no energy.
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
