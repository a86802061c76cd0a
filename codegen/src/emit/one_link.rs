//! What the equations of one link share, whichever loop they stand in: reading of
//! constants, torques, leaves.

use super::Emission;
use super::tokens::ident;
use crate::scene::Forces;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

/// Columns of torques; a function that needs some of them reads all that are there.
const TORQUES: [&str; 3] = ["friction", "drag", "spring"];

/// `let [_, inertia, …] = *constants;`, the columns that are `used` and those of
/// torques: what a function does not read has no name.
pub(super) fn with_torques(columns: &[&str], used: &[&str]) -> TokenStream {
    let used: Vec<&str> = used.iter().chain(&TORQUES).copied().collect();
    read(columns, &used)
}

/// `let [_, inertia, …] = *constants;`, the columns that are `used`.
pub(super) fn read(columns: &[&str], used: &[&str]) -> TokenStream {
    let names = columns.iter().map(|column| match used.contains(column) {
        true => {
            let column = ident(column);
            quote!(#column)
        }
        false => quote!(_),
    });
    quote!(let [#(#names),*] = *constants;)
}

/// The torques on one link, as code: empty where none acts.
pub(super) struct Torques {
    /// What a link's pivot does to its parent: friction and spring.
    joint: Option<TokenStream>,
    /// −Q of the link by itself, and that times 1 / J.
    resistance: Option<[TokenStream; 2]>,
}

impl Torques {
    pub(super) fn of(forces: Forces) -> Self {
        let friction = forces.friction.then(|| quote!(friction * link.bend_rate));
        let spring = forces.spring.then(|| quote!(spring * link.bend));
        let joint: Vec<TokenStream> = friction.into_iter().chain(spring).collect();
        let drag = forces.drag.then(|| quote!(drag * link.omega));
        let all: Vec<TokenStream> = joint.iter().cloned().chain(drag).collect();
        Self {
            joint: (!joint.is_empty()).then(|| quote!(#(#joint)+*)),
            resistance: match all.as_slice() {
                [] => None,
                [one] => Some([one.clone(), quote!(#one * inertia)]),
                _ => Some([quote!(#(#all)+*), quote!((#(#all)+*) * inertia)]),
            },
        }
    }

    /// The joint's torque as the last of a link's answers.
    fn answered(&self) -> Option<TokenStream> {
        self.joint.as_ref().map(|joint| quote!(, #joint))
    }

    /// What `node` and `inner` hand on and take of the children's torques.
    pub(super) fn of_children(&self) -> Option<TokenStream> {
        self.joint.as_ref().map(|_| quote!(, torque))
    }

    /// The torques in κ = v·f − Q of a link with children.
    pub(super) fn in_kappa(&self) -> Option<TokenStream> {
        let [resistance, _] = self.resistance.as_ref()?;
        Some(match self.joint {
            None => quote!(let kappa = kappa + #resistance;),
            Some(_) => match resistance.to_string().contains('+') {
                true => quote!(let kappa = kappa - (torque - (#resistance));),
                false => quote!(let kappa = kappa - (torque - #resistance);),
            },
        })
    }

    /// The last lines of a link with children: its equation solved, what it answers
    /// and what is kept. `whole` is J.
    pub(super) fn eliminated(&self, whole: &TokenStream) -> TokenStream {
        let joint = self.answered();
        quote! {
            let inverse = V::from_f64(1.0) / #whole;
            let (g_x, g_y) = (b_x * inverse, b_y * inverse);
            (
                [
                    (-b_x).mul_add(g_x, xx),
                    (-b_x).mul_add(g_y, xy),
                    (-b_y).mul_add(g_y, yy),
                    (-g_x).mul_add(kappa, f_x),
                    (-g_y).mul_add(kappa, f_y)
                    #joint
                ],
                [g_x, g_y, kappa * inverse],
            )
        }
    }

    /// Force of a leaf in x and y, with the line that it needs.
    fn leaf_force(&self) -> [TokenStream; 3] {
        match &self.resistance {
            None => [
                TokenStream::new(),
                quote!(square * link.sine),
                quote!(square * link.cosine),
            ],
            Some([_, over_inertia]) => [
                // −Q / J
                quote!(let braking = #over_inertia;),
                quote!(square * link.sine + braking * link.cosine),
                quote!(square.mul_add(link.cosine, -(braking * link.sine))),
            ],
        }
    }
}

impl Emission<'_> {
    /// `leaf` and `turn_leaf`, of constants of these columns and so many answers.
    pub(super) fn leaf_functions(&self, columns: &[&str], answers: &Literal) -> [TokenStream; 2] {
        let (runtime, forces) = (self.runtime(), Forces::of(self.scene));
        let size = Literal::usize_unsuffixed(columns.len());
        let torques = Torques::of(forces);
        let torque_constants = torques.resistance.is_some();
        let torque_constants = torque_constants.then(|| with_torques(columns, &["inertia"]));
        let constants = match torque_constants.is_some() || forces.lateral {
            true => ident("constants"),
            false => ident("_constants"),
        };
        let faced = self.faced();
        let [braking, force_x, force_y] = torques.leaf_force();
        let joint = torques.answered();
        let swing = quote!(link.cosine.mul_add(x, link.sine * y));
        let turned = match &torques.resistance {
            None => swing,
            Some([_, over_inertia]) => quote! {
                let swing = #swing;
                swing - #over_inertia
            },
        };
        [
            quote! {
                #[inline(always)]
                fn leaf<V: #runtime::Scalar>(
                    #constants: &[V; #size],
                    link: #runtime::generations::Motion<V>,
                ) -> [V; #answers] {
                    #torque_constants
                    #faced
                    let square = link.omega * link.omega;
                    #braking
                    [
                        link.sine * link.sine,
                        link.cosine * link.sine,
                        link.cosine * link.cosine,
                        #force_x,
                        #force_y
                        #joint
                    ]
                }
            },
            quote! {
                #[inline(always)]
                fn turn_leaf<V: #runtime::Scalar>(
                    #constants: &[V; #size],
                    link: #runtime::generations::Motion<V>,
                    pivot: [V; 2],
                ) -> V {
                    #torque_constants
                    #faced
                    let [x, y] = pivot;
                    #turned
                }
            },
        ]
    }
}
