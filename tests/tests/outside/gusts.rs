//! Forces at random: sums of sines with random phases, at points of links and as couples.

use std::f64::consts::TAU;

use branched_pendulum::prelude::*;
use branched_pendulum::system::{Action, LinkPoint};
use branched_pendulum_compiler_tests::random::Random;

/// A sum of sines.
#[derive(Clone, Debug)]
struct Noise(Vec<[f64; 3]>);

impl Noise {
    fn new(random: &mut Random, size: f64) -> Self {
        let sine = |_| {
            [
                random.between(-size, size),
                random.between(0.5, 9.0),
                random.between(0.0, TAU),
            ]
        };
        Self((0..3).map(sine).collect())
    }

    fn at(&self, time: f64) -> f64 {
        let sines = self.0.iter();
        sines
            .map(|[size, pace, phase]| size * (pace * time + phase).sin())
            .sum()
    }
}

/// Couples on the links, and forces on their ends and centres.
pub(super) struct Gusts<'m, P> {
    model: &'m P,
    couples: Vec<Noise>,
    forces: [Vec<[Noise; 2]>; 2],
}

impl<'m, P: Positions<f64>> Gusts<'m, P> {
    pub(super) fn new(model: &'m P, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let couples = (0..model.links())
            .map(|_| Noise::new(&mut random, 0.01))
            .collect();
        let mut forces = || {
            let force = |_| [Noise::new(&mut random, 0.1), Noise::new(&mut random, 0.1)];
            (0..model.links()).map(force).collect()
        };
        let forces = [forces(), forces()];
        Self {
            model,
            couples,
            forces,
        }
    }
}

impl<P: Positions<f64>> Action<f64> for Gusts<'_, P> {
    fn act(&self, time: f64, theta: &[f64], _: &[f64], torques: &mut [f64]) {
        let mut sum: Vec<f64> = self.couples.iter().map(|couple| couple.at(time)).collect();
        for (point, forces) in [LinkPoint::End, LinkPoint::Centre]
            .into_iter()
            .zip(&self.forces)
        {
            let forces: Vec<[f64; 2]> = forces
                .iter()
                .map(|[x, y]| [x.at(time), y.at(time)])
                .collect();
            self.model
                .point_torques_into(point, theta, &forces, torques);
            for (sum, torque) in sum.iter_mut().zip(&*torques) {
                *sum += torque;
            }
        }
        torques.copy_from_slice(&sum);
    }
}
