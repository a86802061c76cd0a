//! Names of the local values of an emitted function.

use super::Emission;
use crate::program::{Argument, Entry, Fused, Op, ValueId, spelling};
use std::collections::{BTreeMap, BTreeSet};

/// Longer generated names say less than a number.
const LONGEST_NAME: usize = 48;

/// Operations inside one another in one expression, at most: readers tire, and
/// the compiler recurses.
const DEEPEST: usize = 16;

/// What the accelerations of long trees call other things than values.
const RESERVED: [&str; 2] = ["turns", "alpha"];

/// Which values of a function get a `let`, and what they are called.
pub(super) struct Locals {
    pub(super) names: BTreeMap<ValueId, String>,
    /// Sums that are written with a product in them.
    pub(super) fused: BTreeMap<ValueId, Fused>,
    used: BTreeSet<String>,
    /// The number after the last one given to each wanted name; no lower one is
    /// free.
    numbers: BTreeMap<String, usize>,
}

impl Emission<'_> {
    /// Names every input, every named value and every value used more than
    /// once; all others are written in place, and so are products that are fused
    /// with their sums.
    pub(super) fn locals(&self, entry: &Entry, needed: &[ValueId]) -> Locals {
        let fused = self.program.fused(entry);
        let products: BTreeSet<ValueId> = fused.values().map(|sum| sum.product).collect();
        let mut uses: BTreeMap<ValueId, usize> = BTreeMap::new();
        for &id in needed.iter().filter(|id| !products.contains(id)) {
            for operand in self.op(id).operands() {
                let factors = products.contains(&operand).then(|| self.op(operand));
                let factors: Vec<ValueId> = factors.into_iter().flat_map(Op::operands).collect();
                let written = if factors.is_empty() {
                    vec![operand]
                } else {
                    factors
                };
                for value in written {
                    *uses.entry(value).or_default() += 1;
                }
            }
        }
        for &output in &entry.outputs {
            *uses.entry(output).or_default() += 1;
        }
        let mut locals = Locals {
            names: BTreeMap::new(),
            fused,
            used: entry
                .arguments
                .iter()
                .map(|argument| argument.name().to_owned())
                .chain(RESERVED.map(str::to_owned))
                .collect(),
            numbers: BTreeMap::new(),
        };
        let mut depths: BTreeMap<ValueId, usize> = BTreeMap::new();
        for &id in needed {
            let definition = self.program.definition(id);
            let inside = definition
                .op
                .operands()
                .filter_map(|operand| depths.get(&operand));
            let depth = 1 + inside.copied().max().unwrap_or(0);
            if products.contains(&id) {
                depths.insert(id, depth);
                continue;
            }
            let several = uses.get(&id).is_some_and(|count| *count > 1) || depth > DEEPEST;
            let wanted = match (&definition.op, &definition.name) {
                (Op::Constant(_), _) => continue,
                // The argument itself, of which there is one.
                (Op::Input(Argument::Time, _), _) => {
                    locals.names.insert(id, Argument::Time.name().to_owned());
                    continue;
                }
                (Op::Input(argument, index), _) => Some(self.input_name(*argument, *index)),
                (Op::Number(_), _) => None,
                (Op::Sin(_) | Op::Cos(_), Some(name)) => Some(name.clone()),
                (_, Some(name)) => Some(name.clone()),
                (_, None) if several => {
                    let hint = definition.hint.clone();
                    hint.or_else(|| self.describe(id, &locals))
                }
                (_, None) => {
                    depths.insert(id, depth);
                    continue;
                }
            };
            let number = matches!(definition.op, Op::Number(_));
            if number && !several {
                continue;
            }
            let wanted = match wanted {
                Some(name) => name,
                None if number => self.describe(id, &locals).unwrap_or_default(),
                None => String::new(),
            };
            locals.claim(id, wanted);
        }
        locals
    }

    /// `theta_parent`, `omega_m`, `p_d`.
    pub(super) fn input_name(&self, argument: Argument, index: usize) -> String {
        let mechanics = self.mechanics;
        let symbols = match argument {
            Argument::Time => return argument.name().to_owned(),
            Argument::Theta | Argument::Absolute => &mechanics.absolute.coordinates,
            Argument::Omega => &mechanics.absolute.velocities,
            Argument::AbsoluteMomenta => &mechanics.absolute.momenta,
            Argument::Coordinates | Argument::Symmetric => match &mechanics.symmetric {
                Some(frame) => &frame.coordinates,
                None => &mechanics.absolute.coordinates,
            },
            Argument::Rates => match &mechanics.symmetric {
                Some(frame) => &frame.velocities,
                None => &mechanics.absolute.velocities,
            },
            Argument::Momenta => match &mechanics.symmetric {
                Some(frame) => &frame.momenta,
                None => &mechanics.absolute.momenta,
            },
            argument => {
                let strips = self.program.strips.as_ref();
                let name = strips.map(|strips| strips.element(argument, index));
                return name.unwrap_or_default().to_owned();
            }
        };
        let code = &mechanics.symbols.get(symbols[index]).code;
        match argument {
            // The transform serves angles and velocities alike.
            Argument::Absolute | Argument::Symmetric => code.replacen("theta_", "value_", 1),
            _ => code.clone(),
        }
    }

    /// A name that says how the value is formed, if its operands have names.
    pub(super) fn describe(&self, id: ValueId, locals: &Locals) -> Option<String> {
        let name = |operand: ValueId| match self.op(operand) {
            Op::Constant(constant) => Some(self.program.setup.get(*constant).name.clone()),
            _ => locals.names.get(&operand).cloned(),
        };
        let described = match self.op(id) {
            Op::Number(number) => spelling::number(number),
            Op::Neg(a) => format!("minus_{}", name(*a)?),
            Op::Add(a, b) => format!("{}_plus_{}", name(*a)?, name(*b)?),
            Op::Sub(a, b) => format!("{}_minus_{}", name(*a)?, name(*b)?),
            Op::Mul(a, b) if a == b => format!("{}_squared", name(*a)?),
            Op::Mul(a, b) => format!("{}_times_{}", name(*a)?, name(*b)?),
            Op::Div(a, b) => format!("{}_over_{}", name(*a)?, name(*b)?),
            Op::Sqrt(a) => format!("sqrt_{}", name(*a)?),
            Op::Sin(a) => format!("sin_{}", name(*a)?),
            Op::Cos(a) => format!("cos_{}", name(*a)?),
            Op::Input(..) | Op::Constant(_) => return None,
        };
        (described.len() <= LONGEST_NAME).then_some(described)
    }
}

impl Locals {
    pub(super) fn claim(&mut self, id: ValueId, wanted: String) {
        let name = self.fresh(wanted);
        self.names.insert(id, name);
    }

    /// A name that no local has, `wanted` or `wanted` with a number.
    pub(super) fn fresh(&mut self, wanted: String) -> String {
        let wanted = if wanted.is_empty() {
            "shared".to_owned()
        } else {
            wanted
        };
        let mut name = wanted.clone();
        while !self.used.insert(name.clone()) {
            let number = self.numbers.entry(wanted.clone()).or_insert(2);
            name = format!("{wanted}_{number}");
            *number += 1;
        }
        name
    }
}
