//! Constants of a tree in loops: tables of exact numbers, with values that depend on parameters
//! filled in.

use super::Emission;
use super::doc_text::doc_lines;
use super::tokens::{number_tokens, part_tokens};
use crate::functions::{LINK_PROPERTIES, Purpose};
use crate::program::{Column, ConstantId, ConstantOp, LoopTree, Op, ValueId};
use crate::scene::Layout;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};
use std::collections::BTreeMap;

impl Emission<'_> {
    /// Emits `Self { … }` with all constants.
    pub(super) fn strip_values(&self, strips: &LoopTree) -> TokenStream {
        let runtime = self.runtime();
        let (lines, known) = self.formed_constants(strips);
        let rows = strips.strips.iter().map(|strip| strip.constants.as_slice());
        let columns = named(&strips.columns);
        let [table, rows] = self.table("strips", "the equations", &columns, rows.collect(), &known);
        let gravity = self.root_gravity(&known);
        let (parents, tree) = match self.scene.layout {
            Layout::Generations { .. } => (None, quote!(new(#rows, #gravity))),
            Layout::Unrolled | Layout::Links => (
                Some(self.parents()),
                quote!(with_parents(&PARENTS, &#rows, #gravity)),
            ),
        };
        let between = self.spring_dampers(strips, &known);
        let lines_between = self.translational_spring_dampers(strips, &known);
        let with_fields = [self.bodies(strips, &known), self.properties(strips, &known)];
        let (tables, fields): (Vec<_>, Vec<_>) = with_fields.into_iter().flatten().unzip();
        let fields = fields.into_iter().chain(self.stored_values(&known));
        let tree = quote!(#runtime::tree::Tree::#tree #between #lines_between);
        let pullback = self.pullback_values(strips, &known);
        let (places, value) = match pullback {
            Some((places, pullback)) => (
                Some(places),
                quote! {
                    let tree = #tree;
                    Self { pullback: #pullback, tree, #(#fields),* }
                },
            ),
            None => (None, quote!(Self { tree: #tree, #(#fields),* })),
        };
        quote! {
            #parents
            #table
            #(#tables)*
            #places
            #(#lines)*
            #value
        }
    }

    /// Emits the shape of the tree, which further tables need.
    pub(super) fn shape(&self) -> TokenStream {
        let runtime = self.runtime();
        let shape = match self.scene.layout {
            Layout::Generations { .. } => {
                let equations = format_ident!("{}Equations", self.item.ident);
                quote!(Generations(<#equations as #runtime::tree::LinkEquations>::COPIES))
            }
            Layout::Unrolled | Layout::Links => quote!(Parents(&PARENTS)),
        };
        quote!(#runtime::tree::Shape::#shape)
    }

    /// Emits the table that energies and powers read, with its field.
    fn bodies(
        &self,
        strips: &LoopTree,
        known: &BTreeMap<ConstantId, Ident>,
    ) -> Option<(TokenStream, TokenStream)> {
        self.scene.requests.energies.then(|| {
            let (runtime, shape) = (self.runtime(), self.shape());
            let rows = strips.strips.iter().map(|strip| strip.body.as_slice());
            let (rows, columns) = (rows.collect(), named(&strips.body_columns));
            let [table, rows] = self.table("bodies", "energies and powers", &columns, rows, known);
            let field = quote!(bodies: #runtime::tree::Bodies::new(#shape, #rows));
            (table, field)
        })
    }

    /// Emits the table that positions read, with its field.
    fn properties(
        &self,
        strips: &LoopTree,
        known: &BTreeMap<ConstantId, Ident>,
    ) -> Option<(TokenStream, TokenStream)> {
        self.scene.requests.positions.then(|| {
            let (runtime, shape) = (self.runtime(), self.shape());
            let rows = strips.strips.iter();
            let rows = rows.filter_map(|strip| strip.properties.as_ref());
            let rows = rows.map(|row| row.as_slice()).collect();
            let columns = LINK_PROPERTIES.map(str::to_owned);
            let [table, rows] = self.table("properties", "positions", &columns, rows, known);
            let standing = self.scene.stands().then(|| quote!(.standing(true)));
            let field = quote! {
                properties: #runtime::tree::PropertyTable::new(#shape, #rows) #standing
            };
            (table, field)
        })
    }

    /// Emits the fields of the other constants that the model stores.
    fn stored_values(&self, known: &BTreeMap<ConstantId, Ident>) -> Vec<TokenStream> {
        let stored = self.stored_constants();
        let stored = stored.iter().map(|&id| {
            let field = self.field(id);
            match known.get(&id) {
                Some(value) if *value == field => quote!(#field),
                _ => {
                    let value = self.known_value(id, known);
                    quote!(#field: #value)
                }
            }
        });
        stored.collect()
    }

    /// Returns `let` lines for all constants of the tree and of the drive that depend on
    /// parameters, and the names of these constants.
    fn formed_constants(
        &self,
        strips: &LoopTree,
    ) -> (Vec<TokenStream>, BTreeMap<ConstantId, Ident>) {
        let mut wanted: Vec<ConstantId> = strips.all_constants().collect();
        wanted.extend(self.stored_constants());
        wanted.extend(self.root_constants());
        let setup = &self.program.setup;
        let mut formed = setup.behind(wanted, |definition| definition.exact.is_none());
        formed.retain(|&id| {
            let definition = setup.get(id);
            definition.exact.is_none() && !matches!(definition.op, ConstantOp::Parameter(_))
        });
        self.formed_lines(formed, |_| None)
    }

    fn root_constants(&self) -> Vec<ConstantId> {
        let outputs = self.root_outputs().iter();
        let constants = outputs.filter_map(|&id| match *self.op(id) {
            Op::Constant(constant) => Some(constant),
            _ => None,
        });
        constants.collect()
    }

    fn root_outputs(&self) -> &[ValueId] {
        let entry = self.entry(Purpose::RootGravity);
        entry.map_or(&[], |entry| &entry.outputs)
    }

    /// Emits the apparent gravity at the root's pivot without a drive.
    fn root_gravity(&self, known: &BTreeMap<ConstantId, Ident>) -> TokenStream {
        let components = self.root_outputs().iter().map(|&id| match self.op(id) {
            Op::Constant(constant) => self.known_value(*constant, known),
            Op::Number(number) => number_tokens(number),
            _ => unreachable!("gravity is a constant"),
        });
        quote!([#(#components),*])
    }

    pub(super) fn known_value(
        &self,
        id: ConstantId,
        known: &BTreeMap<ConstantId, Ident>,
    ) -> TokenStream {
        match known.get(&id) {
            Some(name) => quote!(#name),
            None => self.constant_value(id, known).0,
        }
    }

    /// Emits the parents of the links, from the root on.
    fn parents(&self) -> TokenStream {
        let count = Literal::usize_unsuffixed(self.scene.links.len());
        let parents = self.scene.links.iter().map(|link| {
            let parent = link.parent.map_or(0, |parent| parent.0);
            Literal::usize_unsuffixed(parent)
        });
        quote! {
            /// Index of the parent of each link, which is an earlier link; unused for the root.
            static PARENTS: [u32; #count] = [#(#parents),*];
        }
    }

    /// Emits a table of constants as exact numbers, and code that converts it to a vector in the
    /// model's scalar, row by row, with the values that depend on parameters inserted.
    pub(super) fn table(
        &self,
        name: &str,
        purpose: &str,
        columns: &[String],
        rows: Vec<&[ConstantId]>,
        known: &BTreeMap<ConstantId, Ident>,
    ) -> [TokenStream; 2] {
        let runtime = self.runtime();
        let constants = format_ident!("{}", name.to_uppercase());
        let name = format_ident!("{name}");
        let row = match self.scene.layout {
            Layout::Generations { .. } => "generation",
            Layout::Unrolled | Layout::Links => "link",
        };
        let mut docs = vec![
            format!(
                "Constants of {purpose}, a row for each {row}, the root's first; of every number the nearest `f64` and what remains. Columns:"
            ),
            String::new(),
        ];
        let numbered = columns.iter().enumerate();
        docs.extend(numbered.map(|(column, meaning)| format!("{}. {meaning}", column + 1)));
        let docs = doc_lines(&docs);
        let count = Literal::usize_unsuffixed(rows.len());
        let width = columns.len();
        let mut placed = Vec::new();
        let lines = rows.iter().enumerate().map(|(link, row)| {
            let numbers = row.iter().enumerate().map(|(column, &id)| {
                let exact = self.program.setup.get(id).exact.as_ref();
                let [high, low] = exact.map(part_tokens).unwrap_or_else(|| {
                    let value = self.known_value(id, known);
                    let place = Literal::usize_unsuffixed(link * width + column);
                    placed.push(quote!(#name[#place] = #value;));
                    [quote!(0.0), quote!(0.0)]
                });
                quote!([#high, #low])
            });
            quote!([#(#numbers),*])
        });
        let lines = quote!(#(#lines),*);
        let width = Literal::usize_unsuffixed(width);
        let table = quote! {
            #docs
            static #constants: [[[f64; 2]; #width]; #count] = [#lines];
        };
        let value = quote!(#runtime::tree::numbers(#constants.as_flattened()));
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
}

/// Returns names and meanings of columns.
fn named(columns: &[Column]) -> Vec<String> {
    let columns = columns.iter();
    columns
        .map(|column| format!("`{}`: {}", column.name(), column.meaning()))
        .collect()
}
