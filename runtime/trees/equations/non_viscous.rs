//! The equations of a link that may have all that links can have, friction that is not viscous
//! among it.

/// Lends its equations. Every property is a parameter, so that each link may have its own.
#[branched_pendulum::branched_pendulum(
    gravity = g,
    code = loops,
    trunk(mass = m, com = (d, e), inertia = i, spring = s, rest = r,
        friction(viscous = c, coulomb = f, static = y, stribeck = z, quadratic = q, width = u),
        drag(viscous = k, quadratic = p, width = v)) [
        bough(mass = m, com = (d, e), inertia = i, at = (l, w), spring = s, rest = r,
            friction(viscous = c, coulomb = f, static = y, stribeck = z, quadratic = q, width = u),
            drag(viscous = k, quadratic = p, width = v)) [
            twig(mass = m, com = (d, e), inertia = i, at = (l, w), spring = s, rest = r,
                friction(viscous = c, coulomb = f, static = y, stribeck = z, quadratic = q, width = u),
                drag(viscous = k, quadratic = p, width = v)),
        ],
        leaf(mass = m, com = (d, e), inertia = i, at = (w, l), spring = s, rest = r,
            friction(viscous = c, coulomb = f, static = y, stribeck = z, quadratic = q, width = u),
            drag(viscous = k, quadratic = p, width = v)),
    ],
    drive(torque = torque),
    emit(energies, forces),
)]
pub(crate) struct NonViscous;
