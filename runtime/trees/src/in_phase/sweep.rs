//! The way through a tree whose copies are in phase: plain numbers above the copies that differ,
//! numbers with the change by their difference within.

use std::marker::PhantomData;

use branched_pendulum::scalar::{Dual, Scalar};
use branched_pendulum::tree::{LinkEquations, LinkMotion, RootDrive, Row};

use super::merged::MergedLink;

/// A number with what a small difference changes it by: a plain one for links that it leaves as
/// they are.
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

/// A number that changes.
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

/// One evaluation. Each number of a link is followed by its change.
pub(super) struct InPhaseSweep<'a, E, T> {
    links: &'a [MergedLink],
    /// A row of constants for each link.
    rows: &'a [T],
    drive: Option<RootDrive<T>>,
    room: &'a mut [T],
    equations: PhantomData<E>,
}

/// Places of a link's numbers in its room.
const ANGLE: usize = 0;
const RATE: usize = 2;
const TORQUE: usize = 4;
const SINE: usize = 6;
const COSINE: usize = 8;
/// Responses of the children.
const SUMS: usize = 10;

impl<'a, E: LinkEquations, T: Scalar> InPhaseSweep<'a, E, T> {
    /// Place of what is kept for the way down.
    const ELIMINATION: usize = SUMS + 2 * <E::Sums<T> as Row<T>>::LENGTH;

    /// Place of what children are handed on the way down.
    const CARRIED: usize = Self::ELIMINATION + 2 * <E::Elimination<T> as Row<T>>::LENGTH;

    /// Numbers of a link.
    pub(super) const ROOM: usize = Self::CARRIED + 2 * <E::Carried<T> as Row<T>>::LENGTH;

    /// There is a row of constants for each link, and room for its numbers.
    #[inline(always)]
    pub(super) fn new(
        links: &'a [MergedLink],
        rows: &'a [T],
        drive: Option<RootDrive<T>>,
        room: &'a mut [T],
    ) -> Self {
        Self {
            links,
            rows,
            drive,
            room,
            equations: PhantomData,
        }
    }

    /// Sets the state of a link: its angle, its angular velocity and the torque on it from
    /// elsewhere, each with its change.
    #[inline(always)]
    pub(super) fn set(&mut self, link: usize, state: [[T; 2]; 3]) {
        let zero = T::from_f64(0.0);
        let [[angle, change], ..] = state;
        let (sine, cosine) = angle.sin_cos();
        let room = &mut self.room[link * Self::ROOM..][..Self::ELIMINATION];
        for (place, [value, change]) in [ANGLE, RATE, TORQUE].into_iter().zip(state) {
            (room[place], room[place + 1]) = (value, change);
        }
        (room[SINE], room[SINE + 1]) = (sine, cosine * change);
        (room[COSINE], room[COSINE + 1]) = (cosine, -(sine * change));
        for sum in &mut room[SUMS..] {
            *sum = zero;
        }
    }

    /// From the last link to the root: responses, added to the sums of the parents. Those of the
    /// copies that differ have no change on what holds them: it is opposite in both.
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

    /// From the root to the last link: gives the angular acceleration of each, and its change.
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
        let own = &self.room[link * Self::ROOM + place..][..2 * R::LENGTH];
        for (number, pair) in row.as_mut().iter_mut().zip(own.chunks_exact(2)) {
            *number = V::of(pair[0], pair[1]);
        }
        row
    }

    #[inline(always)]
    fn write<V: Changed<T>, R: Row<V>>(&mut self, link: usize, place: usize, row: &R) {
        let own = &mut self.room[link * Self::ROOM + place..][..2 * R::LENGTH];
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
            held: V::from_f64(0.0),
        }
    }
}
