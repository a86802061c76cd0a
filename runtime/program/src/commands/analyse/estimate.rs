//! A motion, its energy and power from measured angles, with their errors.

use branched_pendulum_measure::{
    Bands, KinematicSmoother, LocalPolynomials, SmoothedMotion, SmoothingError, bands,
    running_integral,
};
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use super::subject::MeasuredTree;
use crate::Failure;
use crate::smoothed::{AngleRows, Disturbances, Motion, Smoothed, one_by_one};

/// Indices of the quantities in [`Estimate::energies`].
pub mod quantity {
    /// The energy, J: of a difference H_d, of a whole tree H.
    pub const ENERGY: usize = 0;
    /// The power, W: of a difference W, of a whole tree that of friction and drive.
    pub const POWER: usize = 1;
    /// Integral since the first time of all power that changes the energy, J.
    pub const FLOWED: usize = 2;
    /// Such an integral less the change of the energy: zero but for errors, J. By the equations
    /// of motion the one along the likeliest motion, and its error that of noise alone.
    pub const CLOSURE: usize = 3;
    /// Their number.
    pub const COUNT: usize = 4;
}

/// A motion as data tell it.
#[derive(Clone, Debug)]
pub struct Estimate {
    /// Rates of the coordinates, rad/s.
    pub rates: Bands<Vec<f64>>,
    /// Quantities that follow from the motion: [`quantity`] says which stands where.
    pub energies: Bands<[f64; quantity::COUNT]>,
    /// Standard deviation of the links' angles that was found, rad.
    pub noise: f64,
    /// Correlation of successive innovations in standard deviations, the largest; NaN where
    /// nothing is foretold.
    pub whiteness: f64,
    /// Friction that the equations of motion lack, N m s, pivot by pivot; none where none is
    /// sought.
    pub frictions: Vec<f64>,
    /// The likeliest motion.
    pub motion: Vec<Motion>,
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
pub struct Measured<'a> {
    /// The pendulum.
    pub subject: &'a MeasuredTree,
    /// The angles.
    pub record: AngleRows<'a>,
}

impl Measured<'_> {
    /// Estimates the motion knowing only that it is smooth, each coordinate by itself; a
    /// picture that lacks a link counts as missing.
    ///
    /// # Errors
    /// [`Failure::Smoothing`].
    pub fn by_smoothness(&self, draws: Draws) -> Result<Estimate, Failure> {
        self.separately(draws, |times, data| {
            KinematicSmoother::default().smooth(times, data)
        })
    }

    /// Estimates the motion by polynomials near each time, otherwise likewise.
    ///
    /// # Errors
    /// [`Failure::Smoothing`].
    pub fn by_polynomials(&self, draws: Draws) -> Result<Estimate, Failure> {
        self.separately(draws, |times, data| {
            LocalPolynomials::default().smooth(times, data)
        })
    }

    /// Estimates the motion with the equations of motion, beginning from an estimate without
    /// them.
    ///
    /// # Errors
    /// [`Failure::Smoothing`].
    pub fn by_model(&self, guess: &Estimate, draws: Draws) -> Result<Estimate, Failure> {
        let subject = self.subject;
        let guess = guess.motion.iter();
        let guess: Vec<Motion> = guess
            .map(|motion| motion.each_ref().map(|part| subject.links(part)))
            .collect();
        let found = subject.by_model(self.record, &guess)?;
        let symmetric = |part: &Vec<f64>| subject.coordinates(part);
        Ok(self.estimate(draws, &found, |motion| motion.each_ref().map(symmetric)))
    }

    fn separately(
        &self,
        draws: Draws,
        smooth: impl Fn(&[f64], &[Option<f64>]) -> Result<SmoothedMotion, SmoothingError>,
    ) -> Result<Estimate, Failure> {
        let whole = |angles: &Vec<Option<f64>>| -> Vec<Option<f64>> {
            match angles.iter().copied().collect::<Option<Vec<f64>>>() {
                Some(links) => self
                    .subject
                    .coordinates(&links)
                    .into_iter()
                    .map(Some)
                    .collect(),
                None => vec![None; angles.len()],
            }
        };
        let coordinates: Vec<Vec<Option<f64>>> = self.record.angles.iter().map(whole).collect();
        let record = AngleRows {
            angles: &coordinates,
            ..self.record
        };
        let found = one_by_one(record, smooth)?;
        Ok(self.estimate(draws, &found, |motion| motion))
    }

    /// Tells what follows from draws, whose states `coordinates` takes to those that are
    /// told. They are drawn twice, with the same random numbers, rather than kept.
    fn estimate(
        &self,
        Draws { count, seed }: Draws,
        found: &Smoothed,
        coordinates: impl Fn(Motion) -> Motion,
    ) -> Estimate {
        let normal = || {
            let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
            move || StandardNormal.sample(&mut random)
        };
        let told =
            |motion: Vec<Motion>| -> Vec<Motion> { motion.into_iter().map(&coordinates).collect() };
        let mut numbers = normal();
        let (rates, _) = bands(count, || {
            let motion = told((found.draw)(&mut numbers));
            motion.into_iter().map(|[_, rates]| rates).collect()
        });
        let mut numbers = normal();
        let (mut energies, _) = bands(count, || {
            self.energies(&told((found.draw)(&mut numbers)), &found.frictions)
        });
        let motion = told(found.mean.clone());
        if let Some(Disturbances {
            likeliest,
            spurious,
        }) = &found.disturbances
        {
            let likeliest = told(likeliest.clone());
            let closure = |changes: &[Motion]| self.closure(&motion, &likeliest, changes);
            let mut numbers = normal();
            let (noise, _) = bands(count, || closure(&told(spurious(&mut numbers))));
            let places = energies.means.iter_mut().zip(&mut energies.deviations);
            let values = closure(&likeliest).into_iter().zip(noise.deviations);
            for ((mean, deviation), ([value], [error])) in places.zip(values) {
                mean[quantity::CLOSURE] = value;
                deviation[quantity::CLOSURE] = error;
            }
        }
        Estimate {
            rates,
            energies,
            noise: found.noise,
            whiteness: found.whiteness,
            frictions: found.frictions.clone(),
            motion,
        }
    }

    /// The quantities of one motion, with the friction that was found.
    fn energies(&self, motion: &[Motion], friction: &[f64]) -> Vec<[f64; quantity::COUNT]> {
        let energies: Vec<f64> = motion.iter().map(|m| self.subject.energy(m)).collect();
        let at = self.record.times.iter().zip(motion);
        let powers = at.map(|(time, motion)| self.subject.powers(*time, motion, friction));
        let powers: Vec<_> = powers.collect();
        let whole: Vec<f64> = powers.iter().map(|powers| powers.whole).collect();
        let flowed = running_integral(self.record.times, &whole);
        let start = energies.first().copied().unwrap_or(0.0);
        let rows = energies.iter().zip(&powers).zip(&flowed);
        rows.map(|((energy, powers), flowed)| {
            [*energy, powers.told, *flowed, flowed - (energy - start)]
        })
        .collect()
    }

    /// The closure of a motion if its angles of links are all counted from `tilt`, with that
    /// friction beside the pendulum's own, J.
    pub fn closure_if(&self, motion: &[Motion], tilt: f64, friction: &[f64]) -> Vec<f64> {
        let turned = motion.iter().map(|[coordinates, rates]| {
            let mut links = self.subject.links(coordinates);
            links.iter_mut().for_each(|angle| *angle -= tilt);
            [self.subject.coordinates(&links), rates.clone()]
        });
        let rows = self.energies(&turned.collect::<Vec<_>>(), friction);
        rows.iter().map(|row| row[quantity::CLOSURE]).collect()
    }

    /// The closure by changes of a motion beside its equations: along these the energy changes
    /// by its power, so that all else is in the changes. To first order, about the middle of the
    /// likeliest ones.
    fn closure(
        &self,
        motion: &[Motion],
        likeliest: &[Motion],
        changes: &[Motion],
    ) -> Vec<[f64; 1]> {
        let mut closure = 0.0;
        let steps = motion.iter().zip(likeliest).zip(changes);
        steps
            .map(|((motion, likeliest), change)| {
                let middle = [0, 1].map(|part| {
                    let both = motion[part].iter().zip(&likeliest[part]);
                    both.map(|(motion, likeliest)| motion - 0.5 * likeliest)
                        .collect()
                });
                closure -= self.subject.energy_along(&middle, change);
                [closure]
            })
            .collect()
    }
}
