//! One function for each entry point.

use super::Emission;
use super::names::Locals;
use super::parts::{Line, MOST_LINES};
use crate::exact::Rational;
use crate::program::{Argument, Entry, Fused, Op, Purpose, Shape, ValueId};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

pub(super) fn ident(name: &str) -> Ident {
    Ident::new(name, Span::call_site())
}

/// How tightly a written expression binds.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
pub(super) enum Binding {
    Sum,
    Product,
    Prefix,
    Atom,
}

impl Emission<'_> {
    pub(super) fn function(&self, entry: &Entry) -> TokenStream {
        let docs = self.entry_docs(entry);
        let name = ident(&entry.name);
        let arguments = entry.arguments.iter().map(|&argument| {
            let name = ident(argument.name());
            if argument == Argument::Time {
                return quote!(#name: T);
            }
            let size = self.argument_size(argument);
            quote!(#name: &[T; #size])
        });
        let result = self.result_type(entry);
        let needed = self.program.needed(&entry.outputs);
        let locals = self.locals(entry, &needed);
        let body = self.body(entry, &needed, &locals);
        let parts = self.part_functions(entry, &needed, &locals);
        // A batch compiles the accelerations for wider registers than the rest
        // of the build uses, which only inlining allows.
        let inline = if entry.purpose == Purpose::Accelerations {
            quote!(#[inline(always)])
        } else {
            quote!(#[inline])
        };
        quote! {
            #docs
            #inline
            pub fn #name(&self, #(#arguments),*) -> #result {
                #body
            }

            #parts
        }
    }

    /// Links and coordinates are equally many.
    pub(super) fn argument_size(&self, _argument: Argument) -> Literal {
        Literal::usize_unsuffixed(self.scene.links.len())
    }

    pub(super) fn result_type(&self, entry: &Entry) -> TokenStream {
        let length = Literal::usize_unsuffixed(entry.outputs.len());
        let runtime = self.runtime();
        match entry.shape {
            Shape::Scalar => quote!(T),
            Shape::Vector => quote!([T; #length]),
            Shape::Pair => {
                let half = Literal::usize_unsuffixed(entry.outputs.len() / 2);
                quote!([[T; #half]; 2])
            }
            Shape::Matrix(size) => {
                let size = Literal::usize_unsuffixed(size);
                quote!([[T; #size]; #size])
            }
            Shape::Transfer => quote!(#runtime::Transfer<T>),
            Shape::Transfers(count) => {
                let count = Literal::usize_unsuffixed(count);
                quote!([#runtime::Transfer<T>; #count])
            }
            Shape::Budget(count) => {
                let count = Literal::usize_unsuffixed(count);
                quote!(#runtime::Budget<T, #count>)
            }
        }
    }

    fn body(&self, entry: &Entry, needed: &[ValueId], locals: &Locals) -> TokenStream {
        let (gathered, whole) = self.gathered(entry, needed);
        let lines = self.lines(&gathered, whole, needed, locals);
        // The parts of a long function are handed numbers, not arrays.
        let long = lines.len() > MOST_LINES;
        let whole = whole.filter(|_| !long);
        let read = self.read(entry, needed, whole.is_some().then_some(&gathered));
        let inputs = entry
            .arguments
            .iter()
            .filter(|argument| whole != Some(**argument) || self.reads(**argument, &read))
            .map(|&argument| self.take_apart(argument, &read, locals));
        let lines: Vec<TokenStream> = if long {
            let lines = self.lines(&gathered, None, needed, locals);
            let parts = self.parts(entry, &lines, locals);
            let numbers = self.numbers_of_outputs(entry, &lines, locals);
            let calls = parts.calls(entry, &self.names_of_outputs(entry, locals));
            numbers.into_iter().chain(calls).collect()
        } else {
            lines.into_iter().map(|line| line.tokens).collect()
        };
        let outputs = self.outputs(entry, locals);
        quote! {
            #(#inputs)*
            #(#lines)*
            #outputs
        }
    }

    /// The `let` lines of a function; first the sines and cosines that are
    /// asked for at once, of an argument as a `whole` or of single angles.
    pub(super) fn lines(
        &self,
        gathered: &[ValueId],
        whole: Option<Argument>,
        needed: &[ValueId],
        locals: &Locals,
    ) -> Vec<Line> {
        let mut lines = Vec::new();
        let mut paired = gathered.to_vec();
        if !gathered.is_empty() {
            let of_gathered = needed.iter().copied().filter(|&id| {
                matches!(*self.op(id), Op::Sin(angle) | Op::Cos(angle) if gathered.contains(&angle))
            });
            lines.push(Line {
                defines: of_gathered.collect(),
                reads: gathered.to_vec(),
                tokens: self.sin_cos_each(gathered, whole, needed, locals),
            });
        }
        for &id in needed {
            let angle = match *self.op(id) {
                Op::Sin(angle) | Op::Cos(angle) => angle,
                Op::Input(..) | Op::Constant(_) => continue,
                _ => {
                    if let Some(name) = locals.names.get(&id) {
                        let name = ident(name);
                        let (value, _) = self.definition(id, locals);
                        lines.push(Line {
                            defines: vec![id],
                            reads: self.program.definition(id).op.operands().collect(),
                            tokens: quote!(let #name = #value;),
                        });
                    }
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
                lines.push(Line {
                    defines: both.collect(),
                    reads: vec![angle],
                    tokens: self.sin_cos(angle, needed, locals),
                });
            }
        }
        lines
    }

    /// `let [theta_parent, _, theta_child_2] = *theta;`, the elements that are
    /// `read`.
    pub(super) fn take_apart(
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
        let mut any = false;
        let elements: Vec<TokenStream> = (0..self.scene.links.len())
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
        if any {
            quote!(let [#(#elements),*] = *#array;)
        } else {
            quote!(let _ = #array;)
        }
    }

    /// `let (sin_parent, cos_parent) = theta_parent.sin_cos();`
    fn sin_cos(&self, angle: ValueId, needed: &[ValueId], locals: &Locals) -> TokenStream {
        let name = |op: Op| self.local(&op, needed, locals);
        let sin = name(Op::Sin(angle));
        let cos = name(Op::Cos(angle));
        let angle = self.bound(angle, locals, Binding::Atom);
        quote!(let (#sin, #cos) = #angle.sin_cos();)
    }

    /// The name of a value where it is needed, `_` where it is not.
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

    fn outputs(&self, entry: &Entry, locals: &Locals) -> TokenStream {
        let values: Vec<TokenStream> = entry
            .outputs
            .iter()
            .map(|&id| self.bound(id, locals, Binding::Sum))
            .collect();
        let runtime = self.runtime();
        match entry.shape {
            Shape::Scalar => quote!(#(#values)*),
            Shape::Vector => quote!([#(#values),*]),
            Shape::Pair => {
                let (first, second) = values.split_at(values.len() / 2);
                quote!([[#(#first),*], [#(#second),*]])
            }
            Shape::Matrix(size) => {
                let rows = values.chunks(size).map(|row| quote!([#(#row),*]));
                quote!([#(#rows),*])
            }
            Shape::Transfer => {
                let (kinetic, potential) = (&values[0], &values[1]);
                quote!(#runtime::Transfer { kinetic: #kinetic, potential: #potential })
            }
            Shape::Transfers(_) => {
                let transfers = values.chunks(2).map(|parts| {
                    let (kinetic, potential) = (&parts[0], &parts[1]);
                    quote!(#runtime::Transfer { kinetic: #kinetic, potential: #potential })
                });
                quote!([#(#transfers),*])
            }
            Shape::Budget(count) => {
                let (energies, rest) = values.split_at(count);
                let (transfers, powers) = rest.split_at(count);
                quote! {
                    #runtime::Budget {
                        energies: [#(#energies),*],
                        transfers: [#(#transfers),*],
                        powers: [#(#powers),*],
                    }
                }
            }
        }
    }

    /// A value where it is used: its name, or its definition in parentheses if
    /// that binds less tightly than its place asks for.
    pub(super) fn bound(&self, id: ValueId, locals: &Locals, place: Binding) -> TokenStream {
        if let Some(name) = locals.names.get(&id) {
            let name = ident(name);
            return quote!(#name);
        }
        let (value, binding) = self.definition(id, locals);
        if binding < place {
            quote!((#value))
        } else {
            value
        }
    }

    /// `x.mul_add(y, z)`, which is x y + z.
    fn fused(&self, fused: &Fused, locals: &Locals) -> TokenStream {
        let Op::Mul(x, y) = *self.op(fused.product) else {
            unreachable!("products alone are fused");
        };
        let x = if fused.minus_product {
            let x = self.bound(x, locals, Binding::Atom);
            quote!((-#x))
        } else {
            self.bound(x, locals, Binding::Atom)
        };
        let y = self.bound(y, locals, Binding::Sum);
        let z = if fused.minus_addend {
            let z = self.bound(fused.addend, locals, Binding::Atom);
            quote!(-#z)
        } else {
            self.bound(fused.addend, locals, Binding::Sum)
        };
        quote!(#x.mul_add(#y, #z))
    }

    /// A value's definition. Sums and products associate to the left, so that
    /// only right operands need parentheses.
    fn definition(&self, id: ValueId, locals: &Locals) -> (TokenStream, Binding) {
        if let Some(fused) = locals.fused.get(&id) {
            return (self.fused(fused, locals), Binding::Atom);
        }
        let at = |id: ValueId, place: Binding| self.bound(id, locals, place);
        match *self.op(id) {
            Op::Constant(constant) => {
                let field = self.field(constant);
                (quote!(self.#field), Binding::Atom)
            }
            Op::Number(ref number) => (number_tokens(number), Binding::Atom),
            Op::Neg(a) => {
                let a = at(a, Binding::Atom);
                (quote!(-#a), Binding::Prefix)
            }
            Op::Sqrt(a) => {
                let a = at(a, Binding::Atom);
                (quote!(#a.sqrt()), Binding::Atom)
            }
            Op::Add(a, b) => {
                let (a, b) = (at(a, Binding::Sum), at(b, Binding::Product));
                (quote!(#a + #b), Binding::Sum)
            }
            Op::Sub(a, b) => {
                let (a, b) = (at(a, Binding::Sum), at(b, Binding::Product));
                (quote!(#a - #b), Binding::Sum)
            }
            Op::Mul(a, b) => {
                let (a, b) = (at(a, Binding::Product), at(b, Binding::Prefix));
                (quote!(#a * #b), Binding::Product)
            }
            Op::Div(a, b) => {
                let (a, b) = (at(a, Binding::Product), at(b, Binding::Prefix));
                (quote!(#a / #b), Binding::Product)
            }
            Op::Input(..) | Op::Sin(_) | Op::Cos(_) => {
                unreachable!("inputs, sines and cosines are always named")
            }
        }
    }
}

/// `T::from_f64(2.0)`.
pub(super) fn number_tokens(number: &Rational) -> TokenStream {
    let value = number.to_f64();
    let size = Literal::f64_unsuffixed(value.abs());
    if value.is_sign_negative() {
        quote!(T::from_f64(-#size))
    } else {
        quote!(T::from_f64(#size))
    }
}
