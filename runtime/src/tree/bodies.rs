//! Links of a tree in loops as bodies: energies with lateral offsets, momentum and
//! powers of driven trees.

use alloc::sync::Arc;
use alloc::vec::Vec;

use super::sum::Sum;
use crate::scalar::kind::{compiled, compiled_once};
use crate::scalar::{Scalar, at};
use crate::system::Workspace;
use crate::system::cast::put;

/// Parents of the links.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Shape {
    /// The parent of each link, before it; the root's own is 0.
    Parents(&'static [u32]),
    /// Parents likewise, of a tree that is not known before the program runs.
    Shared(Arc<[u32]>),
    /// Copies of each generation under each link of the one before, 1 for the
    /// root; links stand as in a [`Tree`](super::Tree).
    Generations(&'static [usize]),
}

impl Shape {
    pub(super) fn links(&self) -> usize {
        match self {
            Self::Parents(parents) => parents.len(),
            Self::Shared(parents) => parents.len(),
            Self::Generations(copies) => super::links(copies),
        }
    }

    /// Goes from the root to the leaves: the link, its parent but for the root,
    /// and the number of its row.
    #[inline(always)]
    pub(super) fn each(&self, mut visit: impl FnMut(usize, Option<usize>, usize)) {
        let mut listed = |parents: &[u32]| {
            for (link, &parent) in parents.iter().enumerate() {
                visit(link, (link > 0).then_some(parent as usize), link);
            }
        };
        match self {
            Self::Parents(parents) => listed(parents),
            Self::Shared(parents) => listed(parents),
            Self::Generations(copies) => {
                // Where the generation before starts, and how many links it has.
                let (mut above, mut count) = (0, 1);
                let mut start = 0;
                for (generation, &copies) in copies.iter().enumerate() {
                    for copy in 0..copies {
                        for i in 0..count {
                            let parent = (generation > 0).then_some(above + i);
                            visit(start + copy * count + i, parent, generation);
                        }
                    }
                    (above, count) = (start, count * copies);
                    start += count;
                }
            }
        }
    }
}

/// Numbers of a body.
const ROW: usize = 12;

/// Numbers of the laws of a link.
const LAW: usize = 5;

/// The links of a tree in loops as bodies. Emitted models hold them where there is
/// a drive or a lateral offset, and energies are asked for.
///
/// All functions take O(links), with memory that the caller keeps: up to four numbers
/// for each link.
#[derive(Clone, Debug, PartialEq)]
pub struct Bodies<T> {
    shape: Shape,
    /// Rows of all links or generations, one after the other.
    rows: Vec<T>,
    /// Angles at which springs are at rest, likewise; empty where all are zero.
    rests: Vec<T>,
    /// Laws of friction, likewise; empty where all friction is viscous.
    laws: Vec<T>,
}

impl<T: Scalar> Bodies<T> {
    /// Bodies with the constants of each link or of each generation, one after the
    /// other, in SI units:
    ///
    /// half of the mass; first moments m d and m e about the pivot along and across
    /// the link, half of the moment of inertia I + m (d² + e²); the pivot's place ℓ,
    /// w on the parent along and across it; weight m g; g m d and g m e; half of the
    /// stiffness of the torsion spring; friction in the pivot, drag.
    #[must_use]
    pub fn new(shape: Shape, rows: Vec<T>) -> Self {
        Self {
            shape,
            rows,
            rests: Vec::new(),
            laws: Vec::new(),
        }
    }

    /// Returns these bodies with the angles at which the springs of each link or of each
    /// generation are at rest, rad.
    #[must_use]
    pub fn with_rests(self, rests: Vec<T>) -> Self {
        Self { rests, ..self }
    }

    /// Returns these bodies with friction beside viscous friction and drag: C, q and ε of
    /// the torque (C/s + q s) w in the pivot of each link or of each generation at the rate
    /// w relative to the parent, s = √(w² + ε²); q and ε of the torque q s w against the
    /// ground.
    #[must_use]
    pub fn with_laws(self, laws: Vec<T>) -> Self {
        Self { laws, ..self }
    }

    /// Returns these bodies on other scalars.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Bodies<S> {
        Bodies {
            shape: self.shape.clone(),
            rows: self.rows.iter().map(|&value| convert(value)).collect(),
            rests: self.rests.iter().map(|&value| convert(value)).collect(),
            laws: self.laws.iter().map(|&value| convert(value)).collect(),
        }
    }

    /// Kinetic energy Σ ½ m (V + **W** ω)² + ½ I ω², J, with **W** = d v − e u,
    /// u = (sin θ, −cos θ), v = (cos θ, sin θ), in the frame of reference that moves
    /// with the root's pivot. NaN for slices of another length than there are
    /// links.
    #[must_use]
    pub fn kinetic_energy(&self, workspace: &mut Workspace<T>, theta: &[T], omega: &[T]) -> T {
        compiled::<KineticEnergy, T>()(self, workspace, theta, omega)
    }

    /// Linear momentum Σ m (V + **W** ω), kg m/s, to the side in which positive
    /// angles move a link's end, and upwards. NaN for slices of another length than
    /// there are links.
    #[must_use]
    pub fn momentum(&self, workspace: &mut Workspace<T>, theta: &[T], omega: &[T]) -> [T; 2] {
        compiled::<Momentum, T>()(self, workspace, theta, omega)
    }

    /// Power τ ω₀ − **a**·**P**, W, of a torque τ on the root and an acceleration
    /// **a** of its pivot, **P** the momentum: of the inertial forces −m **a** in the
    /// centres of mass. NaN for slices of another length than there are links.
    #[must_use]
    pub fn drive_power(
        &self,
        workspace: &mut Workspace<T>,
        [x, y, torque]: [T; 3],
        theta: &[T],
        omega: &[T],
    ) -> T {
        let [momentum_x, momentum_y] = self.momentum(workspace, theta, omega);
        torque * at(omega, 0) - (x * momentum_x + y * momentum_y)
    }

    /// Power −Σ (c (ω − ω_parent)² + k ω²), W, of friction and drag, with that of
    /// [other friction](Self::with_laws). NaN for a slice
    /// of another length than there are links.
    #[must_use]
    pub fn friction_power(&self, omega: &[T]) -> T {
        compiled::<FrictionPower, T>()(self, omega)
    }

    /// Power Q·ω, W, of torques Q from outside. NaN for slices of another length than
    /// there are links.
    #[must_use]
    pub fn outside_power(&self, omega: &[T], torques: &[T]) -> T {
        let mut sum = Sum::new();
        for (&rate, &torque) in omega.iter().zip(torques) {
            sum.add(torque * rate);
        }
        let whole = [omega.len(), torques.len()] == [self.shape.links(); 2];
        Self::or_nan(whole, sum.total())
    }

    /// Potential energy, J, zero where all angles are zero and springs at rest:
    /// Σ m g H + m g d (1 − cos θ) + m g e sin θ + ½ κ (θ − θ_parent − ρ)², the height of a
    /// link's pivot H = H_parent + ℓ (1 − cos θ_parent) + w sin θ_parent. NaN for a
    /// slice of another length than there are links.
    #[must_use]
    pub fn potential_energy(&self, workspace: &mut Workspace<T>, theta: &[T]) -> T {
        compiled::<PotentialEnergy, T>()(self, workspace, theta)
    }

    /// Returns a row, if there is one.
    #[inline(always)]
    fn row(&self, number: usize) -> Option<&[T; ROW]> {
        let (rows, _) = self.rows.as_chunks();
        rows.get(number)
    }

    /// Returns the laws of friction of a row, if there are any.
    #[inline(always)]
    fn law(&self, number: usize) -> Option<&[T; LAW]> {
        let (rows, _) = self.laws.as_chunks();
        rows.get(number)
    }

    fn sum_of_kinetic_energies(&self, workspace: &mut Workspace<T>, theta: &[T], omega: &[T]) -> T {
        let mut sum = Sum::new();
        let tell = |row: &[T; ROW], [x, y]: [T; 2], [turn_x, turn_y]: [T; 2], rate| {
            let &[half_mass, _, _, half_inertia, ..] = row;
            let own = half_mass * (x * x + y * y) + half_inertia * rate * rate;
            sum.add(own + (x * turn_x + y * turn_y));
        };
        let whole = self.moving(workspace, theta, omega, tell);
        Self::or_nan(whole, sum.total())
    }

    fn sum_of_momenta(&self, workspace: &mut Workspace<T>, theta: &[T], omega: &[T]) -> [T; 2] {
        let (mut sum_x, mut sum_y) = (Sum::new(), Sum::new());
        let tell = |row: &[T; ROW], [x, y]: [T; 2], [turn_x, turn_y]: [T; 2], _| {
            let mass = row[0] + row[0];
            sum_x.add(mass * x + turn_x);
            sum_y.add(mass * y + turn_y);
        };
        let whole = self.moving(workspace, theta, omega, tell);
        [sum_x, sum_y].map(|sum| Self::or_nan(whole, sum.total()))
    }

    fn sum_of_friction_powers(&self, omega: &[T]) -> T {
        let mut sum = Sum::new();
        let whole = omega.len() == self.shape.links();
        if whole {
            self.shape.each(|link, parent, row| {
                if let Some(&[.., friction, drag]) = self.row(row) {
                    let rate = at(omega, link);
                    let relative = match parent {
                        Some(parent) => rate - at(omega, parent),
                        None => rate,
                    };
                    sum.add(friction * relative * relative + drag * rate * rate);
                    if let Some(law) = self.law(row) {
                        sum.add(braking_power(law, relative, rate));
                    }
                }
            });
        }
        Self::or_nan(whole, -sum.total())
    }

    fn sum_of_potential_energies(&self, workspace: &mut Workspace<T>, theta: &[T]) -> T {
        let links = self.shape.links();
        if theta.len() != links {
            return T::from_f64(f64::NAN);
        }
        let (one, zero) = (T::from_f64(1.0), T::from_f64(0.0));
        let mut sum = Sum::new();
        let (heights, others) = workspace.numbers(3 * links).split_at_mut(links);
        let (rises, shifts) = others.split_at_mut(links);
        self.shape.each(|link, parent, number| {
            let Some(row) = self.row(number) else {
                return;
            };
            let &[
                _,
                _,
                _,
                _,
                along,
                across,
                weight,
                gravity,
                lateral,
                spring,
                ..,
            ] = row;
            let angle = at(theta, link);
            let (height, joint_angle) = match parent {
                Some(parent) => {
                    let rise = along * at(rises, parent);
                    (
                        at(heights, parent) + rise + across * at(shifts, parent),
                        angle - at(theta, parent),
                    )
                }
                None => (zero, angle),
            };
            let (shift, cosine) = angle.sin_cos();
            let rise = one - cosine;
            let own = gravity * rise + lateral * shift;
            let strain = match self.rests.get(number) {
                Some(&rest) => joint_angle - rest,
                None => joint_angle,
            };
            sum.add(weight * height + own + spring * strain * strain);
            put(heights, link, height);
            put(rises, link, rise);
            put(shifts, link, shift);
        });
        sum.total()
    }

    /// Tells of every link: its row, the velocity of its pivot, m **W** ω, ω. False
    /// for slices of another length than there are links.
    #[inline(always)]
    fn moving(
        &self,
        workspace: &mut Workspace<T>,
        theta: &[T],
        omega: &[T],
        mut tell: impl FnMut(&[T; ROW], [T; 2], [T; 2], T),
    ) -> bool {
        let links = self.shape.links();
        if [theta.len(), omega.len()] != [links; 2] {
            return false;
        }
        let zero = T::from_f64(0.0);
        // Velocities of pivots, and ω v.
        let (pivots, slopes) = workspace.numbers(4 * links).split_at_mut(2 * links);
        let (pivots_x, pivots_y) = pivots.split_at_mut(links);
        let (slopes_x, slopes_y) = slopes.split_at_mut(links);
        self.shape.each(|link, parent, row| {
            let Some(row) = self.row(row) else {
                return;
            };
            let &[_, moment, lateral, _, along, across, ..] = row;
            let [x, y] = match parent {
                Some(parent) => {
                    let (x, y) = (at(slopes_x, parent), at(slopes_y, parent));
                    [
                        at(pivots_x, parent) + (along * x - across * y),
                        at(pivots_y, parent) + (along * y + across * x),
                    ]
                }
                None => [zero, zero],
            };
            let (sine, cosine) = at(theta, link).sin_cos();
            let rate = at(omega, link);
            let (slope_x, slope_y) = (rate * cosine, rate * sine);
            let own = [
                moment * slope_x - lateral * slope_y,
                moment * slope_y + lateral * slope_x,
            ];
            tell(row, [x, y], own, rate);
            put(pivots_x, link, x);
            put(pivots_y, link, y);
            put(slopes_x, link, slope_x);
            put(slopes_y, link, slope_y);
        });
        true
    }

    fn or_nan(whole: bool, value: T) -> T {
        match whole {
            true => value,
            false => T::from_f64(f64::NAN),
        }
    }
}

compiled_once! {
    KineticEnergy<T> = Bodies::sum_of_kinetic_energies:
        fn(&Bodies<T>, &mut Workspace<T>, &[T], &[T]) -> T
}

compiled_once! {
    Momentum<T> = Bodies::sum_of_momenta:
        fn(&Bodies<T>, &mut Workspace<T>, &[T], &[T]) -> [T; 2]
}

compiled_once! {
    FrictionPower<T> = Bodies::sum_of_friction_powers: fn(&Bodies<T>, &[T]) -> T
}

compiled_once! {
    PotentialEnergy<T> = Bodies::sum_of_potential_energies:
        fn(&Bodies<T>, &mut Workspace<T>, &[T]) -> T
}

/// Power that friction of a link takes by these laws, at the rate relative to the parent
/// and at its own.
#[inline(always)]
fn braking_power<T: Scalar>(law: &[T; LAW], relative: T, rate: T) -> T {
    let &[coulomb, quadratic, width, drag, drag_width] = law;
    let (square, own_square) = (relative * relative, rate * rate);
    let speed = (square + width * width).sqrt();
    let own_speed = (own_square + drag_width * drag_width).sqrt();
    (coulomb / speed + quadratic * speed) * square + drag * own_speed * own_square
}
