//! Splits a long function into parts, and determines the values that the parts pass to each other.

use super::{FunctionPart, FunctionParts, MOST_IN_PART};
use crate::emit::Emission;
use crate::emit::lines::Line;
use crate::emit::names::Locals;
use crate::functions::Argument;
use crate::program::{Op, ValueId};
use std::collections::BTreeSet;

impl Emission<'_> {
    fn is_number(&self, line: &Line) -> bool {
        let number = |id: &ValueId| matches!(self.op(*id), Op::Number(_));
        !line.defines.is_empty() && line.defines.iter().all(number)
    }

    fn is_input(&self, id: ValueId) -> bool {
        matches!(self.op(id), Op::Input(..))
    }

    /// Splits the lines of a function into parts. Lines that define numeric constants are repeated
    /// in every part that uses them.
    pub(in crate::emit) fn parts(
        &self,
        outputs: &[ValueId],
        lines: &[Line],
        locals: &Locals,
    ) -> FunctionParts {
        let (numbers, lines): (Vec<&Line>, Vec<&Line>) =
            lines.iter().partition(|line| self.is_number(line));
        let outputs: BTreeSet<ValueId> = outputs.iter().copied().collect();
        let mut wanted = outputs.clone();
        let mut parts = Vec::new();
        for (number, lines) in self.pieces(&lines, locals).into_iter().enumerate().rev() {
            let part = self.part(number + 1, lines, &numbers, &mut wanted, locals);
            parts.push(part);
        }
        parts.reverse();
        FunctionParts::new(parts, &outputs)
    }

    /// Splits lines into pieces with few lines and few values from earlier pieces.
    fn pieces<'l>(&self, lines: &'l [&'l Line], locals: &Locals) -> Vec<&'l [&'l Line]> {
        let mut pieces = Vec::new();
        let (mut start, mut height) = (0, 0);
        let mut seen = BTreeSet::new();
        for (index, line) in lines.iter().enumerate() {
            let mut touched: BTreeSet<ValueId> = line.defines.iter().copied().collect();
            for &id in &line.reads {
                self.named_operands(id, locals, &mut touched);
            }
            let own = line.height;
            height += own;
            seen.extend(&touched);
            // Each value counts once, whether it comes from outside or is computed here.
            if height + seen.len() > MOST_IN_PART && index > start {
                pieces.push(&lines[start..index]);
                (start, height, seen) = (index, own, touched);
            }
        }
        pieces.push(&lines[start..]);
        pieces
    }

    /// Converts a piece to a part. `wanted` holds the values that later parts and the outputs read;
    /// the values that this part reads are added.
    fn part(
        &self,
        number: usize,
        lines: &[&Line],
        numbers: &[&Line],
        wanted: &mut BTreeSet<ValueId>,
        locals: &Locals,
    ) -> FunctionPart {
        let mut read = BTreeSet::new();
        for &id in lines.iter().flat_map(|line| &line.reads) {
            self.named_operands(id, locals, &mut read);
        }
        let own_numbers = numbers.iter().copied();
        let own_numbers: Vec<&Line> = own_numbers
            .filter(|line| line.defines.iter().any(|id| read.contains(id)))
            .collect();
        let whole: Vec<Argument> = lines.iter().filter_map(|line| line.whole).collect();
        let numbers: BTreeSet<ValueId> = own_numbers
            .iter()
            .flat_map(|line| line.defines.iter().copied())
            .collect();
        let defined: BTreeSet<ValueId> = lines
            .iter()
            .flat_map(|line| line.defines.iter().copied())
            .collect();
        let returns: Vec<ValueId> = wanted.intersection(&defined).copied().collect();
        for id in &returns {
            wanted.remove(id);
        }
        let outside = read
            .iter()
            .copied()
            .filter(|id| !defined.contains(id) && !numbers.contains(id));
        let (inputs, receives): (Vec<ValueId>, Vec<ValueId>) =
            outside.partition(|&id| self.is_input(id));
        wanted.extend(&receives);
        let mut arguments: Vec<Argument> = Vec::new();
        let of_inputs = inputs.iter().filter_map(|&id| match *self.op(id) {
            Op::Input(argument, _) => Some(argument),
            _ => None,
        });
        for argument in of_inputs.chain(whole) {
            if !arguments.contains(&argument) {
                arguments.push(argument);
            }
        }
        arguments.sort_unstable();
        let lines = own_numbers.iter().chain(lines);
        FunctionPart {
            number,
            arguments,
            inputs,
            receives,
            returns,
            lines: lines.map(|line| line.tokens.clone()).collect(),
        }
    }
}
