//! Program to tokens: the model type, its constructors, one function for each
//! entry point, the runtime's traits, and the docs that carry the formulas.

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
mod observables;
mod parts;
mod positions;
mod prescribed;
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
mod strip_forced;
mod strip_powers;
mod strip_rows;
mod strip_scales;
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

/// Everything that emission reads.
pub(crate) struct Emission<'a> {
    pub(crate) item: &'a StructItem,
    pub(crate) scene: &'a Scene,
    pub(crate) mechanics: &'a Mechanics,
    pub(crate) program: &'a Program,
}

/// The tokens that stand where the attributed struct stood.
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
    let (model, values) = (emission.model(), emission.values());
    // The tables of loops are long: they come last.
    if let Some(strips) = &program.strips {
        let code = emission.in_strips(strips);
        let whole = emission.whole_tree();
        return quote!(#model #code #values #whole);
    }
    let functions = program.entries.iter().map(|entry| match entry.purpose {
        Purpose::TaylorCoefficients => emission.taylor_coefficients(entry),
        _ => emission.function(entry),
    });
    let parts = emission.part_implementations();
    let accessors = emission.accessors();
    let traits = emission.traits();
    let whole = emission.whole_tree();
    let runtime = emission.runtime();
    let name = &item.ident;
    quote! {
        #model

        #values

        // All tokens stand where the attribute does, of many lines: clippy
        // takes that for arrays whose elements were broken across lines. A binary
        // may call a few of the functions.
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

/// Returns the equations of one link alone, for trees that other code holds; `None` where
/// the code is no loop.
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
    /// The path of the runtime crate.
    fn runtime(&self) -> TokenStream {
        runtime_path(&self.scene.crate_path)
    }

    /// The constants that the model stores: those that functions read, and the
    /// named ones behind them, in order.
    fn stored_constants(&self) -> Vec<ConstantId> {
        let mut stored = BTreeSet::new();
        // The gravity of loops is part of their tree.
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

    /// The field of a stored constant. A parameter that code reads as it is has
    /// its own name, unless a constant of the scene, or the argument that the
    /// parameters come in, is called the same.
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

    /// The symbol of a constant of the mechanics.
    fn letter(&self, index: usize) -> &Symbol {
        let symbol = self.mechanics.constants[index].symbol;
        self.mechanics.symbols.get(symbol)
    }

    fn op(&self, id: ValueId) -> &Op {
        &self.program.definition(id).op
    }
}

/// Type parameter beside `T`, where a function goes from one scalar to another:
/// `S`, unless the model itself is called so.
fn other_scalar(model: &Ident) -> Ident {
    let name = if model == "S" { "R" } else { "S" };
    Ident::new(name, Span::call_site())
}

/// The tokens of `::branched_pendulum` or of what `crate = …` says.
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
