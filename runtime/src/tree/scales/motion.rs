//! Quantities that do not depend on the scale: motion, torques, velocities, momenta, and factors of
//! the mass matrix.

use super::columns::{
    CARRIED, DEFICIT, DRIVE, GAIN, MOMENT, MOTION, OUTSIDE, RISE, SPLIT, SPRING, STRAIN, VELOCITY,
};
use super::parts::split;
use super::shape::ScaleGeneration;
use super::{ByScale, ScaleEquations, field};
use crate::scalar::Scalar;
use crate::simd::Simd;
use crate::tree::LinkMotion;
use crate::tree::columns::load_front;

impl<E: ScaleEquations, T: Scalar> ByScale<'_, E, T> {
    /// Computes sines and cosines of all angles, and the torques in all joints.
    #[inline(always)]
    pub(super) fn motions<V: Simd<T>>(&mut self) {
        let one = V::from_f64(1.0);
        for generation in 0..self.shape.count() {
            let own = self.shape.at(generation);
            let mut place = 0;
            while place < own.count {
                let angle: V = load_front(self.theta, own.whole + place);
                let (sine, cosine) = angle.sin_cos();
                let omega: V = load_front(self.omega, own.whole + place);
                let slot = own.slot + place;
                self.columns.write(MOTION, slot, [sine, cosine, omega]);
                self.columns.write(RISE, slot, [one - cosine]);
                place += V::LANES;
            }
            if E::SPRINGS || E::FRICTION || E::DRAG {
                self.joints::<V>(generation);
            }
        }
        if E::SPRINGS || E::FRICTION || E::DRAG {
            for generation in 0..self.shape.count() {
                self.joint_torques::<V>(generation);
            }
        }
    }

    /// Computes the torques in the joints of one generation.
    #[inline(always)]
    fn joints<V: Simd<T>>(&mut self, generation: usize) {
        let constants = self.constants::<V>(generation);
        let (own, above) = self.pair(generation);
        for copy in 0..own.count / above.count {
            let mut place = 0;
            while place < above.count {
                let number = copy * above.count + place;
                let mut link: LinkMotion<V> = self.columns.motion(own.slot + number);
                link.joint_angle = load_front(self.theta, own.whole + number);
                if generation > 0 {
                    let parent: LinkMotion<V> = self.columns.motion(above.slot + place);
                    link.joint_rate = link.omega - parent.omega;
                    let angle: V = load_front(self.theta, above.whole + place);
                    link.joint_angle = link.joint_angle - angle;
                }
                let torques = E::scale_torques(&constants, link);
                self.columns.write(STRAIN, own.slot + number, torques);
                place += V::LANES;
            }
        }
    }

    /// Computes the torques on each link of a generation, from its own joint and the joints of its
    /// children. Torques of springs are stored as derivatives of the energy, all others as torques.
    #[inline(always)]
    fn joint_torques<V: Simd<T>>(&mut self, generation: usize) {
        let (own, below) = (self.shape.at(generation), self.shape.at(generation + 1));
        let mut place = 0;
        while place < own.count {
            let slot = own.slot + place;
            let [spring, friction, drag]: [V; 3] = self.columns.read(SPRING, slot);
            let [springs, frictions]: [V; 2] =
                self.columns.of_children(SPRING, place, own.count, below);
            let mut row = [spring - springs, frictions - friction, -drag];
            for (number, between) in row.iter_mut().zip(self.between) {
                if !between.is_empty() {
                    *number = *number + load_front(between, own.whole + place);
                }
            }
            self.columns.write(SPRING, slot, row);
            place += V::LANES;
        }
    }

    /// Returns a generation and the generation before it; for the root, the root's generation
    /// twice.
    #[inline(always)]
    pub(super) fn pair(&self, generation: usize) -> (ScaleGeneration, ScaleGeneration) {
        let own = self.shape.at(generation);
        (own, self.shape.at(generation.saturating_sub(1)))
    }

    /// Computes the torques of the drive, and stores the external torques.
    #[inline(always)]
    pub(super) fn torques_of_drive<V: Simd<T>>(&mut self) {
        let [x, y, torque] = self.drive.unwrap_or([T::from_f64(0.0); 3]);
        for generation in 0..self.shape.count() {
            let own = self.shape.at(generation);
            let constants = self.constants::<V>(generation);
            let mut place = 0;
            while place < own.count {
                let slot = own.slot + place;
                if E::DRIVEN {
                    let link = self.columns.motion::<V>(slot);
                    let given = [V::splat(x), V::splat(y)];
                    let torque = E::scale_inertial(&constants, link, given);
                    self.columns.write(DRIVE, slot, torque);
                }
                if !self.torques.is_empty() {
                    let torque: V = load_front(self.torques, own.whole + place);
                    self.columns.write(OUTSIDE, slot, [torque]);
                }
                place += V::LANES;
            }
        }
        let [moved]: [T; 1] = self.columns.read(DRIVE, 0);
        let on_root = match E::DRIVEN {
            true => moved + torque,
            false => torque,
        };
        self.columns.write(DRIVE, 0, [on_root]);
    }

    /// Computes the velocities of all centres of mass, from the root to the leaves.
    #[inline(always)]
    pub(super) fn velocities<V: Simd<T>>(&mut self) {
        for generation in 0..self.shape.count() {
            let constants = self.constants::<V>(generation);
            let (own, above) = self.pair(generation);
            for copy in 0..own.count / above.count {
                let mut place = 0;
                while place < above.count {
                    let slot = own.slot + copy * above.count + place;
                    let pivot: [V; 2] = match generation {
                        0 => [V::from_f64(0.0); 2],
                        _ => self.columns.read(VELOCITY + 2, above.slot + place),
                    };
                    let link = self.columns.motion(slot);
                    let velocity = E::scale_velocity(&constants, link, pivot);
                    self.columns.write(VELOCITY, slot, velocity);
                    place += V::LANES;
                }
            }
        }
    }

    /// Computes the moments of momentum of all links, from the leaves to the root.
    #[inline(always)]
    pub(super) fn moments<V: Simd<T>>(&mut self) {
        for generation in (0..self.shape.count()).rev() {
            let constants = self.constants::<V>(generation);
            let (own, below) = (self.shape.at(generation), self.shape.at(generation + 1));
            let mut place = 0;
            while place < own.count {
                let slot = own.slot + place;
                let [x, y]: [V; 2] = self.columns.read(VELOCITY, slot);
                let [below_x, below_y]: [V; 2] =
                    self.columns.of_children(CARRIED, place, own.count, below);
                let link = self.columns.motion(slot);
                let moment = E::scale_moment(&constants, link, [x, y, below_x, below_y]);
                self.columns.write(MOMENT, slot, moment);
                place += V::LANES;
            }
        }
    }

    /// Computes the factors of the mass matrix, from the leaves to the root.
    #[inline(always)]
    pub(super) fn factors<V: Simd<T>>(&mut self) {
        for generation in (0..self.shape.count()).rev() {
            let constants = self.constants::<V>(generation);
            let (own, below) = (self.shape.at(generation), self.shape.at(generation + 1));
            let mut place = 0;
            while place < own.count {
                let slot = own.slot + place;
                let deficit: [V; 3] = self.columns.of_children(DEFICIT, place, own.count, below);
                let link = self.columns.motion(slot);
                let [xx, xy, yy, gain_x, gain_y, inverse] =
                    E::scale_factor(&constants, link, deficit);
                self.columns.write(DEFICIT, slot, [xx, xy, yy]);
                self.columns.write(GAIN, slot, [gain_x, gain_y, inverse]);
                place += V::LANES;
            }
        }
    }

    /// Splits all required quantities into scales; if `slopes` is true for the whole budget,
    /// otherwise for energies only.
    #[inline(always)]
    pub(super) fn split_all<V: Simd<T>>(&mut self, slopes: bool) {
        let fields = [
            (VELOCITY, field::VELOCITY, true),
            (VELOCITY + 1, field::VELOCITY + 1, true),
            (MOTION + 2, field::OMEGA, true),
            (RISE, field::RISE, true),
            (MOTION, field::SIDE, true),
            (STRAIN, field::STRAIN, E::SPRINGS),
            (MOMENT, field::MOMENT, slopes),
            (MOMENT + 1, field::MOMENT + 1, slopes),
            (SPRING, field::SPRING, slopes && E::SPRINGS),
        ];
        for (column, field, needed) in fields {
            let start = field * self.shape.parts;
            let Some(parts) = self.parts.get_mut(start..start + self.shape.parts) else {
                return;
            };
            if !needed {
                parts.fill(T::from_f64(0.0));
                continue;
            }
            for generation in 0..self.shape.count() {
                let own = self.shape.at(generation);
                let from = column * self.columns.length + own.slot;
                let to = SPLIT * self.columns.length;
                let numbers = &mut *self.columns.numbers;
                numbers.copy_within(from..from + own.count, to);
                let values = numbers.get_mut(to..to + own.count).unwrap_or_default();
                split::<T, V>(&self.shape, generation, values, parts);
            }
        }
    }
}
