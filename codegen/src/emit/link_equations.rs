//! The equations of one link, for loops over generations and over tables.

use super::Emission;
use super::doc_text::doc_lines;
use super::one_link::{Torques, read, with_torques};
use super::tokens::count;
use crate::scene::Forces;
use proc_macro2::TokenStream;
use quote::quote;

impl Emission<'_> {
    /// The equations of links, for loops over so many, with the copies and names
    /// of generations.
    pub(super) fn recursion(
        &self,
        links: usize,
        copies: &TokenStream,
        names: &TokenStream,
    ) -> TokenStream {
        let (vis, name, runtime) = (&self.item.vis, self.equations_name(), self.runtime());
        let forces = Forces::of(self.scene);
        let columns = forces.columns();
        let sizes = self.recursion_sizes();
        let [_, leaf_answers, ..] = &sizes;
        let links = count(links);
        let joints = forces.in_joints();
        let torque_column = self.torque_column();
        let (facing, node) = (self.facing(&columns), self.node_function(&columns));
        let [leaf, turn_leaf] = self.leaf_functions(&columns, leaf_answers);
        let [joined, inner] = self.sum_functions(&columns);
        let turn = self.turn_function(&columns);
        let docs = doc_lines(&equations_docs(self.scene.table.is_some(), forces));
        // Of commas: all tokens stand where the attribute does, see `emit`.
        let allow =
            quote!(#[allow(clippy::many_single_char_names, clippy::possible_missing_comma)]);
        quote! {
            #docs
            #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
            #vis struct #name;

            #allow
            impl #name {
                #facing
                #node
            }

            #allow
            impl #runtime::generations::Recursion<#(#sizes),*> for #name {
                const LINKS: usize = #links;
                const COPIES: &'static [usize] = &[#copies];
                const NAMES: &'static [&'static str] = &[#names];
                const JOINTS: bool = #joints;
                #torque_column

                #leaf
                #joined
                #inner
                #turn
                #turn_leaf
            }
        }
    }

    /// `node`: a link with children, of the sums of what these answer.
    fn node_function(&self, columns: &[&str]) -> TokenStream {
        let (runtime, forces) = (self.runtime(), Forces::of(self.scene));
        let [constants, _, answers, kept] = self.recursion_sizes();
        let torques = Torques::of(forces);
        let kappa = torques.in_kappa();
        let eliminated = torques.eliminated(&quote!(whole));
        let torque = torques.of_children().map(|_| quote!(torque: V,));
        let read = with_torques(columns, &["inertia", "moment", "lateral", "root_torque"]);
        let (faced, root_torque) = (self.faced(), self.root_torque());
        let [lateral_b, lateral_f] = self.lateral_moment();
        let also = match torques.of_children() {
            Some(_) => ", and the torque at its pivot",
            None => "",
        };
        let docs = doc_lines(&[format!(
            "What a link with children answers: Φ (xx, xy, yy) and **β** (x, y){also}; and what `turn` reads later, g and κ / J. `phi` and `beta` are sums over the children."
        )]);
        quote! {
            #docs
            #[inline(always)]
            fn node<V: #runtime::Scalar>(
                constants: &[V; #constants],
                link: #runtime::generations::Motion<V>,
                phi: [V; 3],
                beta: [V; 2],
                #torque
            ) -> ([V; #answers], [V; #kept]) {
                #read
                #faced
                let (sine, cosine) = (link.sine, link.cosine);
                let [xx, xy, yy] = phi;
                let [x, y] = beta;
                let pull_x = xx.mul_add(cosine, xy * sine);
                let pull_y = xy.mul_add(cosine, yy * sine);
                let b_x = moment.mul_add(cosine, pull_x);
                let b_y = moment.mul_add(sine, pull_y);
                #lateral_b
                let whole = sine.mul_add(pull_y, cosine.mul_add(pull_x, inertia));
                let square = link.omega * link.omega;
                let trace = xx + yy + moment;
                let f_x = square.mul_add((-trace).mul_add(sine, pull_y), x);
                let f_y = (-square).mul_add((-trace).mul_add(cosine, pull_x), y);
                let kappa = cosine.mul_add(f_x, sine * f_y);
                #kappa
                #root_torque
                #lateral_f
                #eliminated
            }
        }
    }

    /// `joined` and `inner`: sums of answers in the units of the parent.
    fn sum_functions(&self, columns: &[&str]) -> [TokenStream; 2] {
        let runtime = self.runtime();
        let [constants, leaf_answers, answers, kept] = self.recursion_sizes();
        let torque = Torques::of(Forces::of(self.scene)).of_children();
        let read = read(columns, &["rest", "square", "ratio"]);
        [
            quote! {
                #[inline(always)]
                fn joined<V: #runtime::Scalar>(below: [V; #leaf_answers]) -> [V; #answers] {
                    let [xx, xy, yy, x, y #torque] = below;
                    [xx, -xy, yy, -x, y #torque]
                }
            },
            quote! {
                #[inline(always)]
                fn inner<V: #runtime::Scalar>(
                    constants: &[V; #constants],
                    link: #runtime::generations::Motion<V>,
                    below: [V; #answers],
                ) -> ([V; #answers], [V; #kept]) {
                    #read
                    let [xx, xy, yy, x, y #torque] = below;
                    let phi = [square.mul_add(xx, rest), square * xy, square.mul_add(yy, rest)];
                    let beta = [ratio * x, ratio * y];
                    Self::node(constants, link, phi, beta #torque)
                }
            },
        ]
    }

    /// `turn`: the way back from the root.
    fn turn_function(&self, columns: &[&str]) -> TokenStream {
        let runtime = self.runtime();
        let [constants, _, _, kept] = self.recursion_sizes();
        let (read, faced) = (read(columns, &["reach"]), self.faced());
        quote! {
            #[inline(always)]
            fn turn<V: #runtime::Scalar>(
                constants: &[V; #constants],
                link: #runtime::generations::Motion<V>,
                kept: [V; #kept],
                pivot: [V; 2],
            ) -> (V, [V; 2]) {
                #read
                #faced
                let [g_x, g_y, turn] = kept;
                let [x, y] = pivot;
                let alpha = g_x.mul_add(x, g_y.mul_add(y, -turn));
                let square = link.omega * link.omega;
                let end_x = square.mul_add(link.sine, (-alpha).mul_add(link.cosine, x));
                let end_y = (-square).mul_add(link.cosine, (-alpha).mul_add(link.sine, y));
                (alpha, [reach * end_x, reach * end_y])
            }
        }
    }
}

fn equations_docs(table: bool, forces: Forces) -> Vec<String> {
    let which = match table {
        true => "one link",
        false => "one link of each generation",
    };
    let torque = match forces.any() {
        true => " Q is the torque of friction, drag and springs.",
        false => "",
    };
    let lateral = match forces.lateral {
        true => {
            " Offsets across the links: **v** and **u** are ℓ **v** − w **u** and ℓ **u** + w **v** of the children's pivot at (ℓ, w), of a leaf those of its centre of mass, in the link's unit of length; the first moment across that direction, `lateral`, adds −m q **u** to b and, after κ, −ω² m q **v** to f."
        }
        false => "",
    };
    let root = match forces.root_torque {
        true => " The torque on the root is a constant of its own, zero for other links.",
        false => "",
    };
    // One string a paragraph: `doc_lines` wraps them.
    [
        &format!(
            "The equations of {which}: articulated-body recursion in the plane \
             (Featherstone, Rigid Body Dynamics Algorithms, 2008, ch. 7)."
        ),
        "",
        "A subtree answers an acceleration **a** of its pivot with a force Φ **a** + **β**. \
         With **v** = (cos θ, sin θ), **u** = (sin θ, −cos θ), and Φ, **β** summed over the \
         children, in units in which their pivots have distance 1:",
        "",
        "```text",
        "b = m d v + Φ v,   J = I + m d² + v·Φ v",
        "f = β − ω² (Φ u + m d u),   κ = v·f − Q,   g = b / J",
        "Φ ← m + Φ − b gᵀ,   β ← f − g κ",
        "ω̇ = −g·a − κ / J,   a ← a + ω̇ v − ω² u",
        "```",
        "",
        &format!(
            "Φ u is (Φ v − v tr Φ) turned by a right angle. Leaves have \
             Φ = m I/J + (m² d²/J) u uᵀ. What does not depend on the angles is in the \
             constants.{torque}{root}{lateral}"
        ),
    ]
    .map(str::to_owned)
    .to_vec()
}
