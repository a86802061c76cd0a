//! Torques from outside on trees in loops.

use super::Emission;
use proc_macro2::TokenStream;
use quote::quote;

impl Emission<'_> {
    /// `impl Forced`; NaN for slices of a wrong length.
    pub(super) fn strip_forced(&self) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let (time, drive) = (self.time_name(), self.drive_at_time());
        let other = super::other_scalar(name);
        let drive_of = self.drive_of(&quote!(pendulum));
        quote! {
            impl<T: #runtime::Scalar> #runtime::Forced<T> for #name<T> {
                fn accelerations_under_into(
                    &self,
                    time: T,
                    theta: &[T],
                    omega: &[T],
                    torques: &[T],
                    alpha: &mut [T],
                ) {
                    let mut workspace = #runtime::system::Workspace::new();
                    #runtime::Forced::accelerations_under_with(
                        self, &mut workspace, time, theta, omega, torques, alpha,
                    );
                }

                fn accelerations_under_with(
                    &self,
                    workspace: &mut #runtime::system::Workspace<T>,
                    #time: T,
                    theta: &[T],
                    omega: &[T],
                    torques: &[T],
                    alpha: &mut [T],
                ) {
                    let given = [theta, omega, torques];
                    self.tree.accelerations_under_with(workspace, #drive, given, alpha);
                }

                #[inline(always)]
                fn accelerations_under_of<#other: #runtime::Scalar>(
                    pendulum: &#name<#other>,
                    #time: #other,
                    theta: &[#other],
                    omega: &[#other],
                    torques: &[#other],
                    alpha: &mut [#other],
                ) {
                    pendulum.tree.evaluate_under(#drive_of, [theta, omega, torques], alpha);
                }
            }
        }
    }
}
