//! Findings of a run: growth, first peak, source of the energy, and error of each form of W.

use branched_pendulum::Transfer;
use branched_pendulum::analysis::{Modes, ModesError};

use super::apparatus::{DIFFERENCE, EXACT, FORMS, Flow, MEAN, PUBLISHED, Sample, folded};
use super::experiment::Run;
use super::scenes::BranchedDouble;

/// Duration (s) before and after a maximum of H_d within which H_d must not exceed it for it to
/// count as the first peak. H_d grows in pulses, about two seconds apart; a pulse followed by a
/// much larger one is not yet the peak.
pub const PEAK_REACH: f64 = 2.0;

/// Angle (rad) that |θ_d| must not yet have exceeded while the forms of W are compared: all forms
/// except the exact one are expansions for small θ_d, and mean nothing when the children turn over.
pub const SMALL_ANGLE: f64 = 0.5;

/// Findings of one run. A field is `None` if its number has no meaning, for example the growth of a
/// disturbance of zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Findings {
    /// Largest |θ_d| of the run (folded to π/2 at most), divided by |θ_d(0)|.
    pub growth: Option<f64>,
    /// The first peak of H_d.
    pub peak: Option<Peak>,
    /// For each form of W: the root mean square of its difference from dH_d/dt, divided by the root
    /// mean square of dH_d/dt. Both are means over a sampling interval: the integral of W over it,
    /// and the change of H_d. With friction, its power on H_d is added to W. Only samples before
    /// |θ_d| first exceeds [`SMALL_ANGLE`] are used.
    pub deviations: [Option<f64>; FORMS.len()],
    /// Largest difference between the energy and the initial energy less the losses by friction,
    /// divided by the initial energy.
    pub energy_error: Option<f64>,
}

/// The first peak of H_d.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Index of the sample.
    pub sample: usize,
    /// Time, s.
    pub time: f64,
    /// H_d, J.
    pub energy: f64,
    /// Largest |θ_m| until then, rad.
    pub largest_mean: f64,
    /// Energy (J) transferred up to the peak according to each form of W, split into kinetic and
    /// potential part.
    pub transferred: [Transfer<f64>; FORMS.len()],
    /// Energy (J) that friction has added to the antiphase mode up to the peak; zero or negative.
    pub friction: f64,
}

impl Peak {
    /// Returns the shares of W_K and W_P in the energy transferred according to a form of W.
    pub fn shares(&self, form: usize) -> Option<(f64, f64)> {
        let transfer = self.transferred.get(form)?;
        let total = transfer.total();
        let shares = (transfer.kinetic / total, transfer.potential / total);
        (shares.0.is_finite() && shares.1.is_finite()).then_some(shares)
    }

    /// Returns the shares of W_K and W_P according to the form published in the paper.
    pub fn published_shares(&self) -> Option<(f64, f64)> {
        self.shares(PUBLISHED)
    }

    /// Returns the shares of W_K and W_P according to the exact form.
    pub fn exact_shares(&self) -> Option<(f64, f64)> {
        self.shares(EXACT)
    }
}

impl Findings {
    /// Reads a run.
    pub fn new(run: &Run) -> Self {
        Self {
            growth: growth(&run.samples),
            peak: peak(run),
            deviations: std::array::from_fn(|form| deviation(run, form)),
            energy_error: energy_error(run),
        }
    }
}

fn growth(samples: &[Sample]) -> Option<f64> {
    let size = |sample: &Sample| folded(sample.coordinates[DIFFERENCE]).abs();
    let largest = samples.iter().map(size).fold(0.0, f64::max);
    ratio(largest, samples.first().map_or(0.0, size))
}

fn peak(run: &Run) -> Option<Peak> {
    let sample = first_peak(&run.samples)?;
    let until = run.samples.get(..=sample)?;
    let at = until.last()?;
    let mut flowed = Flow::default();
    for flow in run.intervals.iter().take(sample) {
        flowed.add(1.0, flow);
    }
    Some(Peak {
        sample,
        time: at.time,
        energy: at.antiphase_energy,
        largest_mean: until
            .iter()
            .map(|sample| sample.coordinates[MEAN].abs())
            .fold(0.0, f64::max),
        transferred: flowed.transfer,
        friction: flowed.antiphase_friction,
    })
}

/// Returns the index of the first maximum of H_d that is not exceeded within [`PEAK_REACH`] before
/// and after it, as far as there are samples.
fn first_peak(samples: &[Sample]) -> Option<usize> {
    let is_peak = |index: usize| {
        let (before, rest) = samples.split_at_checked(index)?;
        let (at, after) = rest.split_first()?;
        let near = |other: &&Sample| (other.time - at.time).abs() <= PEAK_REACH;
        let neighbours = before.iter().rev().take_while(near);
        let mut neighbours = neighbours.chain(after.iter().take_while(near));
        let rises = before.last()?.antiphase_energy < at.antiphase_energy;
        let falls = after.first()?.antiphase_energy <= at.antiphase_energy;
        let lower = |other: &Sample| other.antiphase_energy <= at.antiphase_energy;
        (rises && falls && neighbours.all(lower)).then_some(index)
    };
    (0..samples.len()).find_map(is_peak)
}

fn deviation(run: &Run, form: usize) -> Option<f64> {
    let is_small = |pair: &&[Sample]| {
        let mut angles = pair.iter().map(|sample| sample.coordinates[DIFFERENCE]);
        angles.all(|angle| angle.abs() <= SMALL_ANGLE)
    };
    let changes = run.samples.windows(2).take_while(is_small);
    let changes = changes.zip(&run.intervals);
    let (mut difference, mut whole) = (0.0, 0.0);
    for (pair, flow) in changes {
        let &[before, after] = pair else { continue };
        let change = after.antiphase_energy - before.antiphase_energy;
        difference += (flow.antiphase_rate(form) - change).powi(2);
        whole += change.powi(2);
    }
    ratio(difference.sqrt(), whole.sqrt())
}

fn energy_error(run: &Run) -> Option<f64> {
    let mut samples = run.samples.iter();
    let initial = samples.next()?.energy;
    let mut expected = initial;
    let mut largest = 0.0_f64;
    for (sample, flow) in samples.zip(&run.intervals) {
        expected += flow.friction;
        largest = largest.max((sample.energy - expected).abs());
    }
    ratio(largest, initial)
}

fn ratio(part: f64, whole: f64) -> Option<f64> {
    let ratio = part / whole;
    ratio.is_finite().then_some(ratio)
}

/// The three eigenfrequencies, Hz.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frequencies {
    /// f_+: frequency of the slower in-phase mode.
    pub plus: f64,
    /// f_−: frequency of the faster in-phase mode.
    pub minus: f64,
    /// f_d: the antiphase mode.
    pub antiphase: f64,
}

impl Frequencies {
    /// Frequencies that the paper measured.
    pub const MEASURED: Self = Self {
        plus: 0.88,
        minus: 1.58,
        antiphase: 1.26,
    };

    /// Computes the frequencies of the small oscillations about the rest position.
    ///
    /// # Errors
    /// As [`Modes::new`].
    pub fn of(model: &BranchedDouble) -> Result<Self, ModesError> {
        let rest = [0.0; 3];
        let modes = Modes::new(&model.mass_matrix(&rest), &model.stiffness_matrix(&rest))?;
        // In the antiphase mode the children move against each other.
        let difference = |shape: &[f64]| match shape {
            &[_, theta_2, theta_3] => (theta_2 - theta_3).abs(),
            _ => f64::NAN,
        };
        let antiphase = (0..modes.shapes.len())
            .max_by(|&a, &b| difference(&modes.shapes[a]).total_cmp(&difference(&modes.shapes[b])));
        let mut in_phase = Vec::new();
        let mut frequencies = Self {
            plus: f64::NAN,
            minus: f64::NAN,
            antiphase: f64::NAN,
        };
        for (index, &frequency) in modes.frequencies_hz.iter().enumerate() {
            if Some(index) == antiphase {
                frequencies.antiphase = frequency;
            } else {
                in_phase.push(frequency);
            }
        }
        if let &[plus, minus] = in_phase.as_slice() {
            (frequencies.plus, frequencies.minus) = (plus, minus);
        }
        Ok(frequencies)
    }
}

#[cfg(test)]
mod tests {
    use super::{Findings, first_peak};
    use crate::branched_double::{Apparatus, Friction, Run, Sample, Work};

    /// Creates samples every 0.1 s with these values of H_d.
    fn samples(energies: &[f64]) -> Vec<Sample> {
        let apparatus = Apparatus::new(Friction::default()).unwrap();
        let rest = apparatus.measure(0.0, [0.0; 3], [0.0; 3]);
        let numbered = energies.iter().enumerate();
        numbered
            .map(|(index, &antiphase_energy)| Sample {
                time: 0.1 * index as f64,
                antiphase_energy,
                ..rest
            })
            .collect()
    }

    fn pulses(length: usize, pulses: &[(usize, f64)]) -> Vec<Sample> {
        let mut energies = vec![0.0; length];
        for &(at, height) in pulses {
            energies[at] = height;
        }
        samples(&energies)
    }

    #[test]
    fn the_first_peak_is_the_first_that_nothing_near_exceeds() {
        for (case, expected) in [
            (&[(7, 1.0)][..], Some(7)),
            // Dwarfed within two seconds, twice.
            (&[(7, 1.0), (20, 2.0), (38, 3.0)], Some(38)),
            // The second comes too late.
            (&[(7, 1.0), (40, 2.0)], Some(7)),
            (&[(40, 1.0), (30, 2.0)], Some(30)),
            // Falls from the start, then rises.
            (&[(0, 5.0), (50, 1.0)], Some(50)),
            (&[(0, 5.0), (5, 1.0)], None),
            // Still rising at the end.
            (&[(98, 1.0), (99, 2.0)], None),
        ] {
            assert_eq!(first_peak(&pulses(100, case)), expected, "{case:?}");
        }
        assert_eq!(first_peak(&[]), None);
    }

    #[test]
    fn a_pendulum_at_rest_has_no_findings() {
        let run = Run {
            angle_deg: 0.0,
            samples: samples(&[0.0; 50]),
            intervals: vec![Default::default(); 49],
            work: Work::default(),
        };
        let findings = Findings::new(&run);
        assert_eq!(findings.growth, None);
        assert_eq!(findings.peak, None);
        assert_eq!(findings.deviations, [None; 3]);
        assert_eq!(findings.energy_error, None);
    }
}
