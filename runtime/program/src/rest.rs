//! Equilibria of a tree, described as text.

use branched_pendulum::analysis::{EquilibriumError, ModesError, Stability};
use branched_pendulum::system::{Model, State};

use crate::subject::Subject;

/// Largest number of links whose angles a line of text lists.
const MOST_LINKS: usize = 12;

/// Largest number of stable equilibria that are listed in addition to the first.
const MOST_RESTS: usize = 6;

/// Angle (rad) below which a link counts as being at zero.
const ZERO: f64 = 1e-9;

/// Largest distance (rad) of a start from an equilibrium that is caused by rounding of the input,
/// also if it was written in degrees.
const ROUNDING: f64 = 1e-14;

/// Number of links from which on the frequencies of the modes are not printed, because computing
/// their matrices takes too long.
const MOST_MODES: usize = 256;

/// Number of springs between links from which on stability is not examined, because their stiffness
/// matrix is dense.
const MOST_SPRINGS: usize = 20_000;

impl Subject {
    /// Returns true if the tree has too many springs between links for its stability to be
    /// examined.
    fn has_too_many_springs(&self) -> bool {
        let torsional = self.tree.spring_dampers().iter().map(|_| ());
        let straight = self.tree.translational_spring_dampers().iter().map(|_| ());
        torsional.chain(straight).nth(MOST_SPRINGS).is_some()
    }

    /// Returns the angles of the stable equilibrium to which the tree descends from zero angles; if
    /// it has too many springs between links, the angles of the equilibrium nearest to zero.
    ///
    /// # Errors
    /// [`EquilibriumError`].
    pub fn rest(&self) -> Result<Vec<f64>, EquilibriumError> {
        let zeros = vec![0.0; self.tree.links()];
        match self.has_too_many_springs() {
            true => self.tree.equilibrium(&zeros),
            false => self.tree.stable_equilibrium(&zeros).map(|own| own.theta),
        }
    }

    /// Formats the angles of all links, as in "left 18.33°, right -13.09°".
    pub fn angles_in_words(&self, theta: &[f64]) -> String {
        if theta.iter().all(|angle| angle.abs() < ZERO) {
            return "all angles zero".to_owned();
        }
        let names = self.tree.names().iter().zip(theta).take(MOST_LINKS);
        let words = names.map(|(name, angle)| {
            // A rounded zero has no sign.
            let degrees = (1e4 * angle.to_degrees()).round() / 1e4 + 0.0;
            format!("{name} {degrees:.4}°")
        });
        let words = words.collect::<Vec<_>>().join(", ");
        match theta.len().saturating_sub(MOST_LINKS) {
            0 => words,
            more => format!("{words} and {more} more"),
        }
    }

    /// Describes the stable and unstable equilibria of the tree, one line each; also returns the
    /// angles of the first.
    pub fn rests_in_words(&self) -> (String, Result<Vec<f64>, EquilibriumError>) {
        if self.has_too_many_springs() {
            return match self.rest() {
                Ok(theta) => {
                    let words = self.angles_in_words(&theta);
                    let text = format!(
                        "rests, stably or not, at: {words} (the stability of so many springs between \
                         links is not examined)\n"
                    );
                    (text, Ok(theta))
                }
                Err(error) => (format!("no place of rest was found: {error}\n"), Err(error)),
            };
        }
        let all = match self.tree.equilibria() {
            Ok(all) => all,
            Err(error) => return (format!("no place of rest was found: {error}\n"), Err(error)),
        };
        let mut text = String::new();
        let (unstable, stable): (Vec<_>, Vec<_>) = all
            .iter()
            .partition(|own| own.stability == Stability::Unstable);
        for (place, own) in stable.iter().take(1 + MOST_RESTS).enumerate() {
            let also = if place > 0 { "also " } else { "" };
            let angles = match self.angles_in_words(&own.theta) {
                words if own.theta.iter().all(|angle| angle.abs() < ZERO) => {
                    format!("with {words}")
                }
                words => format!("at {words}"),
            };
            let neutral = match own.stability {
                Stability::Stable | Stability::Unstable => "",
                Stability::Neutral => "; nothing pulls it back in some direction",
            };
            text.push_str(&format!("{also}rests {angles}{neutral}\n"));
        }
        if let Some(more) = stable
            .len()
            .checked_sub(1 + MOST_RESTS)
            .filter(|more| *more > 0)
        {
            text.push_str(&format!("and at {more} more places\n"));
        }
        for own in unstable {
            let words = self.angles_in_words(&own.theta);
            text.push_str(&format!(
                "unstable equilibrium: {words}{}\n",
                self.leaving(&own.theta)
            ));
        }
        let first = all.into_iter().next().map(|own| own.theta);
        (text, first.ok_or(EquilibriumError::NotFinite))
    }

    /// Describes how fast a disturbance of an unstable equilibrium grows.
    fn leaving(&self, theta: &[f64]) -> String {
        if theta.len() > MOST_MODES {
            return String::new();
        }
        let Err(ModesError::NegativeStiffness { eigenvalue }) = self.tree.modes(theta) else {
            return String::new();
        };
        let time = 1.0 / (-eigenvalue).sqrt();
        format!("; a disturbance grows by a factor of e in {time:.3} s")
    }

    /// Returns a remark if the start is at rest in an unstable equilibrium, where rounding alone
    /// decides how the motion begins.
    pub fn unstable_release(&self, start: &State<f64>) -> Option<String> {
        let (theta, omega) = start.values.split_at_checked(self.tree.links())?;
        let is_still = omega.iter().all(|rate| *rate == 0.0)
            && self.tree.drive(0.0).is_none()
            && !self.has_too_many_springs();
        let at = is_still.then(|| self.tree.equilibrium_at(theta, ROUNDING))??;
        (at.stability == Stability::Unstable).then(|| {
            format!(
                "released at rest in an unstable equilibrium ({}){}: a pendulum leaves it by a \
                 disturbance that is not known, and this motion by the rounding of its angles or \
                 not at all; help: release it next to it, as at 179.9 in place of 180\n",
                self.angles_in_words(theta),
                self.leaving(theta)
            )
        })
    }
}
