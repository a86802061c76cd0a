//! What of a tree does not depend on its equations.

use alloc::vec::Vec;

use super::energy::{self, EnergyConstants};
use super::evaluate::{Kernels, accelerations};
use super::layout::Layout;
use super::memory::Sizes;
use super::plan::Plan;
use super::pool::Pool;
use super::root::RootDrive;
use super::threads;
use crate::scalar::Scalar;

/// The constants of a tree in generations, and room for evaluations.
#[derive(Debug)]
pub struct Tree<T> {
    pub(super) plan: Plan,
    /// Rows of the generations, one after the other.
    pub(super) constants: Vec<T>,
    /// Acceleration of the root's pivot.
    pub(super) root: [T; 2],
    pub(super) energies: Vec<EnergyConstants<T>>,
    pub(super) threads: usize,
    pub(super) layout: Layout,
    /// How many numbers an evaluation needs room for.
    room: usize,
    pool: Pool<T>,
}

/// A tree with rows of constants, those of the energies as in [`EnergyConstants`].
fn tree<T: Scalar>(
    copies: &[usize],
    sizes: Sizes,
    constants: Vec<T>,
    root: [T; 2],
    energies: &[[T; 6]],
) -> Tree<T> {
    let plan = Plan::new(copies);
    let threads = threads::default(plan.links());
    let layout = Layout::new::<T>(&plan, sizes);
    Tree {
        threads,
        room: layout.room::<T>(&plan, threads),
        layout,
        plan,
        constants,
        root,
        energies: energies.iter().map(EnergyConstants::of).collect(),
        pool: Pool::new(),
    }
}

impl<T> Tree<T> {
    /// Room that is there is for another number of threads.
    pub(super) fn set_threads(&mut self, threads: usize) {
        self.threads = threads;
        self.room = self.layout.room::<T>(&self.plan, threads);
        self.pool = Pool::new();
    }
}

impl<T: Scalar> Tree<T> {
    /// The same tree on other scalars.
    pub(super) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Tree<S> {
        let layout = self.layout.cast::<S>(&self.plan);
        Tree {
            threads: self.threads,
            room: layout.room::<S>(&self.plan, self.threads),
            layout,
            plan: self.plan.clone(),
            constants: self.constants.iter().map(|&x| convert(x)).collect(),
            root: self.root.map(&convert),
            energies: self.energies.iter().map(|row| row.map(&convert)).collect(),
            pool: Pool::new(),
        }
    }

    pub(super) fn plan(&self) -> &Plan {
        &self.plan
    }

    pub(super) fn pool(&self) -> &Pool<T> {
        &self.pool
    }
}

/// NaN instead of accelerations for slices of another length than there are links.
fn accelerations_into<T: Scalar>(
    tree: &Tree<T>,
    kernels: &Kernels<T>,
    theta: &[T],
    omega: &[T],
    alpha: &mut [T],
) {
    let links = tree.plan.links();
    // One by one: as arrays they would be read back in other widths than they were
    // written in, and the lock would wait for that.
    if theta.len() != links || omega.len() != links || alpha.len() != links {
        alpha.fill(T::from_f64(f64::NAN));
        return;
    }
    tree.pool.lend(tree.room, T::from_f64(0.0), |buffer| {
        accelerations(tree, kernels, None, theta, omega, alpha, buffer);
    });
}

/// The same under a drive.
fn driven_accelerations_into<T: Scalar>(
    tree: &Tree<T>,
    kernels: &Kernels<T>,
    drive: RootDrive<T>,
    theta: &[T],
    omega: &[T],
    alpha: &mut [T],
) {
    if [theta.len(), omega.len(), alpha.len()] != [tree.plan.links(); 3] {
        alpha.fill(T::from_f64(f64::NAN));
        return;
    }
    tree.pool.lend(tree.room, T::from_f64(0.0), |buffer| {
        accelerations(tree, kernels, Some(drive), theta, omega, alpha, buffer);
    });
}

fn kinetic_energy<T: Scalar>(tree: &Tree<T>, theta: &[T], omega: &[T]) -> T {
    if [theta.len(), omega.len()] != [tree.plan.links(); 2] {
        return T::from_f64(f64::NAN);
    }
    let room = energy::workspace(&tree.plan);
    tree.pool.lend(room, T::from_f64(0.0), |buffer| {
        energy::kinetic(&tree.plan, &tree.energies, theta, omega, buffer)
    })
}

fn potential_energy<T: Scalar>(tree: &Tree<T>, theta: &[T]) -> T {
    if theta.len() != tree.plan.links() {
        return T::from_f64(f64::NAN);
    }
    energy::potential(&tree.plan, &tree.energies, theta)
}

/// Makes a tree of its copies and constants.
type Grow<T> = fn(&[usize], Sizes, Vec<T>, [T; 2], &[[T; 6]]) -> Tree<T>;

/// Computes accelerations from angles and velocities.
type Accelerate<T> = fn(&Tree<T>, &Kernels<T>, &[T], &[T], &mut [T]);

/// The same under a drive.
type AccelerateDriven<T> = fn(&Tree<T>, &Kernels<T>, RootDrive<T>, &[T], &[T], &mut [T]);

/// What is done to a tree of any equations. For `f64` and `f32` these functions
/// are compiled with this crate, once, and not with every model.
#[derive(Debug)]
pub struct Loops<T: 'static> {
    pub(super) tree: Grow<T>,
    pub(super) accelerations_into: Accelerate<T>,
    pub(super) driven_accelerations_into: AccelerateDriven<T>,
    pub(super) kinetic_energy: fn(&Tree<T>, &[T], &[T]) -> T,
    pub(super) potential_energy: fn(&Tree<T>, &[T]) -> T,
}

impl<T: Scalar> Loops<T> {
    /// Those for `T`, compiled where this is called.
    pub(crate) const fn new() -> Self {
        Self {
            tree,
            accelerations_into,
            driven_accelerations_into,
            kinetic_energy,
            potential_energy,
        }
    }
}

impl<T: Clone> Clone for Tree<T> {
    /// The copy has room of its own.
    fn clone(&self) -> Self {
        let Self {
            plan,
            constants,
            root,
            energies,
            threads,
            layout,
            room,
            pool: _,
        } = self;
        Self {
            plan: plan.clone(),
            constants: constants.clone(),
            root: root.clone(),
            energies: energies.clone(),
            threads: *threads,
            layout: layout.clone(),
            room: *room,
            pool: Pool::new(),
        }
    }
}

impl<T: PartialEq> PartialEq for Tree<T> {
    /// Whether they are the same tree, however it is computed.
    fn eq(&self, other: &Self) -> bool {
        let Self {
            plan,
            constants,
            root,
            energies,
            threads: _,
            layout: _,
            room: _,
            pool: _,
        } = self;
        *plan == other.plan
            && *constants == other.constants
            && *root == other.root
            && *energies == other.energies
    }
}
