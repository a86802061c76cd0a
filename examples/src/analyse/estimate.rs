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
    use super::super::arguments::Arguments;
    use super::super::report::{Trust, transfer_error};
    use super::super::source::Source;
    use super::{Draws, Estimate, Measured};
    use crate::branched_double::{Apparatus, Friction};

    const DRAWS: Draws = Draws { count: 50, seed: 7 };

    /// Looks with the simulated camera at an apparatus, and analyses it as one without
    /// friction.
    fn estimates(arguments: &Arguments, real: Friction, models: bool) -> (Source, Vec<Estimate>) {
        let apparatus = Apparatus::new(Friction::default()).unwrap();
        let source = Source::new(arguments, &Apparatus::new(real).unwrap()).unwrap();
        let measured = Measured {
            apparatus: &apparatus,
            times: &source.times,
            angles: &source.angles,
        };
        let mut all = vec![measured.by_smoothness(DRAWS).unwrap()];
        if models {
            all.push(measured.by_model(&all[0], DRAWS).unwrap());
        }
        (source, all)
    }

    /// The median of five cameras.
    fn median(mut of: impl FnMut(u64) -> [f64; 2]) -> [f64; 2] {
        let mut all: Vec<[f64; 2]> = (0..5).map(&mut of).collect();
        [0, 1].map(|index| {
            all.sort_by(|a, b| a[index].total_cmp(&b[index]));
            all[2][index]
        })
    }

    #[test]
    fn transfer_from_smoothness() {
        for (difference, rate, bounds) in [
            (1e-2, 240.0, [0.015, 0.02]),
            (1e-2, 60.0, [0.025, 0.03]),
            (1e-3, 240.0, [0.05, 0.05]),
        ] {
            let [transfer, closure] = median(|seed| {
                let arguments = Arguments {
                    difference,
                    rate,
                    seed,
                    ..Arguments::default()
                };
                let (source, all) = estimates(&arguments, Friction::default(), false);
                [
                    transfer_error(&source, &all[0]).unwrap(),
                    Trust::of(&all[0]).closure,
                ]
            });
            assert!(
                transfer < bounds[0] && closure < bounds[1],
                "{rate} {transfer} {closure}"
            );
            // Not by far, or the bounds would tell nothing.
            assert!(3.0 * transfer > bounds[0], "{rate} {transfer}");
        }
    }

    #[test]
    fn the_right_model_is_worth_a_factor_ten_and_a_wrong_one_is_no_loss() {
        let arguments = Arguments {
            rate: 60.0,
            ..Arguments::default()
        };
        let (source, all) = estimates(&arguments, Friction::default(), true);
        let errors = all.iter().map(|one| transfer_error(&source, one).unwrap());
        let errors: Vec<f64> = errors.collect();
        assert!(
            errors[1] < 2e-3 && errors[1] < 0.1 * errors[0],
            "{errors:?}"
        );

        let real = Friction {
            root: 0.0,
            children: 1e-5,
        };
        let (source, all) = estimates(&arguments, real, true);
        let errors = all.iter().map(|one| transfer_error(&source, one).unwrap());
        let errors: Vec<f64> = errors.collect();
        assert!(errors[1] < errors[0], "{errors:?}");
    }
}
