//! Emits one function per entry point.

use super::Emission;
use super::gather::Gathered;
use super::lines::{Line, Written, is_long};
use super::names::Locals;
use super::shapes::{argument_type, result_type};
use super::tokens::{Binding, ident};
use crate::functions::{Argument, Purpose};
use crate::program::{Entry, LINK_MOTION, Op, Pass, ValueId};
use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens, quote};

impl Emission<'_> {
    pub(super) fn function(&self, entry: &Entry) -> TokenStream {
        let docs = self.entry_docs(entry);
        let name = ident(&entry.name);
        let arguments = entry.arguments.iter();
        let arguments = arguments.map(|&argument| self.parameter(argument));
        let count = |count| Literal::usize_unsuffixed(count).into_token_stream();
        let result = result_type(&self.runtime(), entry.shape, entry.outputs.len(), count);
        let needed = self.program.needed(&entry.outputs);
        let (body, parts) = self.body(entry, &needed);
        // Batches and lanes compile the accelerations for wider registers than the rest of the
        // build, which only works if they are inlined. The accelerations of loops call the drive.
        let is_motion = entry.purpose == Purpose::Accelerations || entry.purpose.slices().is_some();
        let in_loops = entry.purpose == Purpose::Drive && self.scene.in_loops();
        let inline = match is_motion || in_loops {
            true => quote!(#[inline(always)]),
            false => quote!(#[inline]),
        };
        // In addition to the model: clippy's limit is seven arguments.
        let crowded = entry.arguments.len() > 6;
        let allowed = crowded.then(|| quote!(#[allow(clippy::too_many_arguments)]));
        quote! {
            #docs
            #allowed
            #inline
            pub fn #name(&self, #(#arguments),*) -> #result {
                #body
            }

            #parts
        }
    }

    /// Returns the declaration of an argument: `theta: &[T; 3]`.
    pub(super) fn parameter(&self, argument: Argument) -> TokenStream {
        let (name, kind) = (ident(argument.name()), self.argument_type(argument));
        quote!(#name: #kind)
    }

    pub(super) fn argument_type(&self, argument: Argument) -> TokenStream {
        argument_type(argument, &self.argument_size(argument).into_token_stream())
    }

    pub(super) fn argument_size(&self, argument: Argument) -> Literal {
        Literal::usize_unsuffixed(self.argument_length(argument))
    }

    /// Returns the length of an array argument. There are as many coordinates as links.
    pub(super) fn argument_length(&self, argument: Argument) -> usize {
        match argument {
            Argument::Difference(sector) | Argument::DifferenceRate(sector) => {
                self.transverse_links(sector)
            }
            Argument::SmallDifferences | Argument::SmallRates | Argument::SmallTorques => {
                self.small_count()
            }
            Argument::Prescribed(set) => self.scene.prescribed[set].links.len(),
            Argument::Time => 1,
            Argument::Actions => self.action_count(),
            Argument::Theta
            | Argument::Omega
            | Argument::AbsoluteMomenta
            | Argument::Coordinates
            | Argument::Rates
            | Argument::Momenta
            | Argument::Forces
            | Argument::Alpha
            | Argument::Weights
            | Argument::Torques
            | Argument::Absolute
            | Argument::Symmetric => self.scene.links.len(),
            Argument::Constants
            | Argument::Body
            | Argument::Motion
            | Argument::Response
            | Argument::Sums
            | Argument::Elimination
            | Argument::Carried
            | Argument::Pivot
            | Argument::Given(_) => match &self.program.strips {
                Some(strips) => strips.length(argument),
                None => unreachable!("`{}` is an argument in loops alone", argument.name()),
            },
        }
    }

    /// Returns the body of a short function.
    pub(super) fn plain_body(&self, entry: &Entry) -> TokenStream {
        let needed = self.program.needed(&entry.outputs);
        self.body(entry, &needed).0
    }

    /// Returns the body of a function, and the functions of its parts if it is long.
    fn body(&self, entry: &Entry, needed: &[ValueId]) -> (TokenStream, TokenStream) {
        let written = self.written(entry, needed);
        if self.is_sunk(entry, &written) {
            let parts = self.sunk_parts(entry, needed, &written);
            return (self.through_evaluate(entry), parts);
        }
        if written.long {
            return self.in_parts(entry, &written.lines, &written.locals);
        }
        let Written {
            lines,
            locals,
            gathered,
            ..
        } = written;
        let whole = gathered.whole;
        let read = self.read(entry, needed, whole.is_some().then_some(&gathered.inputs));
        let inputs = entry
            .arguments
            .iter()
            .filter(|argument| whole != Some(**argument) || self.reads(**argument, &read))
            .map(|&argument| self.destructure(argument, &read, &locals));
        let lines = lines.into_iter().map(|line| line.tokens);
        let outputs = entry.outputs.iter();
        let outputs = outputs.map(|&id| self.bound(id, &locals, Binding::Sum));
        let outputs = self.shaped(entry, outputs.collect());
        let body = quote! {
            #(#inputs)*
            #(#lines)*
            #outputs
        };
        (body, TokenStream::new())
    }

    /// Returns the lines of a function; in a long function the outputs are named too.
    pub(super) fn written(&self, entry: &Entry, needed: &[ValueId]) -> Written {
        let mut locals = self.locals(entry, needed);
        let gathered = self.gathered(entry, needed);
        let splits = self.program.without != Some(Pass::Splitting);
        let mut long = splits && self.surely_long(&locals);
        if long {
            self.name_outputs(entry, &mut locals);
        }
        let mut lines = self.lines(&gathered, needed, &locals);
        if splits && !long && is_long(&lines) {
            long = true;
            self.name_outputs(entry, &mut locals);
            lines = self.lines(&gathered, needed, &locals);
        }
        Written {
            lines,
            locals,
            gathered,
            long,
        }
    }

    /// Returns the `let` lines of a function. First come the sines and cosines computed together,
    /// and the values that their angles need.
    pub(super) fn lines(
        &self,
        gathered: &Gathered,
        needed: &[ValueId],
        locals: &Locals,
    ) -> Vec<Line> {
        let Gathered {
            inputs,
            whole,
            formed,
        } = gathered;
        let mut lines = Vec::new();
        if !inputs.is_empty() {
            lines.push(self.gathered_line(inputs, *whole, needed, locals));
        }
        let first = self.program.needed(formed);
        for &id in &first {
            lines.extend(self.line(id, locals));
        }
        if !formed.is_empty() {
            lines.push(self.gathered_line(formed, None, needed, locals));
        }
        let mut paired: Vec<ValueId> = inputs.iter().chain(formed).copied().collect();
        for &id in needed {
            let angle = match *self.op(id) {
                Op::Sin(angle) | Op::Cos(angle) => angle,
                _ if first.binary_search(&id).is_ok() => continue,
                _ => {
                    lines.extend(self.line(id, locals));
                    continue;
                }
            };
            if !paired.contains(&angle) {
                paired.push(angle);
                let pair = [Op::Sin(angle), Op::Cos(angle)];
                let both = needed
                    .iter()
                    .copied()
                    .filter(|&id| pair.contains(self.op(id)));
                let tokens = self.sin_cos(angle, needed, locals);
                lines.push(Line::new(both.collect(), vec![angle], tokens));
            }
        }
        lines
    }

    /// Returns the line of a named value, unless the value is an argument.
    fn line(&self, id: ValueId, locals: &Locals) -> Option<Line> {
        if let Op::Input(..) | Op::Constant(_) = self.op(id) {
            return None;
        }
        let name = ident(locals.names.get(&id)?);
        let reads = self.op(id).operands().collect();
        Some(Line::new(vec![id], reads, self.named(id, &name, locals)))
    }

    fn gathered_line(
        &self,
        angles: &[ValueId],
        whole: Option<Argument>,
        needed: &[ValueId],
        locals: &Locals,
    ) -> Line {
        let of_angles = needed.iter().copied().filter(
            |&id| matches!(*self.op(id), Op::Sin(angle) | Op::Cos(angle) if angles.contains(&angle)),
        );
        let reads = match whole {
            Some(_) => Vec::new(),
            None => angles.to_vec(),
        };
        let tokens = self.sin_cos_each(angles, whole, needed, locals);
        let mut line = Line::new(of_angles.collect(), reads, tokens);
        line.whole = whole;
        line
    }

    /// Returns `let [theta_parent, _, theta_child_2] = *theta;` with the elements that are `read`.
    pub(super) fn destructure(
        &self,
        argument: Argument,
        read: &[ValueId],
        locals: &Locals,
    ) -> TokenStream {
        let array = ident(argument.name());
        if argument == Argument::Time {
            let used = |id: &ValueId| matches!(self.op(*id), Op::Input(Argument::Time, _));
            return if read.iter().any(used) {
                TokenStream::new()
            } else {
                quote!(let _ = #array;)
            };
        }
        let length = match &self.program.strips {
            Some(strips) => strips.length(argument),
            None => match argument {
                Argument::Forces => 2 * self.scene.links.len(),
                _ => self.argument_length(argument),
            },
        };
        let mut any = false;
        let elements: Vec<TokenStream> = (0..length)
            .map(|index| {
                let name = read
                    .iter()
                    .find(|id| *self.op(**id) == Op::Input(argument, index))
                    .and_then(|id| locals.names.get(id));
                match name {
                    Some(name) => {
                        any = true;
                        let name = ident(name);
                        quote!(#name)
                    }
                    None => quote!(_),
                }
            })
            .collect();
        if !any {
            return quote!(let _ = #array;);
        }
        match argument {
            Argument::Motion => self.motion_taken_apart(&elements),
            Argument::Forces => {
                let vectors = elements.chunks(2).map(|vector| quote!([#(#vector),*]));
                quote!(let [#(#vectors),*] = *#array;)
            }
            Argument::Response
            | Argument::Sums
            | Argument::Elimination
            | Argument::Carried
            | Argument::Pivot
            | Argument::Given(_) => quote!(let [#(#elements),*] = #array;),
            Argument::Time
            | Argument::Theta
            | Argument::Omega
            | Argument::AbsoluteMomenta
            | Argument::Coordinates
            | Argument::Rates
            | Argument::Momenta
            | Argument::Alpha
            | Argument::Weights
            | Argument::Actions
            | Argument::Difference(_)
            | Argument::DifferenceRate(_)
            | Argument::SmallDifferences
            | Argument::SmallRates
            | Argument::Torques
            | Argument::SmallTorques
            | Argument::Prescribed(_)
            | Argument::Absolute
            | Argument::Symmetric
            | Argument::Constants
            | Argument::Body => quote!(let [#(#elements),*] = *#array;),
        }
    }

    /// Returns `let LinkMotion { sine, cosine, .. } = link;`.
    fn motion_taken_apart(&self, elements: &[TokenStream]) -> TokenStream {
        let runtime = self.runtime();
        let array = ident(Argument::Motion.name());
        let names = elements.iter().enumerate().filter_map(|(index, name)| {
            let field = ident(&self.input_name(Argument::Motion, index));
            match name.to_string() {
                name if name == "_" => None,
                name if field == name => Some(quote!(#field)),
                _ => Some(quote!(#field: #name)),
            }
        });
        let names: Vec<TokenStream> = names.collect();
        let rest = (names.len() < LINK_MOTION.len()).then(|| quote!(..));
        quote!(let #runtime::tree::LinkMotion { #(#names,)* #rest } = #array;)
    }

    /// Returns `let (sin_parent, cos_parent) = theta_parent.sin_cos();`.
    fn sin_cos(&self, angle: ValueId, needed: &[ValueId], locals: &Locals) -> TokenStream {
        let name = |op: Op| self.local(&op, needed, locals);
        let sin = name(Op::Sin(angle));
        let cos = name(Op::Cos(angle));
        let angle = self.bound(angle, locals, Binding::Atom);
        quote!(let (#sin, #cos) = #angle.sin_cos();)
    }

    /// Returns the name of a value, or `_` if it is not needed.
    pub(super) fn local(&self, op: &Op, needed: &[ValueId], locals: &Locals) -> TokenStream {
        let found = needed.iter().find(|id| self.op(**id) == op);
        match found.and_then(|id| locals.names.get(id)) {
            Some(name) => {
                let name = ident(name);
                quote!(#name)
            }
            None => quote!(_),
        }
    }
}
