//! Docs of driven trees, and the drive as trees in loops take it.

use super::Emission;
use crate::mechanics::expression::{Expr, NamedFormula, SymbolId};
use crate::mechanics::{DriveTerms, PivotMotion, Temporal};
use proc_macro2::TokenStream;
use quote::quote;

impl Emission<'_> {
    /// The drive in words, for the model's docs.
    pub(super) fn drive_docs(&self) -> Vec<String> {
        let Some(drive) = &self.mechanics.drive else {
            return Vec::new();
        };
        let torque = drive.torque.map(|_| "a torque on the root");
        let pivot = (!drive.pivot.is_empty()).then_some("a motion of the root's pivot");
        let what: Vec<&str> = torque.into_iter().chain(pivot).collect();
        let frame = if self.has_moving_pivot() {
            " Energies and momenta are those in the frame of reference that moves with the pivot, where its acceleration acts as an inertial force on every centre of mass."
        } else {
            ""
        };
        let what = match what.as_slice() {
            [] => "no force: the drive is zero at all times".to_owned(),
            what => what.join(" and "),
        };
        vec![String::new(), format!("Driven by {what}.{frame}")]
    }

    /// Sentence about the frame for the docs of a function of the kinetic
    /// energy.
    pub(super) fn frame_note(&self) -> &'static str {
        if self.has_moving_pivot() {
            " In the frame of reference that moves with the root's pivot."
        } else {
            ""
        }
    }

    /// Arguments before the angles, for the docs of accelerations behind `at `.
    pub(super) fn at_time(&self) -> &'static str {
        if self.mechanics.drive.is_some() {
            "`time` (in s), "
        } else {
            ""
        }
    }

    /// Arguments of b beside the state, for formulas.
    pub(super) fn and_time(&self) -> &'static str {
        if self.mechanics.drive.is_some() {
            ", t"
        } else {
            ""
        }
    }

    /// Powers that the conservative transfer leaves out, for its docs.
    pub(super) fn on_top(&self) -> &'static str {
        if self.has_moving_pivot() {
            "the powers of friction and of the drive come on top"
        } else {
            "friction's power comes on top"
        }
    }

    /// Functions of the powers that change the energy beside that of friction, for docs of this.
    pub(super) fn other_powers(&self) -> &'static str {
        match (&self.mechanics.drive, self.scene.requests.forces) {
            (Some(_), false) => "`drive_power`",
            (Some(_), true) => "`drive_power` and `outside_power`",
            (None, _) => "`outside_power`",
        }
    }

    pub(super) fn has_moving_pivot(&self) -> bool {
        let drive = self.mechanics.drive.as_ref();
        drive.is_some_and(|drive| !drive.pivot.is_empty())
    }

    /// The functions of time, by definition: x and y as given, then τ and the
    /// accelerations that follow.
    pub(super) fn drive_formulas(&self) -> Vec<NamedFormula> {
        let Some(DriveTerms {
            temporal, pivot, ..
        }) = &self.mechanics.drive
        else {
            return Vec::new();
        };
        let positions = pivot
            .iter()
            .map(|PivotMotion { name, position, .. }| NamedFormula::of_letter(name, position));
        let given: Vec<(SymbolId, Expr)> = temporal
            .iter()
            .filter_map(|(&symbol, meaning)| match meaning {
                Temporal::Given(value) => Some((symbol, value.clone())),
                _ => None,
            })
            .collect();
        let (symbols, values): (Vec<SymbolId>, Vec<Expr>) = given.into_iter().unzip();
        positions.chain(self.rows(&symbols, &values)).collect()
    }

    /// The power of the drive, and the functions of time in it.
    pub(super) fn power_formulas(&self, power: &Expr) -> Vec<NamedFormula> {
        let power = std::iter::once(NamedFormula::of_letter("P", power));
        power.chain(self.drive_formulas()).collect()
    }

    /// The drive of a model in loops, in the directions of the equations.
    pub(super) fn inner_drive(&self) -> TokenStream {
        match self.scene.stands() {
            true => quote!({
                let [x, y, torque] = self.drive(time);
                [x, -y, torque]
            }),
            false => quote!(self.drive(time)),
        }
    }

    /// The drive as the tree takes it.
    pub(super) fn drive_at_time(&self) -> TokenStream {
        match self.mechanics.drive {
            Some(_) => quote!(::core::option::Option::Some(self.root_drive(time))),
            None => quote!(::core::option::Option::None),
        }
    }
}
