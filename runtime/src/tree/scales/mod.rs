//! Energies by scale and the transfers between scales (`docs/physics.md`, section 18).
//!
//! Parts of all quantities in all scales come from fast means; the flow of a scale's
//! energy is one solve with the mass matrix, whose factors all scales share. All of it
//! is sums along the tree, for registers of neighbours: O(n) for each scale.

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

/// Quantities whose parts are formed.
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
    /// Computes the energies, as
    /// [`Scales::energies_by_scale`](crate::Scales::energies_by_scale).
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

    /// Computes all of the budget, as
    /// [`Scales::budget_by_scale`](crate::Scales::budget_by_scale): of angles and angular
    /// velocities (the third slice is empty), with the acceleration of the root's pivot
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

    /// Computes all of the budget under torques from outside, the third slice.
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

/// A tree by rule that is known when a program runs: what [`Tree`] is for one whose copies
/// stand in its equations.
#[derive(Clone, Debug, PartialEq)]
pub struct ScaleTree<E, T> {
    copies: Vec<usize>,
    constants: Vec<T>,
    equations: PhantomData<E>,
}

impl<E: ScaleEquations, T: Scalar> ScaleTree<E, T> {
    /// The tree of so many copies of each generation under each link of the one before, 1 for
    /// the root, with a row of constants for each generation, one after the other.
    #[must_use]
    pub fn new(copies: Vec<usize>, rows: Vec<T>) -> Self {
        Self {
            copies,
            constants: rows,
            equations: PhantomData,
        }
    }

    /// Copies of each generation under each link of the one before, 1 for the root.
    #[must_use]
    pub fn copies(&self) -> &[usize] {
        &self.copies
    }

    /// Returns the same tree on other scalars.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> ScaleTree<E, S> {
        let constants = self.constants.iter().copied().map(convert);
        ScaleTree::new(self.copies.clone(), constants.collect())
    }

    /// Computes the energies alone, of angles and angular velocities; NaN of more than
    /// [`MOST_GENERATIONS`].
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

    /// Computes all of the budget: of angles and angular velocities and, unless the third
    /// slice is empty, torques from outside, link by link as those of
    /// [`Scales`](crate::Scales); with the acceleration of the root's pivot and the torque on
    /// the root. Of friction and springs between siblings it takes the slopes (N m) of the
    /// springs' energies by the angles and the torques (N m) of the friction, each link by link,
    /// or empty; the springs' energies are left to the caller. NaN of more than
    /// [`MOST_GENERATIONS`].
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

/// What acts on a tree beside its joints and torques from outside.
struct ActingOnScales<'a, T> {
    drive: Option<[T; 3]>,
    /// Slopes of the energies of springs between siblings, and torques of friction there.
    between: [&'a [T]; 2],
}

impl<T> ActingOnScales<'_, T> {
    /// The drive alone.
    fn of(drive: Option<[T; 3]>) -> Self {
        let between = [[].as_slice(); 2];
        Self { drive, between }
    }
}

/// Copies of the generations, and a row of constants for each.
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
        ScaleOutput::Budget(_) => pieces.room(shape.count()),
        _ => 0,
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

/// Quantities to be computed, and where they go.
enum ScaleOutput<'a, T> {
    Energies(&'a mut ScaleBudget<T>),
    Sectors(&'a mut [T]),
    Budget(&'a mut ScaleBudget<T>),
}

impl<T: Scalar> ScaleOutput<'_, T> {
    /// Writes one number everywhere.
    fn start(&mut self, scales: usize, value: T) {
        match self {
            Self::Energies(budget) | Self::Budget(budget) => budget.fill(scales, value),
            Self::Sectors(energies) => energies.fill(value),
        }
    }
}

/// One computation.
struct ByScale<'a, E, T: 'static> {
    /// Constants of the generations.
    constants: &'a [T],
    shape: ScaleShape,
    columns: ScaleColumns<'a, T>,
    /// Columns of parts.
    parts: &'a mut [T],
    /// Room for what is formed along the scales.
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
            _ => self.energies::<V>(),
        }
        if all {
            self.factors::<V>();
            self.all_scales::<V>(self.pieces);
        }
    }
}

impl<E: ScaleEquations, T: Scalar> ByScale<'_, E, T> {
    /// The constants of a generation.
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

    /// Parts of consecutive fields of links of a generation, from the place behind a
    /// period on: zero in scales that the generation has no part in.
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

    /// Where parts of a generation in a scale start, and their period; none where there
    /// are none.
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
