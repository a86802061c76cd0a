//! The equations of a link without torques in its joint and without lateral offsets, whose
//! children share a pivot.

/// Lends its equations. Every property is a parameter, so that each link may have its own.
#[branched_pendulum::branched_pendulum(
    gravity = g,
    code = loops,
    trunk(mass = m, com = d, inertia = i, joint = l) [
        bough(mass = m, com = d, inertia = i, joint = l) [ twig(mass = m, com = d, inertia = i) ],
    ],
    emit(forces),
)]
pub(crate) struct Plain;
