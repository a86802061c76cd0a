//! Names for constants that are known only by their formula, and for numbers.

use super::constants::{ConstantDefinition, ConstantId, ConstantOp, Setup};
use super::{Op, Program};
use crate::exact::Rational;
use crate::mechanics::Mechanics;
use std::collections::{BTreeMap, BTreeSet};

/// Longest name, in characters, that consists of the factors of a product. A longer one would be
/// less clear than a number.
const LONGEST_PRODUCT: usize = 72;

/// Longest name, in characters, that consists of the members of a sum. A longer one would be less
/// clear than a number.
const LONGEST_SUM: usize = 40;

impl Program {
    /// Names all constants, first those that the code reads.
    ///
    /// Constants of the mechanics have the names of their letters, and constants created with a
    /// name keep it. A product of such constants is named by its factors:
    /// `coupling_child_parent_over_inertia_child`. A sum, and a product that contains a sum, has
    /// the hinted name of its value, such as `reduced_inertia_trunk`. Without a hint it is named by
    /// its members if that name is short, and `constant_1` if not.
    pub(super) fn name_constants(&mut self, mechanics: &Mechanics) {
        let mut read = Vec::new();
        for entry in &self.entries {
            for value in self.needed(&entry.outputs) {
                if let Op::Constant(id) = self.definition(value).op {
                    read.push(id);
                }
            }
        }
        let strips = self.strips.iter().flat_map(|tree| &tree.strips);
        read.extend(strips.flat_map(|strip| strip.constants.iter().copied()));
        let read = self.setup.behind(read, |constant| constant.exact.is_none());
        let all: Vec<ConstantId> = self.setup.iter().map(|(id, _)| id).collect();
        let setup = std::mem::take(&mut self.setup);
        let mut naming = Naming::new(setup, mechanics);
        for id in read.into_iter().chain(all) {
            naming.assign(id);
        }
        self.setup = naming.setup;
    }
}

/// State of the naming of constants.
struct Naming {
    setup: Setup,
    /// Constants that have their final names.
    named: BTreeSet<ConstantId>,
    /// Names in use, each with the number after which to search for a free one.
    used: BTreeMap<String, u32>,
    /// Desired names of constants, as far as they have been determined.
    known: BTreeMap<ConstantId, Option<String>>,
    /// Number of constants named by a number.
    numbered: u32,
}

impl Naming {
    /// Creates the state with the names of the mechanics' constants, which are distinct, and with
    /// those of constants created with a name.
    fn new(setup: Setup, mechanics: &Mechanics) -> Self {
        let codes = mechanics.constants.iter();
        let codes = codes.map(|constant| mechanics.symbols.get(constant.symbol).code.clone());
        let mut naming = Self {
            setup,
            named: BTreeSet::new(),
            used: codes.map(|code| (code, 1)).collect(),
            known: BTreeMap::new(),
            numbered: 0,
        };
        for index in 0..naming.setup.definitions.len() {
            let id = ConstantId(index as u32);
            let ConstantDefinition { op, name, .. } = naming.setup.get(id);
            match op {
                // A parameter keeps its name in texts without reserving it. If it also becomes a
                // field, `emit` distinguishes the two.
                ConstantOp::Named(..) | ConstantOp::Parameter(_) => {
                    let name = name.clone();
                    naming.known.insert(id, Some(name));
                    naming.named.insert(id);
                }
                ConstantOp::Called(_) => {
                    let name = name.clone();
                    naming.name(id, name);
                }
                _ => {}
            }
        }
        naming
    }

    fn name(&mut self, id: ConstantId, wanted: String) {
        // A name with a number may belong to another constant: that of a link's copy.
        let mut name = wanted.clone();
        let mut count = self.used.get(&wanted).copied().unwrap_or(0);
        while self.used.contains_key(&name) {
            count += 1;
            name = format!("{wanted}_{count}");
        }
        self.used.insert(wanted, count.max(1));
        self.used.entry(name.clone()).or_insert(1);
        self.known.insert(id, Some(name.clone()));
        self.setup.definitions[id.0 as usize].name = name;
        self.named.insert(id);
    }

    fn assign(&mut self, id: ConstantId) {
        if self.named.contains(&id) {
            return;
        }
        let name = self.wanted(id).unwrap_or_else(|| {
            self.numbered += 1;
            format!("constant_{}", self.numbered)
        });
        self.name(id, name);
    }

    /// Returns the desired name of a constant; `None` if it has no description.
    fn wanted(&mut self, id: ConstantId) -> Option<String> {
        if let Some(wanted) = self.known.get(&id) {
            return wanted.clone();
        }
        let ConstantDefinition { op, hint, .. } = self.setup.get(id).clone();
        let has_sums = op.operands().any(|operand| self.is_sum(operand));
        let wanted = match op {
            ConstantOp::Product(..) if !has_sums => self.described(&op).or(hint),
            _ => hint.or_else(|| self.described(&op)),
        };
        self.known.insert(id, wanted.clone());
        wanted
    }

    fn is_sum(&self, id: ConstantId) -> bool {
        let op = &self.setup.get(id).op;
        matches!(op, ConstantOp::Add(..) | ConstantOp::Sub(..))
    }

    /// Returns a name that describes the formula of a constant, if it is short enough.
    fn described(&mut self, op: &ConstantOp) -> Option<String> {
        let (name, longest) = match op {
            ConstantOp::Number(value) => (number(value), LONGEST_PRODUCT),
            ConstantOp::Product(factor, powers) => {
                let factors = powers.iter();
                let factors = factors.map(|&(id, power)| Some((self.wanted(id)?, power)));
                let factors = factors.collect::<Option<Vec<_>>>()?;
                (product(factor, &factors), LONGEST_PRODUCT)
            }
            ConstantOp::Add(a, b) => {
                let (a, b) = (self.wanted(*a)?, self.wanted(*b)?);
                (format!("{a}_plus_{b}"), LONGEST_SUM)
            }
            ConstantOp::Sub(a, b) => {
                let (a, b) = (self.wanted(*a)?, self.wanted(*b)?);
                (format!("{a}_minus_{b}"), LONGEST_SUM)
            }
            ConstantOp::Parameter(_) | ConstantOp::Named(..) | ConstantOp::Called(_) => {
                return None;
            }
        };
        (name.len() <= longest).then_some(name)
    }
}

/// Returns the name of a product: `twice_gravity_child`,
/// `coupling_child_parent_over_inertia_child`.
fn product(number: &Rational, powers: &[(String, i32)]) -> String {
    let side = |above: bool| -> Vec<String> {
        powers
            .iter()
            .filter(|(_, power)| (*power > 0) == above)
            .map(|(name, power)| match power.unsigned_abs() {
                1 => name.clone(),
                2 => format!("{name}_squared"),
                other => format!("{name}_to_{other}"),
            })
            .collect()
    };
    let (mut above, mut below) = (side(true), side(false));
    let numerator = number.numerator_text();
    let (sign, numerator) = match numerator.strip_prefix('-') {
        Some(size) => ("minus_", size.to_owned()),
        None => ("", numerator),
    };
    let denominator = number.denominator_text();
    // Many digits say no more than that there is a factor.
    let long = numerator.len().max(denominator.len()) > MOST_FACTOR_DIGITS;
    if numerator == "1" && denominator == "2" && below.is_empty() {
        above.insert(0, "half".into());
    } else if !long {
        for (side, digits) in [(&mut above, &numerator), (&mut below, &denominator)] {
            match digits.as_str() {
                "1" => {}
                "2" if !side.is_empty() => side.insert(0, "twice".into()),
                other => side.insert(0, word(other)),
            }
        }
    }
    let (above, below) = (above.join("_"), below.join("_"));
    let scaled = if long { "scaled_" } else { "" };
    let name = match (above.is_empty(), below.is_empty()) {
        (false, true) => above,
        (true, false) => format!("inverse_{below}"),
        _ => format!("{above}_over_{below}"),
    };
    started(format!("{sign}{scaled}{name}"))
}

/// Returns the name of a number: `half`, `two_over_three`, `number_0_15`. Numbers of many digits
/// are named `coefficient`.
pub(crate) fn number(number: &Rational) -> String {
    let sign = if number.is_negative() { "minus_" } else { "" };
    let numerator = number.numerator_text();
    let numerator = numerator.trim_start_matches('-');
    let denominator = number.denominator_text();
    let decimal = number.to_string();
    let decimal = decimal.trim_start_matches('-');
    let name = match (numerator, denominator.as_str()) {
        (_, "1") if numerator.len() <= MOST_DIGITS => word(numerator),
        ("1", "2") => "half".to_owned(),
        ("1", "4") => "quarter".to_owned(),
        ("1", "8") => "eighth".to_owned(),
        _ if decimal.contains('.') && decimal.len() <= MOST_DIGITS + 1 => decimal.replace('.', "_"),
        _ if numerator.len().max(denominator.len()) <= MOST_FACTOR_DIGITS => {
            format!("{}_over_{}", word(numerator), word(&denominator))
        }
        _ => "coefficient".to_owned(),
    };
    format!("{sign}{}", started(name))
}

/// Largest number of digits of a number that is named by its digits.
const MOST_DIGITS: usize = 8;

/// Largest number of digits of a factor that is named by its digits.
const MOST_FACTOR_DIGITS: usize = 2;

/// Adds a prefix to a name that does not begin with a letter.
fn started(name: String) -> String {
    match name.starts_with(|first: char| first.is_ascii_digit()) {
        true => format!("number_{name}"),
        false => name,
    }
}

fn word(digits: &str) -> String {
    match digits {
        "0" => "zero",
        "1" => "one",
        "2" => "two",
        "3" => "three",
        "4" => "four",
        "5" => "five",
        "6" => "six",
        "7" => "seven",
        "8" => "eight",
        "9" => "nine",
        other => other,
    }
    .into()
}
