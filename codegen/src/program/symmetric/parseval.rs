//! Energies of sectors (sets of symmetric coordinates: all means, or one difference between copies)
//! by Parseval's identity, also for the velocities (physics §5, definition B): Σ_s E_s = H; and the
//! transfer matrix {E_s, E_r}.

use super::budget::{Share, SymmetricMotion};
use super::direction::Direction;
use super::field::{SymmetricField, SymmetricTree};
use super::motion::{ConstantValues, Fields};
use super::series::TruncatedSeries;
use super::tree::SectorId;

/// A vector (x, y) for every link of an orbit (set of equal copies of one link).
type PlaneFields = [SymmetricField; 2];

/// Velocities of the centres of mass, with the levers from which they are computed.
pub(in crate::program) struct Kinematics {
    velocities: Vec<PlaneFields>,
}

/// Slopes of a sector's energy, for each link: by its angle at fixed momenta, and by its momentum.
pub(in crate::program) struct EnergySlopes {
    angles: Fields,
    momenta: Fields,
}

impl SymmetricTree<'_> {
    /// Returns the lever of a point of the links, its derivative by their angle: (a cos − b sin, a
    /// sin + b cos).
    fn lever(&mut self, [a, b]: &[TruncatedSeries; 2], direction: &Direction) -> PlaneFields {
        let Direction { cos, sin } = direction;
        let parts = [
            self.scale(a, cos),
            self.scale(b, sin),
            self.scale(a, sin),
            self.scale(b, cos),
        ];
        let lever = [
            self.sub(&parts[0], &parts[1]),
            self.add(&parts[2], &parts[3]),
        ];
        self.plane_hinted(&lever, "lever");
        lever
    }

    /// Suggests names for both components of a vector field.
    fn plane_hinted(&mut self, plane: &PlaneFields, what: &str) {
        for (axis, component) in ["x", "y"].iter().zip(plane) {
            self.hinted(component, &format!("{what}_{axis}"));
        }
    }

    /// Returns the second derivative of the position, which is the lever rotated by a right angle.
    fn across(&mut self, [x, y]: &PlaneFields) -> PlaneFields {
        [self.neg(y), x.clone()]
    }

    fn add_planes(&mut self, a: &PlaneFields, b: &PlaneFields) -> PlaneFields {
        [self.add(&a[0], &b[0]), self.add(&a[1], &b[1])]
    }

    fn times(&mut self, plane: &PlaneFields, factor: &SymmetricField) -> PlaneFields {
        [self.mul(&plane[0], factor), self.mul(&plane[1], factor)]
    }

    /// Computes the velocities of the centres of mass, or another quantity that is linear in the
    /// levers. `contribution(lever)` is the contribution of a point with that lever, for each
    /// orbit.
    fn of_centres(
        &mut self,
        values: &ConstantValues,
        motion: &SymmetricMotion,
        what: &str,
        mut contribution: impl FnMut(&mut Self, &PlaneFields, usize) -> PlaneFields,
    ) -> Vec<PlaneFields> {
        let mut pivots: Vec<PlaneFields> = Vec::new();
        let mut centres = Vec::new();
        for orbit in 0..self.orbits.len() {
            let constants = &values.orbits[orbit];
            let pivot = match self.orbits[orbit].parent {
                None => [SymmetricField::zero(orbit), SymmetricField::zero(orbit)],
                Some(parent) => {
                    let direction = motion.pose.directions[parent].clone();
                    let lever = self.lever(&constants.pivot, &direction);
                    let own = contribution(self, &lever, parent);
                    let point = self.add_planes(&pivots[parent].clone(), &own);
                    [self.lift(&point[0], orbit), self.lift(&point[1], orbit)]
                }
            };
            let direction = motion.pose.directions[orbit].clone();
            let lever = self.lever(&constants.com, &direction);
            let own = contribution(self, &lever, orbit);
            let centre = self.add_planes(&pivot, &own);
            self.plane_hinted(&centre, what);
            centres.push(centre);
            pivots.push(pivot);
        }
        centres
    }

    pub(in crate::program) fn kinematics(
        &mut self,
        values: &ConstantValues,
        motion: &SymmetricMotion,
    ) -> Kinematics {
        let velocities = self.of_centres(values, motion, "velocity", |tree, lever, orbit| {
            tree.times(lever, &motion.rates[orbit])
        });
        Kinematics { velocities }
    }

    /// Returns the sum over the orbits of mass · v_s · x_s + inertia · ω_s · y_s.
    fn kinetic_product(
        &mut self,
        values: &ConstantValues,
        sector: SectorId,
        [v, x]: [&[PlaneFields]; 2],
        [omega, y]: [&Fields; 2],
    ) -> TruncatedSeries {
        let mut sum = TruncatedSeries::default();
        for orbit in self.orbits_of(sector) {
            let constants = &values.orbits[orbit];
            let norm = self.sector_norm(orbit, sector);
            let mut dot = TruncatedSeries::default();
            for axis in 0..2 {
                let (a, b) = (
                    v[orbit][axis].component(sector),
                    x[orbit][axis].component(sector),
                );
                let product = self.series.mul(&a, &b);
                dot = self.series.add(&dot, &product);
            }
            let moving = self.series.mul(&constants.mass, &dot);
            let product = self
                .series
                .mul(&omega[orbit].component(sector), &y[orbit].component(sector));
            let turning = self.series.mul(&constants.inertia, &product);
            let both = self.series.add(&moving, &turning);
            let term = self.series.mul(&norm, &both);
            sum = self.series.add(&sum, &term);
        }
        sum
    }

    /// Computes energy E_s, transfer W_s and power P_s of all sectors.
    pub(in crate::program) fn parseval_shares(
        &mut self,
        values: &ConstantValues,
        motion: &SymmetricMotion,
        sectors: &[SectorId],
        [conservative, other]: [&Fields; 2],
    ) -> Vec<Share> {
        let kinematics = self.kinematics(values, motion);
        let squares: Fields = motion
            .rates
            .iter()
            .map(|rate| self.mul(rate, rate))
            .collect();
        self.all_hinted(&squares, "omega_squared");
        let accelerations =
            self.of_centres(values, motion, "acceleration", |tree, lever, orbit| {
                let along = tree.times(lever, &conservative[orbit]);
                let across = tree.across(lever);
                let inwards = tree.times(&across, &squares[orbit]);
                tree.add_planes(&along, &inwards)
            });
        let added = self.of_centres(values, motion, "added", |tree, lever, orbit| {
            tree.times(lever, &other[orbit])
        });
        let velocities = &kinematics.velocities;
        sectors
            .iter()
            .map(|&sector| {
                let product = |tree: &mut Self, x: &[PlaneFields], y: &Fields| {
                    tree.kinetic_product(values, sector, [velocities, x], [&motion.rates, y])
                };
                let twice = product(self, velocities, &motion.rates);
                let half = self.half();
                let kinetic = self.series.mul(&half, &twice);
                let potential = self.sector_potential(values, &motion.pose, sector);
                let work = product(self, &accelerations, conservative);
                let stored =
                    self.sector_potential_rate(values, &motion.pose, &motion.rates, sector);
                Share {
                    energy: self.series.add(&kinetic, &potential),
                    transfer: self.series.add(&work, &stored),
                    power: product(self, &added, other),
                }
            })
            .collect()
    }

    /// Computes the derivatives of E_s by angles (at fixed momenta) and by momenta.
    fn slopes(
        &mut self,
        values: &ConstantValues,
        motion: &SymmetricMotion,
        kinematics: &Kinematics,
        factors: &super::solve::MassFactors,
        sector: SectorId,
    ) -> EnergySlopes {
        let orbits = 0..self.orbits.len();
        // Impulses m v_s of the centres of mass, and their sums at each pivot, from the leaves to
        // the root.
        let impulses: Vec<PlaneFields> = orbits
            .clone()
            .map(|orbit| {
                let mass = &values.orbits[orbit].mass;
                let velocity = &kinematics.velocities[orbit];
                let impulse =
                    [0, 1].map(|axis| self.scale(mass, &velocity[axis].restricted(sector)));
                self.plane_hinted(&impulse, "impulse");
                impulse
            })
            .collect();
        let mut carried = impulses.clone();
        let mut by_rates: Fields = motion
            .rates
            .iter()
            .zip(&values.orbits)
            .map(|(rate, constants)| self.scale(&constants.inertia, &rate.restricted(sector)))
            .collect();
        let mut by_angles = self.sector_potential_gradient(values, &motion.pose, sector);
        for orbit in orbits.rev() {
            let constants = &values.orbits[orbit];
            let direction = motion.pose.directions[orbit].clone();
            let lever = self.lever(&constants.com, &direction);
            self.moment(
                &mut by_rates,
                &mut by_angles,
                &lever,
                &impulses[orbit],
                motion,
            );
            if let Some(parent) = self.orbits[orbit].parent {
                let above = [0, 1].map(|axis| self.gather(&carried[orbit][axis].clone(), parent));
                carried[parent] = self.add_planes(&carried[parent].clone(), &above);
                self.plane_hinted(&carried[parent].clone(), "carried");
                let direction = motion.pose.directions[parent].clone();
                let lever = self.lever(&constants.pivot, &direction);
                self.moment(&mut by_rates, &mut by_angles, &lever, &above, motion);
            }
        }
        self.all_hinted(&by_rates, "energy_slope_omega");
        let momenta = self.solve(factors, &by_rates);
        // At fixed momenta the velocities change with the mass matrix.
        let change = self.bilinear_gradient(&motion.pose, &momenta, &motion.rates);
        let angles = self.subtract(&by_angles, &change);
        self.all_hinted(&angles, "energy_slope");
        EnergySlopes { angles, momenta }
    }

    /// Adds lever · impulse to the derivative by ω, and ω lever′ · impulse to that by θ.
    fn moment(
        &mut self,
        by_rates: &mut Fields,
        by_angles: &mut Fields,
        lever: &PlaneFields,
        impulse: &PlaneFields,
        motion: &SymmetricMotion,
    ) {
        let orbit = lever[0].orbit;
        let dot = |tree: &mut Self, a: &PlaneFields| {
            let products = [tree.mul(&a[0], &impulse[0]), tree.mul(&a[1], &impulse[1])];
            tree.add(&products[0], &products[1])
        };
        let along = dot(self, lever);
        self.hinted(&along, "moment");
        self.accumulate(by_rates, &along);
        let across = self.across(lever);
        let across = dot(self, &across);
        self.hinted(&across, "moment_across");
        let across = self.mul(&across, &motion.rates[orbit]);
        self.accumulate(by_angles, &across);
    }

    /// Computes {E_s, E_r} by rows; the matrix is antisymmetric, with a zero diagonal.
    pub(in crate::program) fn transfer_matrix(
        &mut self,
        values: &ConstantValues,
        motion: &SymmetricMotion,
        sectors: &[SectorId],
    ) -> Vec<Vec<TruncatedSeries>> {
        let kinematics = self.kinematics(values, motion);
        let factors = self.factors(values, &motion.pose);
        let slopes: Vec<EnergySlopes> = sectors
            .iter()
            .map(|&sector| self.slopes(values, motion, &kinematics, &factors, sector))
            .collect();
        let mut matrix = vec![vec![TruncatedSeries::default(); sectors.len()]; sectors.len()];
        for (s, into) in slopes.iter().enumerate() {
            for (r, from) in slopes.iter().enumerate().skip(s + 1) {
                let mut bracket = TruncatedSeries::default();
                for orbit in 0..self.orbits.len() {
                    let gain = self.dot(&into.angles[orbit], &from.momenta[orbit]);
                    let loss = self.dot(&into.momenta[orbit], &from.angles[orbit]);
                    let term = self.series.sub(&gain, &loss);
                    bracket = self.series.add(&bracket, &term);
                }
                matrix[r][s] = self.series.neg(&bracket);
                matrix[s][r] = bracket;
            }
        }
        matrix
    }
}
