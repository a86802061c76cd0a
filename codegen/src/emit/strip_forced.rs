//! Torques from outside on trees in loops.

use super::Emission;
use super::computes::SliceFunction;
use proc_macro2::TokenStream;
use quote::quote;

impl Emission<'_> {
    /// The accelerations under torques; NaN for slices of a wrong length.
    pub(super) fn strip_forced(&self) -> TokenStream {
        let drive = self.drive_at_time();
        let function = SliceFunction {
            name: "AccelerationsUnderTorques",
            given: &["theta", "omega", "torques"],
            results: &["alpha"],
            index: None,
        };
        self.computes(
            &function,
            &quote! {
                self.tree.evaluate_under(#drive, [theta, omega, torques], alpha);
            },
            Some(&quote! {
                let given: [&[T]; 3] = [theta, omega, torques];
                self.tree.accelerations_under_with(workspace, #drive, given, alpha);
            }),
        )
    }
}
