//! Models in loops that are driven or have lateral offsets: what they hold and do
//! beside the others.

use super::Emission;
use super::columns::Constants;
use super::doc_text::doc_lines;
use super::one_link::read;
use super::quantities::Numbers;
use super::tokens::ident;
use crate::program::Purpose;
use crate::scene::{Forces, Quantity, has_bodies};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

/// The fields of a model in loops that are no constants of its drive.
const FIELDS: [&str; 4] = ["generations", "links", "bodies", "per_lever"];

impl Emission<'_> {
    /// Whether a field of the model in loops has this name.
    pub(super) fn is_loop_field(&self, name: &str) -> bool {
        self.scene.in_loops() && FIELDS.contains(&name)
    }

    /// Whether energies are those of bodies, which have momentum too.
    pub(super) fn has_bodies(&self) -> bool {
        has_bodies(self.scene)
    }

    /// Replaces a link's sine and cosine by those of the direction of its offsets.
    pub(super) fn faced(&self) -> Option<TokenStream> {
        let lateral = Forces::of(self.scene).lateral;
        lateral.then(|| quote!(let link = Self::facing(constants, link);))
    }

    /// What does so, with constants of these columns.
    pub(super) fn facing(&self, columns: &[&str]) -> Option<TokenStream> {
        let (runtime, forces) = (self.runtime(), Forces::of(self.scene));
        let read = read(columns, &["along", "across"]);
        let count = Literal::usize_unsuffixed(columns.len());
        forces.lateral.then(|| {
            quote! {
                /// The motion with sine and cosine turned and stretched to the place of
                /// the children's pivots, of a leaf to that of its centre of mass.
                #[inline(always)]
                fn facing<V: #runtime::Scalar>(
                    constants: &[V; #count],
                    link: #runtime::generations::Motion<V>,
                ) -> #runtime::generations::Motion<V> {
                    #read
                    #runtime::generations::Motion {
                        sine: along.mul_add(link.sine, across * link.cosine),
                        cosine: along.mul_add(link.cosine, -(across * link.sine)),
                        ..link
                    }
                }
            }
        })
    }

    /// The first moment across these directions, in b and in f.
    pub(super) fn lateral_moment(&self) -> [Option<TokenStream>; 2] {
        if !Forces::of(self.scene).lateral {
            return [None, None];
        }
        let of_b = quote! {
            let b_x = (-lateral).mul_add(sine, b_x);
            let b_y = lateral.mul_add(cosine, b_y);
        };
        // Not in κ: a body's own centripetal force passes through its pivot.
        let of_f = quote! {
            let sideways = square * lateral;
            let f_x = (-sideways).mul_add(cosine, f_x);
            let f_y = (-sideways).mul_add(sine, f_y);
        };
        [Some(of_b), Some(of_f)]
    }

    /// Where the model's energies come from: `links` or `generations`, or bodies.
    pub(super) fn energy_field(&self, field: &str) -> TokenStream {
        let field = ident(if self.has_bodies() { "bodies" } else { field });
        quote!(#field)
    }

    /// Whether the drive moves the root's pivot.
    fn pivot_moves(&self) -> bool {
        let drive = self.mechanics.drive.as_ref();
        drive.is_some_and(|drive| {
            let mut pivot = drive.pivot.iter();
            pivot.any(|motion| motion.acceleration.is_some())
        })
    }

    /// The fields of a model in loops, after the first one.
    pub(super) fn loop_fields(&self, first: TokenStream) -> Vec<TokenStream> {
        let runtime = self.runtime();
        let bodies = self.has_bodies();
        let bodies = bodies.then(|| quote!(bodies: #runtime::generations::Bodies<T>));
        let per_lever = self.pivot_moves().then(|| quote!(per_lever: T));
        let stored = self.stored_constants().into_iter().map(|id| {
            let field = self.field(id);
            quote!(#field: T)
        });
        let extra = bodies.into_iter().chain(per_lever).chain(stored);
        std::iter::once(first).chain(extra).collect()
    }

    /// These fields on another scalar, of a model whose first one is `loops`.
    pub(super) fn cast_fields(&self, loops: &Ident) -> Vec<TokenStream> {
        let stored = self.stored_constants().into_iter();
        let stored: Vec<Ident> = stored.map(|id| self.field(id)).collect();
        let bodies = self.has_bodies().then(|| ident("bodies"));
        let per_lever = self.pivot_moves().then(|| ident("per_lever"));
        let parts: Vec<&Ident> = std::iter::once(loops).chain(&bodies).collect();
        let numbers: Vec<&Ident> = per_lever.iter().chain(&stored).collect();
        // What comes last may keep `convert`.
        let last = numbers.is_empty().then_some(parts.len() - 1);
        let parts = parts.into_iter().enumerate().map(|(i, field)| {
            let convert = match Some(i) == last {
                true => quote!(convert),
                false => quote!(&convert),
            };
            quote!(#field: self.#field.cast(#convert))
        });
        let numbers = numbers
            .iter()
            .map(|field| quote!(#field: convert(self.#field)));
        parts.chain(numbers).collect()
    }

    /// What these fields are: lines before the model's value, and fields in it.
    pub(super) fn loop_values(
        &self,
        per_lever: Option<&Quantity>,
    ) -> (TokenStream, Vec<TokenStream>) {
        let (lines, names) = self.constant_lines();
        let mut fields = Vec::new();
        let mut statics = TokenStream::new();
        if self.has_bodies() {
            let (table, value) = self.bodies();
            statics = table;
            fields.push(quote!(bodies: #value));
        }
        if let (Some(value), true) = (per_lever, self.pivot_moves()) {
            let value = self.quantity(value, Numbers::Scalar);
            fields.push(quote!(per_lever: #value));
        }
        fields.extend(names.iter().map(|name| quote!(#name)));
        (quote!(#statics #(#lines)*), fields)
    }

    /// The table of bodies, and the field's value.
    fn bodies(&self) -> (TokenStream, TokenStream) {
        let runtime = self.runtime();
        let rows = crate::scene::body_rows(self.scene);
        let [table, value] = self.constant_rows(Constants::Bodies, &rows);
        let hanging = match &self.scene.generations {
            None => quote!(Parents(&PARENTS)),
            Some(_) => {
                let equations = self.equations_name();
                let [constants, leaf, answers, kept] = self.recursion_sizes();
                quote! {
                    Copies(
                        <#equations as #runtime::generations::Recursion<
                            #constants, #leaf, #answers, #kept
                        >>::COPIES,
                    )
                }
            }
        };
        let value = quote! {
            #runtime::generations::Bodies::new(
                #runtime::generations::Hanging::#hanging,
                #value,
            )
        };
        (table, value)
    }

    /// The drive in the docs of a model.
    pub(super) fn drive_lines(&self, lines: &mut Vec<String>) {
        if self.mechanics.drive.is_some() {
            lines.extend(self.drive_docs());
            self.show(&self.drive_formulas(), lines);
        }
    }

    /// `const TORQUE: bool = true;` where a torque acts on the root.
    pub(super) fn torque_column(&self) -> Option<TokenStream> {
        let torque = Forces::of(self.scene).root_torque;
        torque.then(|| {
            quote!(
                const TORQUE: bool = true;
            )
        })
    }

    /// The torque in a link's κ, zero but for the root.
    pub(super) fn root_torque(&self) -> Option<TokenStream> {
        let torque = Forces::of(self.scene).root_torque;
        torque.then(|| quote!(let kappa = kappa - root_torque;))
    }

    /// The body of `accelerations_into`; the model's field is given.
    pub(super) fn loop_accelerations(&self, field: &str) -> TokenStream {
        let field = ident(field);
        match self.mechanics.drive {
            None => quote!(self.#field.accelerations_into(theta, omega, alpha);),
            Some(_) => quote! {
                let drive = self.root_drive(time);
                self.#field.driven_accelerations_into(drive, theta, omega, alpha);
            },
        }
    }

    /// The drive as the loops take it.
    fn root_drive(&self) -> TokenStream {
        let (runtime, drive) = (self.runtime(), self.mechanics.drive.as_ref());
        let zero = quote!(T::from_f64(0.0));
        let (torque_name, torque) = match drive.and_then(|drive| drive.torque) {
            Some(_) => (quote!(torque), quote!(torque)),
            None => (quote!(_), quote!(torque: #zero)),
        };
        let (x, y, pivot) = match self.pivot_moves() {
            true => (
                quote!(x),
                quote!(y),
                quote!([-(x * self.per_lever), -(y * self.per_lever)]),
            ),
            false => (quote!(_), quote!(_), quote!([#zero, #zero])),
        };
        quote! {
            #[inline(always)]
            fn root_drive(&self, time: T) -> #runtime::generations::RootDrive<T> {
                let [#x, #y, #torque_name] = self.drive(time);
                #runtime::generations::RootDrive {
                    pivot: #pivot,
                    #torque,
                }
            }
        }
    }

    /// `accelerations` of a driven model in a table.
    pub(super) fn driven_table_accelerations(&self) -> TokenStream {
        let links = Literal::usize_unsuffixed(self.scene.links.len());
        let body = self.loop_accelerations("links");
        quote! {
            /// Angular accelerations (in rad/s²) at `time` (in s), angles `theta` (in rad)
            /// and angular velocities `omega` (in rad/s), in fused arithmetic where
            /// the machine has it. O(links).
            #[must_use]
            pub fn accelerations(
                &self,
                time: T,
                theta: &[T; #links],
                omega: &[T; #links],
            ) -> [T; #links] {
                let mut values = [T::from_f64(0.0); #links];
                let alpha = &mut values;
                #body
                values
            }
        }
    }

    /// What functions of a drive need: all tokens stand where the attribute does,
    /// see `emit`.
    pub(super) fn drive_lint(&self) -> Option<TokenStream> {
        let driven = self.mechanics.drive.is_some();
        driven.then(|| quote!(#[allow(clippy::possible_missing_comma)]))
    }

    /// The drive as a function of time, and where energies are asked for its power
    /// and that of friction.
    pub(super) fn loop_drive(&self) -> TokenStream {
        let mut entries = self.program.entries.iter();
        let Some(entry) = entries.find(|entry| entry.purpose == Purpose::Drive) else {
            return TokenStream::new();
        };
        let (drive, root_drive) = (self.function(entry), self.root_drive());
        let drive = quote!(#drive #root_drive);
        if !self.has_bodies() {
            return drive;
        }
        let power = doc_lines(&[
            "Power (in W) of the drive on the whole tree at `time` (in s), angles `theta` (in rad) and angular velocities `omega` (in rad/s): dE/dt of E = K + U without friction. NaN for slices of another length than there are links. O(links).".to_owned(),
            String::new(),
            "```text".to_owned(),
            "P = τ ω_root − a_x Σ m V_x − a_y Σ m V_y".to_owned(),
            "```".to_owned(),
            String::new(),
            "with the velocities **V** of the centres of mass in the frame that moves with the pivot.".to_owned(),
        ]);
        let forces = Forces::of(self.scene);
        let friction = (forces.friction || forces.drag).then(|| {
            let docs = doc_lines(&[
                "Power −Σ c (ω − ω_parent)² + k ω² (in W) of friction c and drag k on the whole tree, never positive: dE/dt of E = K + U is this and `drive_power`. NaN for a slice of another length than there are links. O(links).".to_owned(),
            ]);
            quote! {
                #docs
                #[must_use]
                pub fn friction_power(&self, omega: &[T]) -> T {
                    self.bodies.friction_power(omega)
                }
            }
        });
        quote! {
            #drive

            #power
            #[must_use]
            pub fn drive_power(&self, time: T, theta: &[T], omega: &[T]) -> T {
                self.bodies.drive_power(self.drive(time), theta, omega)
            }

            #friction
        }
    }
}
