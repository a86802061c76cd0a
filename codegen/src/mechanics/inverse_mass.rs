//! Expansion of the inverse mass matrix in the difference angles (physics §4): M̃ = M⁽⁰⁾ + ε M⁽¹⁾ +
//! ε² M⁽²⁾ + …. With w = M⁽⁰⁾⁻¹ p it gives the kinetic energy order by order, without writing out
//! an inverse.

use super::algebra::Formula;
use super::derivation::{Derivation, Trigonometric};
use super::expression::{Role, SymbolId};
use super::frame::{DerivedFrame, MassMatrix};
use super::print::latex_name;
use crate::functions::Counting;
use crate::scene::{Coordinate, CoordinateKind};

/// Largest in-phase block whose inverse is also written out, for printed formulas.
const WRITTEN_OUT: usize = 2;

/// Mass matrix M̃ and its inverse, expanded about the in-phase motion.
pub(super) struct DerivedExpansion {
    /// Indices of the means among the coordinates.
    pub(super) in_phase: Vec<usize>,
    /// Indices of the differences among the coordinates.
    pub(super) differences: Vec<usize>,
    /// Orders M⁽⁰⁾, M⁽¹⁾, M⁽²⁾, … of the mass matrix, including their powers of the difference
    /// angles.
    pub(super) orders: Vec<MassMatrix>,
    /// Velocities w = M⁽⁰⁾⁻¹ p at leading order: a symbol for each mean, and p_d / M_dd for a
    /// difference d.
    pub(super) velocities: Vec<Formula>,
    /// Symbols of the velocities w of the means, in the order of `in_phase`.
    pub(super) velocity_symbols: Vec<SymbolId>,
    /// Inverse of the in-phase block, written out if the block is small.
    pub(super) written_out: Option<DerivedInverse>,
}

/// Inverse of the in-phase block: adjugate and determinant.
pub(super) struct DerivedInverse {
    /// Symbol D of the determinant.
    pub(super) determinant: SymbolId,
    /// Formula of the determinant D.
    pub(super) determinant_value: Formula,
    /// Adjugate, dense, in the order of `in_phase`.
    pub(super) adjugate: Vec<Vec<Formula>>,
}

impl Derivation<'_> {
    /// Returns the coefficients of ε⁰, ε¹, … ε^order of a formula. The differences have a factor ε,
    /// and with [`Counting::Amplitude`] also their momenta.
    pub(super) fn orders(
        &mut self,
        formula: &Formula,
        pairs: &[(SymbolId, SymbolId)],
        counting: Counting,
        order: u32,
    ) -> Vec<Formula> {
        self.orders_with(formula, pairs, counting, order, Vec::new())
    }

    /// Returns the symbol of the expansion's small factor ε.
    pub(super) fn epsilon(&mut self) -> SymbolId {
        self.symbols
            .intern(Role::Bookkeeping, "epsilon", "ε", "\\varepsilon")
    }

    /// Computes [`orders`](Self::orders) with further symbols replaced by series in ε.
    pub(super) fn orders_with(
        &mut self,
        formula: &Formula,
        pairs: &[(SymbolId, SymbolId)],
        counting: Counting,
        order: u32,
        mut replacements: Vec<(SymbolId, Formula)>,
    ) -> Vec<Formula> {
        let epsilon = self.epsilon();
        let small = Formula::symbol(epsilon);
        for &(q, p) in pairs {
            let scaled = &small * &Formula::symbol(q);
            let (cos, sin) = series(&scaled, order);
            replacements.push((self.cos(q), cos));
            replacements.push((self.sin(q), sin));
            replacements.push((q, scaled));
            if counting == Counting::Amplitude {
                replacements.push((p, &small * &Formula::symbol(p)));
            }
        }
        for symbol in formula.symbols() {
            let (id, versine) = match self.trigonometry.get(&symbol) {
                Some(Trigonometric::VersineOf(id)) => (id, true),
                Some(Trigonometric::SineOf(id)) => (id, false),
                _ => continue,
            };
            let angle: Formula = self.combinations[id.0]
                .iter()
                .map(|&(c, w)| &Formula::integer(w) * &Formula::symbol(c))
                .sum();
            let (cos, sin) = series(&(&small * &angle), order);
            let value = if versine {
                &Formula::integer(1) - &cos
            } else {
                sin
            };
            replacements.push((symbol, value));
        }
        let formula = self.with_rests(formula);
        let table = formula.substitute(&replacements).coefficients(&[epsilon]);
        (0..=order)
            .map(|n| table.get(&vec![n]).cloned().unwrap_or_else(Formula::zero))
            .collect()
    }

    /// Expands M̃ about the in-phase motion up to `order`, which is at least 2.
    pub(super) fn expand_mass(
        &mut self,
        frame: &DerivedFrame,
        coordinates: &[Coordinate],
        order: u32,
    ) -> DerivedExpansion {
        let order = order.max(2);
        let (differences, in_phase): (Vec<usize>, Vec<usize>) = (0..coordinates.len())
            .partition(|&i| matches!(coordinates[i].kind, CoordinateKind::Difference { .. }));
        let pairs: Vec<_> = differences
            .iter()
            .map(|&d| (frame.coordinates[d], frame.momenta[d]))
            .collect();
        let mut orders = vec![MassMatrix::default(); order as usize + 1];
        for (i, j, entry) in frame.mass.iter() {
            let parts = self.orders(entry, &pairs, Counting::Angle, order);
            for (matrix, part) in orders.iter_mut().zip(parts) {
                matrix.add(i, j, part);
            }
        }
        let mut velocities: Vec<Formula> = (0..coordinates.len())
            .map(|i| &Formula::symbol(frame.momenta[i]) / &orders[0].get(i, i))
            .collect();
        let mut velocity_symbols = Vec::new();
        for &i in &in_phase {
            let name = &coordinates[i].name;
            let id = self.symbols.intern(
                Role::Derived,
                &format!("in_phase_omega_{name}"),
                &format!("w_{name}"),
                &format!("w_{{\\mathrm{{{}}}}}", latex_name(name)),
            );
            velocity_symbols.push(id);
            velocities[i] = Formula::symbol(id);
        }
        let written_out = self.write_out(&orders[0], &in_phase);
        DerivedExpansion {
            in_phase,
            differences,
            orders,
            velocities,
            velocity_symbols,
            written_out,
        }
    }

    fn write_out(&mut self, leading: &MassMatrix, in_phase: &[usize]) -> Option<DerivedInverse> {
        if in_phase.is_empty() || in_phase.len() > WRITTEN_OUT {
            return None;
        }
        let entry = |i: usize, j: usize| leading.get(in_phase[i], in_phase[j]);
        let (adjugate, determinant_value) = if in_phase.len() == 1 {
            (vec![vec![Formula::integer(1)]], entry(0, 0))
        } else {
            let off = entry(1, 0);
            let value = &(&entry(0, 0) * &entry(1, 1)) - &off.pow(2);
            let adjugate = vec![vec![entry(1, 1), -off.clone()], vec![-off, entry(0, 0)]];
            (adjugate, value.expand())
        };
        let determinant = self.symbols.intern(Role::Derived, "determinant", "D", "D");
        Some(DerivedInverse {
            determinant,
            determinant_value,
            adjugate,
        })
    }
}

/// Returns the Taylor series of cos x and sin x up to x^order.
fn series(x: &Formula, order: u32) -> (Formula, Formula) {
    let mut cos = Formula::zero();
    let mut sin = Formula::zero();
    let mut factorial = Formula::integer(1);
    for n in 0..=order {
        if n > 0 {
            factorial = &factorial * &Formula::integer(i64::from(n));
        }
        let term = &x.pow(n as i32) / &factorial;
        let signed = if (n / 2) % 2 == 0 { term } else { -term };
        if n % 2 == 0 {
            cos = &cos + &signed;
        } else {
            sin = &sin + &signed;
        }
    }
    (cos, sin)
}

impl DerivedExpansion {
    /// Returns the product M⁽ⁿ⁾ w for n = `order`, with the mass matrix of that order.
    fn apply(&self, order: usize) -> Vec<Formula> {
        let n = self.velocities.len();
        (0..n)
            .map(|i| {
                (0..n)
                    .map(|j| &self.orders[order].get(i, j) * &self.velocities[j])
                    .sum()
            })
            .collect()
    }

    fn half_form(&self, left: &[Formula], right: &[Formula]) -> Formula {
        let products: Formula = left.iter().zip(right).map(|(a, b)| a * b).sum();
        &Formula::integer(2).pow(-1) * &products
    }

    /// Returns K⁽¹⁾ = −½ wᵀ M⁽¹⁾ w, the part of the kinetic energy of first order in the difference
    /// angles.
    pub(super) fn first_order(&self) -> Formula {
        -self.half_form(&self.velocities, &self.apply(1)).expand()
    }

    /// Returns the terms of K⁽¹⁾ + K⁽²⁾ of second order in the amplitude, with K⁽²⁾ = ½ wᵀ(M⁽¹⁾
    /// M⁽⁰⁾⁻¹ M⁽¹⁾ − M⁽²⁾) w. Only the diagonal of M⁽⁰⁾⁻¹ for the differences enters, because the
    /// in-phase part of M⁽¹⁾ w is itself of second order in the amplitude.
    pub(super) fn second_order_in_amplitude(&self) -> Formula {
        let coupling = self.apply(1);
        let squares: Formula = self
            .differences
            .iter()
            .map(|&d| &coupling[d].pow(2) / &self.orders[0].get(d, d))
            .sum();
        let half = Formula::integer(2).pow(-1);
        let second = self.half_form(&self.velocities, &self.apply(2));
        let quadratic = &(&half * &squares) - &second;
        (&self.first_order() + &quadratic).expand()
    }

    /// Returns the inverse mass matrix up to first order in the difference angles, written out:
    /// M⁽⁰⁾⁻¹ and −M⁽⁰⁾⁻¹ M⁽¹⁾ M⁽⁰⁾⁻¹.
    pub(super) fn inverse(&self) -> Option<[Vec<Vec<Formula>>; 2]> {
        let written = self.written_out.as_ref()?;
        let n = self.velocities.len();
        let mut leading = vec![vec![Formula::zero(); n]; n];
        for &d in &self.differences {
            leading[d][d] = self.orders[0].get(d, d).pow(-1);
        }
        let over_determinant = Formula::symbol(written.determinant).pow(-1);
        for (a, &i) in self.in_phase.iter().enumerate() {
            for (b, &j) in self.in_phase.iter().enumerate() {
                leading[i][j] = &written.adjugate[a][b] * &over_determinant;
            }
        }
        let product = |left: &dyn Fn(usize, usize) -> Formula,
                       right: &dyn Fn(usize, usize) -> Formula| {
            (0..n)
                .map(|i| {
                    (0..n)
                        .map(|j| (0..n).map(|k| &left(i, k) * &right(k, j)).sum::<Formula>())
                        .collect::<Vec<_>>()
                })
                .collect::<Vec<_>>()
        };
        let half = product(&|i, k| leading[i][k].clone(), &|k, j| {
            self.orders[1].get(k, j)
        });
        let first = product(&|i, k| half[i][k].clone(), &|k, j| leading[k][j].clone());
        let first = first
            .into_iter()
            .map(|row| row.into_iter().map(|entry| -entry.expand()).collect())
            .collect();
        Some([leading, first])
    }

    /// Returns the in-phase velocities w written out, one per mean.
    pub(super) fn written_velocities(
        &self,
        frame: &DerivedFrame,
    ) -> Option<Vec<(SymbolId, Formula)>> {
        let written = self.written_out.as_ref()?;
        let over_determinant = Formula::symbol(written.determinant).pow(-1);
        let rows = written.adjugate.iter().map(|row| {
            let numerator: Formula = row
                .iter()
                .zip(&self.in_phase)
                .map(|(entry, &j)| entry * &Formula::symbol(frame.momenta[j]))
                .sum();
            &numerator * &over_determinant
        });
        Some(self.velocity_symbols.iter().copied().zip(rows).collect())
    }
}
