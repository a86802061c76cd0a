//! Trees in generations, computed in loops.

mod evaluate;
mod part;
mod recursion;
mod sweep;
mod vector;

use alloc::vec::Vec;
use core::marker::PhantomData;

pub use recursion::{Motion, Recursion};
pub use vector::{Eight, Single, Sixteen, SliceKernel, Vector, Vectors};

use crate::scalar::Scalar;
use evaluate::{Evaluation, Plan};

/// A tree.
#[derive(Debug)]
pub struct Generations<P, T, const C: usize, const L: usize, const R: usize, const K: usize> {
    plan: Plan,
    constants: Vec<[T; C]>,
    root: [T; 2],
    spare: std::sync::Mutex<Vec<Vec<T>>>,
    recursion: PhantomData<P>,
}

impl<P, T, const C: usize, const L: usize, const R: usize, const K: usize>
    Generations<P, T, C, L, R, K>
where
    P: Recursion<C, L, R, K>,
    T: Scalar,
{
    /// New.
    pub fn new(constants: Vec<[T; C]>, root: [T; 2]) -> Self {
        Self {
            plan: Plan::new(P::COPIES),
            constants,
            root,
            spare: std::sync::Mutex::new(Vec::new()),
            recursion: PhantomData,
        }
    }

    /// Evaluates.
    pub fn accelerations_into(&self, theta: &[T], omega: &[T], alpha: &mut [T]) {
        let links = self.plan.links();
        if [theta.len(), omega.len(), alpha.len()] != [links; 3] {
            alpha.fill(T::from_f64(f64::NAN));
            return;
        }
        let spare = self.spare.lock().ok().and_then(|mut spare| spare.pop());
        let mut buffer = spare.unwrap_or_else(|| {
            alloc::vec![T::from_f64(0.0); self.plan.workspace::<R, K>(P::JOINTS)]
        });
        T::over_slices(Evaluation::<P, T, C, L, R, K> {
            plan: &self.plan,
            constants: &self.constants,
            root: self.root,
            theta,
            omega,
            alpha,
            buffer: &mut buffer,
            recursion: PhantomData,
        });
        if let Ok(mut spare) = self.spare.lock() {
            spare.push(buffer);
        }
    }
}
