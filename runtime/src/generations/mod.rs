//! Trees in generations, computed in loops.

mod evaluate;
mod part;
mod plan;
mod recursion;
mod shared;
mod sweep;
mod threads;
mod vector;
pub(crate) mod vectors;

use alloc::vec::Vec;
use core::marker::PhantomData;

pub use recursion::{Motion, Recursion};
pub use vector::{Single, SliceKernel, Vector, Vectors};
pub use vectors::With;

use crate::scalar::Scalar;
use evaluate::{Given, accelerations, workspace};
use plan::Plan;

/// A tree.
#[derive(Debug)]
pub struct Generations<P, T, const C: usize, const L: usize, const R: usize, const K: usize> {
    plan: Plan,
    constants: Vec<[T; C]>,
    root: [T; 2],
    threads: usize,
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
    pub fn new(constants: Vec<[T; C]>, root: [T; 2], threads: usize) -> Self {
        Self {
            plan: Plan::new(P::COPIES),
            constants,
            root,
            threads,
            spare: std::sync::Mutex::new(Vec::new()),
            recursion: PhantomData,
        }
    }

    /// Evaluates.
    pub fn accelerations_into(&self, theta: &[T], omega: &[T], alpha: &mut [T]) {
        if [theta.len(), omega.len(), alpha.len()] != [P::LINKS; 3] {
            alpha.fill(T::from_f64(f64::NAN));
            return;
        }
        let spare = self.spare.lock().ok().and_then(|mut spare| spare.pop());
        let mut buffer = spare.unwrap_or_else(|| {
            alloc::vec![T::from_f64(0.0); workspace::<T, R, K>(&self.plan, P::JOINTS, self.threads)]
        });
        accelerations::<P, T, C, L, R, K>(
            &Given {
                plan: &self.plan,
                constants: &self.constants,
                root: self.root,
                theta,
                omega,
            },
            alpha,
            &mut buffer,
            self.threads,
        );
        if let Ok(mut spare) = self.spare.lock() {
            spare.push(buffer);
        }
    }
}
