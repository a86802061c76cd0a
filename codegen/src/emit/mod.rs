//! Emission of a program as tokens: the model type, its constructors, one function per entry point,
//! the runtime's traits, and docs that contain the formulas.

mod budget;
mod computes;
mod constants;
mod doc_text;
mod docs;
mod drive;
mod example;
mod expressions;
mod formulas;
mod function;
mod gather;
mod latex;
mod lines;
mod links;
mod meanings;
mod model;
mod names;
mod normal_form;
mod observables;
mod parts;
mod positions;
mod prescribed;
mod pullback;
mod quantities;
mod shapes;
mod shown;
mod sink;
mod slices;
mod small;
mod strip_between;
mod strip_bodies;
mod strip_docs;
mod strip_equations;
mod strip_powers;
mod strip_pullback;
mod strip_rows;
mod strip_scales;
mod strip_slices;
mod strip_tables;
mod strips;
mod stub;
mod taylor;
mod taylor_order;
mod taylor_rules;
mod tokens;
mod traits;
mod transfer_forms;
mod transverse;
mod whole;

pub use latex::latex_document;
pub use stub::stub;

use crate::description::StructItem;
use crate::functions::Purpose;
use crate::mechanics::Mechanics;
use crate::mechanics::expression::Symbol;
use crate::program::{ConstantId, ConstantOp, Op, Program, ValueId};
use crate::scene::Scene;
use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};
use std::collections::BTreeSet;

/// Inputs of the emission.
pub(crate) struct Emission<'a> {
    pub(crate) item: &'a StructItem,
    pub(crate) scene: &'a Scene,
    pub(crate) mechanics: &'a Mechanics,
    pub(crate) program: &'a Program,
}

/// Returns the tokens that replace the attributed struct.
///
/// Equal input gives equal tokens. Linear in the program's length.
pub fn emit(
    item: &StructItem,
    scene: &Scene,
    mechanics: &Mechanics,
    program: &Program,
) -> TokenStream {
    let emission = Emission {
        item,
        scene,
        mechanics,
        program,
    };
    quiet(item, emission.tokens())
}

/// Returns the tokens with attributes that allow uses of the struct although the user has
/// deprecated it: only uses in the user's code should warn.
fn quiet(item: &StructItem, tokens: TokenStream) -> TokenStream {
    if !item
        .attrs
        .iter()
        .any(|attribute| attribute.is("deprecated"))
    {
        return tokens;
    }
    let Ok(mut file) = syn::parse2::<syn::File>(tokens.clone()) else {
        return tokens;
    };
    for emitted in &mut file.items {
        let attributes = match emitted {
            syn::Item::Struct(own) if own.ident != item.ident => &mut own.attrs,
            syn::Item::Impl(own) => &mut own.attrs,
            syn::Item::Const(own) => &mut own.attrs,
            syn::Item::Fn(own) => &mut own.attrs,
            syn::Item::Mod(own) => &mut own.attrs,
            syn::Item::Static(own) => &mut own.attrs,
            syn::Item::Trait(own) => &mut own.attrs,
            syn::Item::Type(own) => &mut own.attrs,
            // The struct itself and items of other kinds do not name a deprecated type.
            _ => continue,
        };
        attributes.push(syn::parse_quote!(#[allow(deprecated)]));
    }
    quote!(#file)
}

impl Emission<'_> {
    /// Returns all emitted tokens.
    fn tokens(&self) -> TokenStream {
        let Self { item, program, .. } = *self;
        let (model, values) = (self.model(), self.values());
        // The tables of loops are long, so they come last.
        if let Some(strips) = &program.strips {
            let code = self.in_strips(strips);
            let whole = self.whole_tree();
            return quote!(#model #code #values #whole);
        }
        let functions = program.entries.iter().map(|entry| match entry.purpose {
            Purpose::TaylorCoefficients => self.taylor_coefficients(entry),
            _ => self.function(entry),
        });
        let parts = self.part_implementations();
        let accessors = self.accessors();
        let traits = self.traits();
        let whole = self.whole_tree();
        let runtime = self.runtime();
        let name = &item.ident;
        quote! {
            #model

            #values

            // All tokens have the span of the attribute, which covers many lines; clippy takes that
            // for arrays whose elements are on several lines. A binary may use only a few of the
            // functions.
            #[allow(dead_code, clippy::possible_missing_comma)]
            impl<T: #runtime::Scalar> #name<T> {
                #(#functions)*
            }

            #accessors

            #parts

            #traits

            #whole
        }
    }
}

/// Returns the equations of a single link, for trees stored by other code; `None` if the code is
/// not loops.
pub fn link_equations(
    item: &StructItem,
    scene: &Scene,
    mechanics: &Mechanics,
    program: &Program,
) -> Option<TokenStream> {
    let emission = Emission {
        item,
        scene,
        mechanics,
        program,
    };
    let strips = program.strips.as_ref()?;
    let (link, scales) = (emission.link_equations(strips), emission.scale_equations());
    let (bodies, rows) = (emission.body_equations(), emission.named_rows(strips));
    Some(quote!(#link #scales #bodies #rows))
}

impl Emission<'_> {
    /// Returns the path of the runtime crate.
    fn runtime(&self) -> TokenStream {
        runtime_path(&self.scene.crate_path)
    }

    /// Returns the constants that the model stores, in order: those that functions read, and the
    /// named constants that these use.
    fn stored_constants(&self) -> Vec<ConstantId> {
        let mut stored = BTreeSet::new();
        // In loops, gravity is a part of the tree.
        let entries = self.program.entries.iter();
        for entry in entries.filter(|entry| entry.purpose != Purpose::RootGravity) {
            for value in self.program.needed(&entry.outputs) {
                if let Op::Constant(id) = self.program.definition(value).op {
                    stored.insert(id);
                }
            }
        }
        let setup = &self.program.setup;
        let is_named = |op: &ConstantOp| matches!(op, ConstantOp::Named(..));
        let behind = setup.behind(stored.iter().copied(), |constant| !is_named(&constant.op));
        stored.extend(behind.into_iter().filter(|&id| is_named(&setup.get(id).op)));
        stored.into_iter().collect()
    }

    /// Returns the field of a stored constant. A parameter that the code reads directly has its own
    /// name as field, unless a constant of the scene, or the argument that holds the parameters,
    /// has that name.
    fn field(&self, id: ConstantId) -> Ident {
        let setup = &self.program.setup;
        let definition = setup.get(id);
        let mut name = definition.name.clone();
        if let ConstantOp::Parameter(_) = definition.op {
            let others = |name: &str| {
                let mut constants = setup.iter().filter(|(other, _)| *other != id);
                let mut read = setup.stand_ins.keys();
                name == "parameters"
                    || self.is_loop_field(name)
                    || constants.any(|(_, constant)| constant.name == name)
                    || read.any(|&index| self.letter(index).code == name)
            };
            while others(&name) {
                name = format!("parameter_{name}");
            }
        }
        format_ident!("{name}")
    }

    /// Returns the symbol of a constant of the mechanics.
    fn letter(&self, index: usize) -> &Symbol {
        let symbol = self.mechanics.constants[index].symbol;
        self.mechanics.symbols.get(symbol)
    }

    fn op(&self, id: ValueId) -> &Op {
        &self.program.definition(id).op
    }
}

/// Returns the type parameter other than `T` of functions that convert between scalars: `S`, unless
/// the model has that name.
fn other_scalar(model: &Ident) -> Ident {
    let name = if model == "S" { "R" } else { "S" };
    Ident::new(name, Span::call_site())
}

/// Returns the tokens of `::branched_pendulum`, or of the value of `crate = …`.
pub fn runtime_path(path: &crate::description::CratePath) -> TokenStream {
    let mut segments = path
        .segments
        .iter()
        .map(|segment| match segment.strip_prefix("r#") {
            Some(keyword) => Ident::new_raw(keyword, Span::call_site()),
            None => Ident::new(segment, Span::call_site()),
        });
    let first = segments.next();
    let lead = path.global.then(|| quote!(::));
    quote!(#lead #first #(:: #segments)*)
}
