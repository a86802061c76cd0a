//! Tongues of instability: intervals of releases from which differences between copies grow.

use super::prediction::{DegreeEstimate, Prediction};
use super::refusal::Refusal;
use super::resonance::Resonance;

/// Tongue: an interval on a line of releases from which differences grow.
#[derive(Clone, Debug, PartialEq)]
pub struct Tongue {
    /// Parameter of the line at its lower and upper edge.
    pub edges: [DegreeEstimate; 2],
    /// For each edge, true if it is the end of the line, or the start of a part without
    /// predictions, instead of an edge of the tongue.
    pub is_cut: [bool; 2],
    /// Parameter at which the growth rate is largest.
    pub at: f64,
    /// Prediction there.
    pub largest: Prediction,
}

/// Tongues along a line of releases, and the parts of the line without a prediction.
#[derive(Clone, Debug, PartialEq)]
pub struct Tongues {
    /// The tongues, by ascending parameter.
    pub tongues: Vec<Tongue>,
    /// First and last sample of each part without a prediction, with the first reason. This
    /// includes parts in which only one of the two degrees has growth.
    pub refused: Vec<([f64; 2], Refusal)>,
}

/// Largest number of steps by which an edge is located, and the distance between two steps,
/// relative to that of the samples, at which it counts as found.
const STEPS: usize = 14;
const FOUND: f64 = 1e-9;

impl Tongue {
    /// Returns the resonance.
    pub fn resonance(&self) -> Option<&Resonance> {
        self.largest.resonance.as_ref()
    }

    /// Returns the larger error bar of the two edges.
    pub fn edge_error(&self) -> f64 {
        let errors = self.edges.iter().zip(self.is_cut);
        let errors = errors.map(|(edge, is_cut)| if is_cut { 0.0 } else { edge.error() });
        errors.fold(0.0, f64::max)
    }
}

impl Tongues {
    /// Finds the tongues on a line of releases, in which the growth rate is at least `least` (1/s).
    /// `samples` are ascending parameters of the line; edges are located between them by the secant
    /// method with weighted ends (Illinois). A tongue that lies between two samples is not found.
    pub fn along(
        samples: &[f64],
        least: f64,
        predict: impl Fn(f64) -> Result<Prediction, Refusal>,
    ) -> Self {
        let found: Vec<Result<Prediction, Refusal>> = samples.iter().map(|s| predict(*s)).collect();
        let of = |own: &Prediction, part: fn(&DegreeEstimate) -> f64| part(&own.excess(least));
        let excess = |index: usize, part: fn(&DegreeEstimate) -> f64| match &found[index] {
            Ok(own) => of(own, part),
            Err(_) => f64::NAN,
        };
        let edge = |inside: usize, outside: usize, part: fn(&DegreeEstimate) -> f64| {
            let [mut inner, mut outer] =
                [inside, outside].map(|index| (samples[index], excess(index, part)));
            let width = (outer.0 - inner.0).abs();
            let mut last = (f64::NAN, true);
            for _ in 0..STEPS {
                let secant = inner.0 - inner.1 * (outer.0 - inner.0) / (outer.1 - inner.1);
                // Without a resonance the excess is −∞.
                let at = match outer.1.is_finite() && secant.is_finite() {
                    true => secant,
                    false => 0.5 * (inner.0 + outer.0),
                };
                let Ok(prediction) = predict(at) else {
                    return 0.5 * (inner.0 + outer.0);
                };
                let value = of(&prediction, part);
                let is_inside = value >= 0.0;
                let (moved, kept) = match is_inside {
                    true => (&mut inner, &mut outer),
                    false => (&mut outer, &mut inner),
                };
                *moved = (at, value);
                if is_inside == last.1 && !last.0.is_nan() {
                    kept.1 *= 0.5;
                }
                if (at - last.0).abs() <= FOUND * width || value == 0.0 {
                    return at;
                }
                last = (at, is_inside);
            }
            0.5 * (inner.0 + outer.0)
        };
        let windows = |part: fn(&DegreeEstimate) -> f64| {
            let mut windows: Vec<[usize; 2]> = Vec::new();
            for index in (0..samples.len()).filter(|index| excess(*index, part) >= 0.0) {
                match windows.last_mut() {
                    Some(last) if last[1] + 1 == index => last[1] = index,
                    _ => windows.push([index; 2]),
                }
            }
            windows
        };
        let edges = |[first, last]: [usize; 2], part: fn(&DegreeEstimate) -> f64| {
            let outside = [
                first.checked_sub(1),
                Some(last + 1).filter(|own| *own < samples.len()),
            ];
            let both = [first, last].into_iter().zip(outside);
            let both = both.map(|(inside, outside)| match outside {
                Some(outside) if found[outside].is_ok() => (edge(inside, outside, part), false),
                _ => (samples[inside], true),
            });
            let both: Vec<(f64, bool)> = both.collect();
            [both[0], both[1]]
        };
        let [value, before]: [fn(&DegreeEstimate) -> f64; 2] = [|own| own.value, |own| own.before];
        let [lower, higher] = [windows(before), windows(value)];
        let meets =
            |one: &[usize; 2], other: &[usize; 2]| one[0] <= other[1] + 1 && other[0] <= one[1] + 1;
        let tongues = higher.iter().filter_map(|window| {
            let [first, last] = *window;
            let other = edges(*lower.iter().find(|own| meets(own, window))?, before);
            let own = edges(*window, value);
            let estimate = |side: usize| DegreeEstimate::of([other[side].0, own[side].0]);
            let rate = |index: &usize| excess(*index, value);
            let at = (first..=last).max_by(|a, b| rate(a).total_cmp(&rate(b)))?;
            Some(Tongue {
                edges: [estimate(0), estimate(1)],
                is_cut: [0, 1].map(|side| own[side].1 || other[side].1),
                at: samples[at],
                largest: found[at].clone().ok()?,
            })
        });
        let tongues = tongues.collect();
        let alone = |one: &[[usize; 2]], other: &[[usize; 2]]| -> Vec<[usize; 2]> {
            let alone = one
                .iter()
                .filter(|own| !other.iter().any(|other| meets(own, other)));
            alone.copied().collect()
        };
        let alone = [alone(&lower, &higher), alone(&higher, &lower)].concat();
        let refused = refusals(samples, &found, &alone);
        Self { tongues, refused }
    }
}

/// Joins samples without a prediction; in the intervals `alone` of indices one degree has growth.
fn refusals(
    samples: &[f64],
    found: &[Result<Prediction, Refusal>],
    alone: &[[usize; 2]],
) -> Vec<([f64; 2], Refusal)> {
    let mut refused: Vec<([f64; 2], Refusal)> = Vec::new();
    let mut before = None;
    for (index, (sample, prediction)) in samples.iter().zip(found).enumerate() {
        let is_alone = alone
            .iter()
            .any(|[first, last]| (*first..=*last).contains(&index));
        let refusal = match prediction {
            Err(refusal) => refusal,
            Ok(_) if is_alone => &Refusal::OneDegree,
            Ok(_) => continue,
        };
        match refused.last_mut() {
            Some((range, _)) if before == index.checked_sub(1) => range[1] = *sample,
            _ => refused.push(([*sample; 2], refusal.clone())),
        }
        before = Some(index);
    }
    refused
}
