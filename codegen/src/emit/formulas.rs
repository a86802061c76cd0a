//! The formulas behind each entry point, for its docs.

use super::Emission;
use crate::mechanics::expression::{Expr, Role, SymbolId};
use crate::mechanics::{
    BrakingTorque, Frame, LinkFormula, TransferFormulas, TransferParts, WrittenOut,
};
use crate::program::{Cause, Purpose};

/// A formula: left side and right side.
pub(super) struct DocFormula {
    pub(super) left: String,
    pub(super) left_latex: String,
    pub(super) right: Expr,
}

impl From<LinkFormula> for DocFormula {
    fn from(line: LinkFormula) -> Self {
        let LinkFormula {
            left,
            left_latex,
            right,
        } = line;
        Self {
            left,
            left_latex,
            right,
        }
    }
}

impl Emission<'_> {
    pub(super) fn formulas(&self, purpose: Purpose) -> Vec<DocFormula> {
        let mechanics = self.mechanics;
        let absolute = &mechanics.absolute;
        let symmetric = mechanics.symmetric.as_ref();
        let simple = |left: &str, right: &Expr| {
            vec![DocFormula {
                left: left.to_owned(),
                left_latex: left.to_owned(),
                right: right.clone(),
            }]
        };
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
            Purpose::AngleTransfer(n) => self.transfer(&mechanics.transfers[n], |t| &t.angle),
            Purpose::AmplitudeTransfer(n) => {
                self.transfer(&mechanics.transfers[n], |t| &t.amplitude)
            }
            Purpose::ExactTransfer(n) | Purpose::ExactTransferFromRates(n) => {
                self.transfer(&mechanics.transfers[n], |t| &t.exact)
            }
            Purpose::SplitTransfer(n, cause) => match &mechanics.transfers[n].split {
                Some([growth, forcing]) => Self::transfer_parts(match cause {
                    Cause::MeanTree => growth,
                    Cause::Mismatch => forcing,
                }),
                None => Vec::new(),
            },
            Purpose::QuadraticForm(n) => match &mechanics.transfers[n].quadratic_form {
                Some(form) => ["a_pp", "a_pq", "a_qq"]
                    .iter()
                    .zip(form)
                    .map(|(name, expr)| DocFormula {
                        left: (*name).to_owned(),
                        left_latex: format!("a_{{{}}}", &name[2..]),
                        right: expr.clone(),
                    })
                    .chain(self.written_out())
                    .collect(),
                None => Vec::new(),
            },
            Purpose::AntiphaseDrivePower(n) => self.power_formulas(&mechanics.transfers[n].drive),
            Purpose::Drive | Purpose::RootDrive => self.drive_formulas(),
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
            Purpose::FrictionPower(n) => simple("P", &mechanics.transfers[n].friction),
            Purpose::Scale(function) => self.scale_formulas(function),
            Purpose::Observable(n, form) => self.observable_formulas(n, form),
            Purpose::Positions(_) | Purpose::PointVelocities(_) => self.positions_formulas(purpose),
            Purpose::Transverse(_)
            | Purpose::TransverseEnergy(_)
            | Purpose::TransverseTransfer(_)
            | Purpose::TransverseFriction(_) => self.transverse_formulas(purpose),
            Purpose::SmallEnergy => self.small_formulas(),
            Purpose::SmallAccelerations
            | Purpose::AbsoluteVelocities
            | Purpose::AccelerationsUnder
            | Purpose::Prescribed(_)
            | Purpose::OutsidePower
            | Purpose::AntiphaseOutsidePower(_)
            | Purpose::BudgetUnder(_)
            | Purpose::TaylorCoefficients
            | Purpose::MassMatrix
            | Purpose::Budget(_)
            | Purpose::SectorTransfers(_)
            | Purpose::TransferMatrix
            | Purpose::HigherTransfer(..)
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

    fn momentum_rates(&self, frame: &Frame) -> Vec<DocFormula> {
        let rates = frame.momentum_rates.iter().flatten();
        frame
            .momenta
            .iter()
            .zip(rates)
            .map(|(&id, rate)| {
                let symbol = self.mechanics.symbols.get(id);
                DocFormula {
                    left: format!("d{}/dt", symbol.text),
                    left_latex: format!("\\dot {}", symbol.latex),
                    right: rate.clone(),
                }
            })
            .collect()
    }

    fn momenta(&self, frame: &Frame) -> Vec<DocFormula> {
        match &frame.momentum {
            Some(momentum) => self.rows(&frame.momenta, momentum),
            None => Vec::new(),
        }
    }

    pub(super) fn rows(&self, symbols: &[SymbolId], exprs: &[Expr]) -> Vec<DocFormula> {
        symbols
            .iter()
            .zip(exprs)
            .map(|(&id, expr)| {
                let symbol = self.mechanics.symbols.get(id);
                DocFormula {
                    left: symbol.text.clone(),
                    left_latex: symbol.latex.clone(),
                    right: expr.clone(),
                }
            })
            .collect()
    }

    /// Entries of M below the diagonal and on it, and the rows of b.
    fn equations(&self, frame: &Frame) -> Vec<DocFormula> {
        let name = |index: usize| {
            let code = &self.mechanics.symbols.get(frame.coordinates[index]).code;
            code.strip_prefix("theta_").unwrap_or(code).to_owned()
        };
        let tex = |name: &str| name.replace('_', "\\_");
        let mut formulas: Vec<DocFormula> = frame
            .mass
            .iter()
            .map(|entry| {
                let (row, column) = (name(entry.row), name(entry.column));
                DocFormula {
                    left: format!("M[{row}, {column}]"),
                    left_latex: format!("M_{{\\mathrm{{{},{}}}}}", tex(&row), tex(&column)),
                    right: entry.value.clone(),
                }
            })
            .collect();
        formulas.extend(
            frame
                .bias
                .iter()
                .enumerate()
                .map(|(index, bias)| DocFormula {
                    left: format!("b[{}]", name(index)),
                    left_latex: format!("b_{{\\mathrm{{{}}}}}", tex(&name(index))),
                    right: bias.clone(),
                }),
        );
        formulas.extend(self.braking_formulas(frame));
        formulas
    }

    /// Torques of friction that is not viscous, link by link.
    pub(super) fn braking_formulas(&self, frame: &Frame) -> Vec<DocFormula> {
        let formula = |torque: &BrakingTorque| {
            let symbol = self.mechanics.symbols.get(torque.symbol);
            Some(DocFormula {
                left: symbol.text.clone(),
                left_latex: symbol.latex.clone(),
                right: torque.formula()?,
            })
        };
        frame.torques.iter().filter_map(formula).collect()
    }

    fn transfer(
        &self,
        transfer: &TransferFormulas,
        form: fn(&TransferFormulas) -> &Option<TransferParts>,
    ) -> Vec<DocFormula> {
        let Some(parts) = form(transfer) else {
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

    fn transfer_parts(parts: &TransferParts) -> Vec<DocFormula> {
        let named = |name: &str, expr: &Expr| DocFormula {
            left: name.to_owned(),
            left_latex: format!("W_{{{}}}", &name[2..]),
            right: expr.clone(),
        };
        vec![named("W_K", &parts.kinetic), named("W_P", &parts.potential)]
    }

    /// w and D, where they are written out.
    fn written_out(&self) -> Vec<DocFormula> {
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
