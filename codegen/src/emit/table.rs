//! Large trees of irregular shape: a table of links, and the model that takes the
//! equations of one link through it.

use super::Emission;
use super::columns::Constants;
use super::quantities::Numbers;
use super::tokens::part_tokens;
use crate::scene::{Quantity, Table};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

impl Emission<'_> {
    /// The equations and the functions of a model in a table.
    pub(super) fn table(&self, table: &Table) -> TokenStream {
        let none = TokenStream::new();
        let equations = match table.hanging {
            Some(_) => self.placed_recursion(),
            None => self.recursion(self.scene.links.len(), &none, &none),
        };
        let functions = self.table_functions();
        let pendulum = self.table_pendulum();
        let energies = self.scene.requests.energies;
        let energy = energies.then(|| self.loop_energy("links"));
        quote! {
            #equations
            #functions
            #pendulum
            #energy
        }
    }

    pub(super) fn table_docs(&self) -> Vec<String> {
        let count = self.scene.links.len();
        let energies = match self.scene.requests.energies {
            true => "",
            false => " Energies can be asked for with `emit(energies)`.",
        };
        let mut lines = vec![
            format!(
                "A planar tree of {count} rigid links. Angles are absolute, in radians from the downward vertical, in the order of `LINK_NAMES`; SI units throughout."
            ),
            String::new(),
            format!(
                "The code is a loop over a table of links, O(links), of the equations that are shown where they stand. The first evaluation allocates room, later ones nothing.{energies}"
            ),
        ];
        self.drive_lines(&mut lines);
        lines
    }

    /// The type of the model's one field, `links`.
    pub(super) fn table_type(&self) -> TokenStream {
        let placed = |table: &Table| table.hanging.is_some();
        if self.scene.table.as_ref().is_some_and(placed) {
            return self.placed_type();
        }
        let (runtime, equations) = (self.runtime(), self.equations_name());
        let [constants, _, answers, kept] = self.recursion_sizes();
        quote!(#runtime::generations::Table<#equations, T, #constants, #answers, #kept>)
    }

    /// `Self { … }`, the constants in place.
    pub(super) fn table_value(&self, table: &Table) -> TokenStream {
        let runtime = self.runtime();
        let count = Literal::usize_unsuffixed(self.scene.links.len());
        let parents = self.scene.links.iter().map(|link| {
            let parent = link.parent.map_or(0, |parent| parent.0);
            Literal::usize_unsuffixed(parent)
        });
        let parents = quote! {
            /// The parent of each link, which stands before it; the root has none.
            static PARENTS: [u32; #count] = [#(#parents),*];
        };
        let (extra, fields) = self.loop_values(table.per_lever.as_ref());
        if let Some(hanging) = &table.hanging {
            let [rows, value] = self.placed_value(table, hanging);
            return quote! {
                #parents
                #rows
                #extra
                Self {
                    links: #value,
                    #(#fields),*
                }
            };
        }
        let [motion, motion_value] = self.constant_rows(Constants::Motion, &table.motion);
        let energies = self.scene.requests.energies && !self.has_bodies();
        let [energy, energy_value] = match energies {
            true => self.constant_rows(Constants::Energy, &table.energy),
            false => [TokenStream::new(), quote!(#runtime::generations::rows(&[]))],
        };
        let root = self.quantity(&table.root, Numbers::Scalar);
        quote! {
            #parents
            #motion
            #energy
            #extra
            Self {
                links: #runtime::generations::Table::new(
                    &PARENTS,
                    #motion_value,
                    [T::from_f64(0.0), #root],
                    #energy_value,
                ),
                #(#fields),*
            }
        }
    }

    /// A table of constants, and the vector of these in the model's scalar, in
    /// which values of parameters are put in place.
    pub(super) fn constant_rows<R: AsRef<[Quantity]>>(
        &self,
        table: Constants,
        rows: &[R],
    ) -> [TokenStream; 2] {
        let runtime = self.runtime();
        let constants = Ident::new(&table.name().to_uppercase(), Span::call_site());
        let name = Ident::new(table.name(), Span::call_site());
        let docs = self.columns(table);
        let count = Literal::usize_unsuffixed(rows.len());
        let width = rows.first().map_or(0, |row| row.as_ref().len());
        let width = Literal::usize_unsuffixed(width);
        let mut placed = Vec::new();
        let lines = rows.iter().enumerate().map(|(link, row)| {
            let numbers = row.as_ref().iter().enumerate().map(|(column, value)| {
                let parts = value.exact().map(part_tokens);
                let [high, low] = parts.unwrap_or_else(|| {
                    let value = self.quantity(value, Numbers::Scalar);
                    let link = Literal::usize_unsuffixed(link);
                    let column = Literal::usize_unsuffixed(column);
                    placed.push(quote!(#name[#link][#column] = #value;));
                    [quote!(0.0), quote!(0.0)]
                });
                quote!([#high, #low])
            });
            quote!([#(#numbers),*])
        });
        let lines = quote!(#(#lines),*);
        let table = quote! {
            #docs
            static #constants: [[[f64; 2]; #width]; #count] = [#lines];
        };
        let value = quote!(#runtime::generations::rows(&#constants));
        let value = match placed.is_empty() {
            true => value,
            false => quote! {{
                let mut #name = #value;
                #(#placed)*
                #name
            }},
        };
        [table, value]
    }

    fn table_functions(&self) -> TokenStream {
        let (name, runtime) = (&self.item.ident, self.runtime());
        let links = self.links();
        let energies = self.energies_of(&self.energy_field("links"));
        let (allow, drive) = (self.drive_lint(), self.loop_drive());
        let accelerations = match self.mechanics.drive {
            Some(_) => self.driven_table_accelerations(),
            None => quote! {
                /// Angular accelerations (in rad/s²) at angles `theta` (in rad) and
                /// angular velocities `omega` (in rad/s), in fused arithmetic where the
                /// machine has it. O(links).
                #[must_use]
                pub fn accelerations(&self, theta: &[T; #links], omega: &[T; #links]) -> [T; #links] {
                    let mut alpha = [T::from_f64(0.0); #links];
                    self.links.accelerations_into(theta, omega, &mut alpha);
                    alpha
                }
            },
        };
        quote! {
            #allow
            impl<T: #runtime::Scalar> #name<T> {
                #accelerations

                #energies
                #drive
            }
        }
    }

    fn table_pendulum(&self) -> TokenStream {
        let (name, runtime, links) = (&self.item.ident, self.runtime(), self.links());
        let names = self.scene.links.iter().map(|link| &link.name);
        let cast = self.loop_cast("links");
        let (time, body) = (self.time_name(), self.loop_accelerations("links"));
        quote! {
            impl<T: #runtime::Scalar> #runtime::Pendulum<T> for #name<T> {
                const LINKS: usize = #links;
                const LINK_NAMES: &'static [&'static str] = &[#(#names),*];

                fn accelerations_into(
                    &self,
                    #time: T,
                    theta: &[T],
                    omega: &[T],
                    alpha: &mut [T],
                ) {
                    #body
                }
            }

            #cast
        }
    }
}
