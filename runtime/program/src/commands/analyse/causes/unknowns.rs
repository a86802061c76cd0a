//! Causes with an unknown of their own, which the closure tells.

use super::super::estimate::{Estimate, Measured, quantity};
use super::super::least::{self, ClosureUnknown};
use super::super::verdict::Verdict;
use super::{Cause, FRICTION, Unclosed};
use crate::measured_file::MeasuredFile;

impl Unclosed<'_> {
    /// A camera or an encoder that is not plumb, by the angle that comes nearest to closing.
    pub(super) fn tilt(&self, measured: &Measured<'_>, smooth: &Estimate) -> Option<Cause> {
        let unknown = ClosureUnknown {
            largest: 0.8,
            step: 0.2,
            small: 1e-4,
        };
        // Smooth motions are turned with their data: nothing is to be estimated again.
        let closure = |tilt| measured.closure_if(&smooth.motion, tilt, &[]);
        let found = least::value(unknown, &least::weights(deviations(smooth)), closure)?;
        let found = match self.arguments.model {
            true => self.refined(found.to_degrees()),
            false => found.to_degrees(),
        };
        let tilt = self.arguments.measured.tilt.unwrap_or(0.0) + found;
        // Hundredths of a degree are less than measurements tell.
        let tilt = (100.0 * tilt).round() / 100.0;
        let words = format!(
            "links at rest show about {tilt}°, as before a tilted camera or by encoders that are not at zero there"
        );
        let option = format!("--tilt {tilt}");
        Some(self.cause("tilt", words, option, |file| file.tilt = Some(tilt)))
    }

    /// A tilt (degrees) by the closure of the equations of motion, which tell it better, where it does
    /// not close their budget as it is.
    fn refined(&self, tilt: f64) -> f64 {
        const BESIDE: f64 = 0.1;
        let own = &self.arguments.measured;
        let estimate = |tilt: f64| {
            let tilt = Some(own.tilt.unwrap_or(0.0) + tilt);
            let source = self.read(&MeasuredFile {
                tilt,
                ..own.clone()
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

    /// Friction in one of the pivots that is not among the constants, with the largest closure in its
    /// deviations.
    pub(super) fn friction(&self, measured: &Measured<'_>, smooth: &Estimate) -> Vec<(f64, Cause)> {
        let names = self.subject.names();
        let weights = least::weights(deviations(smooth));
        let pivots = names.pivots.iter().zip(&names.frictions).enumerate();
        let causes = pivots.filter_map(|(pivot, (place, option))| {
            let closure = |friction: f64| {
                let mut all = vec![0.0; names.pivots.len()];
                all[pivot] = friction;
                measured.closure_if(&smooth.motion, 0.0, &all)
            };
            // The closure is linear in it.
            let friction = least::step(&weights, &closure(0.0), &closure(1.0));
            let closure = closure(friction);
            let bars = closure.iter().zip(deviations(smooth)).skip(1);
            let bars = bars.map(|(closure, deviation)| closure.abs() / deviation);
            let bars = bars.fold(0.0, f64::max);
            let closes = friction > 0.0 && bars <= self.verdict.allowed;
            let words = format!("friction in {place} is larger by about {friction:.2e} N m s");
            closes.then(|| (bars, self.cause(FRICTION, words, option, |_| {})))
        });
        causes.collect()
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
