//! Runs the parts of a derivation that the scene requests, and returns the results as plain data.

use super::algebra::{AlgebraError, Formula};
use super::derivation::Derivation;
use super::expression::{Expr, SymbolId};
use super::frame::{DerivedFrame, MassMatrix};
use super::inverse_mass::DerivedExpansion;
use super::meaning::JointDifference;
use super::mismatch::Mismatch;
use super::series::VelocitySeries;
use super::transfer::SubHamiltonian;
use super::{
    Constant, Correction, EnergyParts, Frame, MassExpansion, MatrixEntry, Mechanics,
    TransferFormulas, Truncated, WrittenOut,
};
use crate::functions::Counting;
use crate::scene::TransferRequest;
use crate::scene::coordinates::{self, Coordinate};
use std::collections::BTreeMap;

impl Derivation<'_> {
    pub(super) fn finish(mut self) -> Result<Mechanics, AlgebraError> {
        if self.scene.in_loops() {
            return Ok(self.finish_loops());
        }
        let absolute = self.absolute_frame();
        let mut mechanics = Mechanics {
            parameters: self.parameters.clone(),
            drive: self.plain_drive(Some(&absolute)),
            friction_power: self.total_friction_power(),
            absolute: self.frame(&absolute),
            articulation: self.articulation(&absolute),
            ..Mechanics::default()
        };
        let requests = &self.scene.requests;
        let requests_transverse = requests.transverse;
        // The computation by means and differences assumes that copies have equal constants.
        let nested = requests.symmetric && self.is_nested() && !self.scene.has_unequal_copies();
        if requests.budget.is_some() || nested {
            let coordinates = coordinates::symmetric_coordinates(self.scene);
            mechanics.sectors = Some(self.sectors(&absolute, &coordinates));
            mechanics.coordinates = coordinates;
        }
        let mut derived = None;
        if nested {
            let symmetric = self.symbols_of(&mechanics.coordinates);
            derived = Some(DerivedFrame::of_symbols(&symmetric));
            mechanics.symmetric = Some(symmetric);
        } else if self.scene.requests.symmetric {
            derived = Some(self.derive_symmetric(&absolute, &mut mechanics));
        }
        let symmetric = derived
            .as_ref()
            .map(|frame| (frame, &*mechanics.coordinates));
        mechanics.observables = self.observables(&absolute, symmetric)?;
        if requests_transverse {
            mechanics.transverse = Some(self.transverse(&absolute));
        }
        if self.scene.requests.normal_form {
            mechanics.normal_form = Some(self.normal_form(&absolute));
        }
        if self.scene.requests.positions {
            mechanics.positions = Some(self.positions(&absolute));
        }
        mechanics.constants = self.plain_constants();
        mechanics.lines = self.plain_lines();
        mechanics.joints = self.plain_joints();
        mechanics.trigonometry = self.trigonometry;
        mechanics.combinations = self.combinations;
        mechanics.symbols = self.symbols;
        Ok(mechanics)
    }

    /// Derives the Lagrangian in symmetric coordinates, and the energy transfer if it is requested.
    fn derive_symmetric(
        &mut self,
        absolute: &DerivedFrame,
        mechanics: &mut Mechanics,
    ) -> DerivedFrame {
        let coordinates = coordinates::symmetric_coordinates(self.scene);
        let constants = self.copy_constants(&coordinates);
        let symmetric = self.symmetric_frame(absolute, &coordinates, &constants);
        mechanics.symmetric = Some(self.frame(&symmetric));
        if let Some(request) = self.scene.requests.transfer.clone() {
            let unequal = self.scene.has_unequal_copies();
            let mean = unequal.then(|| self.mean_frame(&symmetric, &constants));
            let mismatch = mean
                .as_ref()
                .map(|mean| self.mismatch(&symmetric, mean, &coordinates));
            let equal = mean.as_ref().unwrap_or(&symmetric);
            let orders = request.angle_orders.iter().chain(&request.amplitude_orders);
            let order = orders.copied().max().unwrap_or(0);
            let expansion = self.expand_mass(equal, &coordinates, order);
            let mut plain = self.expansion(equal, &expansion);
            mechanics.transfers = self.transfers(
                (&symmetric, mismatch.as_ref()),
                &coordinates,
                &expansion,
                &request,
                &mut plain,
            );
            match &mismatch {
                Some(mismatch) => mechanics.mean_tree = Some(self.mean_tree(mismatch)),
                None => mechanics.expansion = Some(plain),
            }
        }
        mechanics.coordinates = coordinates;
        symmetric
    }

    /// Returns the constants as plain data.
    fn plain_constants(&self) -> Vec<Constant> {
        let constants = self.constants.iter();
        let plain = constants.map(|(&symbol, entry)| Constant {
            symbol,
            value: entry.value.cancelled(&self.symbols),
            meaning: entry.meaning.clone(),
            unit: entry.unit,
        });
        plain.collect()
    }

    /// Returns the definitions of relative angles and rates of joints as plain data.
    fn plain_joints(&self) -> BTreeMap<SymbolId, JointDifference> {
        let joints = self.joints.iter();
        let plain = joints.map(|(&symbol, joint)| {
            let JointDifference { terms, rest } = joint;
            let (terms, rest) = (terms.clone(), self.expr(rest));
            (symbol, JointDifference { terms, rest })
        });
        plain.collect()
    }

    /// Returns true if copies have copies or other links below them.
    fn is_nested(&self) -> bool {
        let scene = self.scene;
        let copies = scene.groups.iter().flat_map(|group| &group.copies);
        let mut parents = scene.links.iter().filter_map(|link| link.parent);
        let copies: Vec<_> = copies.collect();
        parents.any(|parent| copies.contains(&&parent))
    }

    /// Creates a frame that only names the coordinates.
    fn symbols_of(&mut self, coordinates: &[Coordinate]) -> Frame {
        let names: Vec<&String> = coordinates.iter().map(|c| &c.name).collect();
        Frame {
            coordinates: names.iter().map(|name| self.coordinate(name)).collect(),
            velocities: names.iter().map(|name| self.velocity(name)).collect(),
            momenta: names.iter().map(|name| self.momentum(name)).collect(),
            ..Frame::default()
        }
    }

    pub(super) fn expr(&self, formula: &Formula) -> Expr {
        formula.to_expr(&self.symbols)
    }

    pub(super) fn exprs(&self, formulas: &[Formula]) -> Vec<Expr> {
        formulas.iter().map(|f| self.expr(f)).collect()
    }

    fn entries(&self, matrix: &MassMatrix) -> Vec<MatrixEntry> {
        matrix
            .iter()
            .filter(|(_, _, value)| !value.is_zero())
            .map(|(row, column, value)| MatrixEntry {
                row,
                column,
                value: self.expr(value),
            })
            .collect()
    }

    pub(super) fn frame(&mut self, frame: &DerivedFrame) -> Frame {
        let torques = self.plain_torques(&frame.torques);
        let requests = &self.scene.requests;
        Frame {
            coordinates: frame.coordinates.clone(),
            velocities: frame.velocities.clone(),
            momenta: frame.momenta.clone(),
            mass: self.entries(&frame.mass),
            stiffness: requests.modes.then(|| self.entries(&self.stiffness(frame))),
            energies: requests.energies.then(|| {
                let kinetic: Formula = frame.kinetic_terms().map(|(_, _, term)| term).sum();
                EnergyParts {
                    kinetic: self.expr(&kinetic.expand()),
                    potential: self.expr(&frame.potential),
                }
            }),
            momentum: requests.momenta.then(|| self.exprs(&frame.momentum())),
            momentum_rates: requests
                .momenta
                .then(|| self.exprs(&frame.momentum_rates(self))),
            torques,
            dissipative_forces: self.exprs(&frame.dissipative_forces(self)),
            drive: self.exprs(&frame.drive_forces(self)),
            bias: self.exprs(&frame.bias(self)),
        }
    }

    pub(super) fn stiffness(&self, frame: &DerivedFrame) -> MassMatrix {
        let mut matrix = MassMatrix::default();
        for (row, slope) in frame.potential_gradient(self).iter().enumerate() {
            for coordinate in self.coordinates_of(slope) {
                let column = frame.index(coordinate);
                if column <= row {
                    matrix.add(row, column, self.partial(slope, coordinate).expand());
                }
            }
        }
        matrix
    }

    fn expansion(&self, frame: &DerivedFrame, expansion: &DerivedExpansion) -> MassExpansion {
        let mut leading = MassMatrix::default();
        for (row, &i) in expansion.in_phase.iter().enumerate() {
            for (column, &j) in expansion.in_phase[..=row].iter().enumerate() {
                leading.add(row, column, expansion.orders[0].get(i, j));
            }
        }
        let dense =
            |rows: Vec<Vec<Formula>>| rows.iter().map(|row| self.exprs(row)).collect::<Vec<_>>();
        let written_out = match (
            &expansion.written_out,
            expansion.inverse(),
            expansion.written_velocities(frame),
        ) {
            (Some(written), Some([inverse, first]), Some(velocities)) => Some(WrittenOut {
                determinant: written.determinant,
                determinant_value: self.expr(&written.determinant_value),
                velocities: velocities.iter().map(|(_, f)| self.expr(f)).collect(),
                inverse: dense(inverse),
                inverse_first_order: dense(first),
            }),
            _ => None,
        };
        MassExpansion {
            in_phase: expansion.in_phase.clone(),
            velocities: expansion.velocity_symbols.clone(),
            leading: self.entries(&leading),
            corrections: Vec::new(),
            written_out,
        }
    }

    /// Derives the transfer W into each difference. If copies differ, it uses the mean tree (the
    /// tree with mean constants), and `expansion` is that of the mean tree.
    fn transfers(
        &mut self,
        (frame, mismatch): (&DerivedFrame, Option<&Mismatch<'_>>),
        coordinates: &[Coordinate],
        expansion: &DerivedExpansion,
        request: &TransferRequest,
        plain: &mut MassExpansion,
    ) -> Vec<TransferFormulas> {
        let series = self.series(frame, coordinates, expansion, request);
        plain.corrections = series
            .iter()
            .flat_map(|series| &series.corrections)
            .map(|correction| Correction {
                in_phase: correction.in_phase.clone(),
                right: self.exprs(&correction.right),
                differences: correction
                    .differences
                    .iter()
                    .map(|(symbol, value)| (*symbol, self.expr(value)))
                    .collect(),
            })
            .collect();
        expansion
            .differences
            .iter()
            .map(|&coordinate| {
                let equal = mismatch.map_or(frame, |mismatch| mismatch.mean);
                let energy = self.sub_hamiltonian(equal, coordinates, expansion, coordinate);
                let split = mismatch.map(|mismatch| {
                    let growth = self.exact_transfer(mismatch.mean, expansion, &energy);
                    let forcing = self.forcing(mismatch, &expansion.differences, &energy);
                    [self.parts(&growth), self.parts(&forcing)]
                });
                let transfer = self.transfer(frame, expansion, &energy, request, &series);
                TransferFormulas { split, ..transfer }
            })
            .collect()
    }

    /// Derives all requested quantities of one difference.
    fn transfer(
        &mut self,
        frame: &DerivedFrame,
        expansion: &DerivedExpansion,
        energy: &SubHamiltonian,
        request: &TransferRequest,
        series: &[VelocitySeries],
    ) -> TransferFormulas {
        let coordinate = energy.coordinate;
        let form = |counting: Counting, order: u32, parts: EnergyParts| Truncated {
            counting,
            order,
            parts,
        };
        let (mut truncated, mut quadratic_form) = (Vec::new(), None);
        if request.angle_orders.contains(&1) {
            let parts = self.angle_transfer(frame, expansion, energy);
            truncated.push(form(Counting::Angle, 1, self.parts(&parts)));
        }
        if request.amplitude_orders.contains(&2) {
            let parts = self.amplitude_transfer(frame, expansion, energy);
            quadratic_form = self.quadratic_form(frame, expansion, coordinate, &parts);
            truncated.push(form(Counting::Amplitude, 2, self.parts(&parts)));
        }
        for series in series {
            for order in higher_orders(request, series.counting) {
                let parts = self.series_transfer(frame, expansion, energy, series, order);
                truncated.push(form(series.counting, order, self.parts(&parts)));
            }
        }
        let exact = request
            .exact
            .then(|| self.exact_transfer(frame, expansion, energy));
        TransferFormulas {
            coordinate,
            energy: EnergyParts {
                kinetic: self.expr(&energy.kinetic),
                potential: self.expr(&energy.potential),
            },
            truncated,
            quadratic_form,
            exact: exact.map(|parts| self.parts(&parts)),
            split: None,
            friction: self.expr(&self.friction_power(frame, energy)),
            drive: self.expr(&self.drive_power(frame, energy)),
            velocity: self.expr(&self.own_velocity(frame, energy)),
        }
    }

    fn parts(&self, parts: &EnergyParts<Formula>) -> EnergyParts {
        parts.map(|part| self.expr(part))
    }

    /// Expands the velocities in a series, for each small quantity (`Counting`) for which orders
    /// are requested that the Poisson brackets do not provide.
    fn series(
        &mut self,
        frame: &DerivedFrame,
        coordinates: &[Coordinate],
        expansion: &DerivedExpansion,
        request: &TransferRequest,
    ) -> Vec<VelocitySeries> {
        [Counting::Angle, Counting::Amplitude]
            .into_iter()
            .filter_map(|counting| {
                let order = higher_orders(request, counting).max()?;
                // Every velocity in W has a factor of first order.
                let order = order.saturating_sub(1);
                Some(self.velocity_series(frame, coordinates, expansion, counting, order))
            })
            .collect()
    }

    fn quadratic_form(
        &self,
        frame: &DerivedFrame,
        expansion: &DerivedExpansion,
        coordinate: usize,
        parts: &EnergyParts<Formula>,
    ) -> Option<[Expr; 3]> {
        let (q, p) = (frame.coordinates[coordinate], frame.momenta[coordinate]);
        let whole = &parts.kinetic + &parts.potential;
        let others = Self::difference_pairs(frame, expansion);
        let foreign = others.iter().any(|&(other, momentum)| {
            other != q && whole.symbols().iter().any(|&s| s == other || s == momentum)
        });
        if foreign {
            return None;
        }
        let table = whole.coefficients(&[p, q]);
        let coefficient = |p: u32, q: u32| match table.get(&vec![p, q]) {
            Some(formula) => self.expr(formula),
            None => Expr::zero(),
        };
        Some([coefficient(2, 0), coefficient(1, 1), coefficient(0, 2)])
    }
}

/// Returns the requested orders that need the series of the velocities. First order in the angles
/// and second order in the amplitude come from Poisson brackets.
fn higher_orders(request: &TransferRequest, counting: Counting) -> impl Iterator<Item = u32> + '_ {
    let orders = match counting {
        Counting::Angle => &request.angle_orders,
        Counting::Amplitude => &request.amplitude_orders,
    };
    let orders = orders.iter().copied();
    orders.filter(move |&order| order != counting.bracket_order())
}
