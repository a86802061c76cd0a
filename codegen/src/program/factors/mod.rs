//! Common factors: a b + a c becomes a (b + c), wherever that saves operations.
//!
//! # Rule
//! A sum is what additions and subtractions make of values that nothing else uses, down
//! to the first value that is named, used elsewhere, or no sum. A term of it is a product
//! as far as that goes by the same rule. The factor whose extraction saves
//! most operations is taken out of the terms that have it, and so on with what
//! stands in its place and with what is left, until nothing is saved. Among equals
//! the one that comes first in the sum is taken. Cofactors are shared like all other
//! values, so that b + c is formed once for two sums. Every entry point is looked at by
//! itself, so that its code does not depend on which others there are, and keeps its
//! sums unless it takes fewer operations in all.
//!
//! # When it is valid
//! Taken out, a factor multiplies each of its terms as before, only later: no term is
//! rounded more often than it has factors, less one, and the sum has terms, less one. The
//! bound of the error of a sum, that many roundings of the sum of the sizes of its
//! terms, stays; where a factor is taken out of two terms that nearly cancel, a b − a c,
//! one product is rounded instead of two. But other terms may be added to each other
//! first. A difference of two products is therefore one term, and is opened only for a
//! factor that both have: it is zero where they are equal factor by factor, before and
//! after.
//!
//! Of constants that are powers of two of one another the smaller is taken out where nothing
//! else can be, which takes as many operations and one constant less: 4 c x + 2 c y becomes
//! 2 c (2 x + y).
//!
//! Where products are fused with sums (accelerations), a product of two
//! values costs nothing in a sum; the saving is counted accordingly.
//!
//! # Cost
//! Each step counts the factors of a sum, F of K terms, so that a sum takes O(K F log F);
//! the rest is a walk over every entry point, times a logarithm.

mod extract;
#[cfg(test)]
mod tests;

use super::builder::Builder;
use super::{Definition, Entry, Op, Program, TooManyValues, ValueId};
use crate::functions::Purpose;
use extract::{Term, extract, product, sum};
use std::collections::{BTreeMap, HashMap};

/// The program with common factors taken out of the entry points that take fewer
/// operations then; the same program, to the number of each value, where none does.
pub(super) fn common_factors(program: Program) -> Program {
    let all = vec![true; program.entries.len()];
    let (factored, changed) = factored(&program, &all);
    let mut chosen = changed.clone();
    let entries = program.entries.iter().zip(&factored.entries);
    for ((before, after), chosen) in entries.zip(&mut chosen) {
        *chosen = *chosen && cost(&factored, after) < cost(&program, before);
    }
    if !chosen.contains(&true) {
        program
    } else if chosen == changed {
        factored
    } else {
        self::factored(&program, &chosen).0
    }
}

/// Operations of an entry point, where a product that is fused with a sum is none.
fn cost(program: &Program, entry: &Entry) -> usize {
    program.operations(&entry.outputs).total() - program.fused(entry).len()
}

/// The program with common factors taken out of the chosen entry points, and whether these
/// changed.
fn factored(program: &Program, chosen: &[bool]) -> (Program, Vec<bool>) {
    let mut pass = Factoring {
        program,
        builder: Builder::on_constants_of(program),
        values: Vec::with_capacity(program.definitions.len()),
    };
    let mut functions: Vec<FactoredEntry> = program
        .entries
        .iter()
        .zip(chosen)
        .map(|(entry, &chosen)| FactoredEntry::new(program, entry, chosen))
        .collect();
    // In the order of the program, whichever entry points need a value: what is not
    // changed keeps its place among the rest.
    for index in 0..program.definitions.len() {
        pass.form(ValueId(index as u32), &mut functions);
    }
    let Factoring {
        builder, values, ..
    } = pass;
    let mut entries = program.entries.clone();
    for (entry, function) in entries.iter_mut().zip(&functions) {
        for output in &mut entry.outputs {
            *output = function.value(*output, &values);
        }
    }
    let changed = functions.iter().map(|function| function.changed);
    match builder.finish(entries, program.choice) {
        Ok(mut factored) => {
            factored.strips.clone_from(&program.strips);
            (factored.without_dead_code(), changed.collect())
        }
        // One of the factors would be a value too many.
        Err(TooManyValues) => (program.clone(), vec![false; chosen.len()]),
    }
}

/// An entry point as the pass sees it.
struct FactoredEntry {
    /// The values that it needs and that are still to come, last first.
    ahead: Vec<ValueId>,
    /// The value that uses a value; none where several do, or one twice.
    user: HashMap<ValueId, Option<ValueId>>,
    /// True if factors are taken out where that saves anything.
    chosen: bool,
    /// True if some were.
    changed: bool,
    /// True if its products are fused with its sums.
    fused: bool,
    /// Values that are others here than in the entry points before it.
    own: BTreeMap<ValueId, ValueId>,
}

impl FactoredEntry {
    fn new(program: &Program, entry: &Entry, chosen: bool) -> Self {
        let mut ahead = program.needed(&entry.outputs);
        let mut user = HashMap::with_capacity(ahead.len());
        for &id in &ahead {
            for operand in program.definition(id).op.operands() {
                let found = user.entry(operand);
                found.and_modify(|user| *user = None).or_insert(Some(id));
            }
        }
        for output in &entry.outputs {
            user.remove(output);
        }
        ahead.reverse();
        Self {
            ahead,
            user,
            chosen,
            changed: false,
            fused: matches!(
                entry.purpose,
                Purpose::Accelerations
                    | Purpose::TransverseMotion(_)
                    | Purpose::Link(_)
                    | Purpose::Scale(_)
            ),
            own: BTreeMap::new(),
        }
    }

    /// The value that uses a value, where there is one alone and that once.
    fn user(&self, id: ValueId) -> Option<ValueId> {
        self.user.get(&id).copied().flatten()
    }

    /// The value that stands for an old one here; `values` holds those of the
    /// other entry points.
    fn value(&self, id: ValueId, values: &[ValueId]) -> ValueId {
        let own = self.own.get(&id).copied();
        own.unwrap_or_else(|| values[id.0 as usize])
    }
}

struct Factoring<'p> {
    program: &'p Program,
    builder: Builder,
    /// The values that stand for those of the program, in the first entry point
    /// that needs them.
    values: Vec<ValueId>,
}

impl Factoring<'_> {
    /// Forms a value for all entry points that need it.
    fn form(&mut self, id: ValueId, functions: &mut [FactoredEntry]) {
        let mut common = None;
        for function in functions {
            if function.ahead.pop_if(|next| *next == id).is_none() {
                continue;
            }
            let value = self.value(id, function);
            match common {
                None => {
                    common = Some(value);
                    self.values.push(value);
                }
                Some(common) if common == value => {}
                Some(_) => {
                    function.own.insert(id, value);
                }
            }
        }
        if common.is_none() {
            let op = &self.program.definition(id).op;
            let op = op.with_operands(|operand| self.values[operand.0 as usize]);
            let value = self.builder.record(op);
            self.values.push(value);
        }
    }

    fn value(&mut self, id: ValueId, function: &mut FactoredEntry) -> ValueId {
        let Definition { op, name, hint } = self.program.definition(id);
        let value = match self.factored(id, function) {
            Some(value) => {
                function.changed = true;
                value
            }
            None => {
                let op = op.with_operands(|operand| function.value(operand, &self.values));
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
    fn factored(&mut self, id: ValueId, function: &FactoredEntry) -> Option<ValueId> {
        let inside = |user: ValueId| self.is_sum(user) && self.opens(id, user, function);
        if !function.chosen || !self.is_sum(id) || function.user(id).is_some_and(inside) {
            return None;
        }
        let mut terms = Vec::new();
        let in_differences = self.terms(id, false, function, &mut terms);
        let saved = in_differences + extract(&mut self.builder, &mut terms, function.fused);
        if saved == 0 {
            return None;
        }
        Some(sum(&mut self.builder, &terms))
    }

    fn is_sum(&self, id: ValueId) -> bool {
        matches!(self.program.definition(id).op, Op::Add(..) | Op::Sub(..))
    }

    /// Returns true if a value becomes a part of the one that uses it.
    fn opens(&self, id: ValueId, user: ValueId, function: &FactoredEntry) -> bool {
        self.program.definition(id).name.is_none() && function.user(id) == Some(user)
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
    fn terms(
        &mut self,
        sum: ValueId,
        negative: bool,
        function: &FactoredEntry,
        terms: &mut Vec<Term>,
    ) -> usize {
        let (a, b, minus) = self.operands(sum);
        let mut saved = 0;
        for (operand, negative) in [(a, negative), (b, negative != minus)] {
            if !self.is_sum(operand) || !self.opens(operand, sum, function) {
                let factors = self.factors(operand, sum, function);
                terms.push(Term {
                    negative,
                    factors,
                    value: Some(function.value(operand, &self.values)),
                });
            } else if self.is_difference_of_products(operand) {
                let (term, gain) = self.difference(operand, negative, function);
                terms.push(term);
                saved += gain;
            } else {
                saved += self.terms(operand, negative, function, terms);
            }
        }
        saved
    }

    fn is_difference_of_products(&self, id: ValueId) -> bool {
        let product = |id: ValueId| matches!(self.program.definition(id).op, Op::Mul(..));
        matches!(self.program.definition(id).op, Op::Sub(a, b) if product(a) && product(b))
    }

    /// A difference of products, with the factors that both have taken out.
    fn difference(
        &mut self,
        id: ValueId,
        negative: bool,
        function: &FactoredEntry,
    ) -> (Term, usize) {
        let (a, b, _) = self.operands(id);
        let (mut first, mut second) =
            (self.factors(a, id, function), self.factors(b, id, function));
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
            let value = function.value(id, &self.values);
            let term = Term {
                negative,
                factors: vec![value],
                value: Some(value),
            };
            return (term, 0);
        }
        let saved = factors.len();
        let [first, second] = [first, second].map(|factors| product(&mut self.builder, &factors));
        factors.push(self.builder.sub(first, second));
        let term = Term {
            negative,
            factors,
            value: None,
        };
        (term, saved)
    }

    fn factors(&self, id: ValueId, user: ValueId, function: &FactoredEntry) -> Vec<ValueId> {
        match self.program.definition(id).op {
            Op::Mul(a, b) if self.opens(id, user, function) => {
                let mut factors = self.factors(a, id, function);
                factors.extend(self.factors(b, id, function));
                factors
            }
            _ => vec![function.value(id, &self.values)],
        }
    }
}
