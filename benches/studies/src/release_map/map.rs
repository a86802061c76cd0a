//! Growth at every point of a plane.

use branched_pendulum::Transverse;
use branched_pendulum::analysis::growth::{Grown, Growth, frequency_at_rest};
use branched_pendulum::prelude::*;
use branched_pendulum::system::TransverseOde;

use super::arguments::Arguments;
use crate::critical_angle::scene::{at_rest, first_sector};
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

/// Points that are computed at a time.
const BLOCK: usize = 2000;

/// Growth over a plane, as far as it was computed.
#[derive(Clone, Debug)]
pub struct Map {
    /// Values of x.
    pub columns: Vec<f64>,
    /// Values of y.
    pub rows: Vec<f64>,
    /// Growth row by row; none where a motion could not be followed. Rows are missing at
    /// the end where the work was interrupted.
    pub grown: Vec<Option<Grown>>,
}

impl Map {
    /// Returns true where nothing was computed.
    pub fn is_empty(&self) -> bool {
        self.grown.is_empty()
    }

    /// Points that were computed.
    pub fn points(&self) -> impl Iterator<Item = (f64, f64, &Grown)> {
        let places = self
            .rows
            .iter()
            .flat_map(|&y| self.columns.iter().map(move |&x| (x, y)));
        let both = places.zip(&self.grown);
        both.filter_map(|((x, y), grown)| Some((x, y, grown.as_ref()?)))
    }

    /// Largest value of x or y.
    pub fn largest(&self) -> f64 {
        let all = self.columns.iter().chain(&self.rows);
        all.copied().fold(0.0, f64::max)
    }

    /// Computes the growth along the releases that `release` gives for x and y, row by
    /// row; in as many rows as there is time for.
    fn compute<P: Transverse<f64> + Sync>(
        (columns, rows): (Vec<f64>, Vec<f64>),
        arguments: &Arguments,
        job: &Job,
        release: impl Fn(f64, f64) -> Result<(TransverseOde<P>, State<f64>), Failure>,
    ) -> Result<Self, Failure> {
        let progress = job.progress(rows.len());
        progress.begin("points of the map");
        let mut map = Self {
            columns,
            rows,
            grown: Vec::new(),
        };
        for rows in map.rows.chunks(BLOCK.div_ceil(map.columns.len())) {
            if job.is_interrupted() {
                break;
            }
            let places = rows
                .iter()
                .flat_map(|&y| map.columns.iter().map(move |&x| (x, y)));
            let releases = places.map(|(x, y)| release(x, y));
            let releases = releases.collect::<Result<Vec<_>, _>>()?;
            let growth = Growth {
                frequency_hz: releases
                    .first()
                    .map_or(f64::NAN, |(ode, _)| frequency_at_rest(ode)),
                horizons: vec![arguments.span],
                tolerance: arguments.tolerance,
            };
            let grown = growth.in_lanes(&Ensemble::new(), &releases);
            map.grown.extend(grown.into_iter().map(Result::ok));
            job.take_interruption();
            progress.advance(rows.len() as f64);
        }
        Ok(map)
    }
}

/// The plane of releases from rest: common angle of all that hangs from the parent, and
/// angle of the parent, degrees.
///
/// # Errors
/// [`Failure`].
pub fn over_releases<P: Transverse<f64> + Sync>(
    arguments: &Arguments,
    job: &Job,
    model: &P,
) -> Result<Map, Failure> {
    let plane = (arguments.children(), arguments.parents());
    Map::compute(plane, arguments, job, |children, parent| {
        Ok((first_sector(model)?, at_rest(model, parent, children)))
    })
}

/// Children vertical and a parent at the angle that gives the energy: mass of the
/// children over the paper's, and energy over that with a horizontal parent.
///
/// # Errors
/// [`Failure`].
pub fn over_ratios<P: Transverse<f64> + Sync>(
    arguments: &Arguments,
    job: &Job,
    model: impl Fn(f64) -> Result<P, Failure>,
) -> Result<Map, Failure> {
    let (columns, rows) = (arguments.children().len(), arguments.parents().len());
    let part = |index: usize, count: usize| index as f64 / (count.max(2) - 1) as f64;
    let [low, high] = RATIOS;
    let ratios = (0..columns).map(|i| low * (high / low).powf(part(i, columns)));
    let energies = (0..rows).map(|i| part(i, rows));
    let plane = (ratios.collect(), energies.collect());
    Map::compute(plane, arguments, job, |ratio, energy| {
        // G_1 (1 − cos θ_1), G_1 being the energy of the horizontal parent.
        let parent = (1.0 - energy).acos().to_degrees();
        let model = model(ratio)?;
        let start = at_rest(&model, parent, 0.0);
        Ok((first_sector(model)?, start))
    })
}

/// Masses of the children over that of the paper's.
pub const RATIOS: [f64; 2] = [0.05, 20.0];
