//! Prints a scene's mechanics, for `cargo branched-pendulum stage mechanics`.

use super::expression::{Expr, SymbolId};
use super::{
    DriveTerms, EnergyParts, Frame, LinkBalance, LinkPositions, MatrixEntry, MeanTree, Mechanics,
    OrbitMechanics, RelativePosition, Temporal, TransferFormulas, constant_text, text,
};
use crate::scene::CoordinateKind;
use std::collections::BTreeSet;
use std::fmt;

impl fmt::Display for Mechanics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.constants(f)?;
        if !self.joints.is_empty() {
            writeln!(f, "joints")?;
        }
        for (&symbol, joint) in &self.joints {
            self.line(f, &self.name(symbol), &joint.formula())?;
        }
        if !self.lines.is_empty() {
            writeln!(f, "lines of straight springs")?;
        }
        for (&symbol, line) in &self.lines {
            self.line(f, &self.name(symbol), &line.formula())?;
        }
        if let Some(drive) = &self.drive {
            self.drive(f, drive)?;
        }
        match &self.link {
            Some(link) => self.link(f, link)?,
            None => {
                writeln!(f, "absolute angles")?;
                self.frame(f, &self.absolute)?;
            }
        }
        if let Some(links) = &self.positions {
            self.positions(f, links)?;
        }
        if let Some(transverse) = &self.transverse {
            self.transverse(f, transverse)?;
        }
        if let Some(normal_form) = &self.normal_form {
            writeln!(f, "normal form of degree 4")?;
            let all: Vec<SymbolId> = normal_form
                .definitions
                .iter()
                .map(|own| own.symbol)
                .collect();
            for formula in normal_form.formulas(&self.symbols, &all, &BTreeSet::new()) {
                self.line(f, &formula.left, &formula.right)?;
            }
        }
        if let Some(frame) = &self.symmetric {
            writeln!(f, "symmetric coordinates")?;
            self.coordinates(f, frame)?;
            self.frame(f, frame)?;
        }
        if let Some(sectors) = &self.sectors {
            self.sectors(f, sectors)?;
        }
        self.expansion(f)?;
        if let Some(MeanTree { frame, added }) = &self.mean_tree {
            writeln!(f, "mean tree, and velocities u that the mismatch adds")?;
            self.matrix(f, "M̃₀", &frame.mass)?;
            for (&symbol, value) in added.unknowns.iter().zip(&added.right) {
                writeln!(f, "  (M̃₀ {}) = {}", self.name(symbol), self.text(value))?;
            }
        }
        for transfer in &self.transfers {
            self.transfer(f, transfer)?;
        }
        self.observables(f)
    }
}

impl Mechanics {
    fn constants(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.constants.is_empty() {
            writeln!(f, "constants")?;
        }
        for constant in &self.constants {
            writeln!(
                f,
                "  {} = {} [{}]: {}",
                self.name(constant.symbol),
                constant_text(&constant.value, &self.symbols),
                constant.unit,
                constant.meaning
            )?;
        }
        Ok(())
    }

    /// Prints the inverse mass matrix by orders of the differences.
    fn expansion(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(expansion) = &self.expansion {
            writeln!(f, "in-phase velocities: M⁽⁰⁾ w = p")?;
            self.matrix(f, "M⁽⁰⁾", &expansion.leading)?;
            if let Some(written) = &expansion.written_out {
                for (&symbol, value) in expansion.velocities.iter().zip(&written.velocities) {
                    self.line(f, &self.name(symbol), value)?;
                }
                self.line(
                    f,
                    &self.name(written.determinant),
                    &written.determinant_value,
                )?;
                self.dense(f, "M⁻¹", &written.inverse)?;
                self.dense(f, "first order of M⁻¹", &written.inverse_first_order)?;
            }
        }
        for correction in self.expansion.iter().flat_map(|e| &e.corrections) {
            for (&symbol, value) in correction.in_phase.iter().zip(&correction.right) {
                writeln!(f, "  (M⁽⁰⁾ {}) = {}", self.name(symbol), self.text(value))?;
            }
            for (symbol, value) in &correction.differences {
                self.line(f, &self.name(*symbol), value)?;
            }
        }
        Ok(())
    }

    fn transfer(&self, f: &mut fmt::Formatter<'_>, transfer: &TransferFormulas) -> fmt::Result {
        let name = &self.coordinates[transfer.coordinate].name;
        writeln!(f, "transfer into {name}")?;
        self.line(f, "T", &transfer.energy.kinetic)?;
        self.line(f, "V", &transfer.energy.potential)?;
        for truncated in &transfer.truncated {
            let name = format!("{} order {}", truncated.counting.name(), truncated.order);
            self.parts(f, &name, &truncated.parts)?;
        }
        if let Some(form) = &transfer.quadratic_form {
            for (name, value) in ["a_pp", "a_pq", "a_qq"].iter().zip(form) {
                self.line(f, name, value)?;
            }
        }
        if let Some(exact) = &transfer.exact {
            self.parts(f, "exact", exact)?;
        }
        if let Some([growth, forcing]) = &transfer.split {
            self.parts(f, "growth", growth)?;
            self.parts(f, "forcing", forcing)?;
        }
        if !transfer.friction.is_zero() {
            self.line(f, "power of friction", &transfer.friction)?;
        }
        if !transfer.drive.is_zero() {
            self.line(f, "power of the drive", &transfer.drive)?;
        }
        Ok(())
    }

    /// Prints each point relative to its reference pivot, with its rates.
    fn positions(&self, f: &mut fmt::Formatter<'_>, links: &[LinkPositions]) -> fmt::Result {
        writeln!(f, "positions from the pivot of the link that they are on")?;
        for (&angle, link) in self.absolute.coordinates.iter().zip(links) {
            let name = &self.symbols.get(angle).code["theta_".len()..];
            let pivot = link.pivot.iter().map(|pivot| ("pivot", pivot));
            let others = [("centre", &link.centre), ("end", &link.end)];
            for (point, relative) in pivot.chain(others) {
                let RelativePosition {
                    position, velocity, ..
                } = relative;
                for (axis, value, rate) in [
                    ("x", &position[0], &velocity[0]),
                    ("y", &position[1], &velocity[1]),
                ] {
                    self.line(f, &format!("{axis} of {point} {name}"), value)?;
                    self.line(f, "  rate", rate)?;
                }
            }
        }
        Ok(())
    }

    pub(super) fn name(&self, symbol: SymbolId) -> String {
        self.symbols.get(symbol).text.clone()
    }

    fn text(&self, expr: &Expr) -> String {
        text(expr, &self.symbols)
    }

    pub(super) fn line(&self, f: &mut fmt::Formatter<'_>, left: &str, right: &Expr) -> fmt::Result {
        writeln!(f, "  {left} = {}", self.text(right))
    }

    pub(super) fn matrix(
        &self,
        f: &mut fmt::Formatter<'_>,
        name: &str,
        entries: &[MatrixEntry],
    ) -> fmt::Result {
        entries.iter().try_for_each(|entry| {
            let left = format!("{name}[{}, {}]", entry.row + 1, entry.column + 1);
            self.line(f, &left, &entry.value)
        })
    }

    fn dense(&self, f: &mut fmt::Formatter<'_>, name: &str, rows: &[Vec<Expr>]) -> fmt::Result {
        for (i, row) in rows.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                if !value.is_zero() {
                    self.line(f, &format!("{name}[{}, {}]", i + 1, j + 1), value)?;
                }
            }
        }
        Ok(())
    }

    fn frame(&self, f: &mut fmt::Formatter<'_>, frame: &Frame) -> fmt::Result {
        if let Some(energies) = &frame.energies {
            self.line(f, "K", &energies.kinetic)?;
            self.line(f, "U", &energies.potential)?;
        }
        self.matrix(f, "M", &frame.mass)?;
        for (index, bias) in frame.bias.iter().enumerate() {
            self.line(f, &format!("b[{}]", index + 1), bias)?;
        }
        for torque in &frame.torques {
            if let Some(formula) = torque.formula() {
                self.line(f, &self.name(torque.symbol), &formula)?;
            }
        }
        for (index, force) in frame.drive.iter().enumerate() {
            if !force.is_zero() {
                self.line(f, &format!("Q[{}]", index + 1), force)?;
            }
        }
        for (&symbol, value) in frame.momenta.iter().zip(frame.momentum.iter().flatten()) {
            self.line(f, &self.name(symbol), value)?;
        }
        match &frame.stiffness {
            Some(stiffness) => self.matrix(f, "∂²U", stiffness),
            None => Ok(()),
        }
    }

    fn link(&self, f: &mut fmt::Formatter<'_>, link: &LinkBalance) -> fmt::Result {
        writeln!(f, "one link, with the subtrees on one pivot of it")?;
        let mut formulas = link.formulas(&self.symbols);
        if let Some(body) = &self.body {
            let functions = body.functions.iter();
            formulas.extend(functions.flat_map(|&of| body.formulas(&self.symbols, of)));
        }
        if let (Some(forces), Some(body), Some(scales)) =
            (&self.joint_forces, &self.body, &self.scales)
        {
            formulas.extend(scales.formulas(forces, body));
        }
        formulas
            .iter()
            .try_for_each(|formula| self.line(f, &formula.left, &formula.right))
    }

    fn drive(&self, f: &mut fmt::Formatter<'_>, drive: &DriveTerms) -> fmt::Result {
        writeln!(f, "drive")?;
        for motion in &drive.pivot {
            self.line(f, motion.name, &motion.position)?;
        }
        for (&symbol, meaning) in &drive.temporal {
            if let Temporal::Given(value) = meaning {
                self.line(f, &self.name(symbol), value)?;
            }
        }
        let powers = [
            ("power", &drive.power),
            ("power of friction", &self.friction_power),
        ];
        powers.iter().try_for_each(|(name, power)| match power {
            Some(power) => self.line(f, name, power),
            None => Ok(()),
        })
    }

    fn coordinates(&self, f: &mut fmt::Formatter<'_>, frame: &Frame) -> fmt::Result {
        for (&symbol, coordinate) in frame.coordinates.iter().zip(&self.coordinates) {
            let kind = match coordinate.kind {
                CoordinateKind::Mean { .. } => "mean",
                CoordinateKind::Difference { .. } => "difference",
            };
            let weights: Vec<String> = coordinate
                .weights
                .iter()
                .map(|(link, weight)| {
                    format!(
                        "{weight:+} {}",
                        self.name(self.absolute.coordinates[link.0])
                    )
                })
                .collect();
            writeln!(
                f,
                "  {} = ({}) / {}, {kind}",
                self.name(symbol),
                weights.join(" "),
                coordinate.norm()
            )?;
        }
        Ok(())
    }

    fn observables(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let observables = &self.observables;
        for (place, used) in [
            ("absolute angles", &observables.absolute),
            ("symmetric coordinates", &observables.symmetric),
        ] {
            if used.definitions.is_empty() {
                continue;
            }
            writeln!(f, "for rates in {place}")?;
            for (&symbol, value) in &used.definitions {
                self.line(f, &self.name(symbol), value)?;
            }
        }
        for observable in &observables.list {
            writeln!(f, "observable {}", observable.name)?;
            self.line(f, "F", &observable.value)?;
            self.line(f, "dF/dt", &observable.rate)?;
            if !observable.friction.is_zero() {
                self.line(f, "friction's part of dF/dt", &observable.friction)?;
            }
            if let Some(canonical) = &observable.canonical {
                self.line(f, "{F, H} and friction", &canonical.rate)?;
                if let Some(system) = &canonical.adjoint {
                    for (&symbol, right) in system.unknowns.iter().zip(&system.right) {
                        writeln!(f, "  (M {}) = {}", self.name(symbol), self.text(right))?;
                    }
                }
            }
        }
        Ok(())
    }

    fn parts(&self, f: &mut fmt::Formatter<'_>, name: &str, parts: &EnergyParts) -> fmt::Result {
        self.line(f, &format!("W_K, {name}"), &parts.kinetic)?;
        self.line(f, &format!("W_P, {name}"), &parts.potential)
    }

    /// Prints the sectors (sets of symmetric coordinates: all means, or one difference between
    /// copies), with their blocks of the mass matrix at the in-phase motion.
    fn sectors(&self, f: &mut fmt::Formatter<'_>, sectors: &OrbitMechanics) -> fmt::Result {
        for sector in &sectors.sectors {
            writeln!(
                f,
                "sector {} of {} coordinates",
                sector.name,
                sector.coordinates.len()
            )?;
            let orbit =
                |coordinate: usize| self.coordinates[coordinate].kind.orbit_and_difference().0;
            let mean = |wanted: usize| {
                let mut means = self.coordinates.iter();
                let found = means.find(|c| c.kind.orbit_and_difference() == (wanted, None));
                found.map_or("", |coordinate| coordinate.name.as_str())
            };
            for (place, &row) in sector.coordinates.iter().enumerate() {
                let (of_row, norm) = (orbit(row), self.coordinates[row].norm());
                for &column in &sector.coordinates[..=place] {
                    let of_column = orbit(column);
                    let names = [row, column].map(|index| &self.coordinates[index].name);
                    write!(f, "  B[{}, {}] = ", names[0], names[1])?;
                    if row == column {
                        let moment = self.text(&self.articulation.joints[of_row].inertia);
                        writeln!(f, "{norm} {moment}")?;
                        continue;
                    }
                    let coupling = sectors
                        .couplings
                        .iter()
                        .find(|c| (c.row, c.column) == (of_row, of_column));
                    let Some(coupling) = coupling else {
                        writeln!(f, "0")?;
                        continue;
                    };
                    let angle = format!("(θ_{} − θ_{})", mean(of_row), mean(of_column));
                    let mut terms = Vec::new();
                    for (factor, function) in [(&coupling.cosine, "cos"), (&coupling.sine, "sin")] {
                        if !factor.is_zero() {
                            terms.push(format!("{norm} {} {function}{angle}", self.text(factor)));
                        }
                    }
                    writeln!(f, "{}", terms.join(" + "))?;
                }
            }
        }
        Ok(())
    }
}
