//! Columns of numbers of all links, one behind the other.

use super::parts::load;
use super::shape::ScaleGeneration;
use crate::scalar::Scalar;
use crate::simd::Simd;
use crate::tree::LinkMotion;

/// Sine and cosine of each link's angle, angular velocity.
pub(super) const MOTION: usize = 0;
/// Strain of springs; torques of springs, friction and drag.
pub(super) const STRAIN: usize = 3;
pub(super) const SPRING: usize = 4;
pub(super) const FRICTION: usize = 5;
pub(super) const DRAG: usize = 6;
/// Torques of the drive and from outside.
pub(super) const DRIVE: usize = 7;
pub(super) const OUTSIDE: usize = 8;
/// Velocities of centres of mass, then of the children's pivots.
pub(super) const VELOCITY: usize = 9;
/// Moments of the momentum of what links carry, then that momentum. Along the flow of a
/// scale, the bias force and the momentum's change stand in the place of the latter.
pub(super) const MOMENT: usize = 13;
pub(super) const CARRIED: usize = 15;
/// Gain, inverse joint inertia.
pub(super) const GAIN: usize = 17;
/// Deficit of articulated inertia; afterwards what is handed down along the flow (two),
/// and the offset.
pub(super) const DEFICIT: usize = 20;
pub(super) const PIVOT: usize = 20;
pub(super) const OFFSET: usize = 22;
/// Changes of velocities along the flow.
pub(super) const SHIFT: usize = 23;
/// 1 − cos θ.
pub(super) const RISE: usize = 27;
/// Values that are split.
pub(super) const SPLIT: usize = 28;
/// Angular velocity along the flow of each scale's energy, and its slope, in turns.
pub(super) const FLOW: usize = 29;

/// The columns.
pub(super) struct ScaleColumns<'a, T> {
    pub(super) numbers: &'a mut [T],
    /// Length of each.
    pub(super) length: usize,
}

impl<T: Scalar> ScaleColumns<'_, T> {
    #[inline(always)]
    pub(super) fn read<V: Simd<T>, const N: usize>(&self, first: usize, place: usize) -> [V; N] {
        let mut row = [V::from_f64(0.0); N];
        for (index, number) in row.iter_mut().enumerate() {
            *number = load(self.numbers, (first + index) * self.length + place);
        }
        row
    }

    #[inline(always)]
    pub(super) fn write<V: Simd<T>, const N: usize>(
        &mut self,
        first: usize,
        place: usize,
        row: [V; N],
    ) {
        for (index, number) in row.into_iter().enumerate() {
            let start = (first + index) * self.length + place;
            number.store(self.numbers.get_mut(start..).unwrap_or_default());
        }
    }

    /// Sum over the children of links of one generation.
    #[inline(always)]
    pub(super) fn of_children<V: Simd<T>, const N: usize>(
        &self,
        first: usize,
        place: usize,
        count: usize,
        below: ScaleGeneration,
    ) -> [V; N] {
        let mut sum = [V::from_f64(0.0); N];
        for copy in 0..below.copies {
            let row: [V; N] = self.read(first, below.slot + copy * count + place);
            for (sum, number) in sum.iter_mut().zip(row) {
                *sum = *sum + number;
            }
        }
        sum
    }

    /// The motion of links but for what joints do.
    #[inline(always)]
    pub(super) fn motion<V: Simd<T>>(&self, place: usize) -> LinkMotion<V> {
        let [sine, cosine, omega] = self.read(MOTION, place);
        LinkMotion {
            sine,
            cosine,
            omega,
            joint_angle: omega,
            joint_rate: omega,
            outside_torque: omega,
        }
    }

    /// Part of a column.
    pub(super) fn part_mut(&mut self, number: usize, place: usize, length: usize) -> &mut [T] {
        let start = number * self.length + place;
        self.numbers
            .get_mut(start..start + length)
            .unwrap_or_default()
    }
}
