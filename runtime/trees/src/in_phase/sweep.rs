//! Evaluation of an in-phase tree, link by link: plain numbers are used above the copies that
//! differ, and within these copies numbers that carry their change by the difference.

use std::marker::PhantomData;

use branched_pendulum::scalar::{Dual, Scalar};
use branched_pendulum::tree::{LinkEquations, LinkMotion, RootDrive, Row};

use super::merged::MergedLink;

/// A number with its derivative by a small difference; or a plain number, for links that the
/// difference does not affect.
trait Changed<T>: Scalar {
    fn of(value: T, change: T) -> Self;

    fn change(self) -> T;

    fn value(self) -> T;
}

impl<T: Scalar> Changed<T> for T {
    #[inline(always)]
    fn of(value: T, _: T) -> T {
        value
    }

    #[inline(always)]
    fn change(self) -> T {
        T::from_f64(0.0)
    }

    #[inline(always)]
    fn value(self) -> T {
        self
    }
}

/// A number with its change.
type WithChange<T> = Dual<T, 1>;

impl<T: Scalar> Changed<T> for WithChange<T> {
    #[inline(always)]
    fn of(value: T, change: T) -> Self {
        Self {
            value,
            tangents: [change],
        }
    }

    #[inline(always)]
    fn change(self) -> T {
        self.tangents[0]
    }

    #[inline(always)]
    fn value(self) -> T {
        self.value
    }
}

/// One evaluation of an in-phase tree. Each number of a link is followed by its change.
pub(super) struct InPhaseSweep<'a, E, T> {
    links: &'a [MergedLink],
    /// Constants, one row for each link.
    rows: &'a [T],
    drive: Option<RootDrive<T>>,
    buffer: &'a mut [T],
    equations: PhantomData<E>,
}

/// Offset of the angle within a link's numbers.
const ANGLE: usize = 0;
const RATE: usize = 2;
const TORQUE: usize = 4;
const SINE: usize = 6;
const COSINE: usize = 8;
/// Offset of the sums of the children's responses within a link's numbers.
const SUMS: usize = 10;

impl<'a, E: LinkEquations, T: Scalar> InPhaseSweep<'a, E, T> {
    /// Offset, within a link's numbers, of the numbers that the upward pass keeps for the downward
    /// pass.
    const ELIMINATION: usize = SUMS + 2 * <E::Sums<T> as Row<T>>::LENGTH;

    /// Offset, within a link's numbers, of the numbers that the downward pass passes to children.
    const CARRIED: usize = Self::ELIMINATION + 2 * <E::Elimination<T> as Row<T>>::LENGTH;

    /// Number of values per link in the buffer.
    pub(super) const WORKSPACE_LEN: usize = Self::CARRIED + 2 * <E::Carried<T> as Row<T>>::LENGTH;

    /// Creates an evaluation, given a row of constants per link and a buffer for the links'
    /// numbers.
    #[inline(always)]
    pub(super) fn new(
        links: &'a [MergedLink],
        rows: &'a [T],
        drive: Option<RootDrive<T>>,
        buffer: &'a mut [T],
    ) -> Self {
        Self {
            links,
            rows,
            drive,
            buffer,
            equations: PhantomData,
        }
    }

    /// Sets angle, angular velocity and external torque of a link, each with its change.
    #[inline(always)]
    pub(super) fn set(&mut self, link: usize, state: [[T; 2]; 3]) {
        let zero = T::from_f64(0.0);
        let [[angle, change], ..] = state;
        let (sine, cosine) = angle.sin_cos();
        let buffer = &mut self.buffer[link * Self::WORKSPACE_LEN..][..Self::ELIMINATION];
        for (place, [value, change]) in [ANGLE, RATE, TORQUE].into_iter().zip(state) {
            (buffer[place], buffer[place + 1]) = (value, change);
        }
        (buffer[SINE], buffer[SINE + 1]) = (sine, cosine * change);
        (buffer[COSINE], buffer[COSINE + 1]) = (cosine, -(sine * change));
        for sum in &mut buffer[SUMS..] {
            *sum = zero;
        }
    }

    /// Makes the upward pass, from the last link to the root: computes responses and adds them to
    /// the sums of the parents. The copies that differ add no change to their parent, because their
    /// changes are opposite.
    #[inline(always)]
    pub(super) fn up(&mut self) {
        for link in (0..self.links.len()).rev() {
            let MergedLink {
                parent,
                difference,
                carries,
                ..
            } = self.links[link];
            match difference {
                Some(_) if self.links[parent].difference.is_some() => {
                    let response = self.respond::<WithChange<T>>(link);
                    self.hand_up(link, response);
                }
                Some(_) if carries => {
                    let response = self.respond::<WithChange<T>>(link);
                    let mut plain = E::Response::<T>::filled(T::from_f64(0.0));
                    let both = plain.as_mut().iter_mut().zip(response.as_ref());
                    for (plain, number) in both {
                        *plain = number.value;
                    }
                    self.hand_up::<T>(link, plain);
                }
                _ => {
                    let response = self.respond::<T>(link);
                    if link > 0 {
                        self.hand_up::<T>(link, response);
                    }
                }
            }
        }
    }

    /// Makes the downward pass, from the root to the last link: computes the angular acceleration
    /// of each link and its change, and passes both to `alpha`.
    #[inline(always)]
    pub(super) fn down(&mut self, root: [T; 2], mut alpha: impl FnMut(usize, T, T)) {
        for link in 0..self.links.len() {
            let MergedLink {
                parent, difference, ..
            } = self.links[link];
            let [value, change] = match difference {
                Some(_) if self.links[parent].difference.is_some() => {
                    let pivot = self.pivot::<WithChange<T>>(link);
                    self.accelerate(link, pivot)
                }
                Some(_) => {
                    let [x, y] = self.pivot::<T>(link);
                    let pivot = [Dual::constant(x), Dual::constant(y)];
                    self.accelerate::<WithChange<T>>(link, pivot)
                }
                None if link == 0 => self.accelerate::<T>(link, root),
                None => {
                    let pivot = self.pivot::<T>(link);
                    self.accelerate(link, pivot)
                }
            };
            alpha(link, value, change);
        }
    }

    #[inline(always)]
    fn respond<V: Changed<T>>(&mut self, link: usize) -> E::Response<V> {
        let (constants, motion) = (self.constants::<V>(link), self.motion(link));
        if !self.links[link].carries {
            return E::leaf(&constants, motion);
        }
        let sums = self.read(link, SUMS);
        let (response, elimination) = E::inner(&constants, motion, sums);
        self.write(link, Self::ELIMINATION, &elimination);
        response
    }

    #[inline(always)]
    fn hand_up<V: Changed<T>>(&mut self, link: usize, response: E::Response<V>) {
        let parent = self.links[link].parent;
        let mut sums = E::attach(&self.constants::<V>(link), self.motion(parent), response);
        let others: E::Sums<V> = self.read(parent, SUMS);
        for (sum, &other) in sums.as_mut().iter_mut().zip(others.as_ref()) {
            *sum = *sum + other;
        }
        self.write(parent, SUMS, &sums);
    }

    #[inline(always)]
    fn pivot<V: Changed<T>>(&self, link: usize) -> [V; 2] {
        let parent = self.links[link].parent;
        let carried = self.read(parent, Self::CARRIED);
        E::pivot(&self.constants::<V>(link), self.motion(parent), carried)
    }

    #[inline(always)]
    fn accelerate<V: Changed<T>>(&mut self, link: usize, pivot: [V; 2]) -> [T; 2] {
        let (constants, motion) = (self.constants::<V>(link), self.motion(link));
        let acceleration = match self.links[link].carries {
            false => E::accelerate_leaf(&constants, motion, pivot),
            true => {
                let elimination = self.read(link, Self::ELIMINATION);
                let (acceleration, carried) = E::accelerate(&constants, motion, elimination, pivot);
                self.write(link, Self::CARRIED, &carried);
                acceleration
            }
        };
        [acceleration.value(), acceleration.change()]
    }

    #[inline(always)]
    fn read<V: Changed<T>, R: Row<V>>(&self, link: usize, place: usize) -> R {
        let mut row = R::filled(V::from_f64(0.0));
        let own = &self.buffer[link * Self::WORKSPACE_LEN + place..][..2 * R::LENGTH];
        for (number, pair) in row.as_mut().iter_mut().zip(own.chunks_exact(2)) {
            *number = V::of(pair[0], pair[1]);
        }
        row
    }

    #[inline(always)]
    fn write<V: Changed<T>, R: Row<V>>(&mut self, link: usize, place: usize, row: &R) {
        let own = &mut self.buffer[link * Self::WORKSPACE_LEN + place..][..2 * R::LENGTH];
        for (number, pair) in row.as_ref().iter().zip(own.chunks_exact_mut(2)) {
            (pair[0], pair[1]) = (number.value(), number.change());
        }
    }

    #[inline(always)]
    fn constants<V: Changed<T>>(&self, link: usize) -> E::Constants<V> {
        let zero = T::from_f64(0.0);
        let mut row = E::Constants::<V>::filled(V::from_f64(0.0));
        let length = <E::Constants<V> as Row<V>>::LENGTH;
        let own = &self.rows[link * length..][..length];
        for (number, &constant) in row.as_mut().iter_mut().zip(own) {
            *number = V::of(constant, zero);
        }
        if E::TORQUE
            && link == 0
            && let (Some(drive), Some(last)) = (self.drive, row.as_mut().last_mut())
        {
            *last = V::of(drive.torque, zero);
        }
        row
    }

    #[inline(always)]
    fn number<V: Changed<T>>(&self, link: usize, place: usize) -> V {
        let [number] = self.read(link, place);
        number
    }

    #[inline(always)]
    fn motion<V: Changed<T>>(&self, link: usize) -> LinkMotion<V> {
        let (angle, rate): (V, V) = (self.number(link, ANGLE), self.number(link, RATE));
        let (joint_angle, joint_rate) = match link {
            0 => (angle, rate),
            _ => {
                let parent = self.links[link].parent;
                let above: V = self.number(parent, ANGLE);
                (angle - above, rate - self.number(parent, RATE))
            }
        };
        LinkMotion {
            sine: self.number(link, SINE),
            cosine: self.number(link, COSINE),
            omega: rate,
            joint_angle,
            joint_rate,
            outside_torque: self.number(link, TORQUE),
            prescribed: V::from_f64(0.0),
        }
    }
}
