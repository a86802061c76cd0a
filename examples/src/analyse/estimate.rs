//! H_d and W of the apparatus from measured angles, with their errors.

use branched_pendulum::analysis::variational::linearised;
use branched_pendulum::analysis::{Bands, KinematicSmoother, ModelSmoother, SmoothedMotion, bands};
use branched_pendulum::prelude::{AbsoluteAngles, Rk4};
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use crate::branched_double::Apparatus;
use crate::branched_double::apparatus::EXACT;
use crate::failure::Failure;

/// Indices of the quantities in [`Estimate::bands`].
pub mod quantity {
    /// Rates of θ_1, θ_m, θ_d, rad/s.
    pub const RATES: usize = 0;
    /// H_d, J.
    pub const ENERGY: usize = 3;
    /// W, exact, W.
    pub const TRANSFER: usize = 4;
    /// ∫ (W + power of friction on H_d) dt since the first time, J.
    pub const FLOWED: usize = 5;
    /// That less the change of H_d: zero but for errors, J.
    pub const CLOSURE: usize = 6;
    /// Their number.
    pub const COUNT: usize = 7;
}

/// The motion of the apparatus as data tell it.
#[derive(Clone, Debug)]
pub struct Estimate {
    /// What follows from the motion: [`quantity`] says which stands where.
    pub bands: Bands<{ quantity::COUNT }>,
    /// Standard deviation of the links' angles that was found, rad.
    pub noise: f64,
    /// Correlation of successive innovations in standard deviations, the largest.
    pub whiteness: f64,
    /// θ_1, θ_m, θ_d and their rates.
    pub motion: Vec<[f64; 6]>,
}

/// Longest step from picture to picture, s: its error is far below that of any camera.
const LONGEST_STEP: f64 = 2e-3;

/// Draws whose mean and deviation are told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Draws {
    /// Their number.
    pub count: usize,
    /// Seed of their random numbers.
    pub seed: u64,
}

/// What a camera has measured.
#[derive(Clone, Copy, Debug)]
pub struct Measured<'a> {
    /// The apparatus.
    pub apparatus: &'a Apparatus,
    /// Times, s.
    pub times: &'a [f64],
    /// Angles of the links, rad.
    pub angles: &'a [[Option<f64>; 3]],
}

impl Measured<'_> {
    /// Estimates the motion knowing only that it is smooth, in symmetric coordinates; a
    /// picture that lacks a link counts as missing.
    ///
    /// # Errors
    /// [`Failure::Smoothing`].
    pub fn by_smoothness(&self, draws: Draws) -> Result<Estimate, Failure> {
        let symmetric = |angles: &[Option<f64>; 3]| match *angles {
            [Some(one), Some(two), Some(three)] => {
                Some(self.apparatus.ideal().to_symmetric(&[one, two, three]))
            }
            _ => None,
        };
        let data: Vec<Option<[f64; 3]>> = self.angles.iter().map(symmetric).collect();
        let smooth = |coordinate: usize| {
            let data: Vec<Option<f64>> = data
                .iter()
                .map(|all| all.map(|all| all[coordinate]))
                .collect();
            KinematicSmoother::default().smooth(self.times, &data)
        };
        let series = [smooth(0)?, smooth(1)?, smooth(2)?];
        let joined = |[a, b, c]: [[f64; 3]; 3]| [a[0], b[0], c[0], a[1], b[1], c[1]];
        let mut random = Xoshiro256PlusPlus::seed_from_u64(draws.seed);
        let mut normal = || StandardNormal.sample(&mut random);
        let (bands, _) = bands(draws.count, || {
            let motion = series.each_ref().map(|series| series.draw(&mut normal));
            let at = |index: usize| joined(motion.each_ref().map(|series| series[index]));
            self.quantities((0..self.times.len()).map(at))
        });
        let at = |index: usize| joined(series.each_ref().map(|series| series.mean(index)));
        let white = series.iter().map(SmoothedMotion::whiteness);
        Ok(Estimate {
            bands,
            noise: series[0].noise(),
            whiteness: white.fold(0.0, |a, b| if b.abs() > f64::abs(a) { b } else { a }),
            motion: (0..self.times.len()).map(at).collect(),
        })
    }

    /// Estimates the motion with the equations of motion of the apparatus, beginning from an
    /// estimate without them.
    ///
    /// # Errors
    /// [`Failure::Smoothing`].
    pub fn by_model(&self, guess: &Estimate, draws: Draws) -> Result<Estimate, Failure> {
        let ideal = self.apparatus.ideal();
        let links = |[a, b, c, d, e, f]: [f64; 6]| {
            let theta = ideal.from_symmetric(&[a, b, c]);
            let omega = ideal.from_symmetric(&[d, e, f]);
            [theta[0], theta[1], theta[2], omega[0], omega[1], omega[2]]
        };
        let symmetric = |[a, b, c, d, e, f]: [f64; 6]| {
            let q = ideal.to_symmetric(&[a, b, c]);
            let v = ideal.to_symmetric(&[d, e, f]);
            [q[0], q[1], q[2], v[0], v[1], v[2]]
        };
        let guess: Vec<[f64; 6]> = guess.motion.iter().copied().map(links).collect();
        let method = Rk4::new(LONGEST_STEP);
        let smoother = ModelSmoother::default();
        let (times, data) = (self.times, self.angles);
        let motion = match self.apparatus.damped() {
            Some(model) => {
                let system = linearised(AbsoluteAngles(model));
                smoother.smooth(&method, &system, times, data, &guess)?
            }
            None => {
                let system = linearised(AbsoluteAngles(ideal));
                smoother.smooth(&method, &system, times, data, &guess)?
            }
        };
        let mut random = Xoshiro256PlusPlus::seed_from_u64(draws.seed);
        let (bands, _) = bands(draws.count, || {
            let drawn = motion.draw(|| StandardNormal.sample(&mut random));
            self.quantities(drawn.into_iter().map(symmetric))
        });
        Ok(Estimate {
            bands,
            noise: motion.noise(),
            whiteness: motion.whiteness(),
            motion: (0..times.len())
                .map(|index| symmetric(motion.mean(index)))
                .collect(),
        })
    }

    /// The quantities of one motion.
    fn quantities(&self, motion: impl Iterator<Item = [f64; 6]>) -> Vec<[f64; quantity::COUNT]> {
        let apparatus = self.apparatus;
        let mut before: Option<(f64, f64)> = None;
        let (mut flowed, mut start) = (0.0, 0.0);
        let row = |(state, &time): ([f64; 6], &f64)| {
            let [a, b, c, d, e, f] = state;
            let (coordinates, rates) = ([a, b, c], [d, e, f]);
            let energy = apparatus.antiphase_energy(&coordinates, &rates);
            let flow = apparatus.flow(&coordinates, &rates);
            let rate = flow.antiphase_rate(EXACT);
            match before {
                None => start = energy,
                Some((last, earlier)) => flowed += 0.5 * (rate + earlier) * (time - last),
            }
            before = Some((time, rate));
            let transfer = flow.transfer[EXACT].total();
            [d, e, f, energy, transfer, flowed, flowed - (energy - start)]
        };
        motion.zip(self.times).map(row).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::camera::{Camera, Release, motion};
    use super::{Estimate, quantity};
    use crate::branched_double::{Apparatus, Friction, Sample};

    fn rms(values: impl Iterator<Item = f64>) -> f64 {
        let (sum, count) = values.fold((0.0, 0), |(sum, count), v| (sum + v * v, count + 1));
        (sum / f64::from(count)).sqrt()
    }

    #[test]
    fn table() {
        let apparatus = Apparatus::new(Friction::default()).unwrap();
        let damped = Apparatus::new(Friction {
            root: 0.0,
            children: 3.5e-5,
        })
        .unwrap();
        let draws = super::Draws { count: 50, seed: 1 };
        for difference in [1e-2, 1e-3] {
            let rate = 240.0;
            let release = Release {
                angle_deg: 47.8,
                difference,
                duration: 4.0,
            };
            for (name, real) in [("right model", &apparatus), ("friction lacking", &damped)] {
                let truth: Vec<Sample> = motion(real, release, rate).unwrap();
                let times: Vec<f64> = truth.iter().map(|s| s.time).collect();
                for noise in [2e-4] {
                    for seed in 0..1 {
                        let camera = Camera {
                            rate,
                            noise,
                            distance: 0.25,
                            seed,
                        };
                        let angles = camera.angles(&truth);
                        let measured = super::Measured {
                            apparatus: &apparatus,
                            times: &times,
                            angles: &angles,
                        };
                        let b = measured.by_smoothness(draws).unwrap();
                        let started = std::time::Instant::now();
                        let c = measured.by_model(&b, draws).unwrap();
                        let spent = started.elapsed();
                        let w = |i: usize| truth[i].flow.transfer[2].total();
                        let n = times.len();
                        let error = |e: &super::Estimate| {
                            rms((0..n).map(|i| e.bands.means[i][quantity::TRANSFER] - w(i)))
                                / rms((0..n).map(w))
                        };
                        println!(
                            "d {difference} {name}: W smooth {:.5} model {:.5}, white {:.1} {:.1}, noise {:.2e} of {:.2e}, {spent:?}",
                            error(&b),
                            error(&c),
                            b.whiteness,
                            c.whiteness,
                            c.noise,
                            camera.angle_noise()
                        );
                    }
                }
            }
        }
    }
}
