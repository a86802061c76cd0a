//! States of a batch, a register at a time.

use crate::scalar::Lane;
use crate::simd::{Kernel, Known, Simd};
use crate::system::known;
use crate::system::{InRegisters, Pendulum};

/// All states, if they are enough for one register; lengths checked.
pub(super) struct Blocks<'a, P, T, In, On, Out> {
    pub(super) pendulum: &'a P,
    pub(super) time: T,
    pub(super) count: usize,
    pub(super) room: &'a mut [T],
    pub(super) theta: &'a [In],
    pub(super) omega: &'a [On],
    pub(super) alpha: &'a mut [Out],
}

impl<P, T, In, On, Out> Kernel<T> for Blocks<'_, P, T, In, On, Out>
where
    P: Pendulum<T>,
    T: Lane,
    In: AsRef<[T]>,
    On: AsRef<[T]>,
    Out: AsMut<[T]>,
{
    /// Number of states that it has done.
    type Output = usize;

    #[inline(always)]
    fn run<R: Simd<T>>(self) -> usize {
        let Some(last) = self.count.checked_sub(R::LANES) else {
            return 0;
        };
        match const { known(P::KNOWN_LINKS) } {
            1 if R::AHEAD => self.ahead::<R, 1>(last),
            2 if R::AHEAD => self.ahead::<R, 2>(last),
            3 if R::AHEAD => self.ahead::<R, 3>(last),
            _ => self.in_turn::<R>(last),
        }
    }
}

impl<P, T, In, On, Out> Blocks<'_, P, T, In, On, Out>
where
    P: Pendulum<T>,
    T: Lane,
    In: AsRef<[T]>,
    On: AsRef<[T]>,
    Out: AsMut<[T]>,
{
    /// A register of states after the other; the last one starts
    /// with state `last`, and overlaps the one before, where it would not be full: some
    /// states are computed twice.
    #[inline(always)]
    fn in_turn<R: Simd<T>>(self, last: usize) -> usize {
        let mut next = 0;
        let links = self.pendulum.links();
        // Links as many as the compiler knows them to be.
        let (Some(theta), Some(omega), Some(alpha)) = (
            self.theta.get(..links),
            self.omega.get(..links),
            self.alpha.get_mut(..links),
        ) else {
            return next;
        };
        let mut pendulum = self.pendulum.in_registers::<R>(self.time, self.room);
        let nothing = R::splat(T::from_f64(f64::NAN)).to_chunk();
        while next < self.count {
            let end = next.min(last) + R::LANES;
            pendulum.evaluate(
                |link| load_late(theta, link, end, &nothing),
                |link| load_late(omega, link, end, &nothing),
                |link, value: R| store(alpha, link, end, value),
            );
            next = end;
        }
        next
    }

    /// All registers of states, of `L` links. Before one, the sines of the next one are
    /// computed: what follows sines is few operations that wait for each other and for a
    /// division, and they do so while the processor is busy with the others.
    #[inline(always)]
    fn ahead<R: Simd<T>, const L: usize>(self, last: usize) -> usize {
        let (Some(theta), Some(omega), Some(alpha)) = (
            self.theta.first_chunk::<L>(),
            self.omega.first_chunk::<L>(),
            self.alpha.first_chunk_mut::<L>(),
        ) else {
            return 0;
        };
        let pendulum = self.pendulum.cast(|x| Known::number(R::splat(x)));
        let time = Known::number(R::splat(self.time));
        let nothing = R::splat(T::from_f64(f64::NAN));
        let mut end = R::LANES;
        let mut turned = turns::<T, R, L>(theta, end, nothing);
        loop {
            let next = end.min(last) + R::LANES;
            let turned_next = turns::<T, R, L>(theta, next, nothing);
            let (sines, cosines) = turned;
            pendulum.evaluate(
                time,
                |link| Known::angle(load(theta, link, end, nothing), link, &sines, &cosines),
                |link| Known::number(load(omega, link, end, nothing)),
                |link, value: Known<R>| store(alpha, link, end, value.number),
            );
            if end == self.count {
                return end;
            }
            (end, turned) = (next, turned_next);
        }
    }
}

/// Sines and cosines of the states that end before `end`.
#[inline(always)]
fn turns<T: Lane, R: Simd<T>, const L: usize>(
    theta: &[impl AsRef<[T]>; L],
    end: usize,
    nothing: R,
) -> ([R; L], [R; L]) {
    let mut angles = [nothing; L];
    for (link, angle) in angles.iter_mut().enumerate() {
        *angle = load(theta, link, end, nothing);
    }
    R::sin_cos_each(&angles)
}

/// One register of one link, that ends before state `end`; `nothing` where the slice is
/// too short, which has been excluded.
#[inline(always)]
fn load<T: Lane, R: Simd<T>>(slices: &[impl AsRef<[T]>], link: usize, end: usize, nothing: R) -> R {
    let slice = slices.get(link).and_then(|slice| slice.as_ref().get(..end));
    slice.and_then(R::last_chunk).map_or(nothing, R::from_chunk)
}

/// Writes what [`load`] reads.
#[inline(always)]
fn store<T: Lane, R: Simd<T>>(slices: &mut [impl AsMut<[T]>], link: usize, end: usize, value: R) {
    if let Some(slice) = slices.get_mut(link) {
        value.store_last(slice.as_mut().get_mut(..end).unwrap_or_default());
    }
}

/// As [`load`], where the number is needed: the choice is between places and
/// not numbers.
#[inline(always)]
fn load_late<T: Lane, R: Simd<T>>(
    slices: &[impl AsRef<[T]>],
    link: usize,
    end: usize,
    nothing: &R::Chunk,
) -> R {
    let block = slices.get(link).and_then(|slice| slice.as_ref().get(..end));
    R::from_chunk(block.and_then(R::last_chunk).unwrap_or(nothing))
}
