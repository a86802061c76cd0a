//! Checks that all implementations compute the same accelerations, before they are timed.

use std::fmt;

use branched_pendulum::Pendulum;

use super::accuracy;
use super::articulated::Articulated;
use super::by_hand::ByHand;
use super::dense::Dense;
use super::large::{BUSH_127, Bush127};
use super::scenes::factorization::Paper;
use super::scenes::recursion::{Tree7, Tree31};
use super::states::random;
use super::table::{self, Link};

/// Returns the largest difference, divided by the largest acceleration.
fn difference(found: &[f64], expected: &[f64]) -> f64 {
    let largest = expected.iter().fold(0.0, |max: f64, x| max.max(x.abs()));
    let pairs = found.iter().zip(expected);
    pairs.fold(0.0, |max: f64, (a, b)| max.max((a - b).abs())) / largest
}

/// Error: an implementation differs from the emitted code.
#[derive(Debug)]
pub struct Disagreement {
    what: String,
}

impl fmt::Display for Disagreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.what)
    }
}

/// Returns an error if `found` differs from the accelerations of the emitted code by more than the
/// limit, relative to the largest acceleration.
fn compare(what: &str, found: &[f64], emitted: &[f64], limit: f64) -> Result<(), Disagreement> {
    let difference = difference(found, emitted);
    if difference < limit {
        return Ok(());
    }
    Err(Disagreement {
        what: format!(
            "{what} of {} links differs by {difference:e} from emitted code, more than {limit:e}",
            emitted.len()
        ),
    })
}

fn agree<const N: usize>(model: &impl Pendulum<f64>, links: &[Link]) -> Result<(), Disagreement> {
    // Rounding errors grow with the condition of the mass matrix, below 10³.
    const LIMIT: f64 = 1e-12;
    let (mut recursion, mut dense) = (Articulated::new(links), Dense::new(links));
    let angles = random(3, N, 100, 3.0).by_state;
    let velocities = random(4, N, 100, 9.0).by_state;
    for (theta, omega) in angles.iter().zip(&velocities) {
        let (mut emitted, mut other) = ([0.0; N], [0.0; N]);
        model.accelerations_into(0.0, theta, omega, &mut emitted);
        recursion.accelerations(theta, omega, &mut other);
        compare("the recursion over a table", &other, &emitted, LIMIT)?;
        dense.accelerations(theta, omega, &mut other);
        compare("the dense matrix", &other, &emitted, LIMIT)?;
    }
    Ok(())
}

fn code_by_hand() -> Result<(), Disagreement> {
    let angles = random(5, 3, 100, 3.0).by_state;
    let velocities = random(6, 3, 100, 9.0).by_state;
    for (theta, omega) in angles.iter().zip(&velocities) {
        let (theta, omega) = (
            [theta[0], theta[1], theta[2]],
            [omega[0], omega[1], omega[2]],
        );
        let emitted = Paper::new().accelerations(&theta, &omega);
        let by_hand = ByHand::default().accelerations(&theta, &omega);
        compare("code by hand", &by_hand, &emitted, 1e-13)?;
    }
    Ok(())
}

/// Checks that errors are at most a small multiple of the bound by the condition of the matrix.
fn errors() -> Result<(), Disagreement> {
    const MOST: f64 = 5.0;
    for row in accuracy::all(30) {
        let is_small = row.worst.into_iter().flatten().all(|worst| worst < MOST);
        // Emitted code was measured.
        let is_measured = row.worst[1..3]
            .iter()
            .all(|worst| worst.is_some_and(|worst| worst > 0.0));
        if !is_small || !is_measured {
            let what = format!("rounding errors are not within {MOST} times their bound: {row:?}");
            return Err(Disagreement { what });
        }
    }
    Ok(())
}

/// Compares all implementations with emitted code at random states.
///
/// # Errors
/// [`Disagreement`], which names the implementation and the difference.
pub fn check() -> Result<(), Disagreement> {
    agree::<3>(&Paper::new(), &table::paper())?;
    agree::<7>(&Tree7::new(), &table::tree(3))?;
    agree::<31>(&Tree31::new(), &table::tree(5))?;
    agree::<127>(&Bush127::new(), &table::bush(BUSH_127))?;
    code_by_hand()?;
    errors()
}
