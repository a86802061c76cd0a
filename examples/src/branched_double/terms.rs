//! Terms of the leading order of W, and their presence in the published form.
//!
//! W = a_pp p_d² + a_pq p_d θ_d + a_qq θ_d² + …; the published form contains the first term and the
//! potential part of the second.

use super::apparatus::{Apparatus, DIFFERENCE, EXACT, PUBLISHED, Sample};
use super::experiment::Run;
use super::findings::SMALL_ANGLE;

/// Names of the terms, in the order of [`terms`].
pub const TERMS: [&str; 4] = ["p_d²", "p_dθ_d, P", "p_dθ_d, K", "θ_d²"];

/// Returns the four terms of W (in watts) at a sample: first those of the published form, then
/// those missing from it.
pub fn terms(apparatus: &Apparatus, sample: &Sample) -> [f64; 4] {
    let [_, pq, qq] = apparatus
        .ideal()
        .transfer_quadratic_form(&sample.coordinates, &sample.momenta);
    let (angle, momentum) = (sample.coordinates[DIFFERENCE], sample.momenta[DIFFERENCE]);
    let published = sample.flow.transfer[PUBLISHED];
    [
        published.kinetic,
        published.potential,
        pq * momentum * angle - published.potential,
        qq * angle * angle,
    ]
}

/// Sizes of the terms along a run, relative to the rms of dH_d/dt, until |θ_d| first exceeds
/// [`SMALL_ANGLE`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sizes {
    /// Root mean squares.
    pub rms: [f64; 4],
    /// Largest magnitudes.
    pub largest: [f64; 4],
}

impl Sizes {
    /// Computes the sizes from a run; `None` if H_d does not change.
    pub fn of(apparatus: &Apparatus, run: &Run) -> Option<Self> {
        let (mut squares, mut largest, mut whole) = ([0.0_f64; 4], [0.0_f64; 4], 0.0);
        let small = |sample: &Sample| sample.coordinates[DIFFERENCE].abs() <= SMALL_ANGLE;
        let end = run.samples.iter().position(|sample| !small(sample));
        let samples = &run.samples[..end.unwrap_or(run.samples.len())];
        for sample in samples {
            let terms = terms(apparatus, sample);
            for ((square, most), term) in squares.iter_mut().zip(&mut largest).zip(terms) {
                *square += term * term;
                *most = most.max(term.abs());
            }
            whole += sample.flow.antiphase_rate(EXACT).powi(2);
        }
        let count = samples.len() as f64;
        let scale = (whole / count).sqrt();
        (scale > 0.0).then(|| Self {
            rms: squares.map(|square| (square / count).sqrt() / scale),
            largest: largest.map(|most| most / scale),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{Sizes, terms};
    use crate::branched_double::{Apparatus, Arguments, Friction, Run};

    /// Compares the terms with the formulas of sections 5.3 and 5.4 of the physics page, written
    /// out.
    #[test]
    fn the_terms_are_those_of_the_quadratic_form() {
        let apparatus = Apparatus::new(Friction::default()).unwrap();
        let sample = apparatus.measure(0.0, [0.7, -0.4, 0.02], [1.2, -2.1, 0.09]);
        let found = terms(&apparatus, &sample);
        let model = apparatus.ideal();
        let (m1, m2) = (model.inertia_parent(), model.inertia_child());
        let (mu, g2) = (model.coupling_child_parent(), model.gravity_child());
        let [p1, pm, pd] = sample.momenta;
        let (s, c) = (-0.4_f64 - 0.7).sin_cos();
        let d = 2.0 * m1 * m2 - 4.0 * mu * mu * c * c;
        let x = m2 * p1 - mu * c * pm;
        let (w1, wm) = (2.0 * x / d, (m1 * pm - 2.0 * mu * c * p1) / d);
        let expected = [
            -mu * s * x * pd * pd / (m2 * m2 * d),
            g2 / m2 * (1.0 - (-0.4_f64).cos()) * pd * 0.02,
            -(mu * mu * s * s * w1 * w1 / (m2 * m2) + mu * c * w1 * wm / m2) * pd * 0.02,
            4.0 * g2 * mu * s * x * 0.02 * 0.02 / (m2 * d),
        ];
        let sum: f64 = found.iter().sum();
        let whole = sample.flow.transfer[1].total();
        assert!((sum / whole - 1.0).abs() < 1e-12, "{sum}, {whole}");
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found / expected - 1.0).abs() < 1e-12,
                "{found}, {expected}"
            );
        }
    }

    #[test]
    fn sizes_do_not_depend_on_a_small_amplitude() {
        let apparatus = Apparatus::new(Friction::default()).unwrap();
        let sizes = |disturbance: f64| {
            let arguments = Arguments {
                disturbance,
                duration: 4.0,
                ..Arguments::default()
            };
            let run = Run::new(30.0, &arguments, |_| ()).unwrap();
            Sizes::of(&apparatus, &run)
        };
        let (small, smaller) = (sizes(1e-4).unwrap(), sizes(1e-5).unwrap());
        for (a, b) in small.rms.iter().zip(smaller.rms) {
            assert!((a / b - 1.0).abs() < 1e-4, "{a}, {b}");
        }
        for (rms, largest) in small.rms.iter().zip(small.largest) {
            assert!(largest > *rms);
        }
        assert_eq!(sizes(0.0), None);
    }
}
