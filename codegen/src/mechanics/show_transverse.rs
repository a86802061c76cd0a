//! Prints small differences of an in-phase motion.

use super::{Mechanics, SmallFormulas, SmallMechanics, TransverseFormulas, TransverseMechanics};
use std::fmt;

impl Mechanics {
    /// Prints the equations of each sector (small differences between copies in phase), M δ̈ + r =
    /// 0, and its energy.
    pub(super) fn transverse(
        &self,
        f: &mut fmt::Formatter<'_>,
        all: &TransverseMechanics,
    ) -> fmt::Result {
        for formulas in &all.sectors {
            let TransverseFormulas {
                sector,
                differences,
                mass,
                residual,
                energy,
                transfer,
                friction,
                ..
            } = formulas;
            writeln!(f, "small differences of {}", sector.name)?;
            self.matrix(f, "M", mass)?;
            for (&symbol, value) in differences.iter().zip(residual) {
                self.line(f, &format!("r of {}", self.name(symbol)), value)?;
            }
            self.line(f, "energy", energy)?;
            self.line(f, "transfer", transfer)?;
            if !friction.is_zero() {
                self.line(f, "power of friction", friction)?;
            }
        }
        all.small
            .iter()
            .try_for_each(|small| self.small(f, all, small))
    }

    /// Prints the terms that small differences add to the in-phase equations.
    fn small(
        &self,
        f: &mut fmt::Formatter<'_>,
        all: &TransverseMechanics,
        small: &SmallMechanics,
    ) -> fmt::Result {
        for formulas in &small.sectors {
            let SmallFormulas {
                sector,
                mass,
                coupling,
                bias,
                difference_bias,
                energy,
            } = formulas;
            writeln!(
                f,
                "differences of {} act back",
                all.sectors[*sector].sector.name
            )?;
            self.matrix(f, "M₂", mass)?;
            self.matrix(f, "M₁", coupling)?;
            for (name, terms) in [("b₂", bias), ("b₁", difference_bias)] {
                for (index, term) in terms.iter().enumerate() {
                    self.line(f, &format!("{name}[{}]", index + 1), term)?;
                }
            }
            self.line(f, "E₂", energy)?;
        }
        Ok(())
    }
}
