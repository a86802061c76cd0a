//! Vectors in the plane, and points that turn with a link.

use crate::scalar::Scalar;

/// A vector: x, and y opposite to a link at angle 0.
pub(super) type Vector<T> = [T; 2];

pub(super) fn dot<T: Scalar>([a, b]: Vector<T>, [x, y]: Vector<T>) -> T {
    a * x + b * y
}

pub(super) fn sum<T: Scalar>([a, b]: Vector<T>, [x, y]: Vector<T>) -> Vector<T> {
    [a + x, b + y]
}

pub(super) fn scaled<T: Scalar>(factor: T, [x, y]: Vector<T>) -> Vector<T> {
    [factor * x, factor * y]
}

/// Returns the vector J v, which is v turned by a right angle.
pub(super) fn turned<T: Scalar>([x, y]: Vector<T>) -> Vector<T> {
    [-y, x]
}

/// Returns the vector −J v, which is v turned back by a right angle.
pub(super) fn turned_back<T: Scalar>([x, y]: Vector<T>) -> Vector<T> {
    [y, -x]
}

/// Returns the direction along a link at an angle (rad).
pub(super) fn direction<T: Scalar>(angle: T) -> Vector<T> {
    let (sin, cos) = angle.sin_cos();
    [sin, -cos]
}

/// Returns the vector with components `along` a link and across it, in the direction `axis` of the
/// link.
pub(super) fn arm<T: Scalar>([along, across]: [T; 2], axis: Vector<T>) -> Vector<T> {
    sum(scaled(along, axis), scaled(across, turned(axis)))
}

/// Returns the derivatives of e·g by the angle of the link and by the components of the arm e; `g`
/// is kept.
pub(super) fn arm_slopes<T: Scalar>(
    [along, across]: [T; 2],
    axis: Vector<T>,
    g: Vector<T>,
) -> (T, [T; 2]) {
    let [by_along, by_across] = [dot(axis, g), dot(turned(axis), g)];
    (along * by_across - across * by_along, [by_along, by_across])
}
