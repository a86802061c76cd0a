//! Nonlinear normal modes of the in-phase motion, as curves in the plane of releases.

use std::fmt::Write;

use branched_pendulum::analysis::growth::{BrakeOrbit, Continuation, Floquet, GrowthError};
use branched_pendulum::analysis::variational::{Copies, linearised};
use branched_pendulum::analysis::{Modes, SectorModes};
use branched_pendulum::prelude::*;
use branched_pendulum::sectors::{Sector, SectorCoordinate, Sectors};
use branched_pendulum_trees::PendulumTree;

use crate::Failure;
use crate::commands::differences::start_apart;
use crate::commands::plane::{MapPlane, Point};

/// A nonlinear normal mode, beginning with its linear oscillation.
pub(super) struct NormalMode {
    /// Frequency of small motions, Hz.
    frequency_hz: f64,
    /// Motions of the mode, from small to large: points of the plane, with their periods.
    releases: Vec<(Point, f64)>,
    /// Growth of differences along each.
    floquet: Vec<Floquet>,
}

/// Tolerance of the integrations.
const TOLERANCE: f64 = 1e-10;

/// Longest step along a mode, rad.
const STEP: f64 = 0.04;

/// Growth rate (1/s) from which on differences count as growing along a motion.
const LEAST: f64 = 1e-4;

/// Linear modes of a tree whose copies are in phase.
pub(super) struct InPhaseModes {
    sector: Sector,
    /// Equilibrium values of the coordinates, in rad.
    rest: Vec<f64>,
    /// Mass matrix at equilibrium, in orthonormal coordinates, kg m².
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

    /// Returns the coordinates relative to equilibrium, given the angles of all links.
    pub(super) fn coordinates(&self, theta: &[f64]) -> Vec<f64> {
        let both = self.sector.coordinates().iter().zip(&self.rest);
        both.map(|(own, rest)| own.of(theta) - rest).collect()
    }

    /// Returns the rates of the coordinates, given the angular velocities of all links.
    pub(super) fn rates(&self, omega: &[f64]) -> Vec<f64> {
        let coordinates = self.sector.coordinates().iter();
        coordinates.map(|own| own.of(omega)).collect()
    }

    /// Returns the component of a mode in given coordinates, or in their rates.
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

    /// Returns the shape of a mode as a vector of coordinates.
    fn shape(&self, mode: usize) -> Vec<f64> {
        let coordinates = self.sector.coordinates().iter();
        let shape = coordinates.zip(&self.modes.shapes[mode]);
        shape.map(|(own, part)| part / own.norm().sqrt()).collect()
    }
}

/// Checks that the plane can show the curves of the modes: its axes must be all coordinates of the
/// in-phase motion.
pub(super) fn check(plane: &MapPlane<'_>) -> Result<(), Failure> {
    match axes(plane) {
        Some(_) => Ok(()),
        None => Err(Failure::Lacking {
            what: "`--modes`: nonlinear normal modes are drawn as curves if the in-phase motion \
                has two angles, which are the two axes: name each axis by its link or by the \
                common name of its copies"
                .to_owned(),
        }),
    }
}

/// Returns the index of the in-phase coordinate of each axis.
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

/// Returns the nonlinear modes up to the largest angle of the plane.
///
/// # Errors
/// [`Failure::SectorModes`], [`Failure::Growth`], or [`Failure::Tree`] if the copies do not stay in
/// phase.
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
    let differences = differences.map_err(|_| start_apart())?;
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
    /// Returns the curve of the mode's releases through the plane, to both sides of the
    /// equilibrium.
    pub(super) fn curve(&self) -> [Vec<f64>; 2] {
        let one = || self.releases.iter().map(|(point, _)| *point);
        let other = one().rev().map(|point| point.map(|angle| -angle));
        let all = other.chain([[0.0; 2]]).chain(one());
        let (x, y) = all.map(|[x, y]| (x, y)).unzip();
        [x, y]
    }
}

/// Describes the ends of the modes, and where differences grow along them.
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
