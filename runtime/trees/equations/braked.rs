//! The equations of a link with friction that is not viscous, beside all else.

use branched_pendulum::prelude::*;

/// Lends its equations. Every property is a parameter, so that each link may have its own.
#[branched_pendulum(
    gravity = g,
    code = loops,
    trunk(mass = m, com = (d, e), inertia = i, drag(viscous = k, quadratic = a, width = b),
        friction(viscous = c, coulomb = f, quadratic = p, width = n), spring = s, rest = r) [
        bough(mass = m, com = (d, e), inertia = i, at = (l, w),
            drag(viscous = k, quadratic = a, width = b),
            friction(viscous = c, coulomb = f, quadratic = p, width = n), spring = s, rest = r) [
            twig(mass = m, com = (d, e), inertia = i, at = (l, w),
                drag(viscous = k, quadratic = a, width = b),
                friction(viscous = c, coulomb = f, quadratic = p, width = n), spring = s, rest = r),
        ],
        leaf(mass = m, com = (d, e), inertia = i, at = (w, l),
            drag(viscous = k, quadratic = a, width = b),
            friction(viscous = c, coulomb = f, quadratic = p, width = n), spring = s, rest = r),
    ],
    drive(torque = q),
    emit(forces),
)]
pub struct Braked;
