//! Possible causes of a gap in the energy budget that involve an unknown value. The value is
//! determined so that the budget closes.

use super::super::estimate::{Estimate, Measured, quantity};
use super::super::least::{self, ClosureUnknown};
use super::super::verdict::Verdict;
use super::change::{Change, Kind};
use super::readings::change;
use super::{Node, Unclosed};
use crate::measured_file::MeasuredFile;

/// Settings for the search of an unknown tilt of the camera or encoder, in rad.
const TILT: ClosureUnknown = ClosureUnknown {
    largest: 0.8,
    step: 0.2,
    small: 1e-4,
};

/// Friction that makes the gap in the energy budget smallest.
struct Braked {
    /// Friction coefficients in addition to those of the constants, in N m s.
    coefficients: Vec<f64>,
    closure: Vec<f64>,
}

impl Unclosed<'_> {
    /// Returns the tilt of camera or encoder that comes nearest to closing the budget: with the
    /// present friction, or together with the friction that then comes nearest.
    pub(super) fn tilt(&self, node: &Node, with_friction: bool) -> Option<Change> {
        let measured = self.measured(node);
        let smooth = &node.estimate;
        let weights = least::weights(deviations(smooth));
        // Smooth motions are turned with their data: nothing is to be estimated again.
        let closure = |tilt| match with_friction {
            true => self.braked(&measured, smooth, tilt).closure,
            false => measured.closure_if(&smooth.motion, tilt, &[]),
        };
        let found = least::value(TILT, &weights, closure)?.to_degrees();
        let found = match self.arguments.model {
            true => self.refined(node, found),
            false => found,
        };
        let tilt = node.file.tilt.unwrap_or(0.0) + found;
        // Hundredths of a degree are less than measurements determine.
        let tilt = (100.0 * tilt).round() / 100.0;
        let words = format!(
            "links at rest show about {tilt}°, as before a tilted camera or by encoders that are not at zero there"
        );
        let option = format!("--tilt {tilt}");
        Some(change(&node.file, Kind::Tilt, words, option, |file| {
            file.tilt = Some(tilt);
        }))
    }

    /// Refines a tilt (degrees) by the energy budget of the equations of motion, which determine it
    /// better, if that budget does not close already.
    fn refined(&self, node: &Node, tilt: f64) -> f64 {
        const BESIDE: f64 = 0.1;
        let estimate = |tilt: f64| {
            let tilt = Some(node.file.tilt.unwrap_or(0.0) + tilt);
            let source = self.read(&MeasuredFile {
                tilt,
                ..node.file.clone()
            })?;
            let (found, draws) = self.estimate(&source)?;
            let closes = Verdict::of(&source.times, &found, draws).closes();
            Some((found, closes))
        };
        let Some((here, false)) = estimate(tilt) else {
            return tilt;
        };
        let Some((beside, _)) = estimate(tilt + BESIDE) else {
            return tilt;
        };
        let weights = least::weights(deviations(&here));
        let step = least::step(&weights, &closure(&here), &closure(&beside));
        tilt + BESIDE * step.clamp(-10.0, 10.0)
    }

    /// Returns the interpretation with friction that is missing in the constants. `None` if the
    /// friction would have to be negative.
    pub(super) fn friction(&self, node: &Node) -> Option<Node> {
        let braked = self.braked(&self.measured(node), &node.estimate, 0.0);
        let all = &self.subject.names().frictions;
        let found = all.iter().zip(&braked.coefficients);
        let found: Vec<_> = found.filter(|(_, lacking)| **lacking > 0.0).collect();
        if found.is_empty() {
            return None;
        }
        let places = found.iter().map(|(own, lacking)| {
            format!("in {} is larger by about {lacking:.2e} N m s", own.place)
        });
        let words = format!("friction {}", places.collect::<Vec<_>>().join(" and "));
        let options = found.iter().map(|(own, lacking)| own.option(**lacking));
        let mut estimate = node.estimate.clone();
        for (row, closure) in estimate.energies.means.iter_mut().zip(&braked.closure) {
            row[quantity::CLOSURE] = *closure;
        }
        let change = Change {
            kind: Kind::Friction,
            words,
            options: options.collect(),
            file: node.file.clone(),
        };
        let verdict = Verdict::of(&node.source.times, &estimate, node.draws);
        let changes = [&node.changes[..], &[change]].concat();
        Some(Node {
            changes,
            verdict,
            ..node.clone()
        })
    }

    /// Returns the friction that comes nearest to closing the energy budget.
    fn braked(&self, measured: &Measured<'_>, smooth: &Estimate, tilt: f64) -> Braked {
        let names = self.subject.names();
        let closure = |friction: &[f64]| measured.closure_if(&smooth.motion, tilt, friction);
        let without = closure(&[]);
        // The closure is linear in each coefficient.
        let columns = names.frictions.iter().map(|own| {
            let mut all = vec![0.0; names.pivots.len()];
            own.pivots.iter().for_each(|pivot| all[*pivot] = 1.0);
            let with = closure(&all);
            with.iter().zip(&without).map(|(a, b)| a - b).collect()
        });
        let columns: Vec<Vec<f64>> = columns.collect();
        let weights = least::weights(deviations(smooth));
        let coefficients = least::coefficients(&weights, &without, &columns);
        let mut closure = without;
        for (column, coefficient) in columns.iter().zip(&coefficients) {
            closure
                .iter_mut()
                .zip(column)
                .for_each(|(own, part)| *own += coefficient * part);
        }
        Braked {
            coefficients,
            closure,
        }
    }
}

fn deviations(estimate: &Estimate) -> impl Iterator<Item = f64> {
    let rows = estimate.energies.deviations.iter();
    rows.map(|row| row[quantity::CLOSURE])
}

fn closure(estimate: &Estimate) -> Vec<f64> {
    let rows = estimate.energies.means.iter();
    rows.map(|row| row[quantity::CLOSURE]).collect()
}
