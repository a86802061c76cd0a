//! First and second derivatives of the potential energy by the angles, link by link.

use super::{Bodies, BodyEquations};
use crate::scalar::{Dual, Scalar, at};
use crate::tree::LinkMotion;
use crate::tree::equations::Row;

/// First and second derivatives of one link's part of the potential energy. It depends on the
/// link's own angle and, by the spring in its pivot, on its parent's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkSlopes<T> {
    /// Index of the link.
    pub link: usize,
    /// Index of its parent; `None` for the root.
    pub parent: Option<usize>,
    /// First derivatives by the link's own angle and by its parent's angle, in N m.
    pub first: [T; 2],
    /// Second derivatives, in N m/rad: by the link's own angle twice, by both angles, and by the
    /// parent's angle twice.
    pub second: [T; 3],
}

/// A number with its first and second derivatives by two angles.
type Twice<T> = Dual<Dual<T, 2>, 2>;

fn constant<T: Scalar>(value: T) -> Twice<T> {
    Twice::constant(Dual::constant(value))
}

fn variable<T: Scalar>(value: T, direction: usize) -> Twice<T> {
    Twice::variable(Dual::variable(value, direction), direction)
}

impl<E: BodyEquations, T: Scalar> Bodies<E, T> {
    /// Visits the derivatives of each link's part of the potential energy at angles `theta` (rad),
    /// parents before their children. O(links). Returns false, without a visit, for a slice whose
    /// length is not the number of links.
    pub fn potential_energy_slopes(
        &self,
        theta: &[T],
        mut visit: impl FnMut(LinkSlopes<T>),
    ) -> bool {
        if theta.len() != self.shape.links() {
            return false;
        }
        let zero = constant(T::from_f64(0.0));
        for strip in self.shape.strips() {
            let Some(body) = self.row::<T>(strip.row) else {
                return false;
            };
            let mut lifted = <E::Body<Twice<T>> as Row<Twice<T>>>::filled(zero);
            for (own, &value) in lifted.as_mut().iter_mut().zip(body.as_ref()) {
                *own = constant(value);
            }
            for (link, parent) in strip.each() {
                let angle = variable(at(theta, link), 0);
                let (sine, cosine) = angle.sin_cos();
                let joint_angle = match parent {
                    Some(parent) => angle - variable(at(theta, parent), 1),
                    None => angle,
                };
                let motion = LinkMotion {
                    joint_angle,
                    joint_rate: zero,
                    ..LinkMotion::turning(sine, cosine, zero)
                };
                let [energy] = E::potential_energy(&lifted, motion);
                let [own, above] = energy.tangents;
                visit(LinkSlopes {
                    link,
                    parent,
                    first: [own.value, above.value],
                    second: [own.tangents[0], own.tangents[1], above.tangents[1]],
                });
            }
        }
        true
    }
}
