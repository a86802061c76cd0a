//! Splitting of long functions into parts: for readers, and because the compiler's passes take a
//! time that grows faster than the length of a function.
//!
//! Parts pass values to each other in one array of the function. A slot of the array is reused as
//! soon as no later part reads its value.

mod cut;

use super::Emission;
use super::lines::{Line, MOST_LINES, Written, is_whole};
use super::names::Locals;
use super::tokens::{Binding, ident, number_tokens};
use crate::functions::{Argument, Purpose};
use crate::program::{Entry, Op, ValueId};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};
use std::collections::{BTreeMap, BTreeSet};

/// Approximate largest number of lines of a part, including those that read values from the array
/// and write them to it.
const MOST_IN_PART: usize = 640;

/// Name of the array of values that parts share.
pub(super) const SHARED: &str = "shared_values";

/// Some lines of a function, with the values that they receive and return.
pub(super) struct FunctionPart {
    pub(super) number: usize,
    /// Arguments of the function that are passed to the part.
    arguments: Vec<Argument>,
    /// Elements of these arguments that the part reads.
    pub(super) inputs: Vec<ValueId>,
    receives: Vec<ValueId>,
    returns: Vec<ValueId>,
    lines: Vec<TokenStream>,
}

/// A long function in parts.
pub(super) struct FunctionParts {
    pub(super) parts: Vec<FunctionPart>,
    /// Slots of the values in the array.
    slots: BTreeMap<ValueId, usize>,
    /// Length of the array.
    pub(super) size: usize,
}

impl FunctionParts {
    /// Assigns a slot to every value that parts return, reusing free slots. Outputs keep theirs
    /// until the end.
    fn new(parts: Vec<FunctionPart>, outputs: &BTreeSet<ValueId>) -> Self {
        let mut last_read = BTreeMap::new();
        for part in &parts {
            last_read.extend(part.receives.iter().map(|&id| (id, part.number)));
        }
        let (mut slots, mut size, mut free) = (BTreeMap::new(), 0, Vec::new());
        for part in &parts {
            // A part reads its received values before it returns any.
            let done = part.receives.iter();
            let done = done.filter(|id| last_read[id] == part.number && !outputs.contains(id));
            free.extend(done.map(|id| slots[id]));
            for &id in &part.returns {
                let slot = free.pop().unwrap_or_else(|| {
                    size += 1;
                    size - 1
                });
                slots.insert(id, slot);
            }
        }
        Self { parts, slots, size }
    }

    fn slot(&self, id: ValueId) -> TokenStream {
        let (shared, slot) = (ident(SHARED), Literal::usize_unsuffixed(self.slots[&id]));
        quote!(#shared[#slot])
    }
}

impl Emission<'_> {
    /// Returns true if the named values alone, with at least one line each, make the function too
    /// long.
    pub(super) fn surely_long(&self, locals: &Locals) -> bool {
        let lines = locals.names.keys().filter(|id| {
            !matches!(
                self.op(**id),
                Op::Input(..) | Op::Constant(_) | Op::Sin(_) | Op::Cos(_)
            )
        });
        lines.count() > MOST_LINES
    }

    /// Names the outputs of a long function, because its parts compute them.
    pub(super) fn name_outputs(&self, entry: &Entry, locals: &mut Locals) {
        locals.fresh(SHARED.to_owned());
        for (number, &id) in entry.outputs.iter().enumerate() {
            let leaf = matches!(self.op(id), Op::Constant(_) | Op::Number(_));
            if !leaf && !locals.names.contains_key(&id) {
                locals.claim(id, format!("output_{number}"));
            }
        }
    }

    /// Returns the body of a long function, and the functions that follow it.
    pub(super) fn in_parts(
        &self,
        entry: &Entry,
        lines: &[Line],
        locals: &Locals,
    ) -> (TokenStream, TokenStream) {
        let parts = self.parts(&entry.outputs, lines, locals);
        let used =
            |argument: &&Argument| parts.parts.iter().any(|p| p.arguments.contains(argument));
        let read = |argument: &&Argument| {
            let input =
                |id: &ValueId| matches!(*self.op(*id), Op::Input(of, _) if of == **argument);
            entry.outputs.iter().any(input)
        };
        let unused = entry.arguments.iter().filter(|a| !used(a) && !read(a));
        let unused = unused.map(|argument| ident(argument.name()));
        let (shared, size) = (ident(SHARED), Literal::usize_unsuffixed(parts.size));
        let runtime = self.runtime();
        let calls = parts.parts.iter().map(|part| {
            let arguments = part.arguments.iter();
            let arguments = arguments.map(|argument| ident(argument.name()));
            if entry.purpose == Purpose::Accelerations {
                let number = Literal::usize_unsuffixed(part.number);
                let handed = arguments.map(|name| quote!(#name));
                let handed = together(handed.chain([quote!(&mut #shared)]).collect());
                quote!(#runtime::emitted::outlined::<#number, T, _, _>(self, #handed);)
            } else {
                let name = part.name(entry);
                quote!(self.#name(#(#arguments,)* &mut #shared);)
            }
        });
        let values = entry.outputs.iter();
        let values = values.map(|&id| self.output_of_parts(id, &parts, locals));
        let outputs = self.shaped(entry, values.collect());
        let body = quote! {
            #(let _ = #unused;)*
            let mut #shared = [T::from_f64(0.0); #size];
            #(#calls)*
            #outputs
        };
        if entry.purpose == Purpose::Accelerations {
            return (body, TokenStream::new());
        }
        (body, self.functions_of_parts(entry, &parts, lines, locals))
    }

    /// Returns the functions of the parts.
    fn functions_of_parts(
        &self,
        entry: &Entry,
        parts: &FunctionParts,
        lines: &[Line],
        locals: &Locals,
    ) -> TokenStream {
        let (shared, size) = (ident(SHARED), Literal::usize_unsuffixed(parts.size));
        let inline = is_whole(lines).then(|| quote!(#[inline(always)]));
        let functions = parts.parts.iter().map(|part| {
            let name = part.name(entry);
            let docs = format!(
                " Part {} of [`{1}`](Self::{1}), on the values that its parts share.",
                part.number, entry.name
            );
            let parameters = part.arguments.iter();
            let parameters = parameters.map(|&argument| self.parameter(argument));
            let body = self.part_body(part, parts, locals);
            quote! {
                #[doc = #docs]
                #inline
                fn #name(&self, #(#parameters,)* #shared: &mut [T; #size]) {
                    #body
                }
            }
        });
        functions.collect()
    }

    /// Returns the expression of an output of a long function, which reads an argument or the array
    /// of shared values.
    fn output_of_parts(&self, id: ValueId, parts: &FunctionParts, locals: &Locals) -> TokenStream {
        match *self.op(id) {
            Op::Input(Argument::Time, _) => self.bound(id, locals, Binding::Sum),
            Op::Input(argument, index) => {
                let name = ident(argument.name());
                let place = |index| Literal::usize_unsuffixed(index);
                match argument {
                    Argument::Forces => {
                        let (link, axis) = (place(index / 2), place(index % 2));
                        quote!(#name[#link][#axis])
                    }
                    _ => {
                        let index = place(index);
                        quote!(#name[#index])
                    }
                }
            }
            Op::Number(ref number) => number_tokens(number),
            Op::Constant(_) => self.bound(id, locals, Binding::Sum),
            _ => parts.slot(id),
        }
    }

    /// Emits the parts of the accelerations if these are long. They are implementations of a trait,
    /// so that they are compiled for the instruction set of the scalar; plain functions would not
    /// be.
    pub(super) fn part_implementations(&self) -> TokenStream {
        let Some(entry) = self.entry(Purpose::Accelerations) else {
            return TokenStream::new();
        };
        let needed = self.program.needed(&entry.outputs);
        let written = self.written(entry, &needed);
        if !written.long || self.is_sunk(entry, &written) {
            return TokenStream::new();
        }
        let Written { lines, locals, .. } = written;
        let parts = self.parts(&entry.outputs, &lines, &locals);
        let (name, runtime) = (&self.item.ident, self.runtime());
        let (shared, size) = (ident(SHARED), Literal::usize_unsuffixed(parts.size));
        let implementations = parts.parts.iter().map(|part| {
            let number = Literal::usize_unsuffixed(part.number);
            let arguments = part.arguments.iter();
            let names = arguments.clone().map(|argument| {
                let name = ident(argument.name());
                quote!(#name)
            });
            let names = together(names.chain([quote!(#shared)]).collect());
            let types = arguments.map(|&argument| self.argument_type(argument));
            let types = together(types.chain([quote!(&mut [T; #size])]).collect());
            let body = self.part_body(part, &parts, &locals);
            quote! {
                impl<T: #runtime::Scalar> #runtime::emitted::Part<#number, #types> for #name<T> {
                    type Output = ();

                    #[inline(always)]
                    fn part(&self, #names: #types) {
                        #body
                    }
                }
            }
        });
        implementations.collect()
    }

    fn part_body(
        &self,
        part: &FunctionPart,
        parts: &FunctionParts,
        locals: &Locals,
    ) -> TokenStream {
        let elements = part.arguments.iter();
        let elements = elements.filter(|argument| self.reads(**argument, &part.inputs));
        let elements = elements.map(|&argument| self.destructure(argument, &part.inputs, locals));
        self.part_lines(part, parts, locals, elements.collect())
    }

    /// Returns the lines of a part, after those that read its inputs.
    pub(super) fn part_lines(
        &self,
        part: &FunctionPart,
        parts: &FunctionParts,
        locals: &Locals,
        elements: Vec<TokenStream>,
    ) -> TokenStream {
        let named = |id: &ValueId| (ident(&locals.names[id]), parts.slot(*id));
        let taken = part.receives.iter().map(named);
        let taken = taken.map(|(name, slot)| quote!(let #name = #slot;));
        let given = part.returns.iter().map(named);
        let given = given.map(|(name, slot)| quote!(#slot = #name;));
        let lines = &part.lines;
        quote! {
            #(#elements)*
            #(#taken)*
            #(#lines)*
            #(#given)*
        }
    }

    /// Returns the named values that the expression of a value uses.
    pub(super) fn named_operands(
        &self,
        id: ValueId,
        locals: &Locals,
        found: &mut BTreeSet<ValueId>,
    ) {
        if locals.names.contains_key(&id) {
            found.insert(id);
            return;
        }
        for operand in self.program.definition(id).op.operands() {
            self.named_operands(operand, locals, found);
        }
    }
}

/// Combines several items into a tuple; a single item is returned unchanged.
fn together(parts: Vec<TokenStream>) -> TokenStream {
    match parts.as_slice() {
        [only] => only.clone(),
        parts => quote!((#(#parts),*)),
    }
}

impl FunctionPart {
    pub(super) fn name(&self, entry: &Entry) -> Ident {
        format_ident!("{}_part_{}", entry.name, self.number)
    }
}
