//! Formulas for the docs of each entry point.

use super::Emission;
use crate::functions::{Cause, Counting, Purpose};
use crate::mechanics::expression::{Expr, NamedFormula, Role, SymbolId};
use crate::mechanics::{BrakingTorque, EnergyParts, Frame, LineMeaning, WrittenOut};
use std::collections::BTreeSet;

impl Emission<'_> {
    /// Returns the formulas of a function, with the definitions of the relative angles and rates in
    /// them.
    pub(super) fn formulas(&self, purpose: Purpose) -> Vec<NamedFormula> {
        let mut formulas = self.own_formulas(purpose);
        let symbols = &self.mechanics.symbols;
        let mut joints = BTreeSet::new();
        for formula in &formulas {
            formula.right.for_each_symbol(&mut |symbol| {
                joints.insert(symbol);
            });
        }
        let joints = joints.into_iter();
        formulas.extend(joints.filter_map(|symbol| {
            let joint = self.mechanics.joints.get(&symbol)?;
            Some(NamedFormula::of_symbol(symbols, symbol, &joint.formula()))
        }));
        self.add_lines(&mut formulas);
        formulas
    }

    /// Adds the definitions of the symbols that describe the lines of straight springs, each after
    /// the symbols that it uses.
    fn add_lines(&self, formulas: &mut Vec<NamedFormula>) {
        let (symbols, mut known, mut next) = (&self.mechanics.symbols, BTreeSet::new(), 0);
        while let Some(formula) = formulas.get(next) {
            let mut found = BTreeSet::new();
            formula.right.for_each_symbol(&mut |symbol| {
                found.insert(symbol);
                // A root that is spelled out already shows its components.
                let roots = self.mechanics.lines.values();
                for meaning in roots {
                    if let LineMeaning::Root { square, shown } = meaning
                        && *shown == symbol
                    {
                        square.for_each_symbol(&mut |symbol| {
                            found.insert(symbol);
                        });
                    }
                }
            });
            let found = found.into_iter().filter(|symbol| known.insert(*symbol));
            let lines = found.filter_map(|symbol| {
                let line = self.mechanics.lines.get(&symbol)?;
                Some(NamedFormula::of_symbol(symbols, symbol, &line.formula()))
            });
            let lines: Vec<NamedFormula> = lines.collect();
            formulas.extend(lines);
            next += 1;
        }
    }

    fn own_formulas(&self, purpose: Purpose) -> Vec<NamedFormula> {
        let mechanics = self.mechanics;
        let absolute = &mechanics.absolute;
        let symmetric = mechanics.symmetric.as_ref();
        let simple = |left: &str, right: &Expr| vec![NamedFormula::of_letter(left, right)];
        match purpose {
            Purpose::Accelerations => self.equations(absolute),
            Purpose::KineticEnergy => match &absolute.energies {
                Some(energies) => simple("K", &energies.kinetic),
                None => Vec::new(),
            },
            Purpose::PotentialEnergy => match &absolute.energies {
                Some(energies) => simple("U", &energies.potential),
                None => Vec::new(),
            },
            Purpose::AbsoluteMomenta => self.momenta(absolute),
            Purpose::CanonicalRates => self.momentum_rates(absolute),
            Purpose::SymmetricAccelerations => symmetric
                .map(|frame| self.equations(frame))
                .unwrap_or_default(),
            Purpose::SymmetricMomenta => symmetric
                .map(|frame| self.momenta(frame))
                .unwrap_or_default(),
            Purpose::SubHamiltonian(n) => {
                let energy = &mechanics.transfers[n].energy;
                let sum = Expr::Sum(vec![energy.kinetic.clone(), energy.potential.clone()]);
                simple("H_d", &sum)
            }
            Purpose::TruncatedTransfer(n, counting, order) => {
                self.truncated_formulas(n, counting, order)
            }
            Purpose::ExactTransfer(n, _) => self.transfer(mechanics.transfers[n].exact.as_ref()),
            Purpose::SplitTransfer(n, cause, _) => self.split_formulas(n, cause),
            Purpose::QuadraticForm(n) => self.quadratic_form(n),
            Purpose::AntiphaseDrivePower(n, _) => {
                self.power_formulas(&mechanics.transfers[n].drive)
            }
            Purpose::AntiphaseFrictionPower(n, _) => simple("P", &mechanics.transfers[n].friction),
            Purpose::Drive | Purpose::RootDrive | Purpose::DrivePullback => self.drive_formulas(),
            Purpose::DrivePower => match mechanics.drive.as_ref().and_then(|d| d.power.as_ref()) {
                Some(power) => self.power_formulas(power),
                None => Vec::new(),
            },
            Purpose::TotalFrictionPower => match &mechanics.friction_power {
                Some(power) => {
                    let mut formulas = simple("P", power);
                    formulas.extend(self.braking_formulas(absolute));
                    formulas
                }
                None => Vec::new(),
            },
            Purpose::Scale(function) => self.scale_formulas(function),
            Purpose::Body(function) => match &mechanics.body {
                Some(body) => body.formulas(&mechanics.symbols, function),
                None => Vec::new(),
            },
            Purpose::Observable(n, form) => self.observable_formulas(n, form),
            Purpose::Positions(kind) => self.positions_formulas(kind, false),
            Purpose::PointVelocities(kind) => self.positions_formulas(kind, true),
            Purpose::Transverse(sector) => self.transverse_residuals(sector),
            Purpose::TransverseEnergy(sector) => {
                simple("E", &self.transverse_sector(sector).energy)
            }
            Purpose::TransverseTransfer(sector) => {
                simple("W", &self.transverse_sector(sector).transfer)
            }
            Purpose::TransverseFriction(sector, _) => {
                simple("P", &self.transverse_sector(sector).friction)
            }
            Purpose::SmallEnergy => self.small_formulas(),
            Purpose::NormalForm(function) => self.normal_form_formulas(function),
            Purpose::SmallAccelerations
            | Purpose::SmallAccelerationsUnder
            | Purpose::AbsoluteVelocities
            | Purpose::AccelerationsUnder
            | Purpose::InverseDynamics
            | Purpose::AccelerationsPullback
            | Purpose::AccelerationsUnderPullback
            | Purpose::Gradient(_)
            | Purpose::TransverseMotion(_)
            | Purpose::Prescribed(_)
            | Purpose::OutsidePower
            | Purpose::AntiphaseOutsidePower(..)
            | Purpose::BudgetUnder(_)
            | Purpose::TaylorCoefficients
            | Purpose::MassMatrix
            | Purpose::Budget(..)
            | Purpose::SectorTransfers(_)
            | Purpose::TruncatedSectorTransfers(..)
            | Purpose::TransferMatrix(_)
            | Purpose::StiffnessMatrix
            | Purpose::ToSymmetric
            | Purpose::FromSymmetric
            | Purpose::SymmetricVelocities
            | Purpose::Hamiltonian
            | Purpose::PointTorques(_)
            | Purpose::LinkProperties
            | Purpose::Link(_)
            | Purpose::RootGravity => Vec::new(),
        }
    }

    /// Returns the formulas of the energy transfer W up to an order. Only the order that is a
    /// single Poisson bracket is short enough to be shown.
    fn truncated_formulas(&self, n: usize, counting: Counting, order: u32) -> Vec<NamedFormula> {
        if order != counting.bracket_order() {
            return Vec::new();
        }
        self.transfer(self.mechanics.transfers[n].truncated(counting, order))
    }

    /// Returns the formulas of the part of W that has one cause.
    fn split_formulas(&self, n: usize, cause: Cause) -> Vec<NamedFormula> {
        let Some([growth, forcing]) = &self.mechanics.transfers[n].split else {
            return Vec::new();
        };
        Self::transfer_parts(match cause {
            Cause::MeanTree => growth,
            Cause::Mismatch => forcing,
        })
    }

    /// Returns the formulas of the coefficients of the quadratic form of W.
    fn quadratic_form(&self, n: usize) -> Vec<NamedFormula> {
        let Some(form) = &self.mechanics.transfers[n].quadratic_form else {
            return Vec::new();
        };
        let coefficients = ["a_pp", "a_pq", "a_qq"].iter().zip(form);
        let coefficients = coefficients
            .map(|(&name, expr)| NamedFormula::new(name, format!("a_{{{}}}", &name[2..]), expr));
        coefficients.chain(self.written_out()).collect()
    }

    fn momentum_rates(&self, frame: &Frame) -> Vec<NamedFormula> {
        let rates = frame.momentum_rates.iter().flatten();
        frame
            .momenta
            .iter()
            .zip(rates)
            .map(|(&id, rate)| {
                let symbol = self.mechanics.symbols.get(id);
                let latex = format!("\\dot {}", symbol.latex);
                NamedFormula::new(format!("d{}/dt", symbol.text), latex, rate)
            })
            .collect()
    }

    fn momenta(&self, frame: &Frame) -> Vec<NamedFormula> {
        match &frame.momentum {
            Some(momentum) => self.rows(&frame.momenta, momentum),
            None => Vec::new(),
        }
    }

    pub(super) fn rows(&self, symbols: &[SymbolId], exprs: &[Expr]) -> Vec<NamedFormula> {
        symbols
            .iter()
            .zip(exprs)
            .map(|(&id, expr)| NamedFormula::of_symbol(&self.mechanics.symbols, id, expr))
            .collect()
    }

    /// Returns the lower triangle of the mass matrix M, and the rows of b.
    fn equations(&self, frame: &Frame) -> Vec<NamedFormula> {
        let name = |index: usize| {
            let code = &self.mechanics.symbols.get(frame.coordinates[index]).code;
            code.strip_prefix("theta_").unwrap_or(code).to_owned()
        };
        let tex = |name: &str| name.replace('_', "\\_");
        let mut formulas: Vec<NamedFormula> = frame
            .mass
            .iter()
            .map(|entry| {
                let (row, column) = (name(entry.row), name(entry.column));
                let latex = format!("M_{{\\mathrm{{{},{}}}}}", tex(&row), tex(&column));
                NamedFormula::new(format!("M[{row}, {column}]"), latex, &entry.value)
            })
            .collect();
        formulas.extend(frame.bias.iter().enumerate().map(|(index, bias)| {
            let row = name(index);
            let latex = format!("b_{{\\mathrm{{{}}}}}", tex(&row));
            NamedFormula::new(format!("b[{row}]"), latex, bias)
        }));
        formulas.extend(self.braking_formulas(frame));
        formulas
    }

    /// Returns the formulas of the torques of friction that is not viscous, link by link.
    pub(super) fn braking_formulas(&self, frame: &Frame) -> Vec<NamedFormula> {
        let symbols = &self.mechanics.symbols;
        let formula = |torque: &BrakingTorque| {
            let right = torque.formula()?;
            Some(NamedFormula::of_symbol(symbols, torque.symbol, &right))
        };
        frame.torques.iter().filter_map(formula).collect()
    }

    fn transfer(&self, parts: Option<&EnergyParts>) -> Vec<NamedFormula> {
        let Some(parts) = parts else {
            return Vec::new();
        };
        let mut formulas = Self::transfer_parts(parts);
        let mut truncated = false;
        parts.kinetic.for_each_symbol(&mut |id| {
            truncated |= self.mechanics.symbols.get(id).role == Role::Derived;
        });
        if truncated {
            formulas.extend(self.written_out());
        }
        formulas
    }

    fn transfer_parts(parts: &EnergyParts) -> Vec<NamedFormula> {
        let named = |name: &str, expr: &Expr| {
            NamedFormula::new(name, format!("W_{{{}}}", &name[2..]), expr)
        };
        vec![named("W_K", &parts.kinetic), named("W_P", &parts.potential)]
    }

    /// Returns the formulas of the in-phase velocities w and of the determinant D, if the other
    /// formulas contain them.
    fn written_out(&self) -> Vec<NamedFormula> {
        let Some(expansion) = &self.mechanics.expansion else {
            return Vec::new();
        };
        let Some(WrittenOut {
            determinant,
            determinant_value,
            velocities,
            ..
        }) = &expansion.written_out
        else {
            return Vec::new();
        };
        let mut formulas = self.rows(&expansion.velocities, velocities);
        formulas.extend(self.rows(&[*determinant], std::slice::from_ref(determinant_value)));
        formulas
    }
}
