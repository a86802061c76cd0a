//! Links of a tree in loops as bodies: energies with lateral offsets, momentum and
//! powers of driven trees.

mod terms;

use alloc::vec::Vec;

use super::shape::Shape;
use super::sum::Sum;
use crate::scalar::kind::{compiled, compiled_once};
use crate::scalar::{Scalar, at};
use crate::system::Workspace;
use terms::{LinkTerms, TurnedLink, sums};

/// Numbers of a body.
const ROW: usize = 12;

/// Numbers of the laws of a link.
const LAW: usize = 5;

/// The links of a tree in loops as bodies. Emitted models hold them where there is
/// a drive or a lateral offset, and energies are asked for.
///
/// All functions take O(links), with memory that the caller keeps: up to six numbers
/// for each link. In numbers that do not fuse, values have the same
/// bits on every machine.
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
        let [energy] = compiled::<KineticEnergy, T>()(self, workspace, theta, omega);
        energy
    }

    /// Linear momentum Σ m (V + **W** ω), kg m/s, to the side in which positive
    /// angles move a link's end, and against the direction of links of angle 0. NaN for
    /// slices of another length than there are links.
    #[must_use]
    pub fn momentum(&self, workspace: &mut Workspace<T>, theta: &[T], omega: &[T]) -> [T; 2] {
        compiled::<Momentum, T>()(self, workspace, theta, omega)
    }

    /// Power τ ω₀ − **a**·**P**, W, of a torque τ on the root and an acceleration
    /// **a** of its pivot in the directions of the momentum **P**: of the inertial forces
    /// −m **a** in the centres of mass. NaN for slices of another length than there are links.
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
        let [energy] = compiled::<PotentialEnergy, T>()(self, workspace, theta, theta);
        energy
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

    fn sum_of_friction_powers(&self, omega: &[T]) -> T {
        let mut sum = Sum::new();
        let whole = omega.len() == self.shape.links();
        if whole {
            for strip in self.shape.strips() {
                let (Some(&[.., friction, drag]), law) = (self.row(strip.row), self.law(strip.row))
                else {
                    continue;
                };
                for index in 0..strip.count {
                    let rate = at(omega, strip.link + index);
                    let relative = match strip.parent {
                        Some(parent) => rate - at(omega, parent + index),
                        None => rate,
                    };
                    sum.add(friction * relative * relative + drag * rate * rate);
                    if let Some(law) = law {
                        sum.add(braking_power(law, relative, rate));
                    }
                }
            }
        }
        Self::or_nan(whole, -sum.total())
    }

    fn or_nan(whole: bool, value: T) -> T {
        match whole {
            true => value,
            false => T::from_f64(f64::NAN),
        }
    }
}

/// Kinetic energy of links of a given angular velocity; known of a pivot is its velocity.
struct KineticTerm;

impl LinkTerms<2, 1> for KineticTerm {
    #[inline(always)]
    fn pivot<V: Scalar>(child: &[V; ROW], parent: TurnedLink<V, 2>) -> [V; 2] {
        let &[_, _, _, _, along, across, ..] = child;
        let ([x, y], [slope_x, slope_y]) = (parent.pivot, slopes(&parent));
        [
            x + (along * slope_x - across * slope_y),
            y + (along * slope_y + across * slope_x),
        ]
    }

    #[inline(always)]
    fn terms<V: Scalar>(row: &[V; ROW], link: TurnedLink<V, 2>, _: V) -> [V; 1] {
        let &[half_mass, _, _, half_inertia, ..] = row;
        let ([x, y], [turn_x, turn_y]) = (link.pivot, turns(row, &link));
        let own = half_mass * (x * x + y * y) + half_inertia * link.given * link.given;
        [own + (x * turn_x + y * turn_y)]
    }
}

/// Momentum of links of a given angular velocity, likewise.
struct MomentumTerms;

impl LinkTerms<2, 2> for MomentumTerms {
    #[inline(always)]
    fn pivot<V: Scalar>(child: &[V; ROW], parent: TurnedLink<V, 2>) -> [V; 2] {
        KineticTerm::pivot(child, parent)
    }

    #[inline(always)]
    fn terms<V: Scalar>(row: &[V; ROW], link: TurnedLink<V, 2>, _: V) -> [V; 2] {
        let mass = row[0] + row[0];
        let ([x, y], [turn_x, turn_y]) = (link.pivot, turns(row, &link));
        [mass * x + turn_x, mass * y + turn_y]
    }
}

/// ω v.
#[inline(always)]
fn slopes<V: Scalar>(link: &TurnedLink<V, 2>) -> [V; 2] {
    [link.given * link.cosine, link.given * link.sine]
}

/// m **W** ω.
#[inline(always)]
fn turns<V: Scalar>(row: &[V; ROW], link: &TurnedLink<V, 2>) -> [V; 2] {
    let (&[_, moment, lateral, ..], [x, y]) = (row, slopes(link));
    [moment * x - lateral * y, moment * y + lateral * x]
}

/// Potential energy of links of a given angle; known of a pivot is its height.
struct PotentialTerm;

impl LinkTerms<1, 1> for PotentialTerm {
    #[inline(always)]
    fn pivot<V: Scalar>(child: &[V; ROW], parent: TurnedLink<V, 1>) -> [V; 1] {
        let &[_, _, _, _, along, across, ..] = child;
        let ([height], rise) = (parent.pivot, V::from_f64(1.0) - parent.cosine);
        [height + along * rise + across * parent.sine]
    }

    #[inline(always)]
    fn terms<V: Scalar>(row: &[V; ROW], link: TurnedLink<V, 1>, strain: V) -> [V; 1] {
        let &[_, _, _, _, _, _, weight, gravity, lateral, spring, ..] = row;
        let ([height], rise) = (link.pivot, V::from_f64(1.0) - link.cosine);
        let own = gravity * rise + lateral * link.sine;
        [weight * height + own + spring * strain * strain]
    }
}

compiled_once! {
    KineticEnergy<T> = sums::<KineticTerm, _, 2, 1>:
        fn(&Bodies<T>, &mut Workspace<T>, &[T], &[T]) -> [T; 1]
}

compiled_once! {
    Momentum<T> = sums::<MomentumTerms, _, 2, 2>:
        fn(&Bodies<T>, &mut Workspace<T>, &[T], &[T]) -> [T; 2]
}

compiled_once! {
    PotentialEnergy<T> = sums::<PotentialTerm, _, 1, 1>:
        fn(&Bodies<T>, &mut Workspace<T>, &[T], &[T]) -> [T; 1]
}

compiled_once! {
    FrictionPower<T> = Bodies::sum_of_friction_powers: fn(&Bodies<T>, &[T]) -> T
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
