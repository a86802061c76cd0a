//! Energies by scale and the transfers between scales (`docs/physics.md`, section 18).
//!
//! The parts of all quantities in all scales are computed from means over copies, generation by
//! generation. The flow of a scale's energy takes one solution with the mass matrix, whose factors
//! serve all scales. All computations are sums along the tree, in registers of neighbouring links,
//! and take O(n) operations per scale.

mod blocks;
mod columns;
mod coupled;
mod energies;
mod equations;
mod flows;
mod motion;
mod pairs;
mod parts;
mod sectors;
mod shape;

use alloc::vec::Vec;
use core::marker::PhantomData;

pub use equations::ScaleEquations;

use super::Tree;
use super::columns::load;
use super::equations::Row;
use super::memory::take;
use crate::scalar::Scalar;
use crate::sectors::ScaleBudget;
use crate::simd::dispatch::in_widest;
use crate::simd::{Kernel, Simd};
use crate::system::Workspace;
use blocks::Pieces;
use columns::{ALL, ScaleColumns};
pub use shape::MOST_GENERATIONS;
use shape::ScaleShape;

/// Indices of the quantities that are split into scales.
mod field {
    pub(super) const VELOCITY: usize = 0;
    pub(super) const OMEGA: usize = 2;
    pub(super) const RISE: usize = 3;
    pub(super) const SIDE: usize = 4;
    pub(super) const STRAIN: usize = 5;
    pub(super) const MOMENT: usize = 6;
    pub(super) const SPRING: usize = 8;
    pub(super) const ALL: usize = 9;
}

impl<E: ScaleEquations, T: Scalar> Tree<E, T> {
    /// Computes the energies, as [`Scales::energies_by_scale`](crate::Scales::energies_by_scale).
    pub fn energies_by_scale(
        &self,
        workspace: &mut Workspace<T>,
        theta: &[T],
        omega: &[T],
        budget: &mut ScaleBudget<T>,
    ) {
        let wanted = ScaleOutput::Energies(budget);
        let acting = ActingOnScales::of(None);
        by_scale(self.rule(), workspace, acting, [theta, omega, &[]], wanted);
        self.add_energies_between(theta, budget);
    }

    /// Computes the energies of sectors, as
    /// [`Scales::energies_by_sector`](crate::Scales::energies_by_sector).
    pub fn energies_by_sector(
        &self,
        workspace: &mut Workspace<T>,
        theta: &[T],
        omega: &[T],
        energies: &mut [T],
    ) {
        let wanted = ScaleOutput::Sectors(energies);
        let acting = ActingOnScales::of(None);
        by_scale(self.rule(), workspace, acting, [theta, omega, &[]], wanted);
        self.add_energies_of_sectors(theta, energies);
    }

    /// Computes the whole energy budget, as
    /// [`Scales::budget_by_scale`](crate::Scales::budget_by_scale). `given` contains angles,
    /// angular velocities and an empty slice; `drive` contains the acceleration of the root's pivot
    /// and the torque on the root.
    pub fn budget_by_scale(
        &self,
        workspace: &mut Workspace<T>,
        drive: Option<[T; 3]>,
        given: [&[T]; 3],
        budget: &mut ScaleBudget<T>,
    ) {
        self.whole_budget(workspace, drive, given, budget);
    }

    /// Computes the whole energy budget under external torques, which are the third slice of
    /// `given`.
    pub fn budget_by_scale_under(
        &self,
        workspace: &mut Workspace<T>,
        drive: Option<[T; 3]>,
        given: [&[T]; 3],
        budget: &mut ScaleBudget<T>,
    ) {
        let given = match given[2].len() == self.skeleton.plan.links() {
            true => given,
            false => [[].as_slice(); 3],
        };
        self.whole_budget(workspace, drive, given, budget);
    }

    fn rule(&self) -> RuleTree<'_, E, T> {
        RuleTree {
            copies: E::COPIES,
            constants: &self.skeleton.constants,
            equations: PhantomData,
        }
    }
}

/// Rule-based tree that is built at run time; the counterpart of a [`Tree`] whose numbers of copies
/// are constants of its equations.
#[derive(Clone, Debug, PartialEq)]
pub struct ScaleTree<E, T> {
    copies: Vec<usize>,
    constants: Vec<T>,
    equations: PhantomData<E>,
}

impl<E: ScaleEquations, T: Scalar> ScaleTree<E, T> {
    /// Creates the tree. `copies` has the number of copies of each generation under each link of
    /// the generation before (1 for the root); `rows` has one row of constants per generation.
    #[must_use]
    pub fn new(copies: Vec<usize>, rows: Vec<T>) -> Self {
        Self {
            copies,
            constants: rows,
            equations: PhantomData,
        }
    }

    /// Returns the number of copies of each generation under each link of the generation before; 1
    /// for the root.
    #[must_use]
    pub fn copies(&self) -> &[usize] {
        &self.copies
    }

    /// Returns the same tree with constants of another scalar type.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> ScaleTree<E, S> {
        let constants = self.constants.iter().copied().map(convert);
        ScaleTree::new(self.copies.clone(), constants.collect())
    }

    /// Computes only the energies (J) by scale, from angles and angular velocities; NaN for more
    /// than [`MOST_GENERATIONS`] generations.
    pub fn energies_by_scale(
        &self,
        workspace: &mut Workspace<T>,
        theta: &[T],
        omega: &[T],
        budget: &mut ScaleBudget<T>,
    ) {
        let (acting, given) = (ActingOnScales::of(None), [theta, omega, &[]]);
        let wanted = ScaleOutput::Energies(budget);
        by_scale(self.rule(), workspace, acting, given, wanted);
    }

    fn rule(&self) -> RuleTree<'_, E, T> {
        RuleTree {
            copies: &self.copies,
            constants: &self.constants,
            equations: PhantomData,
        }
    }

    /// Computes the whole energy budget. `given` holds angles, angular velocities and external
    /// torques (or an empty slice), link by link in the order of [`Scales`](crate::Scales); `drive`
    /// holds the acceleration of the root's pivot and the torque on the root. `between` holds, link
    /// by link or empty, the derivatives (N m) of the energy of springs between siblings with
    /// respect to the angles and the torques (N m) of friction between siblings; the energies of
    /// these springs are left to the caller. NaN for more than [`MOST_GENERATIONS`] generations.
    pub fn budget_by_scale(
        &self,
        workspace: &mut Workspace<T>,
        drive: Option<[T; 3]>,
        given: [&[T]; 3],
        between: [&[T]; 2],
        budget: &mut ScaleBudget<T>,
    ) {
        let acting = ActingOnScales { drive, between };
        by_scale(
            self.rule(),
            workspace,
            acting,
            given,
            ScaleOutput::Budget(budget),
        );
    }
}

/// Actions on a tree in addition to its joints and external torques: the drive, and forces between
/// siblings.
struct ActingOnScales<'a, T> {
    drive: Option<[T; 3]>,
    /// Derivatives of the energy of springs between siblings by the angles, and torques of friction
    /// between siblings.
    between: [&'a [T]; 2],
}

impl<T> ActingOnScales<'_, T> {
    /// Returns the actions of a drive alone.
    fn of(drive: Option<[T; 3]>) -> Self {
        let between = [[].as_slice(); 2];
        Self { drive, between }
    }
}

/// Rule-based tree: the numbers of copies of its generations, with one row of constants for each.
struct RuleTree<'a, E, T> {
    copies: &'a [usize],
    constants: &'a [T],
    equations: PhantomData<E>,
}

fn by_scale<E: ScaleEquations, T: Scalar>(
    rule: RuleTree<'_, E, T>,
    workspace: &mut Workspace<T>,
    ActingOnScales { drive, between }: ActingOnScales<'_, T>,
    [theta, omega, torques]: [&[T]; 3],
    mut wanted: ScaleOutput<'_, T>,
) {
    let shape = ScaleShape::new(rule.copies.iter().copied());
    let fits = |links: usize| {
        let between = between.iter().all(|own| [0, links].contains(&own.len()));
        [theta.len(), omega.len()] == [links; 2] && between
    };
    let shape = shape.filter(|shape| fits(shape.links));
    let pieces = shape.and_then(|shape| Pieces::new(rule.copies, &shape));
    wanted.start(
        rule.copies.len(),
        match pieces {
            Some(_) => T::from_f64(0.0),
            None => T::from_f64(f64::NAN),
        },
    );
    let (Some(shape), Some(pieces)) = (shape, pieces) else {
        return;
    };
    let (columns, parts) = (ALL * shape.column, field::ALL * shape.parts);
    let working = match wanted {
        ScaleOutput::Budget(_) => pieces.workspace_len(shape.count()),
        ScaleOutput::Energies(_) | ScaleOutput::Sectors(_) => 0,
    };
    let mut numbers = workspace.numbers(columns + parts + working);
    let own = take(&mut numbers, columns);
    let parts = take(&mut numbers, parts);
    in_widest::<T, _>(ByScale::<E, T> {
        constants: rule.constants,
        columns: ScaleColumns {
            numbers: own,
            length: shape.column,
        },
        parts,
        working: numbers,
        shape,
        pieces: &pieces,
        drive,
        between,
        theta,
        omega,
        torques,
        wanted,
        equations: PhantomData,
    });
}

/// Destination of the computed quantities.
enum ScaleOutput<'a, T> {
    Energies(&'a mut ScaleBudget<T>),
    Sectors(&'a mut [T]),
    Budget(&'a mut ScaleBudget<T>),
}

impl<T: Scalar> ScaleOutput<'_, T> {
    /// Sets all computed quantities to `value`.
    fn start(&mut self, scales: usize, value: T) {
        match self {
            Self::Energies(budget) | Self::Budget(budget) => budget.fill(scales, value),
            Self::Sectors(energies) => energies.fill(value),
        }
    }
}

/// State of one computation.
struct ByScale<'a, E, T: 'static> {
    /// Constants of the generations.
    constants: &'a [T],
    shape: ScaleShape,
    columns: ScaleColumns<'a, T>,
    /// Columns of parts.
    parts: &'a mut [T],
    /// Workspace for the flows of all scales.
    working: &'a mut [T],
    pieces: &'a Pieces,
    drive: Option<[T; 3]>,
    between: [&'a [T]; 2],
    theta: &'a [T],
    omega: &'a [T],
    torques: &'a [T],
    wanted: ScaleOutput<'a, T>,
    equations: PhantomData<E>,
}

impl<E: ScaleEquations, T: Scalar> Kernel<T> for ByScale<'_, E, T> {
    type Output = ();

    #[inline(always)]
    fn run<V: Simd<T>>(mut self) {
        let all = matches!(self.wanted, ScaleOutput::Budget(_));
        self.motions::<V>();
        self.velocities::<V>();
        if all {
            self.torques_of_drive::<V>();
            self.moments::<V>();
        }
        self.split_all::<V>(all);
        match self.wanted {
            ScaleOutput::Sectors(_) => self.sectors(),
            ScaleOutput::Energies(_) | ScaleOutput::Budget(_) => self.energies::<V>(),
        }
        if all {
            self.factors::<V>();
            self.all_scales::<V>(self.pieces);
        }
    }
}

impl<E: ScaleEquations, T: Scalar> ByScale<'_, E, T> {
    /// Returns the constants of a generation.
    #[inline(always)]
    fn constants<V: Simd<T>>(&self, generation: usize) -> E::Constants<V> {
        let mut row = <E::Constants<V> as Row<V>>::filled(V::from_f64(0.0));
        let length = <E::Constants<V> as Row<V>>::LENGTH;
        let numbers = self.constants.get(generation * length..);
        for (place, &number) in row.as_mut().iter_mut().zip(numbers.unwrap_or_default()) {
            *place = V::splat(number);
        }
        row
    }

    /// Returns the parts, in one scale, of consecutive quantities for links of a generation;
    /// `place` is an index within the period. The parts are zero in scales in which the generation
    /// has none.
    #[inline(always)]
    fn part<V: Simd<T>, const N: usize>(
        &self,
        first: usize,
        start: Option<usize>,
        place: usize,
    ) -> [V; N] {
        let mut row = [V::from_f64(0.0); N];
        let Some(start) = start else { return row };
        for (index, number) in row.iter_mut().enumerate() {
            let column = (first + index) * self.shape.parts;
            *number = load(self.parts, column + start + place);
        }
        row
    }

    /// Returns the index at which a generation's parts in a scale start (`None` if it has none),
    /// and the number of links after which they repeat.
    #[inline(always)]
    fn part_start(&self, scale: usize, generation: usize) -> (Option<usize>, usize) {
        match scale <= generation {
            true => (
                Some(self.shape.part(scale, generation)),
                self.shape.period(scale, generation),
            ),
            false => (None, self.shape.at(generation).count),
        }
    }
}
