//! States of a batch, a register at a time.

use crate::scalar::dispatch::RegisterKernel;
use crate::scalar::register::{Block, Known, Register};
use crate::scalar::{Lane, Scalar};
use crate::system::{Cast, InRegisters};

/// Links up to which two registers are computed in step: so few alone have not
/// enough operations that need not wait for each other. With more links the values
/// of two registers of states do not find room.
const FEW: usize = 3;

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

impl<P, T, In, On, Out> RegisterKernel<T> for Blocks<'_, P, T, In, On, Out>
where
    P: Cast<T>,
    T: Lane,
    In: AsRef<[T]>,
    On: AsRef<[T]>,
    Out: AsMut<[T]>,
{
    /// Number of states that it has done.
    type Output = usize;

    #[inline(always)]
    fn run<R: Register<Lane = T>>(mut self) -> usize {
        let Some(last) = self.count.checked_sub(R::LANES) else {
            return 0;
        };
        if R::AHEAD {
            match P::LINKS {
                1 => self.ahead::<R, 1>(last),
                2 => self.ahead::<R, 2>(last),
                3 => self.ahead::<R, 3>(last),
                _ => self.in_turn::<R>(0, last),
            }
        } else {
            let next = self.in_step::<R>();
            self.in_turn::<R>(next, last)
        }
    }
}

impl<P, T, In, On, Out> Blocks<'_, P, T, In, On, Out>
where
    P: Cast<T>,
    T: Lane,
    In: AsRef<[T]>,
    On: AsRef<[T]>,
    Out: AsMut<[T]>,
{
    /// A register of states after the other from state `next` on; the last one starts
    /// with state `last`, and overlaps the one before, where it would not be full: some
    /// states are computed twice.
    #[inline(always)]
    fn in_turn<R: Register<Lane = T>>(self, mut next: usize, last: usize) -> usize {
        // Links as many as the compiler knows them to be.
        let (Some(theta), Some(omega), Some(alpha)) = (
            self.theta.get(..P::LINKS),
            self.omega.get(..P::LINKS),
            self.alpha.get_mut(..P::LINKS),
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

    /// Two registers of states in step, up to [`FEW`] links, as often as they are full;
    /// gives the next state.
    #[inline(always)]
    fn in_step<R: Register<Lane = T>>(&mut self) -> usize {
        let mut next = 0;
        if P::LINKS <= FEW {
            let pendulum = self.pendulum.cast(Block::<R, 2>::splat);
            while next + 2 * R::LANES <= self.count {
                if !self.block(&pendulum, next) {
                    return next;
                }
                next += 2 * R::LANES;
            }
        }
        next
    }

    /// The states from `start` on, as many as a block holds; false if there are
    /// not so many.
    #[inline(always)]
    fn block<R: Register<Lane = T>, const N: usize>(
        &mut self,
        pendulum: &P::Of<Block<R, N>>,
        start: usize,
    ) -> bool {
        // Links as many as the compiler knows them to be.
        let (Some(theta), Some(omega), Some(alpha)) = (
            self.theta.get(..P::LINKS),
            self.omega.get(..P::LINKS),
            self.alpha.get_mut(..P::LINKS),
        ) else {
            return false;
        };
        // Known, and asked here so that the compiler knows it too and reads the
        // numbers below without a question for each.
        for (theta, omega) in theta.iter().zip(omega) {
            for i in 0..N {
                let start = start + i * R::LANES;
                let angles = from::<R>(theta.as_ref(), start);
                if angles.is_none() || from::<R>(omega.as_ref(), start).is_none() {
                    return false;
                }
            }
        }
        pendulum.evaluate(
            Block::splat(self.time),
            |link| load_block(theta, link, start),
            |link| load_block(omega, link, start),
            |link, value: Block<R, N>| {
                let Some(slice) = alpha.get_mut(link) else {
                    return;
                };
                for i in 0..N {
                    let start = start + i * R::LANES;
                    if let Some(states) = slice.as_mut().get_mut(start..start + R::LANES) {
                        value.0[i].store(states);
                    }
                }
            },
        );
        true
    }

    /// All registers of states, of `L` links. Before one, the sines of the next one are
    /// computed: what follows sines is few operations that wait for each other and for a
    /// division, and they do so while the processor is busy with the others.
    #[inline(always)]
    fn ahead<R: Register<Lane = T>, const L: usize>(self, last: usize) -> usize {
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
        let mut turned = turns::<R, L>(theta, end, nothing);
        loop {
            let next = end.min(last) + R::LANES;
            let turned_next = turns::<R, L>(theta, next, nothing);
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

/// The register that starts with state `start`.
#[inline(always)]
fn from<R: Register>(states: &[R::Lane], start: usize) -> Option<R> {
    states.get(start..start + R::LANES).and_then(R::load)
}

/// The block of one link that starts with state `start`.
#[inline(always)]
fn load_block<R: Register, const N: usize>(
    slices: &[impl AsRef<[R::Lane]>],
    link: usize,
    start: usize,
) -> Block<R, N> {
    // Lengths have been checked.
    let mut block = Block::from_f64(f64::NAN);
    if let Some(slice) = slices.get(link) {
        for i in 0..N {
            if let Some(register) = from(slice.as_ref(), start + i * R::LANES) {
                block.0[i] = register;
            }
        }
    }
    block
}

/// Sines and cosines of the states that end before `end`.
#[inline(always)]
fn turns<R: Register, const L: usize>(
    theta: &[impl AsRef<[R::Lane]>; L],
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
fn load<R: Register>(slices: &[impl AsRef<[R::Lane]>], link: usize, end: usize, nothing: R) -> R {
    let slice = slices.get(link).and_then(|slice| slice.as_ref().get(..end));
    slice.and_then(R::last_chunk).map_or(nothing, R::from_chunk)
}

/// Writes what [`load`] reads.
#[inline(always)]
fn store<R: Register>(slices: &mut [impl AsMut<[R::Lane]>], link: usize, end: usize, value: R) {
    if let Some(slice) = slices.get_mut(link) {
        value.store_last(slice.as_mut().get_mut(..end).unwrap_or_default());
    }
}

/// As [`load`], where the number is needed: the choice is between places and
/// not numbers.
#[inline(always)]
fn load_late<R: Register>(
    slices: &[impl AsRef<[R::Lane]>],
    link: usize,
    end: usize,
    nothing: &R::Chunk,
) -> R {
    let block = slices.get(link).and_then(|slice| slice.as_ref().get(..end));
    R::from_chunk(block.and_then(R::last_chunk).unwrap_or(nothing))
}
