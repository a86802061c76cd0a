//! Tables of links that carry children at several places: the equations of one
//! link, and what holds them.

use super::Emission;
use super::columns::Constants;
use super::doc_text::doc_lines;
use super::one_link::{Torques, with_torques};
use super::quantities::Numbers;
use crate::scene::{Forces, Quantity, Table, placed_columns};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

impl Emission<'_> {
    /// The numbers of constants, of a link's answers, of what it is about its
    /// parent's pivot, and of what is kept.
    fn placed_sizes(&self) -> [Literal; 4] {
        let forces = Forces::of(self.scene);
        let torque = usize::from(forces.in_joints());
        let constants = placed_columns(forces).len();
        [constants, 5 + torque, 9 + torque, 3].map(Literal::usize_unsuffixed)
    }

    /// The type of the model's field `links`.
    pub(super) fn placed_type(&self) -> TokenStream {
        let (runtime, equations) = (self.runtime(), self.equations_name());
        let sizes = self.placed_sizes();
        quote!(#runtime::generations::PlacedTable<#equations, T, #(#sizes),*>)
    }

    /// The table's constants, and its value; its parents are `PARENTS`.
    pub(super) fn placed_value(
        &self,
        table: &Table,
        hanging: &[[Quantity; 6]],
    ) -> [TokenStream; 2] {
        let runtime = self.runtime();
        let [motion, motion_value] = self.constant_rows(Constants::Motion, &table.motion);
        let [hanging, hanging_value] = self.constant_rows(Constants::Hanging, hanging);
        let root = self.quantity(&table.root, Numbers::Scalar);
        [
            quote!(#motion #hanging),
            quote! {
                #runtime::generations::PlacedTable::new(
                    &PARENTS,
                    #motion_value,
                    #hanging_value,
                    [T::from_f64(0.0), #root],
                )
            },
        ]
    }

    /// The equations of one link.
    pub(super) fn placed_recursion(&self) -> TokenStream {
        let (vis, name, runtime) = (&self.item.vis, self.equations_name(), self.runtime());
        let forces = Forces::of(self.scene);
        let columns = placed_columns(forces);
        let sizes = self.placed_sizes();
        let [_, answers, sums, kept] = sizes.clone();
        let links = Literal::usize_unsuffixed(self.scene.links.len());
        let joints = forces.in_joints();
        let [leaf, turn_leaf] = self.leaf_functions(&columns, &answers);
        let facing = self
            .facing(&columns)
            .map(|facing| quote!(impl #name { #facing }));
        let torque_column = self.torque_column();
        let torque = Torques::of(forces).of_children();
        let inner = self.placed_inner(&columns);
        let docs = doc_lines(&docs(forces));
        let allow =
            quote!(#[allow(clippy::many_single_char_names, clippy::possible_missing_comma)]);
        quote! {
            #docs
            #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
            #vis struct #name;

            #facing

            #allow
            impl #runtime::generations::PlacedRecursion<#(#sizes),*> for #name {
                const LINKS: usize = #links;
                const JOINTS: bool = #joints;
                #torque_column

                #leaf

                #[inline(always)]
                fn hang<V: #runtime::Scalar>(
                    link: #runtime::generations::Motion<V>,
                    place: [V; 2],
                    answers: [V; #answers],
                ) -> [V; #sums] {
                    let [along, across] = place;
                    let [xx, xy, yy, x, y #torque] = answers;
                    let sine = along.mul_add(link.sine, across * link.cosine);
                    let cosine = along.mul_add(link.cosine, -(across * link.sine));
                    let pull_x = xx.mul_add(cosine, xy * sine);
                    let pull_y = xy.mul_add(cosine, yy * sine);
                    let whole = sine.mul_add(pull_y, cosine * pull_x);
                    let square = link.omega * link.omega;
                    let trace = xx + yy;
                    let f_x = square.mul_add((-trace).mul_add(sine, pull_y), x);
                    let f_y = (-square).mul_add((-trace).mul_add(cosine, pull_x), y);
                    let kappa = cosine.mul_add(f_x, sine * f_y);
                    [xx, xy, yy, pull_x, pull_y, whole, f_x, f_y, kappa #torque]
                }

                #inner

                #[inline(always)]
                fn turn<V: #runtime::Scalar>(
                    link: #runtime::generations::Motion<V>,
                    kept: [V; #kept],
                    pivot: [V; 2],
                ) -> (V, [V; 2]) {
                    let [g_x, g_y, turn] = kept;
                    let [x, y] = pivot;
                    let alpha = g_x.mul_add(x, g_y.mul_add(y, -turn));
                    let square = link.omega * link.omega;
                    let turn_x = square.mul_add(link.sine, -(alpha * link.cosine));
                    let turn_y = (-square).mul_add(link.cosine, -(alpha * link.sine));
                    (alpha, [turn_x, turn_y])
                }

                #turn_leaf
            }
        }
    }

    /// `inner`: a link with children, of the sums of what these answer about its pivot.
    fn placed_inner(&self, columns: &[&str]) -> TokenStream {
        let (runtime, torques) = (self.runtime(), Torques::of(Forces::of(self.scene)));
        let [constants, answers, sums, kept] = self.placed_sizes();
        let (kappa, torque) = (torques.in_kappa(), torques.of_children());
        let eliminated = torques.eliminated(&quote!((inertia + whole)));
        let read = with_torques(columns, &["inertia", "moment", "lateral", "root_torque"]);
        let [lateral_b, lateral_f] = self.lateral_moment();
        let root_torque = self.root_torque();
        quote! {
            #[inline(always)]
            fn inner<V: #runtime::Scalar>(
                constants: &[V; #constants],
                link: #runtime::generations::Motion<V>,
                below: [V; #sums],
            ) -> ([V; #answers], [V; #kept]) {
                #read
                let [xx, xy, yy, pull_x, pull_y, whole, f_x, f_y, kappa #torque] = below;
                let (sine, cosine) = (link.sine, link.cosine);
                let b_x = moment.mul_add(cosine, pull_x);
                let b_y = moment.mul_add(sine, pull_y);
                #lateral_b
                let square = link.omega * link.omega;
                let swing = square * moment;
                let f_x = (-swing).mul_add(sine, f_x);
                let f_y = swing.mul_add(cosine, f_y);
                #lateral_f
                #kappa
                #root_torque
                #eliminated
            }
        }
    }
}

fn docs(forces: Forces) -> Vec<String> {
    let torque = match forces.any() {
        true => " Q is the torque of friction, drag and springs.",
        false => "",
    };
    let root = match forces.root_torque {
        true => " The torque on the root is a constant of its own, zero for other links.",
        false => "",
    };
    let lateral = match forces.lateral {
        true => {
            " A first moment m e across the link adds −m e u to b and −ω² m e v to the force. A leaf's **u** and **v** are those of its centre of mass, in its unit of length."
        }
        false => "",
    };
    [
        "The equations of one link: articulated-body recursion in the plane (Featherstone, Rigid Body Dynamics Algorithms, 2008, ch. 7), for children at several places.",
        "",
        "A subtree answers an acceleration **a** of its pivot with a force Φ **a** + **β**. With **v** = (cos θ, sin θ), **u** = (sin θ, −cos θ), a child at ℓ along and w across the link, **v**_j = ℓ **v** − w **u** and **u**_j = ℓ **u** + w **v**:",
        "",
        "```text",
        "q_j = β_j − ω² Φ_j u_j",
        "b = m d v + Σ Φ_j v_j,   J = I + m d² + Σ v_j·Φ_j v_j",
        "f = Σ q_j − ω² m d u,   κ = Σ v_j·q_j − Q,   g = b / J",
        "Φ ← m + Σ Φ_j − b gᵀ,   β ← f − g κ",
        "ω̇ = −g·a − κ / J,   a_j = a + ω̇ v_j − ω² u_j",
        "```",
        "",
        &format!(
            "Leaves have Φ = m I/J + (m² d²/J) u uᵀ. What does not depend on the angles is in the constants.{torque}{root}{lateral}"
        ),
    ]
    .map(str::to_owned)
    .to_vec()
}
