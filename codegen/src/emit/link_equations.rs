//! The equations of one link, for loops over generations and over tables.

use super::Emission;
use super::docs::doc_lines;
use crate::scene::Forces;
use proc_macro2::{Ident, Literal, Span, TokenStream};
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
        let [constants, leaf_answers, answers, kept] = sizes.clone();
        let links = Literal::usize_unsuffixed(links);
        let joints = forces.in_joints();
        // What a function does not read is not taken apart.
        let read = |used: &[&str]| {
            let columns = columns.iter().map(|column| match used.contains(column) {
                true => {
                    let column = Ident::new(column, Span::call_site());
                    quote!(#column)
                }
                false => quote!(_),
            });
            quote!(let [#(#columns),*] = *constants;)
        };
        let force_names = ["friction", "drag", "spring"];
        let with = |own: &[&'static str]| -> Vec<&'static str> {
            own.iter().copied().chain(force_names).collect()
        };
        let torque = torque(forces);
        let in_joint = in_joint(forces);
        let (leaf_read, unread) = match forces.any() {
            true => (read(&with(&["inertia"])), None),
            false => (TokenStream::new(), Some(quote!(let _ = constants;))),
        };
        let (leaf_x, leaf_y) = match forces.any() {
            true => (
                quote!(square * link.sine - push * link.cosine),
                quote!(square.mul_add(link.cosine, push * link.sine)),
            ),
            false => (quote!(square * link.sine), quote!(square * link.cosine)),
        };
        let push = forces.any().then(|| {
            quote! {
                // Q / J
                let push = (#torque) * inertia;
            }
        });
        let leaf_torque = joints.then(|| quote!(, #in_joint));
        let torque_parameter = joints.then(|| quote!(torque: V,));
        let torque_argument = joints.then(|| quote!(, torque));
        let node_forces = forces.any().then(|| {
            let from_below = joints.then(|| quote!(+ torque));
            quote! {
                let kappa = kappa - (#torque #from_below);
            }
        });
        let node_answer = joints.then(|| quote!(, #in_joint));
        let node_constants = read(&with(&["inertia", "moment", "lateral", "root_torque"]));
        let (torque_column, root_torque) = (self.torque_column(), self.root_torque());
        let inner_constants = read(&["rest", "square", "ratio"]);
        let turn_constants = read(&["reach"]);
        let turned_leaf = match forces.any() {
            true => quote!(swing + (#torque) * inertia),
            false => quote!(swing),
        };
        let unread = unread.filter(|_| !forces.lateral);
        let (facing, faced, [lateral_b, lateral_f]) =
            (self.facing(&columns), self.faced(), self.lateral_moment());
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

                #[inline(always)]
                fn node<V: #runtime::Scalar>(
                    constants: &[V; #constants],
                    link: #runtime::generations::Motion<V>,
                    [xx, xy, yy]: [V; 3],
                    [x, y]: [V; 2],
                    #torque_parameter
                ) -> ([V; #answers], [V; #kept]) {
                    #node_constants
                    #faced
                    let (sine, cosine) = (link.sine, link.cosine);
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
                    #node_forces
                    #root_torque
                    #lateral_f
                    let inverse = V::from_f64(1.0) / whole;
                    let (g_x, g_y) = (b_x * inverse, b_y * inverse);
                    (
                        [
                            (-b_x).mul_add(g_x, xx),
                            (-b_x).mul_add(g_y, xy),
                            (-b_y).mul_add(g_y, yy),
                            (-g_x).mul_add(kappa, f_x),
                            (-g_y).mul_add(kappa, f_y)
                            #node_answer
                        ],
                        [g_x, g_y, kappa * inverse],
                    )
                }
            }

            #allow
            impl #runtime::generations::Recursion<#(#sizes),*> for #name {
                const LINKS: usize = #links;
                const COPIES: &'static [usize] = &[#copies];
                const NAMES: &'static [&'static str] = &[#names];
                const JOINTS: bool = #joints;
                #torque_column

                #[inline(always)]
                fn leaf<V: #runtime::Scalar>(
                    constants: &[V; #constants],
                    link: #runtime::generations::Motion<V>,
                ) -> [V; #leaf_answers] {
                    #leaf_read
                    #unread
                    #faced
                    let square = link.omega * link.omega;
                    #push
                    [
                        link.sine * link.sine,
                        link.cosine * link.sine,
                        link.cosine * link.cosine,
                        #leaf_x,
                        #leaf_y
                        #leaf_torque
                    ]
                }

                #[inline(always)]
                fn joined<V: #runtime::Scalar>(
                    [xx, xy, yy, x, y #torque_argument]: [V; #leaf_answers],
                ) -> [V; #answers] {
                    [xx, -xy, yy, -x, y #torque_argument]
                }

                #[inline(always)]
                fn inner<V: #runtime::Scalar>(
                    constants: &[V; #constants],
                    link: #runtime::generations::Motion<V>,
                    below: [V; #answers],
                ) -> ([V; #answers], [V; #kept]) {
                    #inner_constants
                    let [xx, xy, yy, x, y #torque_argument] = below;
                    let phi = [square.mul_add(xx, rest), square * xy, square.mul_add(yy, rest)];
                    Self::node(constants, link, phi, [ratio * x, ratio * y] #torque_argument)
                }

                #[inline(always)]
                fn turn<V: #runtime::Scalar>(
                    constants: &[V; #constants],
                    link: #runtime::generations::Motion<V>,
                    [g_x, g_y, turn]: [V; #kept],
                    [x, y]: [V; 2],
                ) -> (V, [V; 2]) {
                    #turn_constants
                    #faced
                    let alpha = g_x.mul_add(x, g_y.mul_add(y, -turn));
                    let square = link.omega * link.omega;
                    let end_x = square.mul_add(link.sine, (-alpha).mul_add(link.cosine, x));
                    let end_y = (-square).mul_add(link.cosine, (-alpha).mul_add(link.sine, y));
                    (alpha, [reach * end_x, reach * end_y])
                }

                #[inline(always)]
                fn turn_leaf<V: #runtime::Scalar>(
                    constants: &[V; #constants],
                    link: #runtime::generations::Motion<V>,
                    [x, y]: [V; 2],
                ) -> V {
                    #leaf_read
                    #unread
                    #faced
                    let swing = link.cosine.mul_add(x, link.sine * y);
                    #turned_leaf
                }
            }
        }
    }
}

/// The torque that acts on a link from outside of its subtree: friction and
/// spring in its pivot, drag.
pub(super) fn torque(forces: Forces) -> TokenStream {
    let joint = forces.in_joints().then(|| in_joint(forces));
    let drag = forces.drag.then(|| quote!(drag * link.omega));
    let parts = joint.into_iter().chain(drag);
    quote!(-(#(#parts)+*))
}

/// What a link's pivot does to its parent.
pub(super) fn in_joint(forces: Forces) -> TokenStream {
    let friction = forces.friction.then(|| quote!(friction * link.bend_rate));
    let spring = forces.spring.then(|| quote!(spring * link.bend));
    let parts = friction.into_iter().chain(spring);
    quote!(#(#parts)+*)
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
