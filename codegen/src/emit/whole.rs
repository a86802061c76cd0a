//! Emits the whole tree that a reduced model represents, as data.

use super::Emission;
use super::doc_text::doc_lines;
use crate::scene::{NodeMotion, Reduction, WholeNode, WholeOrder};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

impl Emission<'_> {
    /// Emits the constant `WHOLE` of a reduced model.
    pub(super) fn whole_tree(&self) -> Option<TokenStream> {
        let Reduction {
            order,
            links,
            orbits,
        } = self.scene.reduction.as_ref()?;
        let (name, runtime) = (&self.item.ident, self.runtime());
        let entries = orbits.iter().map(|orbit| {
            let WholeNode {
                copies,
                in_phase,
                end,
                motion,
                ..
            } = orbit;
            let (copies, end) = (
                Literal::usize_unsuffixed(*copies),
                Literal::usize_unsuffixed(*end),
            );
            let motion = match motion {
                NodeMotion::Moving { offset, stride } => {
                    let offset = Literal::usize_unsuffixed(*offset);
                    let stride = Literal::usize_unsuffixed(*stride);
                    quote!(Moving { offset: #offset, stride: #stride })
                }
                NodeMotion::Locked { angle } => {
                    let angle = Literal::f64_unsuffixed(angle.to_f64());
                    quote!(Locked { angle: #angle })
                }
            };
            quote! {
                #runtime::emitted::WholeOrbit {
                    copies: #copies,
                    in_phase: #in_phase,
                    end: #end,
                    motion: #runtime::emitted::WholeMotion::#motion,
                }
            }
        });
        let docs = doc_lines(&self.whole_docs());
        let (model, count) = (self.links(), Literal::usize_unsuffixed(*links));
        let order = match order {
            WholeOrder::DepthFirst => quote!(depth_first),
            WholeOrder::Generations => quote!(by_generations),
        };
        Some(quote! {
            // As for the functions, see `emit`.
            #[allow(clippy::possible_missing_comma)]
            impl #name<f64> {
                #docs
                pub const WHOLE: #runtime::WholeTree =
                    #runtime::WholeTree::#order(#model, #count, &[#(#entries),*]);
            }
        })
    }

    /// Returns the docs of the whole tree.
    fn whole_docs(&self) -> Vec<String> {
        let Some(Reduction { links, orbits, .. }) = &self.scene.reduction else {
            return Vec::new();
        };
        let mut lines = vec![
            format!(
                "The tree of {links} links whose motion this model describes. Its links have the order of the same description without `in_phase` and `locked`."
            ),
            String::new(),
        ];
        for orbit in orbits {
            lines.push(format!("- {orbit}"));
        }
        lines
    }
}
