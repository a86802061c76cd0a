//! The nonlinear normal modes of the motion in phase, as curves through the plane of releases.

use std::fmt::Write;

use branched_pendulum::analysis::growth::{BrakeOrbit, Continuation, Floquet, GrowthError};
use branched_pendulum::analysis::variational::{Copies, linearised};
use branched_pendulum::analysis::{Modes, SectorModes};
use branched_pendulum::prelude::*;
use branched_pendulum::sectors::{Sector, SectorCoordinate, Sectors};
use branched_pendulum_trees::PendulumTree;

use super::plane::{MapPlane, Point};
use crate::Failure;
use crate::commands::growth::out_of_phase;

/// A mode, from its linear oscillation on.
pub(super) struct NormalMode {
    /// Frequency of small motions, Hz.
    frequency_hz: f64,
    /// Motions of the mode, from small to large, as points of the plane, with their periods.
    releases: Vec<(Point, f64)>,
    /// Growth of differences along each.
    floquet: Vec<Floquet>,
}

/// Tolerance of the integrations.
const TOLERANCE: f64 = 1e-10;

/// Longest step along a mode, rad.
const STEP: f64 = 0.04;

/// Growth rate from which on differences grow along a motion, 1/s.
const LEAST: f64 = 1e-4;

/// The linear modes of a tree whose copies are in phase.
pub(super) struct InPhaseModes {
    sector: Sector,
    /// Where the coordinates rest, rad.
    rest: Vec<f64>,
    /// Mass matrix there, by orthonormal coordinates, kg m².
    mass: Vec<Vec<f64>>,
    modes: Modes,
}

impl InPhaseModes {
    pub(super) fn of(tree: &PendulumTree) -> Result<Self, Failure> {
        let angles = tree.equilibrium(&vec![0.0; tree.links()])?;
        let (mass, stiffness) = (tree.mass_matrix(&angles), tree.stiffness_matrix(&angles));
        let mut blocks = SectorModes::new(tree.sectors(), &mass, &stiffness)?.blocks;
        let (block, sector) = (blocks.swap_remove(0), tree.sectors()[0].clone());
        let rest = sector.coordinates().iter();
        Ok(Self {
            rest: rest.map(|own| own.of(&angles)).collect(),
            sector,
            mass: block.mass,
            modes: block.modes,
        })
    }

    /// Returns the frequencies, Hz.
    pub(super) fn frequencies_hz(&self) -> &[f64] {
        &self.modes.frequencies_hz
    }

    /// Returns the coordinates from their rest at angles of all links.
    pub(super) fn coordinates(&self, theta: &[f64]) -> Vec<f64> {
        let both = self.sector.coordinates().iter().zip(&self.rest);
        both.map(|(own, rest)| own.of(theta) - rest).collect()
    }

    /// Returns the rates of the coordinates at angular velocities of all links.
    pub(super) fn rates(&self, omega: &[f64]) -> Vec<f64> {
        let coordinates = self.sector.coordinates().iter();
        coordinates.map(|own| own.of(omega)).collect()
    }

    /// Returns the part of a mode in coordinates or in their rates.
    pub(super) fn part(&self, mode: usize, values: &[f64]) -> f64 {
        let rows = self.modes.shapes[mode].iter().zip(&self.mass);
        let orthonormal = |(own, value): (&SectorCoordinate, &f64)| own.norm().sqrt() * value;
        let coordinates = self.sector.coordinates();
        let along = rows.map(|(part, row)| {
            let values = coordinates.iter().zip(values).map(orthonormal);
            part * row.iter().zip(values).map(|(m, x)| m * x).sum::<f64>()
        });
        along.sum()
    }

    /// Returns the shape of a mode in its coordinates.
    fn shape(&self, mode: usize) -> Vec<f64> {
        let coordinates = self.sector.coordinates().iter();
        let shape = coordinates.zip(&self.modes.shapes[mode]);
        shape.map(|(own, part)| part / own.norm().sqrt()).collect()
    }
}

/// Passes a plane in which the motions in phase have curves: its axes are all their coordinates.
pub(super) fn check(plane: &MapPlane<'_>) -> Result<(), Failure> {
    match axes(plane) {
        Some(_) => Ok(()),
        None => Err(Failure::Lacking {
            what: "`--modes`: nonlinear normal modes are curves where the motion in phase has two \
                   angles, those of both axes: name each by its link or by the common name of \
                   its copies"
                .to_owned(),
        }),
    }
}

/// Returns the coordinate in phase of each axis.
fn axes(plane: &MapPlane<'_>) -> Option<[usize; 2]> {
    let coordinates = plane.subject.tree.sectors().first()?.coordinates();
    let place = |links: &[usize]| {
        coordinates.iter().position(|own| {
            let own: Vec<usize> = own.weights().iter().map(|(link, _)| *link).collect();
            own == links
        })
    };
    let [x, y] = plane.links()?;
    let both = [place(x)?, place(y)?];
    (coordinates.len() == 2 && both[0] != both[1]).then_some(both)
}

/// Returns the modes up to the largest angle of the plane.
///
/// # Errors
/// [`Failure::SectorModes`], [`Failure::Growth`], or [`Failure::Tree`] for copies that do not move
/// alike.
pub(super) fn of(plane: &MapPlane<'_>, copies: &Copies) -> Result<Vec<NormalMode>, Failure> {
    let (tree, Some(axes)) = (&plane.subject.tree, axes(plane)) else {
        return Ok(Vec::new());
    };
    let linear = InPhaseModes::of(tree)?;
    let in_phase = tree.in_phase(&tree.all_copies());
    let in_phase = in_phase.map_err(|source| Failure::tree(&plane.subject.name, source))?;
    let system = linearised(in_phase.clone());
    let differences = tree.in_phase(copies);
    let differences = differences.and_then(|own| own.with_differences(copies));
    let differences = differences.map_err(|_| out_of_phase())?;
    let continuation = Continuation {
        tolerance: TOLERANCE,
        step: STEP,
        largest: plane.largest().to_radians(),
    };
    let frequencies = linear.frequencies_hz().iter().enumerate();
    let modes = frequencies.map(|(mode, &frequency_hz)| {
        let shape = linear.shape(mode);
        let orbits = continuation.orbits(&system, &linear.rest, &shape, frequency_hz)?;
        // The copies that differ may be some of those that are in phase.
        let beside = |own: &[f64]| {
            let angles = differences.of_whole(&in_phase.whole(own));
            angles.ok_or(GrowthError::Difference)
        };
        let floquet = orbits.iter().map(|orbit| {
            let orbit = BrakeOrbit {
                release: beside(&orbit.release)?,
                turn: beside(&orbit.turn)?,
                period: orbit.period,
            };
            Floquet::of_differences(&differences, &orbit, TOLERANCE)
        });
        let floquet = floquet.collect::<Result<_, _>>()?;
        let point = |orbit: &BrakeOrbit| axes.map(|axis| orbit.release[axis].to_degrees());
        let releases = orbits.iter().map(|orbit| (point(orbit), orbit.period));
        Ok(NormalMode {
            frequency_hz,
            floquet,
            releases: releases.collect(),
        })
    });
    modes.collect()
}

impl NormalMode {
    /// Returns the curve of releases through the plane, to both sides.
    pub(super) fn curve(&self) -> [Vec<f64>; 2] {
        let one = || self.releases.iter().map(|(point, _)| *point);
        let other = one().rev().map(|point| point.map(|angle| -angle));
        let all = other.chain([[0.0; 2]]).chain(one());
        let (x, y) = all.map(|[x, y]| (x, y)).unzip();
        [x, y]
    }
}

/// Returns the ends of the modes, and where differences grow along them, in words.
pub(super) fn text(modes: &[NormalMode]) -> String {
    let mut text = String::new();
    for (number, mode) in modes.iter().enumerate() {
        let Some(([x, y], period)) = mode.releases.last() else {
            continue;
        };
        let rates = mode.floquet.iter().map(|floquet| floquet.rate.value);
        let grows: Vec<f64> = rates.filter(|rate| *rate > LEAST).collect();
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "Mode f_{}: {:.4} Hz when small, {:.4} Hz at {x:.1}° and {y:.1}°; differences grow along\n  \
             {} of its {} motions, by {:.3} 1/s at most",
            number + 1,
            mode.frequency_hz,
            1.0 / period,
            grows.len(),
            mode.floquet.len(),
            grows.iter().copied().fold(0.0, f64::max),
        );
    }
    text
}
