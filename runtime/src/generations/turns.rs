//! What every recursion reads of the angles, formed before it.

use super::evaluate::copy;
use super::sweep::Sweep;
use super::vector::{SliceKernel, Vector, Vectors};
use crate::scalar::Scalar;

/// Sines and cosines of a part's angles.
pub(super) struct Turns<'a, 'b, T>(pub(super) &'a mut Sweep<'b, T>);

impl<T: Scalar> SliceKernel<T> for Turns<'_, '_, T> {
    #[inline(always)]
    fn run<W: Vectors<T>>(self) {
        let Sweep {
            part,
            theta,
            storage,
            ..
        } = self.0;
        for run in part.all() {
            let own = run.own..run.own + run.length;
            let slices = (
                theta.get(run.whole..run.whole + run.length),
                storage.sines.get_mut(own.clone()),
                storage.cosines.get_mut(own),
            );
            if let (Some(angles), Some(sines), Some(cosines)) = slices {
                turn::<T, W::Wide>(angles, sines, cosines);
            }
        }
    }
}

/// Most numbers in a register.
const MOST: usize = 16;

/// The slices have one length. The last vector overlaps the one before; fewer
/// angles than a vector holds are computed beside zeros.
#[inline(always)]
fn turn<T: Scalar, V: Vector<T>>(angles: &[T], sines: &mut [T], cosines: &mut [T]) {
    const { assert!(V::LANES <= MOST, "a register of few angles") };
    let count = angles.len();
    let (mut few, mut few_sines, mut few_cosines) = (
        [T::from_f64(0.0); MOST],
        [T::from_f64(0.0); MOST],
        [T::from_f64(0.0); MOST],
    );
    let is_few = count < V::LANES;
    // One loop for both: sines are long.
    let (from, to_sines, to_cosines) = if is_few {
        copy(&mut few, angles);
        (&few[..], &mut few_sines[..], &mut few_cosines[..])
    } else {
        (angles, &mut *sines, &mut *cosines)
    };
    let mut index = 0;
    while index < count {
        let at = index.min(count.max(V::LANES) - V::LANES);
        let (sine, cosine) = V::load(from, at).sin_cos();
        sine.store(to_sines, at);
        cosine.store(to_cosines, at);
        index += V::LANES;
    }
    if is_few {
        copy(sines, &few_sines);
        copy(cosines, &few_cosines);
    }
}
