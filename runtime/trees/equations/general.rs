//! The equations of a link that may have all that links can have.

/// Lends its equations. Every property is a parameter, so that each link may have its own.
#[branched_pendulum::branched_pendulum(
    gravity = g,
    code = loops,
    trunk(mass = m, com = (d, e), inertia = i, friction = c, drag = k, spring = s, rest = r) [
        bough(mass = m, com = (d, e), inertia = i, at = (l, w), friction = c, drag = k,
            spring = s, rest = r) [
            twig(mass = m, com = (d, e), inertia = i, at = (l, w), friction = c, drag = k,
                spring = s, rest = r),
        ],
        leaf(mass = m, com = (d, e), inertia = i, at = (w, l), friction = c, drag = k,
            spring = s, rest = r),
    ],
    drive(torque = q),
    emit(forces, positions),
)]
pub(crate) struct General;
