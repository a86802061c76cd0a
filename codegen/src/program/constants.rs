//! Constants of the model, as a separate small program. Its inputs are the description's numbers
//! and parameters; everything else is computed from them once per model, exactly if no parameter is
//! involved.

use crate::exact::Rational;
use crate::scene::{Scene, Sign};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Index of a constant in [`Setup`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ConstantId(pub u32);

/// Operation that computes a constant.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ConstantOp {
    /// A number.
    Number(Rational),
    /// A parameter of the scene, by its index there.
    Parameter(usize),
    /// A constant of the mechanics, by its index there, with the value of another constant.
    Named(usize, ConstantId),
    /// A constant that the program names, with the value of another constant.
    Called(ConstantId),
    /// A number times integer powers of other constants. These are sorted and are neither numbers
    /// nor products, so that each product has one form.
    Product(Rational, Vec<(ConstantId, i32)>),
    /// Sum.
    Add(ConstantId, ConstantId),
    /// Difference.
    Sub(ConstantId, ConstantId),
}

impl ConstantOp {
    /// Returns the constants that the operation uses.
    pub fn operands(&self) -> impl Iterator<Item = ConstantId> {
        self.readings().into_iter().map(|(id, _)| id)
    }

    /// Returns the constants that the operation reads, and how often it reads each.
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

/// A constant of the model, with the operation that computes it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ConstantDefinition {
    /// Operation that computes the constant.
    pub op: ConstantOp,
    /// Exact value of the constant, if no parameter is involved.
    pub exact: Option<Rational>,
    /// Name of the constant in code. All constants are named at the end; until then it is the name
    /// given at creation, if any.
    pub name: String,
    /// Name that is used if the constant gets no other.
    pub(super) hint: Option<String>,
}

impl ConstantDefinition {
    /// Returns true if the constant has no name, so that only its formula describes it.
    pub(super) fn is_anonymous(&self) -> bool {
        matches!(
            self.op,
            ConstantOp::Product(..) | ConstantOp::Add(..) | ConstantOp::Sub(..)
        )
    }
}

/// Constants of a model; each uses earlier ones only.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Setup {
    /// All constants, each after the constants from which it is computed.
    pub definitions: Vec<ConstantDefinition>,
    /// For each constant of the mechanics, by its index there, the constant that represents it.
    /// Equal constants have the same representative.
    pub stand_ins: BTreeMap<usize, ConstantId>,
    known: HashMap<ConstantOp, ConstantId>,
}

impl Setup {
    /// Returns the constants from which `outputs` are computed, including these, in the order of
    /// definition. The operands of a constant are included only if `enters` returns true for it.
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

    /// Returns the definition of a constant.
    pub fn get(&self, id: ConstantId) -> &ConstantDefinition {
        &self.definitions[id.0 as usize]
    }

    /// Iterates over all constants, in the order in which they are computed.
    pub fn iter(&self) -> impl Iterator<Item = (ConstantId, &ConstantDefinition)> {
        let definitions = self.definitions.iter().enumerate();
        definitions.map(|(index, definition)| (ConstantId(index as u32), definition))
    }

    /// Returns a number as a constant.
    #[doc(hidden)]
    pub fn number(&mut self, value: Rational) -> ConstantId {
        self.intern(ConstantOp::Number(value), None)
    }

    /// Returns a parameter of the scene as a constant.
    #[doc(hidden)]
    pub fn parameter(&mut self, index: usize, name: &str) -> ConstantId {
        self.intern(ConstantOp::Parameter(index), Some(name))
    }

    /// Returns a constant of the mechanics with the value of `formed`.
    pub(super) fn named(&mut self, index: usize, formed: ConstantId, name: &str) -> ConstantId {
        self.intern(ConstantOp::Named(index, formed), Some(name))
    }

    /// Suggests a name for a constant that has only a formula. The first hint is kept.
    pub(super) fn hint(&mut self, id: ConstantId, name: &str) {
        let definition = &mut self.definitions[id.0 as usize];
        if definition.is_anonymous() && definition.hint.is_none() {
            definition.hint = Some(name.to_owned());
        }
    }

    /// Returns a constant with its own name and the value of `formed`.
    #[doc(hidden)]
    pub fn called(&mut self, formed: ConstantId, name: &str) -> ConstantId {
        self.intern(ConstantOp::Called(formed), Some(name))
    }

    /// Returns a + b.
    pub(super) fn add(&mut self, a: ConstantId, b: ConstantId) -> ConstantId {
        match (self.as_number(a), self.as_number(b)) {
            (Some(x), Some(y)) => self.number(x + y),
            (Some(x), None) if x.is_zero() => b,
            (None, Some(y)) if y.is_zero() => a,
            _ => self.intern(ConstantOp::Add(a, b), None),
        }
    }

    /// Returns a − b.
    pub(super) fn sub(&mut self, a: ConstantId, b: ConstantId) -> ConstantId {
        match (self.as_number(a), self.as_number(b)) {
            (Some(x), Some(y)) => self.number(x - y),
            (None, Some(y)) if y.is_zero() => a,
            _ => self.intern(ConstantOp::Sub(a, b), None),
        }
    }

    /// Returns −a.
    pub(super) fn neg(&mut self, a: ConstantId) -> ConstantId {
        let (number, powers) = self.as_product(a);
        self.product(-number, powers)
    }

    /// Returns a · b.
    #[doc(hidden)]
    pub fn mul(&mut self, a: ConstantId, b: ConstantId) -> ConstantId {
        self.combine(a, b, 1)
    }

    /// Returns a / b; b must not be zero.
    pub(super) fn div(&mut self, a: ConstantId, b: ConstantId) -> ConstantId {
        self.combine(a, b, -1)
    }

    /// Returns an integer power of a, which must not be zero if the exponent is negative.
    pub(super) fn power(&mut self, a: ConstantId, exponent: i32) -> ConstantId {
        let one = self.number(Rational::from(1));
        (0..exponent.unsigned_abs()).fold(one, |power, _| match exponent > 0 {
            true => self.mul(power, a),
            false => self.div(power, a),
        })
    }

    /// Returns the derivatives of constants by a parameter of the scene, as constants. The result
    /// also has the derivatives of the constants from which they are computed.
    ///
    /// Linear in the number of all these constants, times a logarithm.
    pub(super) fn derivatives(
        &mut self,
        of: impl IntoIterator<Item = ConstantId>,
        parameter: usize,
    ) -> BTreeMap<ConstantId, ConstantId> {
        let mut slopes = BTreeMap::new();
        for id in self.behind(of, |_| true) {
            let slope = match self.get(id).op.clone() {
                ConstantOp::Number(_) => self.number(Rational::from(0)),
                ConstantOp::Parameter(index) => {
                    self.number(Rational::from(i64::from(index == parameter)))
                }
                ConstantOp::Named(_, a) | ConstantOp::Called(a) => slopes[&a],
                ConstantOp::Add(a, b) => self.add(slopes[&a], slopes[&b]),
                ConstantOp::Sub(a, b) => self.sub(slopes[&a], slopes[&b]),
                ConstantOp::Product(_, powers) => self.slope_of_product(id, &powers, &slopes),
            };
            slopes.insert(id, slope);
        }
        slopes
    }

    /// Returns the derivative f Σ n c′/c of a product f with factors cⁿ, whose derivatives c′ are
    /// `slopes`.
    fn slope_of_product(
        &mut self,
        product: ConstantId,
        powers: &[(ConstantId, i32)],
        slopes: &BTreeMap<ConstantId, ConstantId>,
    ) -> ConstantId {
        let mut sum = self.number(Rational::from(0));
        for &(base, power) in powers {
            let slope = slopes[&base];
            // A factor that does not depend on the parameter may be zero.
            if self.as_number(slope).is_some_and(|slope| slope.is_zero()) {
                continue;
            }
            let power = self.number(Rational::from(i64::from(power)));
            let without = self.div(product, base);
            let share = self.mul(power, without);
            let share = self.mul(share, slope);
            sum = self.add(sum, share);
        }
        sum
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

    /// Returns true if the constant is positive for all parameters whose signs the scene accepts.
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

    /// Returns the n of a = 2ⁿ b with |n| ≤ 3; `None` if there is none.
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
