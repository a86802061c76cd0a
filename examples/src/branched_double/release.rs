//! One motion of the pendulum, from the release to the end of the observation.

use branched_pendulum::prelude::*;
use branched_pendulum::system::OdeFn;
use branched_pendulum_data::Column;
use branched_pendulum_frame::{Failure, Job};

use super::Arguments;
use super::apparatus::{BranchedDouble, FORMS, POWERS, Sample, parts};

/// Relative error allowed in one integration step; the absolute one is a thousandth of it.
pub const TOLERANCE: f64 = 1e-12;

/// Samples of a motion that began with one release.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Initial angle of the parent link, in degrees.
    pub angle_deg: f64,
    /// The samples, [`RATE`](super::RATE) in each second; the first is taken at the release.
    pub samples: Vec<Sample>,
}

impl Run {
    /// Releases the pendulum from rest at the angle `angle_deg` of the parent.
    ///
    /// The motion is integrated in symmetric coordinates: in these, θ_d is a separate variable and
    /// keeps its relative accuracy however small it is; computed as the difference of two nearly
    /// equal angles, it would lose it. The integrals of all powers are further components of the
    /// state, which makes them as accurate as the motion.
    ///
    /// # Errors
    /// [`Failure::Integration`] if the integrator does not reach the end.
    pub fn new(
        model: &BranchedDouble,
        angle_deg: f64,
        arguments: &Arguments,
    ) -> Result<Self, Failure> {
        let equations = OdeFn::new(
            6 + POWERS,
            |_: f64, state: &[f64], derivatives: &mut [f64]| {
                let (coordinates, rates, _) = parts(state);
                let accelerations = model.symmetric_accelerations(&coordinates, &rates);
                let powers = model.powers(&coordinates, &rates).0;
                let all = rates.into_iter().chain(accelerations).chain(powers);
                for (derivative, value) in derivatives.iter_mut().zip(all) {
                    *derivative = value;
                }
            },
        );
        let mut start = vec![0.0; equations.dimension()];
        start[0] = angle_deg.to_radians();
        start[2] = arguments.disturbance;
        let start = State::new(0.0, start);
        let times = arguments.times();
        let options = Options {
            // The length of a run is the user's choice, not the method's.
            step_limit: u64::MAX,
            ..Options::with_tolerance(TOLERANCE)
        };
        let mut samples = Vec::with_capacity(times.len());
        let measure = |time, state: &[f64]| samples.push(model.measure(time, state));
        let solution = Dop853::new(options).sample(&equations, &start, &times, measure);
        solution.map_err(|error| Failure::integration(angle_deg, error))?;
        Ok(Self { angle_deg, samples })
    }

    /// Returns the angle of release as text, for the names of panels and lines.
    pub fn release(&self) -> String {
        format!("θ_1(0) = {:?}°", self.angle_deg)
    }

    /// Returns the run with only the samples from the time `from` to the time `to`.
    pub fn between(&self, from: f64, to: f64) -> Self {
        let samples = self.samples.iter().copied();
        Self {
            angle_deg: self.angle_deg,
            samples: samples
                .filter(|sample| (from..=to).contains(&sample.time))
                .collect(),
        }
    }

    /// Returns the times of all samples.
    pub fn times(&self) -> Vec<f64> {
        self.column(|sample| sample.time)
    }

    /// Returns one quantity at all samples.
    pub fn column(&self, value: impl Fn(&Sample) -> f64) -> Vec<f64> {
        self.samples.iter().map(value).collect()
    }

    /// Writes the samples as a table.
    ///
    /// # Errors
    /// [`Failure::Csv`] or [`Failure::File`].
    pub fn write(&self, job: &Job) -> Result<(), Failure> {
        let name = format!("samples-{:?}deg.csv", self.angle_deg);
        job.csv(&name, &columns(), |file| {
            let mut samples = self.samples.iter();
            samples.try_for_each(|sample| file.row(row(sample)))
        })
    }
}

/// Returns the columns of the table of samples, in the order of [`row`].
fn columns() -> Vec<Column> {
    let forms = FORMS.map(|form| form.replace(' ', "_"));
    let transfers = forms.map(|form| ["W_K", "W_P", "W"].map(|part| format!("{part}_{form}")));
    let mut columns = Vec::new();
    for (unit, names) in [
        ("s", "time"),
        ("rad", "theta_1 theta_2 theta_3 theta_m theta_d"),
        ("rad/s", "omega_1 omega_2 omega_3 omega_m omega_d"),
        ("kg m^2/s", "p_1 p_m p_d"),
        ("J", "H_d H"),
        ("W", &transfers.concat().join(" ")),
        ("W", "friction_power_on_H_d"),
    ] {
        columns.extend(names.split(' ').map(|name| Column::new(name, unit)));
    }
    columns
}

fn row(sample: &Sample) -> Vec<f64> {
    let [_, omega_m, omega_d] = sample.rates;
    let mut row = vec![sample.time];
    row.extend(sample.theta);
    row.extend([sample.mean, sample.difference]);
    row.extend(sample.omega);
    row.extend([omega_m, omega_d]);
    row.extend(sample.momenta);
    row.extend([sample.antiphase_energy, sample.energy]);
    for form in 0..FORMS.len() {
        let transfer = sample.powers.transfer(form);
        row.extend([transfer.kinetic, transfer.potential, transfer.total()]);
    }
    row.push(sample.powers.friction());
    row
}
