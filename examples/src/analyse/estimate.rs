//! A motion, its energy and power from measured angles, with their errors.

use branched_pendulum::analysis::{
    Bands, KinematicSmoother, LocalPolynomials, SmoothedCoordinates, SmoothedMotion,
    SmoothingError, bands, running_integral,
};
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use super::subject::{Motion, Record, Subject};
use crate::failure::Failure;

/// Indices of the quantities in [`Estimate::energies`].
pub mod quantity {
    /// The energy, J: of a branched pendulum H_d, of a chain H.
    pub const ENERGY: usize = 0;
    /// The power, W: of a branched pendulum W, of a chain that of friction.
    pub const POWER: usize = 1;
    /// Integral since the first time of all power that changes the energy, J.
    pub const FLOWED: usize = 2;
    /// That less the change of the energy: zero but for errors, J.
    pub const CLOSURE: usize = 3;
    /// Their number.
    pub const COUNT: usize = 4;
}

/// A motion as data tell it.
#[derive(Clone, Debug)]
pub struct Estimate<const N: usize> {
    /// Rates of the coordinates, rad/s.
    pub rates: Bands<N>,
    /// Quantities that follow from the motion: [`quantity`] says which stands where.
    pub energies: Bands<{ quantity::COUNT }>,
    /// Standard deviation of the links' angles that was found, rad.
    pub noise: f64,
    /// Correlation of successive innovations in standard deviations, the largest; NaN where
    /// nothing is foretold.
    pub whiteness: f64,
    /// The likeliest motion.
    pub motion: Vec<Motion<N>>,
}

/// Draws whose mean and deviation are told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Draws {
    /// Their number.
    pub count: usize,
    /// Seed of their random numbers.
    pub seed: u64,
}

/// Measured angles of a pendulum.
#[derive(Clone, Copy)]
pub struct Measured<'a, const N: usize> {
    /// The pendulum.
    pub subject: &'a dyn Subject<N>,
    /// The angles.
    pub record: Record<'a, N>,
}

/// Quantities that are told of a motion beside itself.
struct Told {
    noise: f64,
    whiteness: f64,
}

impl<const N: usize> Measured<'_, N> {
    /// Estimates the motion knowing only that it is smooth, each coordinate by itself; a
    /// picture that lacks a link counts as missing.
    ///
    /// # Errors
    /// [`Failure::Smoothing`].
    pub fn by_smoothness(&self, draws: Draws) -> Result<Estimate<N>, Failure> {
        self.separately(draws, |times, data| {
            KinematicSmoother::default().smooth(times, data)
        })
    }

    /// Estimates the motion by polynomials near each time, otherwise likewise.
    ///
    /// # Errors
    /// [`Failure::Smoothing`].
    pub fn by_polynomials(&self, draws: Draws) -> Result<Estimate<N>, Failure> {
        self.separately(draws, |times, data| {
            LocalPolynomials::default().smooth(times, data)
        })
    }

    /// Estimates the motion with the equations of motion, beginning from an estimate without
    /// them.
    ///
    /// # Errors
    /// [`Failure::Smoothing`].
    pub fn by_model(&self, guess: &Estimate<N>, draws: Draws) -> Result<Estimate<N>, Failure> {
        let subject = self.subject;
        let guess = guess.motion.iter();
        let guess: Vec<Motion<N>> = guess
            .map(|motion| motion.each_ref().map(|part| subject.links(part)))
            .collect();
        let found = subject.by_model(self.record, &guess)?;
        let symmetric = |motion: Vec<Motion<N>>| -> Vec<Motion<N>> {
            let states = motion.iter();
            states
                .map(|state| state.each_ref().map(|part| subject.coordinates(part)))
                .collect()
        };
        let told = Told {
            noise: found.noise,
            whiteness: found.whiteness,
        };
        let draw = |normal: &mut dyn FnMut() -> f64| symmetric((found.draw)(normal));
        Ok(self.estimate(draws, told, symmetric(found.mean.clone()), draw))
    }

    fn separately(
        &self,
        draws: Draws,
        smooth: impl Fn(&[f64], &[Option<f64>]) -> Result<SmoothedMotion<3>, SmoothingError>,
    ) -> Result<Estimate<N>, Failure> {
        let times = self.record.times;
        let whole = |angles: &[Option<f64>; N]| -> Option<[f64; N]> {
            let mut links = [0.0; N];
            for (link, angle) in links.iter_mut().zip(angles) {
                *link = (*angle)?;
            }
            Some(self.subject.coordinates(&links))
        };
        let data: Vec<Option<[f64; N]>> = self.record.angles.iter().map(whole).collect();
        let of = |coordinate: usize| -> Vec<Option<f64>> {
            data.iter()
                .map(|all| all.map(|all| all[coordinate]))
                .collect()
        };
        let smoothed = SmoothedCoordinates::new((0..N).map(of), |data| smooth(times, data))?;
        let noise = smoothed.coordinates().first().map(SmoothedMotion::noise);
        let told = Told {
            noise: noise.unwrap_or(f64::NAN),
            whiteness: smoothed.whiteness(),
        };
        let parted = |state: Vec<f64>| -> Motion<N> {
            [0, N].map(|first| std::array::from_fn(|of| state[first + of]))
        };
        let motion = (0..times.len()).map(|time| parted(smoothed.mean(time)));
        let draw = |normal: &mut dyn FnMut() -> f64| {
            smoothed.draw(normal).into_iter().map(parted).collect()
        };
        Ok(self.estimate(draws, told, motion.collect(), draw))
    }

    /// Tells what follows from draws. They are drawn twice, with the same random numbers,
    /// rather than kept.
    fn estimate(
        &self,
        Draws { count, seed }: Draws,
        told: Told,
        motion: Vec<Motion<N>>,
        draw: impl Fn(&mut dyn FnMut() -> f64) -> Vec<Motion<N>>,
    ) -> Estimate<N> {
        let normal = || {
            let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
            move || StandardNormal.sample(&mut random)
        };
        let mut numbers = normal();
        let (rates, _) = bands(count, || {
            let motion = draw(&mut numbers);
            motion.iter().map(|[_, rates]| *rates).collect()
        });
        let mut numbers = normal();
        let (energies, _) = bands(count, || self.energies(&draw(&mut numbers)));
        Estimate {
            rates,
            energies,
            noise: told.noise,
            whiteness: told.whiteness,
            motion,
        }
    }

    /// The quantities of one motion.
    fn energies(&self, motion: &[Motion<N>]) -> Vec<[f64; quantity::COUNT]> {
        let energies: Vec<f64> = motion.iter().map(|m| self.subject.energy(m)).collect();
        let powers: Vec<_> = motion.iter().map(|m| self.subject.powers(m)).collect();
        let whole: Vec<f64> = powers.iter().map(|powers| powers.whole).collect();
        let flowed = running_integral(self.record.times, &whole);
        let start = energies.first().copied().unwrap_or(0.0);
        let rows = energies.iter().zip(&powers).zip(&flowed);
        rows.map(|((energy, powers), flowed)| {
            [*energy, powers.told, *flowed, flowed - (energy - start)]
        })
        .collect()
    }
}
