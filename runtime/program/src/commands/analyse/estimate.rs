//! Estimation of a motion, its energy and its power from measured angles, with their errors.

use std::ops::Range;

use branched_pendulum_data::Timing;
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
    /// Energy in J: H_d of a difference, or H of a whole tree.
    pub const ENERGY: usize = 0;
    /// Power in W: W of a difference, or the power of friction and drive for a whole tree.
    pub const POWER: usize = 1;
    /// Integral of all power that changes the energy, since the first time of the interval, in J.
    pub const FLOWED: usize = 2;
    /// Closure: this integral minus the change of the energy, zero except for errors, in J. If
    /// equations of motion are used, it is the closure along the most likely motion, and its error
    /// is that of noise only.
    pub const CLOSURE: usize = 3;
    /// Their number.
    pub const COUNT: usize = 4;
}

/// A motion estimated from data, with its errors.
#[derive(Clone, Debug)]
pub struct Estimate {
    /// Rates of the coordinates, rad/s.
    pub rates: Bands<Vec<f64>>,
    /// Quantities computed from the motion, at the indices in [`quantity`].
    pub energies: Bands<[f64; quantity::COUNT]>,
    /// Estimated standard deviation of the links' measured angles, in rad.
    pub noise: f64,
    /// Largest correlation of successive innovations (prediction errors), in standard deviations;
    /// NaN if the method makes no predictions.
    pub whiteness: f64,
    /// Friction coefficients (N m s) that are missing in the equations of motion, pivot by pivot;
    /// empty if none are searched for.
    pub frictions: Vec<f64>,
    /// The likeliest motion.
    pub motion: Vec<Motion>,
}

impl Estimate {
    /// Appends the estimate for a later time interval to this estimate.
    fn followed_by(mut self, later: Self) -> Self {
        // Of the longer stretch, which shows more of it.
        if later.motion.len() > self.motion.len() {
            self.frictions = later.frictions;
        }
        if later.whiteness.abs() > self.whiteness.abs() {
            self.whiteness = later.whiteness;
        }
        self.noise = self.noise.max(later.noise);
        self.rates.means.extend(later.rates.means);
        self.rates.deviations.extend(later.rates.deviations);
        self.energies.means.extend(later.energies.means);
        self.energies.deviations.extend(later.energies.deviations);
        self.motion.extend(later.motion);
        self
    }
}

/// Random draws of the motion, from which means and standard deviations are computed.
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
    /// Estimates the motion by smoothness only, each coordinate separately; a picture in which a
    /// link is missing counts as missing.
    ///
    /// # Errors
    /// [`Failure::Smoothing`].
    pub fn by_smoothness(&self, draws: Draws) -> Result<Estimate, Failure> {
        self.in_stretches(|part, _| {
            part.separately(draws, |times, data| {
                KinematicSmoother::default().smooth(times, data)
            })
        })
    }

    /// Estimates the motion by polynomials near each time, each coordinate separately.
    ///
    /// # Errors
    /// [`Failure::Smoothing`].
    pub fn by_polynomials(&self, draws: Draws) -> Result<Estimate, Failure> {
        self.in_stretches(|part, _| {
            part.separately(draws, |times, data| {
                LocalPolynomials::default().smooth(times, data)
            })
        })
    }

    /// Estimates the motion with the equations of motion, starting from an estimate without them.
    ///
    /// # Errors
    /// [`Failure::Smoothing`].
    pub fn by_model(&self, guess: &Estimate, draws: Draws) -> Result<Estimate, Failure> {
        let subject = self.subject;
        let symmetric = |part: &Vec<f64>| subject.coordinates(part);
        self.in_stretches(|part, rows| {
            let guess = guess.motion[rows].iter();
            let guess: Vec<Motion> = guess
                .map(|motion| motion.each_ref().map(|part| subject.links(part)))
                .collect();
            let found = subject.by_model(part.record, &guess)?;
            Ok(part.estimate(draws, &found, |motion| motion.each_ref().map(symmetric)))
        })
    }

    /// Estimates the intervals between long gaps one after the other. Each is a separate motion,
    /// whose energy change is counted from its own start.
    fn in_stretches(
        &self,
        estimate: impl Fn(&Measured<'_>, Range<usize>) -> Result<Estimate, Failure>,
    ) -> Result<Estimate, Failure> {
        let AngleRows { times, angles } = self.record;
        let of_rows = |rows: Range<usize>| {
            let part = Measured {
                record: AngleRows {
                    times: &times[rows.clone()],
                    angles: &angles[rows.clone()],
                },
                ..*self
            };
            estimate(&part, rows)
        };
        let mut parts = Timing::stretches(times).into_iter();
        let Some(first) = parts.next() else {
            return of_rows(0..times.len());
        };
        parts.try_fold(of_rows(first)?, |whole, rows| {
            Ok(whole.followed_by(of_rows(rows)?))
        })
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

    /// Computes means and standard deviations of all quantities from random draws; `coordinates`
    /// converts the drawn states to those that are reported. The same motions are drawn twice, with
    /// the same random numbers, instead of being stored.
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
        let reported =
            |motion: Vec<Motion>| -> Vec<Motion> { motion.into_iter().map(&coordinates).collect() };
        let mut numbers = normal();
        let (rates, _) = bands(count, || {
            let motion = reported((found.draw)(&mut numbers));
            motion.into_iter().map(|[_, rates]| rates).collect()
        });
        let mut numbers = normal();
        let (mut energies, _) = bands(count, || {
            self.energies(&reported((found.draw)(&mut numbers)), &found.frictions)
        });
        let motion = reported(found.mean.clone());
        if let Some(Disturbances {
            likeliest,
            spurious,
        }) = &found.disturbances
        {
            let likeliest = reported(likeliest.clone());
            let closure = |changes: &[Motion]| self.closure(&motion, &likeliest, changes);
            let mut numbers = normal();
            let (noise, _) = bands(count, || closure(&reported(spurious(&mut numbers))));
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

    /// Computes the quantities of one motion, including the estimated friction.
    fn energies(&self, motion: &[Motion], friction: &[f64]) -> Vec<[f64; quantity::COUNT]> {
        let energies: Vec<f64> = motion.iter().map(|m| self.subject.energy(m)).collect();
        let at = self.record.times.iter().zip(motion);
        let powers = at.map(|(time, motion)| self.subject.powers(*time, motion, friction));
        let powers: Vec<_> = powers.collect();
        let whole: Vec<f64> = powers.iter().map(|powers| powers.whole).collect();
        let mut quantities = Vec::with_capacity(motion.len());
        // Nothing is known of the power in a long gap.
        for rows in Timing::stretches(self.record.times) {
            let flowed = running_integral(&self.record.times[rows.clone()], &whole[rows.clone()]);
            let start = energies[rows.start];
            quantities.extend(rows.zip(flowed).map(|(row, flowed)| {
                let closure = flowed - (energies[row] - start);
                [energies[row], powers[row].reported, flowed, closure]
            }));
        }
        quantities
    }

    /// Computes the closure of the energy budget (J) of a motion if the angles of all links are
    /// measured from `tilt`, with the given friction in addition to that of the pendulum.
    pub fn closure_if(&self, motion: &[Motion], tilt: f64, friction: &[f64]) -> Vec<f64> {
        let turned = motion.iter().map(|[coordinates, rates]| {
            let mut links = self.subject.links(coordinates);
            links.iter_mut().for_each(|angle| *angle -= tilt);
            [self.subject.coordinates(&links), rates.clone()]
        });
        let rows = self.energies(&turned.collect::<Vec<_>>(), friction);
        rows.iter().map(|row| row[quantity::CLOSURE]).collect()
    }

    /// Computes the closure of the energy budget from changes of a motion that its equations do not
    /// explain. Along the equations the energy changes by its power, so that the whole gap comes
    /// from these changes. To first order about the mean of the most likely changes.
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
