//! Docs of driven trees, and emission of the drive of trees in loops.

use super::Emission;
use crate::mechanics::expression::{Expr, NamedFormula, SymbolId};
use crate::mechanics::{DriveTerms, PivotMotion, Temporal};
use proc_macro2::TokenStream;
use quote::quote;

impl Emission<'_> {
    /// Describes the drive for the model's docs.
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

    /// Returns a sentence about the frame of reference, for the docs of functions of the kinetic
    /// energy.
    pub(super) fn frame_note(&self) -> &'static str {
        if self.has_moving_pivot() {
            " In the frame of reference that moves with the root's pivot."
        } else {
            ""
        }
    }

    /// Returns the list of arguments before the angles, which follows the word `at` in the docs of
    /// accelerations.
    pub(super) fn at_time(&self) -> &'static str {
        if self.mechanics.drive.is_some() {
            "`time` (in s), "
        } else {
            ""
        }
    }

    /// Returns the arguments that b depends on in addition to the state, for formulas.
    pub(super) fn and_time(&self) -> &'static str {
        if self.mechanics.drive.is_some() {
            ", t"
        } else {
            ""
        }
    }

    /// Names the powers that the conservative transfer excludes, for its docs.
    pub(super) fn on_top(&self) -> &'static str {
        if self.has_moving_pivot() {
            "the powers of friction and of the drive are not included"
        } else {
            "the power of friction is not included"
        }
    }

    /// Names the functions of the powers that change the energy in addition to friction, for the
    /// docs of the latter.
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

    /// Returns the formulas of functions of time: the given position (x, y) of the root's pivot and
    /// torque τ, then the resulting accelerations.
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

    /// Returns the formulas of the drive's power, and of the functions of time in it.
    pub(super) fn power_formulas(&self, power: &Expr) -> Vec<NamedFormula> {
        let power = std::iter::once(NamedFormula::of_letter("P", power));
        power.chain(self.drive_formulas()).collect()
    }

    /// Emits the drive of a model in loops, with components along the axes that the equations use.
    pub(super) fn inner_drive(&self) -> TokenStream {
        match self.scene.stands() {
            true => quote!({
                let [x, y, torque] = self.drive(time);
                [x, -y, torque]
            }),
            false => quote!(self.drive(time)),
        }
    }

    /// Emits the drive as the value that the tree's functions receive.
    pub(super) fn drive_at_time(&self) -> TokenStream {
        match self.mechanics.drive {
            Some(_) => quote!(::core::option::Option::Some(self.root_drive(time))),
            None => quote!(::core::option::Option::None),
        }
    }
}
