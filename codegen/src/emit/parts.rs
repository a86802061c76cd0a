//! Long functions in parts: readers tire, and the compiler's passes over one
//! function take longer than in proportion to its length.

use super::Emission;
use super::function::ident;
use super::names::Locals;
use crate::program::{Entry, Op, Purpose, ValueId};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};
use std::collections::{BTreeMap, BTreeSet};

/// A function of more `let` lines than this is written in parts of at most as
/// many.
pub(super) const MOST_LINES: usize = 600;

/// Parts that hand each other more names than this in all do it by an array:
/// lists of thousands of arguments are as long as what they replace.
const MOST_NAMES: usize = 10_000;

/// Lines and values taken from the array, at most, in a part that uses one.
const MOST_WITH_ARRAY: usize = 500;

/// One `let` line.
pub(super) struct Line {
    /// The values that it names.
    pub(super) defines: Vec<ValueId>,
    /// Values that it is formed from, named or not.
    pub(super) reads: Vec<ValueId>,
    pub(super) tokens: TokenStream,
}

/// A long function in parts.
pub(super) struct Parts {
    parts: Vec<Part>,
    /// Places of the values that parts hand each other in an array, if they do.
    places: Option<BTreeMap<Ident, usize>>,
}

/// Some lines of a function, with what goes in and out.
pub(super) struct Part {
    number: usize,
    receives: Vec<Ident>,
    returns: Vec<Ident>,
    lines: Vec<TokenStream>,
}

impl Part {
    fn name(&self, entry: &Entry) -> Ident {
        format_ident!("{}_part_{}", entry.name, self.number)
    }

    /// The line that stands for the part in the whole.
    fn call(&self, entry: &Entry) -> TokenStream {
        let (name, receives, returns) = (self.name(entry), &self.receives, &self.returns);
        let call = outlined(entry, quote!(self.#name([#(#receives),*])));
        quote!(let [#(#returns),*] = #call;)
    }

    fn function(&self, entry: &Entry) -> TokenStream {
        let name = self.name(entry);
        let docs = format!(" Part {} of [`{1}`](Self::{1}).", self.number, entry.name);
        let (receives, returns, lines) = (&self.receives, &self.returns, &self.lines);
        let inline = inlined(entry);
        let taken = Literal::usize_unsuffixed(receives.len());
        let given = Literal::usize_unsuffixed(returns.len());
        quote! {
            #[doc = #docs]
            #inline
            fn #name(&self, [#(#receives),*]: [T; #taken]) -> [T; #given] {
                #(#lines)*
                [#(#returns),*]
            }
        }
    }

    /// The part as a function on the array.
    fn on_array(&self, entry: &Entry, places: &BTreeMap<Ident, usize>) -> TokenStream {
        let name = self.name(entry);
        let docs = format!(
            " Part {} of [`{1}`](Self::{1}), on the values that its parts share.",
            self.number, entry.name
        );
        let size = Literal::usize_unsuffixed(places.len());
        let inline = inlined(entry);
        let taken = taken(&self.receives, places);
        let given = given(&self.returns, places);
        let lines = &self.lines;
        quote! {
            #[doc = #docs]
            #inline
            fn #name(&self, shared_values: &mut [T; #size]) {
                #(#taken)*
                #(#lines)*
                #(#given)*
            }
        }
    }
}

/// A call of a part. Those of the accelerations are functions of the instructions
/// that the scalar stands for.
fn outlined(entry: &Entry, call: TokenStream) -> TokenStream {
    if entry.purpose == Purpose::Accelerations {
        quote!(T::outlined(|| #call))
    } else {
        call
    }
}

/// What makes [`outlined`] possible.
fn inlined(entry: &Entry) -> Option<TokenStream> {
    (entry.purpose == Purpose::Accelerations).then(|| quote!(#[inline(always)]))
}

/// `let x = shared_values[3];`
fn taken(names: &[Ident], places: &BTreeMap<Ident, usize>) -> Vec<TokenStream> {
    let line = |name: &Ident| {
        let place = Literal::usize_unsuffixed(places[name]);
        quote!(let #name = shared_values[#place];)
    };
    names.iter().map(line).collect()
}

/// `shared_values[3] = x;`
fn given(names: &[Ident], places: &BTreeMap<Ident, usize>) -> Vec<TokenStream> {
    let line = |name: &Ident| {
        let place = Literal::usize_unsuffixed(places[name]);
        quote!(shared_values[#place] = #name;)
    };
    names.iter().map(line).collect()
}

impl Parts {
    /// The lines that stand for the parts in the whole, after those of the
    /// inputs; `outputs` names what the lines after them read.
    pub(super) fn calls(&self, entry: &Entry, outputs: &[Ident]) -> Vec<TokenStream> {
        let Some(places) = &self.places else {
            return self.parts.iter().map(|part| part.call(entry)).collect();
        };
        let made: BTreeSet<&Ident> = self.parts.iter().flat_map(|part| &part.returns).collect();
        let received: BTreeSet<&Ident> =
            self.parts.iter().flat_map(|part| &part.receives).collect();
        let inputs: Vec<Ident> = received.difference(&made).copied().cloned().collect();
        let outputs: Vec<Ident> = outputs
            .iter()
            .filter(|name| made.contains(name))
            .cloned()
            .collect();
        let size = Literal::usize_unsuffixed(places.len());
        let mut lines = vec![quote!(let mut shared_values = [T::from_f64(0.0); #size];)];
        lines.extend(given(&inputs, places));
        lines.extend(self.parts.iter().map(|part| {
            let name = part.name(entry);
            let call = outlined(entry, quote!(self.#name(&mut shared_values)));
            quote!(#call;)
        }));
        lines.extend(taken(&outputs, places));
        lines
    }

    fn functions(&self, entry: &Entry) -> Vec<TokenStream> {
        let parts = self.parts.iter();
        match &self.places {
            Some(places) => parts.map(|part| part.on_array(entry, places)).collect(),
            None => parts.map(|part| part.function(entry)).collect(),
        }
    }
}

impl Emission<'_> {
    /// The named values that a value is written in.
    fn named_operands(&self, id: ValueId, locals: &Locals, found: &mut BTreeSet<ValueId>) {
        if locals.names.contains_key(&id) {
            found.insert(id);
            return;
        }
        for operand in self.program.definition(id).op.operands() {
            self.named_operands(operand, locals, found);
        }
    }

    /// The named values that the outputs are written in.
    fn behind_outputs(&self, entry: &Entry, locals: &Locals) -> BTreeSet<ValueId> {
        let mut wanted = BTreeSet::new();
        for &output in &entry.outputs {
            self.named_operands(output, locals, &mut wanted);
        }
        wanted
    }

    fn is_number(&self, line: &Line) -> bool {
        let number = |id: &ValueId| matches!(self.op(*id), Op::Number(_));
        line.defines.iter().all(number)
    }

    /// Cuts the lines of a function into parts of equal length. Numbers are
    /// written again in every part that uses them.
    pub(super) fn parts(&self, entry: &Entry, lines: &[Line], locals: &Locals) -> Parts {
        let (numbers, lines): (Vec<&Line>, Vec<&Line>) =
            lines.iter().partition(|line| self.is_number(line));
        let count = lines.len().div_ceil(MOST_LINES);
        let length = lines.len().div_ceil(count);
        let even: Vec<&[&Line]> = lines.chunks(length).collect();
        let parts = self.cut(entry, &numbers, &even, locals);
        let names: usize = parts
            .iter()
            .map(|part| part.receives.len() + part.returns.len())
            .sum();
        if names <= MOST_NAMES {
            return Parts {
                parts,
                places: None,
            };
        }
        let parts = self.cut(entry, &numbers, &self.short(&lines, locals), locals);
        let shared = parts
            .iter()
            .flat_map(|part| part.receives.iter().chain(&part.returns));
        let mut places = BTreeMap::new();
        for name in shared {
            let next = places.len();
            places.entry(name.clone()).or_insert(next);
        }
        Parts {
            parts,
            places: Some(places),
        }
    }

    /// Pieces of few lines and few values from outside.
    fn short<'l>(&self, lines: &'l [&'l Line], locals: &Locals) -> Vec<&'l [&'l Line]> {
        let mut pieces = Vec::new();
        let mut start = 0;
        let mut seen = BTreeSet::new();
        for (index, line) in lines.iter().enumerate() {
            for &id in &line.reads {
                self.named_operands(id, locals, &mut seen);
            }
            seen.extend(&line.defines);
            // Values count once, whether they come from outside or are made.
            if seen.len() > MOST_WITH_ARRAY && index > start {
                pieces.push(&lines[start..index]);
                start = index;
                seen.clear();
                for &id in &line.reads {
                    self.named_operands(id, locals, &mut seen);
                }
                seen.extend(&line.defines);
            }
        }
        pieces.push(&lines[start..]);
        pieces
    }

    /// The given pieces as parts.
    fn cut(
        &self,
        entry: &Entry,
        numbers: &[&Line],
        pieces: &[&[&Line]],
        locals: &Locals,
    ) -> Vec<Part> {
        let mut wanted = self.behind_outputs(entry, locals);
        let mut parts = Vec::new();
        for (number, &lines) in pieces.iter().enumerate().rev() {
            let mut read = BTreeSet::new();
            for line in lines {
                for &id in &line.reads {
                    self.named_operands(id, locals, &mut read);
                }
            }
            let own_numbers: Vec<&Line> = numbers
                .iter()
                .copied()
                .filter(|line| line.defines.iter().any(|id| read.contains(id)))
                .collect();
            let defined: BTreeSet<ValueId> = own_numbers
                .iter()
                .chain(lines)
                .flat_map(|line| line.defines.clone())
                .collect();
            let is_number = |id: &&ValueId| matches!(self.op(**id), Op::Number(_));
            let returns: Vec<ValueId> = wanted
                .intersection(&defined)
                .filter(|id| !is_number(id))
                .copied()
                .collect();
            let receives: Vec<ValueId> = read.difference(&defined).copied().collect();
            for id in &returns {
                wanted.remove(id);
            }
            wanted.extend(&receives);
            let names = |ids: &[ValueId]| ids.iter().map(|id| ident(&locals.names[id])).collect();
            parts.push(Part {
                number: number + 1,
                receives: names(&receives),
                returns: names(&returns),
                lines: own_numbers
                    .iter()
                    .chain(lines)
                    .map(|line| line.tokens.clone())
                    .collect(),
            });
        }
        parts.reverse();
        parts
    }

    /// The lines of numbers that the outputs are written in.
    pub(super) fn numbers_of_outputs(
        &self,
        entry: &Entry,
        lines: &[Line],
        locals: &Locals,
    ) -> Vec<TokenStream> {
        let wanted = self.behind_outputs(entry, locals);
        lines
            .iter()
            .filter(|line| self.is_number(line))
            .filter(|line| line.defines.iter().any(|id| wanted.contains(id)))
            .map(|line| line.tokens.clone())
            .collect()
    }

    /// The names that the outputs are written in.
    pub(super) fn names_of_outputs(&self, entry: &Entry, locals: &Locals) -> Vec<Ident> {
        let wanted = self.behind_outputs(entry, locals);
        wanted.iter().map(|id| ident(&locals.names[id])).collect()
    }

    /// The functions behind a long one; nothing for others.
    pub(super) fn part_functions(
        &self,
        entry: &Entry,
        needed: &[ValueId],
        locals: &Locals,
    ) -> TokenStream {
        // Most functions have too few values for it, and are not written twice.
        let values = needed
            .iter()
            .filter(|&&id| !matches!(self.op(id), Op::Input(..)));
        if values.count() <= MOST_LINES {
            return TokenStream::new();
        }
        let (gathered, _) = self.gathered(entry, needed);
        let lines = self.lines(&gathered, None, needed, locals);
        if lines.len() <= MOST_LINES {
            return TokenStream::new();
        }
        let functions = self.parts(entry, &lines, locals).functions(entry);
        quote!(#(#functions)*)
    }
}
