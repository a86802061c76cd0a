//! Sinking: a different order of lines in the accelerations of trees with more values than vector
//! registers. Angles and velocities are read, sines and cosines computed, and results written one
//! by one when they are needed, subtree after subtree. A value that is read early would have to be
//! stored until its use, as would the values that depend on it alone.

use super::Emission;
use super::lines::{Line, Written, is_whole};
use super::names::Locals;
use super::parts::{FunctionPart, SHARED};
use super::tokens::{Binding, ident};
use crate::functions::{Argument, Purpose};
use crate::program::{Entry, Op, Pass, ValueId};
use proc_macro2::{Literal, TokenStream};
use quote::quote;
use std::collections::{BTreeMap, BTreeSet};

/// Number of simultaneously needed values from which on sinking makes the code faster: twice the
/// number of vector registers of current processors. In shorter functions the evaluation of one
/// state would lose more time than a batch gains.
const WAITING: usize = 64;

/// Number of angles whose sines and cosines are computed together, so that the processor works on
/// the others while it waits for the result of one operation.
const TOGETHER: usize = 4;

/// Builder of the lines of `evaluate`.
struct Sinking<'e, 'p> {
    emission: &'e Emission<'p>,
    entry: &'e Entry,
    needed: &'e [ValueId],
    locals: &'e Locals,
    /// Groups of angles whose sines and cosines are computed together.
    groups: Vec<Vec<ValueId>>,
    /// Lines that only read inputs, by the values that they define; they are emitted when these
    /// values are needed.
    early: BTreeMap<ValueId, Line>,
    /// Inputs, sines and cosines that have been read.
    known: BTreeSet<ValueId>,
    /// Indices of the outputs that have been written.
    results: BTreeSet<usize>,
    written: Vec<Line>,
}

impl Emission<'_> {
    /// Returns true if the body of this function is in `evaluate`, with lines in the order in which
    /// values are needed. This is the case for accelerations whose values do not fit into
    /// registers, if the function is compiled as a whole.
    pub(super) fn is_sunk(&self, entry: &Entry, written: &Written) -> bool {
        self.program.without != Some(Pass::Order)
            && entry.purpose == Purpose::Accelerations
            && written.gathered.whole == Some(Argument::Theta)
            && is_whole(&written.lines)
            && self.program.live(entry) > WAITING
    }

    /// Emits the body of `evaluate`, if it has a separate one.
    pub(super) fn sunk(&self) -> Option<TokenStream> {
        let entry = self.entry(Purpose::Accelerations)?;
        let needed = self.program.needed(&entry.outputs);
        let written = self.written(entry, &needed);
        if !self.is_sunk(entry, &written) {
            return None;
        }
        let lines = self.sunk_lines(entry, &needed, &written);
        let links = (0..self.scene.links.len()).map(Literal::usize_unsuffixed);
        let runtime = self.runtime();
        let sin_cos =
            quote!(let sin_cos = #runtime::emitted::SinCosPairs::among([#(theta(#links)),*]););
        if !written.long {
            let lines = lines.iter().map(|line| &line.tokens);
            return Some(quote!(#sin_cos #(#lines)*));
        }
        let parts = self.parts(&[], &lines, &written.locals);
        let (shared, size) = (ident(SHARED), Literal::usize_unsuffixed(parts.size));
        let time = self.sunk_time(entry);
        let calls = parts.parts.iter().map(|part| {
            let name = part.name(entry);
            quote!(self.#name(#time &sin_cos, &theta, &omega, &mut alpha, &mut #shared);)
        });
        Some(quote! {
            #sin_cos
            let mut #shared = [T::from_f64(0.0); #size];
            #(#calls)*
        })
    }

    /// Emits the body of the function itself if it calls `evaluate`.
    pub(super) fn through_evaluate(&self, entry: &Entry) -> TokenStream {
        let (runtime, links) = (self.runtime(), self.links());
        let time = match entry.arguments.contains(&Argument::Time) {
            true => quote!(time),
            false => quote!(T::from_f64(0.0)),
        };
        quote! {
            let mut alpha = [T::from_f64(0.0); #links];
            #runtime::Pendulum::evaluate(
                self,
                #time,
                |link| theta[link],
                |link| omega[link],
                |link, value| alpha[link] = value,
            );
            alpha
        }
    }

    /// Emits the parts of a long `evaluate` as functions.
    pub(super) fn sunk_parts(
        &self,
        entry: &Entry,
        needed: &[ValueId],
        written: &Written,
    ) -> TokenStream {
        if !written.long {
            return TokenStream::new();
        }
        let (runtime, links, locals) = (self.runtime(), self.links(), &written.locals);
        let parts = self.parts(&[], &self.sunk_lines(entry, needed, written), locals);
        let (shared, size) = (ident(SHARED), Literal::usize_unsuffixed(parts.size));
        let time = entry.arguments.contains(&Argument::Time);
        let time = time.then(|| quote!(time: T,));
        let functions = parts.parts.iter().map(|part| {
            let name = part.name(entry);
            let docs = format!(
                " Part {} of [`{1}`](Self::{1}), on the values that its parts share.",
                part.number, entry.name
            );
            let body = self.part_lines(part, &parts, locals, self.read_again(part, locals));
            quote! {
                #[doc = #docs]
                #[inline(always)]
                #[allow(unused_variables)]
                fn #name(
                    &self,
                    #time
                    sin_cos: &#runtime::emitted::SinCosPairs<T, #links>,
                    theta: &impl ::core::ops::Fn(usize) -> T,
                    omega: &impl ::core::ops::Fn(usize) -> T,
                    alpha: &mut impl ::core::ops::FnMut(usize, T),
                    #shared: &mut [T; #size],
                ) {
                    #body
                }
            }
        });
        functions.collect()
    }

    fn sunk_time(&self, entry: &Entry) -> Option<TokenStream> {
        let timed = entry.arguments.contains(&Argument::Time);
        timed.then(|| quote!(time,))
    }

    /// Returns the inputs that an earlier part has read too.
    fn read_again(&self, part: &FunctionPart, locals: &Locals) -> Vec<TokenStream> {
        let inputs = part.inputs.iter();
        inputs.filter_map(|&id| self.input(id, locals)).collect()
    }

    /// Returns `let omega_a = omega(0);`.
    fn input(&self, id: ValueId, locals: &Locals) -> Option<TokenStream> {
        match *self.op(id) {
            Op::Input(argument, index) if argument != Argument::Time => {
                let (name, argument) = (ident(&locals.names[&id]), ident(argument.name()));
                let link = Literal::usize_unsuffixed(index);
                Some(quote!(let #name = #argument(#link);))
            }
            _ => None,
        }
    }

    fn sunk_lines(&self, entry: &Entry, needed: &[ValueId], written: &Written) -> Vec<Line> {
        let locals = &written.locals;
        // The first line computes all sines and cosines.
        let lines = written.lines.get(1..).unwrap_or_default();
        let mut sinking = Sinking {
            emission: self,
            entry,
            needed,
            locals,
            groups: Vec::new(),
            early: BTreeMap::new(),
            known: BTreeSet::new(),
            results: BTreeSet::new(),
            written: Vec::new(),
        };
        let mut angles: Vec<ValueId> = Vec::new();
        for id in lines.iter().flat_map(|line| sinking.read(&line.reads)) {
            angles.extend(sinking.angle(id).filter(|angle| !angles.contains(angle)));
        }
        sinking.groups = angles.chunks(TOGETHER).map(<[_]>::to_vec).collect();
        for line in lines {
            if sinking.is_early(line) {
                let defined = line.defines.iter().map(|&id| (id, line.clone()));
                sinking.early.extend(defined);
            } else {
                sinking.line(line);
            }
        }
        sinking.rest();
        sinking.written
    }
}

impl Sinking<'_, '_> {
    /// Returns the named values that the expressions of `ids` read.
    fn read(&self, ids: &[ValueId]) -> BTreeSet<ValueId> {
        let mut read = BTreeSet::new();
        for &id in ids {
            self.emission.named_operands(id, self.locals, &mut read);
        }
        read
    }

    /// Returns the angle of a sine or cosine.
    fn angle(&self, id: ValueId) -> Option<ValueId> {
        match *self.emission.op(id) {
            Op::Sin(angle) | Op::Cos(angle) => match *self.emission.op(angle) {
                Op::Input(Argument::Theta, _) => Some(angle),
                _ => None,
            },
            _ => None,
        }
    }

    /// Returns true if a line reads inputs only, directly or through other such lines.
    fn is_early(&self, line: &Line) -> bool {
        let input = |id: &ValueId| matches!(self.emission.op(*id), Op::Input(..));
        let known = |id: &ValueId| input(id) || self.early.contains_key(id);
        !line.defines.is_empty() && self.read(&line.reads).iter().all(known)
    }

    /// Emits the results that are not defined by a line.
    fn line(&mut self, line: &Line) {
        self.reads(&line.reads);
        self.written.push(line.clone());
        for (index, output) in self.entry.outputs.iter().enumerate() {
            if line.defines.contains(output) {
                self.result(index, *output);
            }
        }
    }

    /// Emits the results that no line defines.
    fn rest(&mut self) {
        for (index, &output) in self.entry.outputs.iter().enumerate() {
            if !self.results.contains(&index) {
                self.reads(&[output]);
                self.result(index, output);
            }
        }
    }

    fn result(&mut self, index: usize, output: ValueId) {
        let value = self.emission.bound(output, self.locals, Binding::Sum);
        let link = Literal::usize_unsuffixed(index);
        self.results.insert(index);
        let tokens = quote!(alpha(#link, #value););
        self.written
            .push(Line::new(Vec::new(), vec![output], tokens));
    }

    /// Reads the inputs, emits the waiting lines and computes the sines and cosines that these
    /// values need and that have not been read before.
    fn reads(&mut self, ids: &[ValueId]) {
        for id in self.read(ids) {
            if self.known.contains(&id) {
                continue;
            }
            if let Some(line) = self.early.get(&id).cloned() {
                self.known.extend(&line.defines);
                self.line(&line);
            } else if let Some(angle) = self.angle(id) {
                self.turn(angle);
            } else if let Some(tokens) = self.emission.input(id, self.locals) {
                self.known.insert(id);
                self.written.push(Line::new(vec![id], Vec::new(), tokens));
            }
        }
    }

    /// Emits `let ([sin_a, sin_b], [cos_a, cos_b]) = sin_cos.of([0, 1], [theta(0), theta(1)]);`.
    fn turn(&mut self, angle: ValueId) {
        let group = self.groups.iter().find(|group| group.contains(&angle));
        let group = group.map_or_else(Vec::new, Vec::clone);
        let names = |op: fn(ValueId) -> Op| -> Vec<TokenStream> {
            let ops = group.iter().map(|&angle| op(angle));
            ops.map(|op| self.emission.local(&op, self.needed, self.locals))
                .collect()
        };
        let (sines, cosines) = (names(Op::Sin), names(Op::Cos));
        let links = group.iter().map(|&angle| match *self.emission.op(angle) {
            Op::Input(_, index) => Literal::usize_unsuffixed(index),
            _ => unreachable!("angles of groups are inputs"),
        });
        let links: Vec<Literal> = links.collect();
        let defined = self.needed.iter().copied();
        let defined: Vec<ValueId> = defined
            .filter(|&id| self.angle(id).is_some_and(|angle| group.contains(&angle)))
            .collect();
        self.known.extend(&defined);
        let tokens = quote! {
            let ([#(#sines),*], [#(#cosines),*]) =
                sin_cos.of([#(#links),*], [#(theta(#links)),*]);
        };
        self.written.push(Line::new(defined, Vec::new(), tokens));
    }
}
