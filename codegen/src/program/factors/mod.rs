//! Common factors: a b + a c becomes a (b + c), if that saves operations.
//!
//! # Rule
//! A sum consists of all additions and subtractions down to the first value that is named, used
//! elsewhere, or not a sum. By the same criterion each of its terms is a product of factors. The
//! factor whose extraction saves most operations is taken out of the terms that contain it. This
//! repeats with the new sum of cofactors and with the remaining terms, until nothing is saved;
//! among equal factors the first in the sum is taken. Cofactors are shared like all other values,
//! so that b + c is computed once for two sums. Every entry point is treated separately, so that
//! its code does not depend on the others. It keeps its original sums unless the new ones take
//! fewer operations in total.
//!
//! # When it is valid
//! An extracted factor multiplies each of its terms as before, only later: no term is rounded more
//! often than its number of factors minus one, and the sum not more often than its number of terms
//! minus one. The error bound of a sum (this many roundings, times the sum of the magnitudes of its
//! terms) is therefore unchanged; if a factor is extracted from two terms that nearly cancel, a b −
//! a c, one product is rounded instead of two. However, other terms may be added to each other
//! first. A difference of two products is therefore treated as one term, and is opened only for a
//! factor of both. It is zero if the products are equal factor by factor, before and after.
//!
//! If one constant is a power of two times another, the smaller one is extracted if nothing else
//! can be. This takes as many operations but one constant less: 4 c x + 2 c y becomes 2 c (2 x +
//! y).
//!
//! If products are fused with sums (accelerations), a product of two values costs nothing in a sum;
//! the saving is counted accordingly.
//!
//! # Cost
//! Each step counts the factors of a sum. With F factors in K terms a sum takes O(K F log F); the
//! rest is one pass over every entry point, times a logarithm.

mod extract;

use super::builder::Builder;
use super::{Definition, Entry, Op, Program, TooManyValues, ValueId};
use crate::functions::Purpose;
use extract::{Term, extract, product, sum};
use std::collections::{BTreeMap, HashMap};

/// Extracts common factors in the entry points that take fewer operations afterwards. If there are
/// none, the program is returned unchanged, including the indices of its values.
pub fn common_factors(program: Program) -> Program {
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

/// Returns the number of operations of an entry point; a product that is fused with a sum does not
/// count.
fn cost(program: &Program, entry: &Entry) -> usize {
    program.operations(&entry.outputs).total() - program.fused(entry).len()
}

/// Extracts common factors in the chosen entry points; also returns which of them changed.
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
    // In the order of the program, whichever entry points need a value, so that unchanged values
    // keep their relative order.
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
        // The extracted factors would exceed the number of values.
        Err(TooManyValues) => (program.clone(), vec![false; chosen.len()]),
    }
}

/// State of the pass for one entry point.
struct FactoredEntry {
    /// Needed values that are still to be built, in reverse order.
    ahead: Vec<ValueId>,
    /// The only value that uses a value; `None` if several do, or one uses it twice.
    user: HashMap<ValueId, Option<ValueId>>,
    /// True if factors are extracted where that saves operations.
    chosen: bool,
    /// True if a factor has been extracted.
    changed: bool,
    /// True if products are fused with sums.
    fused: bool,
    /// Replacements of values that differ from those in earlier entry points.
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

    /// Returns the value that uses a value, if it is the only one and uses it once.
    fn user(&self, id: ValueId) -> Option<ValueId> {
        self.user.get(&id).copied().flatten()
    }

    /// Returns the replacement of an old value in this entry point; `values` holds the common
    /// replacements.
    fn value(&self, id: ValueId, values: &[ValueId]) -> ValueId {
        let own = self.own.get(&id).copied();
        own.unwrap_or_else(|| values[id.0 as usize])
    }
}

struct Factoring<'p> {
    program: &'p Program,
    builder: Builder,
    /// Replacement of each value of the program, as built for the first entry point that needs it.
    values: Vec<ValueId>,
}

impl Factoring<'_> {
    /// Builds a value for all entry points that need it.
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

    /// Returns a sum with extracted factors, if that saves operations.
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

    /// Returns true if a value becomes a part of the value that uses it.
    fn opens(&self, id: ValueId, user: ValueId, function: &FactoredEntry) -> bool {
        self.program.definition(id).name.is_none() && function.user(id) == Some(user)
    }

    /// Returns the operands of a sum, and true if the second is subtracted.
    fn operands(&self, sum: ValueId) -> (ValueId, ValueId, bool) {
        match self.program.definition(sum).op {
            Op::Add(a, b) => (a, b, false),
            Op::Sub(a, b) => (a, b, true),
            _ => unreachable!("operands are asked of sums"),
        }
    }

    /// Appends the terms of a sum to `terms`. Returns the number of operations saved by common
    /// factors in differences of products.
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

    /// Returns a difference of products with their common factors extracted.
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
        // At least one factor of each product remains.
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
