//! Torques of friction that is not viscous, computed on means and differences.
//!
//! Between copies they are nonlinear. Given f = w² + ε² and y = 1/√f, and for static friction z =
//! 1/√(w² + ϖ²), everything else is products of fields, so that zero differences remain zero and
//! small ones keep their digits.

use super::field::{SymmetricField, SymmetricTree};
use super::motion::{ConstantValues, Fields};
use super::series::TruncatedSeries;
use crate::exact::Rational;
use crate::scene::{FrictionContact, FrictionLaw};

/// A friction law whose constants are series; zero is an empty series.
pub(in crate::program) type LawValues = FrictionLaw<TruncatedSeries>;

impl LawValues {
    pub(in crate::program) fn is_zero(&self) -> bool {
        self.strengths().into_iter().all(TruncatedSeries::is_zero)
    }
}

impl SymmetricTree<'_> {
    /// Returns the rates on which a friction law acts: of the joints of an orbit (set of equal
    /// copies of one link), or of its links.
    pub(in crate::program) fn braking_rate(
        &mut self,
        rates: &Fields,
        orbit: usize,
        place: FrictionContact,
    ) -> SymmetricField {
        match place {
            FrictionContact::Joint => self.relative(rates, orbit),
            FrictionContact::Ground => rates[orbit].clone(),
        }
    }

    /// Adds the torques of friction that is not viscous.
    pub(super) fn add_braking(
        &mut self,
        sums: &mut Fields,
        values: &ConstantValues,
        rates: &Fields,
    ) {
        for (orbit, constants) in values.orbits.iter().enumerate() {
            let [joint, ground] = &constants.passive.laws;
            if !joint.is_zero() {
                let rate = self.braking_rate(rates, orbit, FrictionContact::Joint);
                let torque = self.braking_torque(joint, &rate);
                self.add_joint_torque(sums, &torque);
            }
            if !ground.is_zero() {
                let torque = self.braking_torque(ground, &rates[orbit]);
                self.accumulate(sums, &torque);
            }
        }
    }

    /// Computes the torque (A/s + q s) w = (A y + q f y) w.
    pub(in crate::program) fn braking_torque(
        &mut self,
        law: &LawValues,
        rate: &SymmetricField,
    ) -> SymmetricField {
        let square = self.mul(rate, rate);
        let width = self.series.mul(&law.width, &law.width);
        let width = SymmetricField::uniform(rate.orbit, width);
        let square = self.add(&square, &width);
        self.hinted(&square, "speed_squared");
        let inverse = self.inverse_root(&square);
        self.hinted(&inverse, "inverse_speed");
        let mut factor = self.scale(&law.coulomb, &inverse);
        if !law.excess.is_zero() {
            let excess = self.static_excess(law, rate);
            let excess = self.mul(&excess, &inverse);
            factor = self.add(&factor, &excess);
        }
        if !law.quadratic.is_zero() {
            let speed = self.mul(&square, &inverse);
            self.hinted(&speed, "speed");
            let quadratic = self.scale(&law.quadratic, &speed);
            factor = self.add(&factor, &quadratic);
        }
        self.mul(&factor, rate)
    }

    /// Computes ΔC ϖ²/(ϖ² + w²), the excess of friction over Coulomb friction, as ΔC ϖ² z².
    fn static_excess(&mut self, law: &LawValues, rate: &SymmetricField) -> SymmetricField {
        let square = self.mul(rate, rate);
        let stribeck = self.series.mul(&law.stribeck, &law.stribeck);
        let sum = SymmetricField::uniform(rate.orbit, stribeck.clone());
        let sum = self.add(&square, &sum);
        let inverse = self.inverse_root(&sum);
        self.hinted(&inverse, "inverse_stribeck_speed");
        let inverse = self.mul(&inverse, &inverse);
        let most = self.series.mul(&law.excess, &stribeck);
        self.scale(&most, &inverse)
    }

    /// Computes 1/√f of a positive field, link by link.
    fn inverse_root(&mut self, f: &SymmetricField) -> SymmetricField {
        let leading = self.leading(f);
        let mut result = self.by_copies(&leading, |series, value| series.inverse_root(value));
        if leading.varies_below(self.branch(f.orbit)) {
            result = self.refined_root(&leading, &result);
        }
        // Each round corrects at least one further order.
        for _ in 0..self.series.truncation.unwrap_or(0) {
            result = self.refined_root(f, &result);
        }
        result
    }

    /// Computes one Newton step: y + y (1 − f y²)/2.
    fn refined_root(&mut self, f: &SymmetricField, estimate: &SymmetricField) -> SymmetricField {
        let one = self.series.integer(1);
        let one = SymmetricField::uniform(f.orbit, one);
        let product = self.mul(f, estimate);
        let product = self.mul(&product, estimate);
        let defect = self.sub(&one, &product);
        let half = Rational::from_ratio(1, 2).unwrap_or_else(Rational::one);
        let half = self.series.number(half);
        let defect = self.scale(&half, &defect);
        let correction = self.mul(estimate, &defect);
        self.add(estimate, &correction)
    }
}
