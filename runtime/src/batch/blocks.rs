//! Evaluation of a batch, one register of states at a time.

use crate::scalar::Lane;
use crate::simd::{Kernel, Simd, WithSinCos};
use crate::system::known;
use crate::system::{InRegisters, Pendulum};

/// All states of a batch that fills at least one register, with the function to compute. Lengths of
/// slices have been checked.
pub(super) struct Blocks<'a, P, T, In, On, Out> {
    pub(super) pendulum: &'a P,
    pub(super) time: T,
    pub(super) count: usize,
    pub(super) buffer: &'a mut [T],
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
    /// Number of evaluated states.
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
    /// Evaluates the states register by register. The last register starts with state `last`; if it
    /// would not be full, it overlaps the one before, so that some states are computed twice.
    #[inline(always)]
    fn in_turn<R: Simd<T>>(self, last: usize) -> usize {
        let mut next = 0;
        let links = self.pendulum.links();
        // As many links as the compiler knows them to be.
        let (Some(theta), Some(omega), Some(alpha)) = (
            self.theta.get(..links),
            self.omega.get(..links),
            self.alpha.get_mut(..links),
        ) else {
            return next;
        };
        let mut pendulum = self.pendulum.in_registers::<R>(self.time, self.buffer);
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

    /// Evaluates all registers of states of a model with `L` links. The sines of the next register
    /// are computed before each register is finished. The operations after the sines are few,
    /// depend on each other and contain a division, so that the processor can overlap them with
    /// sines.
    #[inline(always)]
    fn ahead<R: Simd<T>, const L: usize>(self, last: usize) -> usize {
        let (Some(theta), Some(omega), Some(alpha)) = (
            self.theta.first_chunk::<L>(),
            self.omega.first_chunk::<L>(),
            self.alpha.first_chunk_mut::<L>(),
        ) else {
            return 0;
        };
        let pendulum = self.pendulum.cast(|x| WithSinCos::number(R::splat(x)));
        let time = WithSinCos::number(R::splat(self.time));
        let nothing = R::splat(T::from_f64(f64::NAN));
        let mut end = R::LANES;
        let mut turned = sines::<T, R, L>(theta, end, nothing);
        loop {
            let next = end.min(last) + R::LANES;
            let turned_next = sines::<T, R, L>(theta, next, nothing);
            let (sines, cosines) = turned;
            pendulum.evaluate(
                time,
                |link| WithSinCos::angle(load(theta, link, end, nothing), link, &sines, &cosines),
                |link| WithSinCos::number(load(omega, link, end, nothing)),
                |link, value: WithSinCos<R>| store(alpha, link, end, value.number),
            );
            if end == self.count {
                return end;
            }
            (end, turned) = (next, turned_next);
        }
    }
}

/// Computes the sines and cosines of the register of states that ends before state `end`.
#[inline(always)]
fn sines<T: Lane, R: Simd<T>, const L: usize>(
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

/// Reads one register of one link's numbers that ends before state `end`; returns `nothing` if the
/// slice is too short, which cannot happen.
#[inline(always)]
fn load<T: Lane, R: Simd<T>>(slices: &[impl AsRef<[T]>], link: usize, end: usize, nothing: R) -> R {
    let slice = slices.get(link).and_then(|slice| slice.as_ref().get(..end));
    slice.and_then(R::last_chunk).map_or(nothing, R::from_chunk)
}

/// Writes the register that [`load`] reads.
#[inline(always)]
fn store<T: Lane, R: Simd<T>>(slices: &mut [impl AsMut<[T]>], link: usize, end: usize, value: R) {
    if let Some(slice) = slices.get_mut(link) {
        value.store_last(slice.as_mut().get_mut(..end).unwrap_or_default());
    }
}

/// Reads a register like [`load`], at the time at which it is needed, because it selects an address
/// and not a number.
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
