//! The model's constants as a small program of their own: leaves are the
//! description's numbers and parameters; everything else is formed from them
//! once, exactly where no parameter is involved.

use crate::exact::Rational;
use crate::scene::{Scene, Sign};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Index of a constant in [`Setup`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ConstantId(pub u32);

/// Operation that forms a constant.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ConstantOp {
    /// A number.
    Number(Rational),
    /// A parameter of the scene, by its index there.
    Parameter(usize),
    /// A constant that the mechanics names, by its index there, formed as the
    /// other constant says.
    Named(usize, ConstantId),
    /// A constant under a name of the program's own, formed as the other
    /// constant says.
    Called(ConstantId),
    /// A number times integer powers of other constants, which are ordered and
    /// neither numbers nor products: one spelling for each product.
    Product(Rational, Vec<(ConstantId, i32)>),
    /// Sum.
    Add(ConstantId, ConstantId),
    /// Difference.
    Sub(ConstantId, ConstantId),
}

impl ConstantOp {
    /// The constants it is formed of.
    pub fn operands(&self) -> impl Iterator<Item = ConstantId> {
        self.readings().into_iter().map(|(id, _)| id)
    }

    /// The constants that it reads, and how often each.
    pub fn readings(&self) -> Vec<(ConstantId, usize)> {
        match self {
            Self::Number(_) | Self::Parameter(_) => Vec::new(),
            Self::Named(_, a) | Self::Called(a) => vec![(*a, 1)],
            Self::Product(_, powers) => powers
                .iter()
                .map(|&(id, power)| (id, power.unsigned_abs() as usize))
                .collect(),
            Self::Add(a, b) | Self::Sub(a, b) => vec![(*a, 1), (*b, 1)],
        }
    }
}

/// A constant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ConstantDefinition {
    /// The operation that forms it.
    pub op: ConstantOp,
    /// Value of the constant, where no parameter is involved.
    pub exact: Option<Rational>,
    /// Name of the constant in code, given to all of them at the end; until then, that of
    /// whoever formed it, if any.
    pub name: String,
    /// What code calls a constant that nobody has named.
    pub(super) hint: Option<String>,
}

impl ConstantDefinition {
    /// Returns true if nothing but its formation says what the constant is.
    pub(super) fn is_anonymous(&self) -> bool {
        matches!(
            self.op,
            ConstantOp::Product(..) | ConstantOp::Add(..) | ConstantOp::Sub(..)
        )
    }
}

/// The constants of a model; each uses earlier ones only.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Setup {
    /// The constants.
    pub definitions: Vec<ConstantDefinition>,
    /// The constants of the mechanics, by their index there, and those that stand for them:
    /// equal ones are one.
    pub stand_ins: BTreeMap<usize, ConstantId>,
    known: HashMap<ConstantOp, ConstantId>,
}

impl Setup {
    /// The constants that `outputs` are formed of, these included, in the order of their
    /// definitions; what is behind a constant counts where `enters` it.
    pub fn behind(
        &self,
        outputs: impl IntoIterator<Item = ConstantId>,
        enters: impl Fn(&ConstantDefinition) -> bool,
    ) -> BTreeSet<ConstantId> {
        let mut behind = BTreeSet::new();
        let mut waiting: Vec<ConstantId> = outputs.into_iter().collect();
        while let Some(id) = waiting.pop() {
            let definition = self.get(id);
            if behind.insert(id) && enters(definition) {
                waiting.extend(definition.op.operands());
            }
        }
        behind
    }

    /// The definition of a constant.
    pub fn get(&self, id: ConstantId) -> &ConstantDefinition {
        &self.definitions[id.0 as usize]
    }

    /// All constants, in the order in which they were formed.
    pub fn iter(&self) -> impl Iterator<Item = (ConstantId, &ConstantDefinition)> {
        let definitions = self.definitions.iter().enumerate();
        definitions.map(|(index, definition)| (ConstantId(index as u32), definition))
    }

    /// A number.
    pub(super) fn number(&mut self, value: Rational) -> ConstantId {
        self.intern(ConstantOp::Number(value), None)
    }

    /// A parameter of the scene.
    pub(super) fn parameter(&mut self, index: usize, name: &str) -> ConstantId {
        self.intern(ConstantOp::Parameter(index), Some(name))
    }

    /// A constant of the mechanics.
    pub(super) fn named(&mut self, index: usize, formed: ConstantId, name: &str) -> ConstantId {
        self.intern(ConstantOp::Named(index, formed), Some(name))
    }

    /// Says what an anonymous constant is called where it is formed. The first hint stays.
    pub(super) fn hint(&mut self, id: ConstantId, name: &str) {
        let definition = &mut self.definitions[id.0 as usize];
        if definition.is_anonymous() && definition.hint.is_none() {
            definition.hint = Some(name.to_owned());
        }
    }

    /// A constant that is read under a name of its own.
    pub(super) fn called(&mut self, formed: ConstantId, name: &str) -> ConstantId {
        self.intern(ConstantOp::Called(formed), Some(name))
    }

    /// a + b.
    pub(super) fn add(&mut self, a: ConstantId, b: ConstantId) -> ConstantId {
        match (self.as_number(a), self.as_number(b)) {
            (Some(x), Some(y)) => self.number(x + y),
            (Some(x), None) if x.is_zero() => b,
            (None, Some(y)) if y.is_zero() => a,
            _ => self.intern(ConstantOp::Add(a, b), None),
        }
    }

    /// a − b.
    pub(super) fn sub(&mut self, a: ConstantId, b: ConstantId) -> ConstantId {
        match (self.as_number(a), self.as_number(b)) {
            (Some(x), Some(y)) => self.number(x - y),
            (None, Some(y)) if y.is_zero() => a,
            _ => self.intern(ConstantOp::Sub(a, b), None),
        }
    }

    /// −a.
    pub(super) fn neg(&mut self, a: ConstantId) -> ConstantId {
        let (number, powers) = self.as_product(a);
        self.product(-number, powers)
    }

    /// a · b.
    pub(super) fn mul(&mut self, a: ConstantId, b: ConstantId) -> ConstantId {
        self.combine(a, b, 1)
    }

    /// a / b, b not zero.
    pub(super) fn div(&mut self, a: ConstantId, b: ConstantId) -> ConstantId {
        self.combine(a, b, -1)
    }

    /// An integer power of a, which is not zero where that is negative.
    pub(super) fn power(&mut self, a: ConstantId, exponent: i32) -> ConstantId {
        let one = self.number(Rational::from(1));
        (0..exponent.unsigned_abs()).fold(one, |power, _| match exponent > 0 {
            true => self.mul(power, a),
            false => self.div(power, a),
        })
    }

    fn combine(&mut self, a: ConstantId, b: ConstantId, exponent: i32) -> ConstantId {
        let (number_a, mut powers) = self.as_product(a);
        let (number_b, powers_b) = self.as_product(b);
        let factor = match number_b.checked_pow(exponent) {
            Ok(factor) => factor,
            Err(error) => unreachable!("constants are divided by non-zero ones only: {error}"),
        };
        for (id, power) in powers_b {
            *powers.entry(id).or_default() += exponent * power;
        }
        powers.retain(|_, power| *power != 0);
        self.product(number_a * factor, powers)
    }

    fn product(&mut self, number: Rational, powers: BTreeMap<ConstantId, i32>) -> ConstantId {
        let single = match powers.iter().next() {
            Some((&id, 1)) if powers.len() == 1 => Some(id),
            _ => None,
        };
        match single {
            _ if powers.is_empty() || number.is_zero() => self.number(number),
            Some(id) if number.is_one() => id,
            _ => {
                let powers = powers.into_iter().collect();
                self.intern(ConstantOp::Product(number, powers), None)
            }
        }
    }

    /// Returns true if the signs that the scene demands of its parameters make
    /// a constant positive.
    pub(super) fn is_positive(&self, id: ConstantId, scene: &Scene) -> bool {
        let positive = |id: &ConstantId| self.is_positive(*id, scene);
        match &self.get(id).op {
            ConstantOp::Number(number) => !number.is_negative() && !number.is_zero(),
            ConstantOp::Parameter(index) => scene.parameters[*index].sign == Sign::Positive,
            ConstantOp::Named(_, a) | ConstantOp::Called(a) => positive(a),
            ConstantOp::Product(number, powers) => {
                !number.is_negative()
                    && !number.is_zero()
                    && powers.iter().all(|(base, _)| positive(base))
            }
            ConstantOp::Add(a, b) => positive(a) && positive(b),
            ConstantOp::Sub(..) => false,
        }
    }

    /// The n of a = 2ⁿ b, up to 3 of either sign; `None` where a is no such multiple.
    pub(super) fn binary_exponent(&self, a: ConstantId, b: ConstantId) -> Option<i32> {
        let ((a, powers_a), (b, powers_b)) = (self.as_product(a), self.as_product(b));
        let ratio = a.checked_div(&b)?;
        let is = |exponent: &i32| {
            let power = Rational::from(2).checked_pow(*exponent);
            power.is_ok_and(|power| power == ratio)
        };
        let exponent = (-3..=3).find(is)?;
        (powers_a == powers_b).then_some(exponent)
    }

    fn as_number(&self, id: ConstantId) -> Option<Rational> {
        match &self.get(id).op {
            ConstantOp::Number(number) => Some(number.clone()),
            _ => None,
        }
    }

    fn as_product(&self, id: ConstantId) -> (Rational, BTreeMap<ConstantId, i32>) {
        match &self.get(id).op {
            ConstantOp::Number(number) => (number.clone(), BTreeMap::new()),
            ConstantOp::Product(number, powers) => {
                (number.clone(), powers.iter().copied().collect())
            }
            _ => (Rational::from(1), BTreeMap::from([(id, 1)])),
        }
    }

    fn intern(&mut self, op: ConstantOp, name: Option<&str>) -> ConstantId {
        if let Some(&id) = self.known.get(&op) {
            return id;
        }
        let id = ConstantId(self.definitions.len() as u32);
        let exact = self.value(&op);
        let name = name.unwrap_or_default().to_owned();
        self.known.insert(op.clone(), id);
        self.definitions.push(ConstantDefinition {
            op,
            exact,
            name,
            hint: None,
        });
        id
    }

    fn value(&self, op: &ConstantOp) -> Option<Rational> {
        let exact = |id: ConstantId| self.get(id).exact.clone();
        match op {
            ConstantOp::Number(number) => Some(number.clone()),
            ConstantOp::Parameter(_) => None,
            ConstantOp::Named(_, a) | ConstantOp::Called(a) => exact(*a),
            ConstantOp::Product(number, powers) => powers
                .iter()
                .try_fold(number.clone(), |product, (id, power)| {
                    Some(product * exact(*id)?.checked_pow(*power).ok()?)
                }),
            ConstantOp::Add(a, b) => Some(exact(*a)? + exact(*b)?),
            ConstantOp::Sub(a, b) => Some(exact(*a)? - exact(*b)?),
        }
    }
}
