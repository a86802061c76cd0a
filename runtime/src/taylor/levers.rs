//! What links do to each other.

use super::expand::Start;
use super::matrix::{Vector, packs};
use super::quad::{Pack, Quad};
use crate::scalar::Scalar;

/// The entry a cos(θ_i − θ_j) + b sin(θ_i − θ_j) of the mass matrix.
#[derive(Clone, Copy, Debug)]
pub struct Coupling<T> {
    /// Row i and column j.
    pub links: [usize; 2],
    /// a, kg m².
    pub cosine: T,
    /// b, kg m²; none if it is zero by shape.
    pub sine: Option<T>,
}

/// The connections between links, as columns of two matrices.
pub(super) struct Levers<'a, T, const N: usize, const M: usize> {
    /// A, symmetric, without its diagonal.
    pub(super) along: &'a [Vector<T, M>],
    /// B, antisymmetric, if it is not zero.
    pub(super) across: Option<&'a [Vector<T, M>]>,
}

impl<'a, T: Scalar, const N: usize, const M: usize> Levers<'a, T, N, M> {
    /// The couplings, written to columns of `along` and `across`.
    #[inline(always)]
    pub(super) fn new(
        couplings: &[Coupling<T>],
        along: &'a mut [Vector<T, M>],
        across: &'a mut [Vector<T, M>],
    ) -> Self {
        along.fill([Quad::splat(T::from_f64(0.0)); M]);
        let lateral = couplings.iter().any(|coupling| coupling.sine.is_some());
        if lateral {
            across.fill([Quad::splat(T::from_f64(0.0)); M]);
        }
        for coupling in couplings {
            let [i, j] = coupling.links;
            along[j][i / 4].0[i % 4] = coupling.cosine;
            along[i][j / 4].0[j % 4] = coupling.cosine;
            if let Some(sine) = coupling.sine {
                across[j][i / 4].0[i % 4] = sine;
                across[i][j / 4].0[j % 4] = -sine;
            }
        }
        Self {
            along,
            across: lateral.then_some(across),
        }
    }

    /// To columns of `mass`, A cos(θ_i − θ_j) + B sin(θ_i − θ_j) with the
    /// diagonal, and again to those of `copy`; to `turning`, A sin(θ_i − θ_j) −
    /// B cos(θ_i − θ_j).
    #[inline(always)]
    pub(super) fn matrices<P: Pack<T>>(
        &self,
        start: &Start<'_, T, N>,
        inertias: &[T; N],
        [mass, copy, turning]: [&mut [Vector<T, M>]; 3],
    ) {
        let cosines: [P; M] = packs(&start.cosines);
        let sines: [P; M] = packs(&start.sines);
        let columns = mass.iter_mut().zip(copy).zip(turning).enumerate();
        for (j, ((mass, copy), turning)) in columns.take(N) {
            let (cosine, sine) = (P::splat(start.cosines[j]), P::splat(start.sines[j]));
            // Not written into the column afterwards: that would have to reach
            // the memory before the column can be read.
            let mut diagonal = [Quad::splat(T::from_f64(0.0)); M];
            diagonal[j / 4].0[j % 4] = inertias[j];
            for m in 0..M {
                let cos_between = cosines[m].times(cosine).plus_product(sines[m], sine);
                let sin_between = sines[m].times(cosine).minus_product(cosines[m], sine);
                let along = P::load(&self.along[j][m]);
                let mut entry = P::load(&diagonal[m]).plus_product(along, cos_between);
                let mut slope = along.times(sin_between);
                if let Some(across) = self.across {
                    let across = P::load(&across[j][m]);
                    entry = entry.plus_product(across, sin_between);
                    slope = slope.minus_product(across, cos_between);
                }
                entry.store(&mut mass[m]);
                entry.store(&mut copy[m]);
                slope.store(&mut turning[m]);
            }
        }
    }
}
