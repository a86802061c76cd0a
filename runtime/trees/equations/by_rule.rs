//! The equations of a link in a tree by rule, for energies and transfers by scale.

/// Lends its equations. Every property is a parameter, so that each generation may have its own.
#[branched_pendulum::branched_pendulum(
    gravity = g,
    tree: generations(count = 3, branching = 2, mass = m, com = (d, e), inertia = i, joint = (l, w),
        spring = s, rest = r,
        friction(viscous = c, coulomb = f, static = y, stribeck = z, quadratic = q, width = u),
        drag(viscous = k, quadratic = p, width = v)),
    drive(torque = torque, x = a * t^2),
    emit(budget(parseval, scales)),
)]
pub(crate) struct ByRule;
