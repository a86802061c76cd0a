//! Long functions in parts: readers tire, and the compiler's passes over one
//! function take longer than in proportion to its length.

use super::Emission;
use super::function::ident;
use super::names::Locals;
use crate::program::{Entry, Op, ValueId};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};
use std::collections::BTreeSet;

/// A function of more `let` lines than this is written in parts of at most as
/// many.
pub(super) const MOST_LINES: usize = 600;

/// One `let` line.
pub(super) struct Line {
    /// The values that it names.
    pub(super) defines: Vec<ValueId>,
    /// Values that it is formed from, named or not.
    pub(super) reads: Vec<ValueId>,
    pub(super) tokens: TokenStream,
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
    pub(super) fn call(&self, entry: &Entry) -> TokenStream {
        let (name, receives, returns) = (self.name(entry), &self.receives, &self.returns);
        quote!(let [#(#returns),*] = self.#name([#(#receives),*]);)
    }

    fn function(&self, entry: &Entry) -> TokenStream {
        let name = self.name(entry);
        let docs = format!(" Part {} of [`{1}`](Self::{1}).", self.number, entry.name);
        let (receives, returns, lines) = (&self.receives, &self.returns, &self.lines);
        let taken = Literal::usize_unsuffixed(receives.len());
        let given = Literal::usize_unsuffixed(returns.len());
        quote! {
            #[doc = #docs]
            fn #name(&self, [#(#receives),*]: [T; #taken]) -> [T; #given] {
                #(#lines)*
                [#(#returns),*]
            }
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

    fn is_number(&self, line: &Line) -> bool {
        let number = |id: &ValueId| matches!(self.op(*id), Op::Number(_));
        line.defines.iter().all(number)
    }

    /// Cuts the lines of a function into parts of equal length. Numbers are
    /// written again in every part that uses them.
    pub(super) fn parts(&self, entry: &Entry, lines: &[Line], locals: &Locals) -> Vec<Part> {
        let (numbers, lines): (Vec<&Line>, Vec<&Line>) =
            lines.iter().partition(|line| self.is_number(line));
        let count = lines.len().div_ceil(MOST_LINES);
        let length = lines.len().div_ceil(count);
        let mut wanted = BTreeSet::new();
        for &output in &entry.outputs {
            self.named_operands(output, locals, &mut wanted);
        }
        let mut parts = Vec::new();
        for (number, lines) in lines.chunks(length).enumerate().rev() {
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
        let mut wanted = BTreeSet::new();
        for &output in &entry.outputs {
            self.named_operands(output, locals, &mut wanted);
        }
        lines
            .iter()
            .filter(|line| self.is_number(line))
            .filter(|line| line.defines.iter().any(|id| wanted.contains(id)))
            .map(|line| line.tokens.clone())
            .collect()
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
        let parts = self.parts(entry, &lines, locals);
        let functions = parts.iter().map(|part| part.function(entry));
        quote!(#(#functions)*)
    }
}
