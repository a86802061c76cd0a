//! Names of the local values of an emitted function.

use super::Emission;
use crate::functions::Argument;
use crate::program::{Entry, FusedSum, Op, ValueId, constant_names};
use std::collections::{BTreeMap, BTreeSet};

/// Longest generated name, in characters. A longer one would be less clear than a number.
const LONGEST_NAME: usize = 48;

/// Deepest nesting of operations in one expression. It is limited for readers, and because the
/// compiler recurses.
const DEEPEST: usize = 16;

/// Names that the accelerations of long trees use for things other than values.
const RESERVED: [&str; 2] = ["sin_cos", "alpha"];

/// Names of those values of a function that get a `let`.
pub(super) struct Locals {
    pub(super) names: BTreeMap<ValueId, String>,
    /// Sums that are written with a fused product.
    pub(super) fused: BTreeMap<ValueId, FusedSum>,
    used: BTreeSet<String>,
    /// For each wanted name, the last number appended to it; lower numbers are in use.
    numbers: BTreeMap<String, usize>,
}

impl Emission<'_> {
    /// Names every input, every value with a required name and every value that is used more than
    /// once. All others are written at their use, as are products fused with their sums.
    pub(super) fn locals(&self, entry: &Entry, needed: &[ValueId]) -> Locals {
        let fused = self.program.fused(entry);
        let products: BTreeSet<ValueId> = fused.values().map(|sum| sum.product).collect();
        let uses = self.uses(entry, needed, &products);
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
        // Depth of the values that are written at their use.
        let mut depths = vec![0; self.program.definitions.len()];
        for &id in needed {
            let definition = self.program.definition(id);
            let inside = definition.op.operands();
            let inside = inside.map(|operand| depths[operand.0 as usize]);
            let depth = 1 + inside.max().unwrap_or(0);
            if products.contains(&id) {
                depths[id.0 as usize] = depth;
                continue;
            }
            let several = uses[id.0 as usize] > 1 || depth > DEEPEST;
            let wanted = match (&definition.op, &definition.name) {
                (Op::Constant(_), _) => continue,
                // The argument itself is the only value of this kind.
                (Op::Input(Argument::Time, _), _) => {
                    locals.names.insert(id, Argument::Time.name().to_owned());
                    continue;
                }
                (Op::Input(argument, index), _) => Some(self.input_name(*argument, *index)),
                (Op::Number(_), _) => None,
                (Op::Sin(_) | Op::Cos(_), Some(name)) => Some(name.clone()),
                (_, Some(name)) => Some(name.clone()),
                (_, None) if several => Some(match &definition.hint {
                    Some(hint) => hint.clone(),
                    None => self.described(id, &locals),
                }),
                (_, None) => {
                    depths[id.0 as usize] = depth;
                    continue;
                }
            };
            let number = matches!(definition.op, Op::Number(_));
            if number && !several {
                continue;
            }
            let wanted = wanted.unwrap_or_else(|| self.described(id, &locals));
            locals.claim(id, wanted);
        }
        locals
    }

    /// Counts the uses of each value; uses by a fused product count as uses by its sum.
    fn uses(&self, entry: &Entry, needed: &[ValueId], products: &BTreeSet<ValueId>) -> Vec<u32> {
        let mut uses = vec![0_u32; self.program.definitions.len()];
        for &id in needed.iter().filter(|id| !products.contains(id)) {
            for operand in self.op(id).operands() {
                if !products.contains(&operand) {
                    uses[operand.0 as usize] += 1;
                    continue;
                }
                for factor in self.op(operand).operands() {
                    uses[factor.0 as usize] += 1;
                }
            }
        }
        for &output in &entry.outputs {
            uses[output.0 as usize] += 1;
        }
        uses
    }

    /// Returns the name of an input: `theta_parent`, `omega_m`, `p_d`.
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
            Argument::Alpha => match &mechanics.transverse {
                Some(transverse) => &transverse.accelerations,
                None => return format!("alpha_{}", self.scene.links[index].name),
            },
            Argument::Actions => match &mechanics.normal_form {
                Some(form) => &form.actions,
                None => unreachable!("actions are arguments of a normal form alone"),
            },
            Argument::Difference(sector) => &self.transverse_sector(sector).differences,
            Argument::DifferenceRate(sector) => &self.transverse_sector(sector).rates,
            Argument::SmallDifferences => return self.small_name("delta", index),
            Argument::SmallRates => return self.small_name("delta_rate", index),
            Argument::SmallTorques => return self.small_name("outside_delta", index),
            Argument::Torques => return format!("outside_{}", self.scene.links[index].name),
            Argument::Weights => return format!("weight_{}", self.scene.links[index].name),
            Argument::Prescribed(set) => {
                return format!("prescribed_{}", self.scene.prescribed[set].members[index]);
            }
            Argument::Forces => {
                let axis = ["x", "y"][index % 2];
                return format!("force_{axis}_{}", self.scene.links[index / 2].name);
            }
            argument => {
                let strips = self.program.strips.as_ref();
                let name = strips.map(|strips| strips.element(argument, index));
                return name.unwrap_or_default().to_owned();
            }
        };
        let code = &mechanics.symbols.get(symbols[index]).code;
        // The transform accepts angles and velocities.
        let is_either = matches!(argument, Argument::Absolute | Argument::Symmetric);
        match is_either {
            true => code.replacen("theta_", "value_", 1),
            false => code.clone(),
        }
    }

    /// Returns a name that describes a value: the whole formula if it is short enough; otherwise
    /// the kind of operation and the first local value in it.
    pub(super) fn described(&self, id: ValueId, locals: &Locals) -> String {
        if let Some(name) = self.describe(id, locals) {
            return name;
        }
        let kind = match self.op(id) {
            Op::Add(..) | Op::Sub(..) => "sum",
            Op::Div(..) => "quotient",
            Op::Neg(_) => "opposite",
            Op::Sqrt(_) => "root",
            _ => "product",
        };
        match self.first_local(id, locals) {
            Some(name) if name.len() <= LONGEST_NAME => format!("{kind}_with_{name}"),
            _ => kind.to_owned(),
        }
    }

    /// Returns the name of the first local value that a value uses, except numbers.
    fn first_local<'l>(&self, id: ValueId, locals: &'l Locals) -> Option<&'l str> {
        let mut operands = self.op(id).operands();
        operands.find_map(
            |operand| match (self.op(operand), locals.names.get(&operand)) {
                (Op::Number(_), _) => None,
                (_, Some(name)) => Some(name.as_str()),
                (_, None) => self.first_local(operand, locals),
            },
        )
    }

    /// Returns a name that describes the formula of a value, if it is short enough.
    pub(super) fn describe(&self, id: ValueId, locals: &Locals) -> Option<String> {
        let name = |operand: ValueId| match self.op(operand) {
            Op::Constant(constant) => Some(self.program.setup.get(*constant).name.clone()),
            _ => match locals.names.get(&operand) {
                Some(name) => Some(name.clone()),
                None => self.describe(operand, locals),
            },
        };
        let described = match self.op(id) {
            Op::Number(number) => constant_names::number(number),
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

    /// Returns an unused name for the value with the opposite sign.
    pub(super) fn opposite(&self, name: &str) -> String {
        match name.strip_prefix("minus_") {
            Some(own) => self.free(own).0,
            None => self.free(&format!("minus_{name}")).0,
        }
    }

    /// Reserves and returns an unused name: `wanted`, with a number if necessary.
    pub(super) fn fresh(&mut self, wanted: String) -> String {
        let (name, next) = self.free(&wanted);
        self.used.insert(name.clone());
        self.numbers.insert(wanted, next);
        name
    }

    /// Returns an unused name, `wanted` with a number if necessary, and the next number.
    fn free(&self, wanted: &str) -> (String, usize) {
        let mut name = wanted.to_owned();
        let mut next = self.numbers.get(wanted).copied().unwrap_or(2);
        while self.used.contains(&name) {
            name = format!("{wanted}_{next}");
            next += 1;
        }
        (name, next)
    }
}
