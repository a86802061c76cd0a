//! Emits `impl TransferForms`: the forms of the transfer W by index, if a scene has truncated forms
//! and the exact one.

use super::Emission;
use crate::functions::{Counting, EntryState, Purpose};
use crate::program::Entry;
use crate::scene::{SectorVariables, sectors};
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};
use std::collections::BTreeMap;

/// A form of W, in the order in which forms are listed.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum ListedForm {
    Angle(u32),
    Amplitude(u32),
    Exact,
}

impl ListedForm {
    /// Returns the form as the runtime names it.
    fn name(self, runtime: &TokenStream) -> TokenStream {
        match self {
            Self::Angle(order) => {
                let order = Literal::u32_unsuffixed(order);
                quote!(#runtime::TransferForm::Angle(#order))
            }
            Self::Amplitude(order) => {
                let order = Literal::u32_unsuffixed(order);
                quote!(#runtime::TransferForm::Amplitude(#order))
            }
            Self::Exact => quote!(#runtime::TransferForm::Exact),
        }
    }
}

/// The forms in order, each with the call that returns an array of transfers.
type Calls = Vec<(ListedForm, TokenStream)>;

impl Emission<'_> {
    pub(super) fn transfer_forms(&self) -> Option<TokenStream> {
        let all = sectors(&self.mechanics.coordinates);
        let (receivers, forms) = match self.budget_forms() {
            Some(forms) => {
                let receivers = all.iter().map(|sector| sector.name.clone()).collect();
                (receivers, forms)
            }
            None => self.leaf_forms()?,
        };
        Some(self.implementation(&receivers, &forms, &self.small_sectors(&all)))
    }

    /// Returns the calls for W of all sectors; `None` unless there are both truncated forms and the
    /// exact one.
    fn budget_forms(&self) -> Option<Calls> {
        let mut forms = BTreeMap::new();
        for entry in &self.program.entries {
            let call = call(entry);
            if let Purpose::TruncatedSectorTransfers(counting, order) = entry.purpose {
                forms.insert(truncated(counting, order), call);
            } else if entry.purpose == Purpose::SectorTransfers(EntryState::Rates) {
                let name = format_ident!("{}", entry.name);
                let exact = quote! {{
                    let rates = self.symmetric_velocities(coordinates, momenta);
                    self.#name(coordinates, &rates)
                }};
                forms.insert(ListedForm::Exact, exact);
            }
        }
        complete(forms)
    }

    /// Returns the names of the differences between leaves, and the calls for W into all of them.
    fn leaf_forms(&self) -> Option<(Vec<String>, Calls)> {
        let mut forms: BTreeMap<ListedForm, Vec<TokenStream>> = BTreeMap::new();
        for entry in &self.program.entries {
            let form = if let Purpose::TruncatedTransfer(_, counting, order) = entry.purpose {
                truncated(counting, order)
            } else if let Purpose::ExactTransfer(_, EntryState::Momenta(_)) = entry.purpose {
                ListedForm::Exact
            } else {
                continue;
            };
            // Entry points are in the order of the transfers.
            forms.entry(form).or_default().push(call(entry));
        }
        let forms = forms
            .into_iter()
            .map(|(form, calls)| (form, quote!([#(#calls),*])))
            .collect();
        let transfers = self.mechanics.transfers.iter();
        let names = transfers
            .map(|transfer| self.mechanics.coordinates[transfer.coordinate].name.clone())
            .collect();
        Some((names, complete(forms)?))
    }

    /// Returns the sectors that count as small: all differences, unless some are named.
    fn small_sectors(&self, all: &[SectorVariables]) -> Vec<SectorVariables> {
        let request = self.scene.requests.budget.as_ref();
        let named = request.map_or(&[][..], |budget| budget.small.as_slice());
        let small = |sector: &&SectorVariables| {
            sector
                .difference
                .is_some_and(|difference| named.is_empty() || named.contains(&difference))
        };
        all.iter().filter(small).cloned().collect()
    }

    fn implementation(
        &self,
        receivers: &[String],
        forms: &[(ListedForm, TokenStream)],
        small: &[SectorVariables],
    ) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let names = forms.iter().map(|&(form, _)| form.name(&runtime));
        let small = small.iter().map(|sector| {
            let name = &sector.name;
            let indices = sector.coordinates.iter();
            let indices = indices.map(|&index| Literal::usize_unsuffixed(index));
            quote!(#runtime::transfer_forms::SmallSector {
                name: #name,
                coordinates: &[#(#indices),*],
            })
        });
        let transfers = self.transfers_by_form(forms);
        let momenta = self.fill(&["momenta"], Purpose::SymmetricMomenta);
        quote! {
            // As for the functions above.
            #[allow(clippy::possible_missing_comma)]
            impl<T: #runtime::Scalar> #runtime::TransferForms<T> for #name<T> {
                const TRANSFER_FORMS: &'static [#runtime::TransferForm] = &[#(#names),*];
                const RECEIVERS: &'static [&'static str] = &[#(#receivers),*];
                const SMALL_SECTORS: &'static [#runtime::transfer_forms::SmallSector] =
                    &[#(#small),*];

                #[inline]
                fn transfers_into(
                    &self,
                    form: usize,
                    coordinates: &[T],
                    momenta: &[T],
                    transfers: &mut [#runtime::Transfer<T>],
                ) {
                    #transfers
                }

                #[inline]
                fn symmetric_momenta_into(
                    &self,
                    coordinates: &[T],
                    rates: &[T],
                    momenta: &mut [T],
                ) {
                    #momenta
                }
            }
        }
    }

    /// Emits the body of `transfers_into`, which selects a form by its index.
    fn transfers_by_form(&self, forms: &[(ListedForm, TokenStream)]) -> TokenStream {
        let runtime = self.runtime();
        let arms = forms.iter().enumerate().map(|(number, (_, call))| {
            let number = Literal::usize_unsuffixed(number);
            quote!(#number => #runtime::emitted::write(transfers, &#call))
        });
        let unknown = self.unknown(&["transfers"]);
        self.with_arrays(
            &[vec!["coordinates", "momenta"]],
            quote! {
                match form {
                    #(#arms,)*
                    _ => #unknown
                }
            },
            unknown.clone(),
        )
    }
}

fn truncated(counting: Counting, order: u32) -> ListedForm {
    match counting {
        Counting::Angle => ListedForm::Angle(order),
        Counting::Amplitude => ListedForm::Amplitude(order),
    }
}

fn call(entry: &Entry) -> TokenStream {
    let name = format_ident!("{}", entry.name);
    quote!(self.#name(coordinates, momenta))
}

/// Returns the forms in order; `None` unless the exact form and at least one other are present.
fn complete(forms: BTreeMap<ListedForm, TokenStream>) -> Option<Calls> {
    let compared = forms.len() > 1 && forms.contains_key(&ListedForm::Exact);
    compared.then(|| forms.into_iter().collect())
}
