//! Common factors: a b + a c becomes a (b + c), wherever that saves operations.
//!
//! # Rule
//! A sum is what additions and subtractions make of values that nothing else uses, down
//! to the first value that is named, used elsewhere, or no sum. A term of it is a product
//! as far as that goes by the same rule. The factor whose extraction saves
//! most operations is taken out of the terms that have it, and so on with what
//! stands in its place and with what is left, until nothing is saved. Among equals
//! the value formed last is taken. Cofactors are shared like all other
//! values, so that b + c is formed once for two sums.
//!
//! # When it is valid
//! Taken out, a factor multiplies each of its terms as before, only later: no term is
//! rounded more often than it has factors, less one, and the sum has terms, less one. The
//! bound of the error of a sum, that many roundings of the sum of the sizes of its
//! terms, stays; where a factor is taken out of two terms that nearly cancel, a b − a c,
//! one product is rounded instead of two. But other terms may be added to each other
//! first. A difference of two products is therefore one term, and is opened only for a
//! factor that both have: it is zero where they are equal, before and after.
//!
//! Where products are fused with sums (accelerations), a product of two
//! values costs nothing in a sum; the saving is counted accordingly.
//!
//! # Cost
//! Each step counts the factors of a sum, F of K terms, so that a sum takes O(K F log F).

use super::builder::Builder;
use super::uses::Uses;
use super::{Definition, Op, Program, Purpose, ValueId};
use std::collections::BTreeMap;

/// A product with its sign, in values of the program in the making.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Term {
    negative: bool,
    factors: Vec<ValueId>,
}

/// The program with common factors taken out; the same program, to the number of each
/// value, where there are none.
pub(super) fn common_factors(program: Program) -> Program {
    let uses = Uses::new(&program);
    let mut pass = Factoring {
        program: &program,
        uses: &uses,
        builder: Builder::on_constants_of(&program),
        values: Vec::with_capacity(program.definitions.len()),
        saved: 0,
    };
    for index in 0..program.definitions.len() {
        let id = ValueId(index as u32);
        let value = pass.value(id);
        pass.values.push(value);
    }
    if pass.saved == 0 {
        return program;
    }
    let Factoring {
        builder, values, ..
    } = pass;
    let mut entries = program.entries.clone();
    for output in entries.iter_mut().flat_map(|entry| &mut entry.outputs) {
        *output = values[output.0 as usize];
    }
    builder.finish(entries, program.choice).without_dead_code()
}

struct Factoring<'p> {
    program: &'p Program,
    uses: &'p Uses,
    builder: Builder,
    /// What has become of the values of the program.
    values: Vec<ValueId>,
    saved: usize,
}

impl Factoring<'_> {
    fn value(&mut self, id: ValueId) -> ValueId {
        let Definition { op, name, hint } = self.program.definition(id);
        let value = match self.factored(id) {
            Some(value) => value,
            None => {
                let op = op.with_operands(|operand| self.values[operand.0 as usize]);
                self.builder.record(op)
            }
        };
        if let Some(name) = name {
            self.builder.name(value, name);
        }
        if let Some(hint) = hint {
            self.builder.hint(value, hint);
        }
        value
    }

    /// The value of a sum with factors taken out, if that saves anything.
    fn factored(&mut self, id: ValueId) -> Option<ValueId> {
        if !self.is_sum(id) || self.uses.is_dead(id) || self.is_inside(id) {
            return None;
        }
        let mut terms = Vec::new();
        let in_differences = self.terms(id, false, &mut terms);
        let fused = self
            .uses
            .serves(id, |purpose| purpose == Purpose::Accelerations);
        let saved = in_differences + self.extract(&mut terms, fused);
        if saved == 0 {
            return None;
        }
        self.saved += saved;
        Some(self.sum(&terms))
    }

    fn is_sum(&self, id: ValueId) -> bool {
        matches!(self.program.definition(id).op, Op::Add(..) | Op::Sub(..))
    }

    /// Whether a value is nothing but a part of each value that uses it.
    fn is_inside(&self, id: ValueId) -> bool {
        self.program.definition(id).name.is_none()
            && self
                .uses
                .of(id)
                .iter()
                .all(|&user| self.is_sum(user) && self.uses.alone(id, user))
    }

    /// Whether a value becomes a part of the one that uses it.
    fn opens(&self, id: ValueId, user: ValueId) -> bool {
        self.program.definition(id).name.is_none() && self.uses.alone(id, user)
    }

    /// The operands of a sum, and whether the second is subtracted.
    fn operands(&self, sum: ValueId) -> (ValueId, ValueId, bool) {
        match self.program.definition(sum).op {
            Op::Add(a, b) => (a, b, false),
            Op::Sub(a, b) => (a, b, true),
            _ => unreachable!("operands are asked of sums"),
        }
    }

    /// The terms of a sum; says what is saved in the differences among them.
    fn terms(&mut self, sum: ValueId, negative: bool, terms: &mut Vec<Term>) -> usize {
        let (a, b, minus) = self.operands(sum);
        let mut saved = 0;
        for (operand, negative) in [(a, negative), (b, negative != minus)] {
            if !self.is_sum(operand) || !self.opens(operand, sum) {
                let factors = self.factors(operand, sum);
                terms.push(Term { negative, factors });
            } else if self.is_difference_of_products(operand) {
                let (term, gain) = self.difference(operand, negative);
                terms.push(term);
                saved += gain;
            } else {
                saved += self.terms(operand, negative, terms);
            }
        }
        saved
    }

    fn is_difference_of_products(&self, id: ValueId) -> bool {
        let product = |id: ValueId| matches!(self.program.definition(id).op, Op::Mul(..));
        matches!(self.program.definition(id).op, Op::Sub(a, b) if product(a) && product(b))
    }

    /// A difference of products, with the factors that both have taken out.
    fn difference(&mut self, id: ValueId, negative: bool) -> (Term, usize) {
        let (a, b, _) = self.operands(id);
        let (mut first, mut second) = (self.factors(a, id), self.factors(b, id));
        let mut factors = Vec::new();
        // Something of both products stays.
        let mut place = 0;
        while place < first.len() && first.len() > 1 && second.len() > 1 {
            match second.iter().position(|&factor| factor == first[place]) {
                Some(found) => {
                    factors.push(first.remove(place));
                    second.remove(found);
                }
                None => place += 1,
            }
        }
        if factors.is_empty() {
            let factors = vec![self.values[id.0 as usize]];
            return (Term { negative, factors }, 0);
        }
        let saved = factors.len();
        let [first, second] = [first, second].map(|factors| self.product(&factors));
        factors.push(self.builder.sub(first, second));
        (Term { negative, factors }, saved)
    }

    fn factors(&self, id: ValueId, user: ValueId) -> Vec<ValueId> {
        match self.program.definition(id).op {
            Op::Mul(a, b) if self.opens(id, user) => {
                let mut factors = self.factors(a, id);
                factors.extend(self.factors(b, id));
                factors
            }
            _ => vec![self.values[id.0 as usize]],
        }
    }

    /// Takes factors out, greatest saving first; says what is saved.
    fn extract(&mut self, terms: &mut Vec<Term>, fused: bool) -> usize {
        let mut saved = 0;
        while let Some((factor, gain)) = best(terms, fused) {
            saved += gain;
            let first = terms.iter().position(|term| term.factors.contains(&factor));
            let mut group = Vec::new();
            terms.retain_mut(|term| {
                let place = term.factors.iter().position(|&f| f == factor);
                match place {
                    Some(place) if term.factors.len() > 1 => {
                        term.factors.remove(place);
                        group.push(term.clone());
                        false
                    }
                    _ => true,
                }
            });
            let negative = group.iter().all(|term| term.negative);
            for term in &mut group {
                term.negative ^= negative;
            }
            saved += self.extract(&mut group, fused);
            let cofactor = self.sum(&group);
            let factors = vec![factor, cofactor];
            let place = first.unwrap_or(0).min(terms.len());
            terms.insert(place, Term { negative, factors });
        }
        saved
    }

    /// A sum's value; it starts with a positive term if it has one.
    fn sum(&mut self, terms: &[Term]) -> ValueId {
        let first = terms.iter().position(|term| !term.negative).unwrap_or(0);
        let negative = terms[first].negative;
        let mut sum = self.product(&terms[first].factors);
        for (index, term) in terms.iter().enumerate() {
            if index != first {
                let value = self.product(&term.factors);
                sum = match term.negative == negative {
                    true => self.builder.add(sum, value),
                    false => self.builder.sub(sum, value),
                };
            }
        }
        if negative { self.builder.neg(sum) } else { sum }
    }

    fn product(&mut self, factors: &[ValueId]) -> ValueId {
        let mut product = factors[0];
        for &factor in &factors[1..] {
            product = self.builder.mul(product, factor);
        }
        product
    }
}

/// The factor that saves most, and what it saves.
fn best(terms: &[Term], fused: bool) -> Option<(ValueId, usize)> {
    let mut gains: BTreeMap<ValueId, isize> = BTreeMap::new();
    for term in terms.iter().filter(|term| term.factors.len() > 1) {
        let mut seen: Vec<ValueId> = Vec::new();
        for &factor in &term.factors {
            if !seen.contains(&factor) {
                seen.push(factor);
                // Fused, a product of two costs nothing in its sum.
                let saving = isize::from(!fused || term.factors.len() > 2);
                *gains.entry(factor).or_insert(-1) += saving;
            }
        }
    }
    let best = gains
        .into_iter()
        .max_by_key(|&(factor, gain)| (gain, factor))?;
    (best.1 > 0).then_some((best.0, best.1 as usize))
}
