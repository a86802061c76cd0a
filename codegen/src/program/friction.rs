//! Torques of friction that is not viscous (physics §17).
//!
//! One function computes them for single links, written out and in loops. In symmetric coordinates
//! of equal copies they are computed on means and differences.

use super::ValueId;
use super::builder::Builder;
use super::entry_state::{law_values, symmetric_tree};
use super::lower::{Environment, Lowering};
use super::symmetric::Fields;
use crate::mechanics::expression::{Expr, SymbolId};
use crate::mechanics::{BrakingTorque, TorqueSource};
use crate::scene::{FrictionContact, FrictionLaw};

/// A friction law whose constants are values of the program.
pub(super) type Law = FrictionLaw<ValueId>;

impl Builder {
    /// Computes the speed √(w² + ε²).
    fn speed(&mut self, law: &Law, rate: ValueId, suffix: &str) -> ValueId {
        let square = self.mul(rate, rate);
        let width = self.mul(law.width, law.width);
        let sum = self.add(square, width);
        let speed = self.sqrt(sum);
        self.name(speed, &format!("speed{suffix}"))
    }

    /// Computes A/s with A = C + ΔC ϖ²/(ϖ² + w²) as one fraction, or C/s without an excess ΔC.
    fn strength_over_speed(
        &mut self,
        law: &Law,
        rate: ValueId,
        speed: ValueId,
        suffix: &str,
    ) -> ValueId {
        if self.is(law.excess, 0) {
            return self.div(law.coulomb, speed);
        }
        let square = self.mul(rate, rate);
        let stribeck = self.mul(law.stribeck, law.stribeck);
        let sum = self.add(stribeck, square);
        let sum = self.name(sum, &format!("stribeck_speed_squared{suffix}"));
        let excess = self.mul(law.excess, stribeck);
        let coulomb = self.mul(law.coulomb, sum);
        let strength = self.add(coulomb, excess);
        let divisor = self.mul(sum, speed);
        self.div(strength, divisor)
    }

    /// Computes the torque (A/s + q s) w, zero without a law; `suffix` is appended to the names of
    /// its values.
    pub(super) fn braking_torque(&mut self, law: &Law, rate: ValueId, suffix: &str) -> ValueId {
        let [coulomb, quadratic, excess] = law.strengths().map(|own| self.is(*own, 0));
        if [coulomb, quadratic, excess] == [true; 3] {
            return self.integer(0);
        }
        let speed = self.speed(law, rate, suffix);
        let factor = match (coulomb && excess, quadratic) {
            (true, true | false) => self.mul(law.quadratic, speed),
            (false, true) => self.strength_over_speed(law, rate, speed, suffix),
            (false, false) => {
                let strength = self.strength_over_speed(law, rate, speed, suffix);
                let quadratic = self.mul(law.quadratic, speed);
                self.add(strength, quadratic)
            }
        };
        self.mul(factor, rate)
    }

    /// Computes the derivative of the torque by w.
    fn braking_slope(&mut self, law: &Law, rate: ValueId, suffix: &str) -> ValueId {
        let slope = self.slope_without_excess(law, rate, suffix);
        match self.excess_derivatives(law, rate, suffix) {
            Some([of_excess, _]) => self.add(slope, of_excess),
            None => slope,
        }
    }

    /// Computes the second derivative of the torque by w.
    fn braking_curvature(&mut self, law: &Law, rate: ValueId, suffix: &str) -> ValueId {
        let curvature = self.curvature_without_excess(law, rate, suffix);
        match self.excess_derivatives(law, rate, suffix) {
            Some([_, of_excess]) => self.add(curvature, of_excess),
            None => curvature,
        }
    }

    /// Computes the first and second derivative by w of the excess's torque B w/s, where B = ΔC r
    /// and r = ϖ²/(ϖ² + w²); `None` without an excess. The slope is [ε²/s² − 2 (1 − r)] B/s and the
    /// curvature −[(4 r − 3 + 2 ε²/s²) 2 r/ϖ² + 3 ε²/s⁴] B w/s.
    fn excess_derivatives(
        &mut self,
        law: &Law,
        rate: ValueId,
        suffix: &str,
    ) -> Option<[ValueId; 2]> {
        if self.is(law.excess, 0) {
            return None;
        }
        let speed = self.speed(law, rate, suffix);
        let [one, two, three, four] = [1, 2, 3, 4].map(|number| self.integer(number));
        let inverse = self.div(one, speed);
        let width = self.mul(law.width, inverse);
        let narrow = self.mul(width, width);
        let [square, stribeck] = [rate, law.stribeck].map(|own| self.mul(own, own));
        let sum = self.add(stribeck, square);
        let per_sum = self.div(one, sum);
        let [left, lost] = [stribeck, square].map(|own| self.mul(own, per_sum));
        let strength = self.mul(law.excess, left);
        let over_speed = self.mul(strength, inverse);
        let twice = self.mul(two, lost);
        let slope = self.sub(narrow, twice);
        let slope = self.mul(over_speed, slope);
        let first = self.mul(four, left);
        let first = self.sub(first, three);
        let second = self.mul(two, narrow);
        let bend = self.add(first, second);
        // r/ϖ² = 1/(ϖ² + w²).
        let twice = self.mul(two, per_sum);
        let bend = self.mul(twice, bend);
        let squared = self.mul(inverse, inverse);
        let steep = self.mul(narrow, squared);
        let steep = self.mul(three, steep);
        let sum = self.add(bend, steep);
        let product = self.mul(over_speed, rate);
        let curvature = self.mul(product, sum);
        Some([slope, self.neg(curvature)])
    }

    /// Computes the derivative by w of the torque without the excess, C ε²/s³ + q (s + w²/s).
    fn slope_without_excess(&mut self, law: &Law, rate: ValueId, suffix: &str) -> ValueId {
        let speed = self.speed(law, rate, suffix);
        let one = self.integer(1);
        let inverse = self.div(one, speed);
        let relative = self.mul(rate, inverse);
        let width = self.mul(law.width, inverse);
        let narrow = self.mul(width, width);
        let narrow = self.mul(law.coulomb, narrow);
        let coulomb = self.mul(narrow, inverse);
        let excess = self.mul(rate, relative);
        let sum = self.add(speed, excess);
        let quadratic = self.mul(law.quadratic, sum);
        self.add(coulomb, quadratic)
    }

    /// Computes the second derivative by w of the torque without the excess, [q (3 − w²/s²) − 3 C
    /// ε²/s⁴] w/s.
    fn curvature_without_excess(&mut self, law: &Law, rate: ValueId, suffix: &str) -> ValueId {
        let speed = self.speed(law, rate, suffix);
        let one = self.integer(1);
        let inverse = self.div(one, speed);
        let relative = self.mul(rate, inverse);
        let square = self.mul(relative, relative);
        let three = self.integer(3);
        let rest = self.sub(three, square);
        let quadratic = self.mul(law.quadratic, rest);
        let width = self.mul(law.width, inverse);
        let narrow = self.mul(width, width);
        let narrow = self.mul(law.coulomb, narrow);
        let narrow = self.mul(three, narrow);
        let squared = self.mul(inverse, inverse);
        let coulomb = self.mul(narrow, squared);
        let sum = self.sub(quadratic, coulomb);
        self.mul(sum, relative)
    }
}

impl Lowering<'_> {
    pub(super) fn law(
        &mut self,
        environment: &mut Environment<'_>,
        law: &FrictionLaw<Expr>,
    ) -> Law {
        law.map(|expr| self.expr(environment, expr))
    }

    /// Returns the value of a friction torque or of its slope; `None` for other symbols.
    pub(super) fn braking(
        &mut self,
        environment: &mut Environment<'_>,
        symbol: SymbolId,
    ) -> Option<ValueId> {
        let frame = environment.frame;
        let mut torques = frame.torques.iter();
        let torque =
            torques.find(|known| known.symbol == symbol || known.slopes.contains(&symbol))?;
        match &torque.source {
            TorqueSource::Coordinate(_) => {
                self.braking_fields(environment, torque.place);
                environment.supplied(symbol)
            }
            TorqueSource::Link { rate, law, .. } => {
                let rate = self.expr(environment, rate);
                let law = self.law(environment, law);
                let code = &self.mechanics.symbols.get(symbol).code;
                let link = &self.mechanics.symbols.get(torque.symbol).code;
                let suffix = link.replacen("braking", "", 1);
                let form = match torque.slopes.iter().position(|slope| *slope == symbol) {
                    None => Builder::braking_torque,
                    Some(0) => Builder::braking_slope,
                    Some(_) => Builder::braking_curvature,
                };
                let value = form(&mut self.builder, &law, rate, &suffix);
                Some(self.builder.name(value, code))
            }
        }
    }

    /// Supplies the friction torques in symmetric coordinates, for joints or for drag against the
    /// ground.
    fn braking_fields(&mut self, environment: &mut Environment<'_>, place: FrictionContact) {
        let (mechanics, frame) = (self.mechanics, environment.frame);
        let velocities = frame.velocities.iter();
        let velocities: Vec<ValueId> = velocities
            .map(|&velocity| self.symbol(environment, velocity))
            .collect();
        let laws = mechanics.articulation.joints.iter();
        let laws: Vec<_> = laws
            .map(|joint| law_values(self, joint.passive.law(place)))
            .collect();
        let mut tree = symmetric_tree(self, None);
        let mut rates: Fields = tree.zeros();
        for (coordinate, &velocity) in mechanics.coordinates.iter().zip(&velocities) {
            let (orbit, sector) = coordinate.kind.orbit_and_difference();
            let value = tree.series.value(velocity);
            rates[orbit].set(sector, value);
        }
        let mut found = Vec::new();
        for BrakingTorque { symbol, source, .. } in
            frame.torques.iter().filter(|torque| torque.place == place)
        {
            let TorqueSource::Coordinate(index) = *source else {
                continue;
            };
            let (orbit, sector) = mechanics.coordinates[index].kind.orbit_and_difference();
            let rate = tree.braking_rate(&rates, orbit, place);
            let torque = tree.braking_torque(&laws[orbit], &rate);
            let component = tree.component(&torque, sector);
            found.push((*symbol, tree.series.total(&component)));
        }
        for (symbol, value) in found {
            let code = &mechanics.symbols.get(symbol).code;
            self.builder.name(value, code);
            environment.supply(symbol, value);
        }
    }
}
