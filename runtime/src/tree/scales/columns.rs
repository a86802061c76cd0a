//! Columns of numbers: in each column, one number for every link.

use super::shape::ScaleGeneration;
use crate::scalar::Scalar;
use crate::simd::Simd;
use crate::tree::LinkMotion;
use crate::tree::columns::load;

/// Index of the column with the sine of each link's angle; cosine and angular velocity are in the
/// next two.
pub(super) const MOTION: usize = 0;
/// Index of the column with the strain of the spring in each pivot; torques of springs, friction
/// and drag are in the next three.
pub(super) const STRAIN: usize = 3;
pub(super) const SPRING: usize = 4;
pub(super) const FRICTION: usize = 5;
pub(super) const DRAG: usize = 6;
/// Index of the column with the torques of the drive; external torques are in the next one.
pub(super) const DRIVE: usize = 7;
pub(super) const OUTSIDE: usize = 8;
/// Index of the first column with velocities of centres of mass; velocities of the children's
/// pivots follow.
pub(super) const VELOCITY: usize = 9;
/// Index of the first column with moments of the momentum that each link carries; this momentum
/// follows.
pub(super) const MOMENT: usize = 13;
pub(super) const CARRIED: usize = 15;
/// Index of the first column with the gain (two numbers); the inverse joint inertia follows.
pub(super) const GAIN: usize = 17;
/// Index of the first column with the deficit of articulated inertia (three numbers).
pub(super) const DEFICIT: usize = 20;
/// Index of the column with 1 − cos θ.
pub(super) const RISE: usize = 23;
/// Index of the column with values that are split into scales.
pub(super) const SPLIT: usize = 24;
/// Number of columns that describe a state.
pub(super) const ALL: usize = 25;

/// Index of the column with the bias force along the flow of one scale; later with the change of
/// momentum.
pub(super) const BIAS: usize = 0;
/// Column of the offset.
pub(super) const OFFSET: usize = 2;
/// Index of the first column with the motion of pivots along the flow, which the downward pass
/// computes.
pub(super) const PIVOT: usize = 3;
/// Index of the first column with changes of the velocities of centres of mass; those of the
/// children's pivots follow.
pub(super) const SHIFT: usize = 5;
/// Number of columns for the flow of one scale.
pub(super) const WORKING: usize = 9;

/// View of a slice as columns with one number per link.
pub(super) struct ScaleColumns<'a, T> {
    pub(super) numbers: &'a mut [T],
    /// Length of each column.
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

    /// Reads numbers of `count` neighbouring links from `N` columns, padded with zeros.
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

    /// Returns, for links of one generation, the sums of numbers over their children.
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

    /// Returns the motion of the links at `place`, without their joint motion.
    #[inline(always)]
    pub(super) fn motion<V: Simd<T>>(&self, place: usize) -> LinkMotion<V> {
        let [sine, cosine, omega] = self.read(MOTION, place);
        LinkMotion::turning(sine, cosine, omega)
    }

    /// Copies numbers of two consecutive columns from another view.
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
