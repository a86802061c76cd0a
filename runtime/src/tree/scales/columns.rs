//! Columns of numbers of all links, one behind the other.

use super::shape::ScaleGeneration;
use crate::scalar::Scalar;
use crate::simd::Simd;
use crate::tree::LinkMotion;
use crate::tree::columns::load;

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
/// Moments of the momentum of what links carry, then that momentum.
pub(super) const MOMENT: usize = 13;
pub(super) const CARRIED: usize = 15;
/// Gain, inverse joint inertia.
pub(super) const GAIN: usize = 17;
/// Deficit of articulated inertia.
pub(super) const DEFICIT: usize = 20;
/// 1 − cos θ.
pub(super) const RISE: usize = 23;
/// Values that are split.
pub(super) const SPLIT: usize = 24;
/// Number of columns of a state.
pub(super) const ALL: usize = 25;

/// Columns along the flow of one scale: the bias force, and in its place the change of
/// momentum.
pub(super) const BIAS: usize = 0;
/// Offset.
pub(super) const OFFSET: usize = 2;
/// Motion of pivots, handed down along the flow.
pub(super) const PIVOT: usize = 3;
/// Changes of velocities of centres of mass, then of the children's pivots.
pub(super) const SHIFT: usize = 5;
/// Number of columns along the flow of a scale.
pub(super) const WORKING: usize = 9;

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

    /// Reads the numbers of so many links, and zeros behind them.
    #[inline(always)]
    pub(super) fn read_some<V: Simd<T>, const N: usize>(
        &self,
        first: usize,
        place: usize,
        count: usize,
    ) -> [V; N] {
        let (zero, mut row) = (V::from_f64(0.0), self.read::<V, N>(first, place));
        for number in &mut row {
            *number = number.in_first_lanes(count, zero);
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
        LinkMotion::turning(sine, cosine, omega)
    }

    /// Copies some numbers of two consecutive columns of others, from a place there to one
    /// here.
    pub(super) fn copy_two(
        &mut self,
        first: usize,
        place: usize,
        from: &ScaleColumns<'_, T>,
        (other, length): (usize, usize),
    ) {
        for column in first..first + 2 {
            let (to, from_place) = (column * self.length + place, column * from.length + other);
            let own = self.numbers.get_mut(to..to + length);
            let others = from.numbers.get(from_place..from_place + length);
            if let (Some(own), Some(others)) = (own, others) {
                own.copy_from_slice(others);
            }
        }
    }
}
