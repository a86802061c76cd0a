//! Trees whose normal form has no formulas.

use super::Mistake;

pub(super) const MISTAKES: &[Mistake] = &[
    (
        "normal_form_of_three_modes",
        "#[branched_pendulum(gravity = 1, emit(normal_form),
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) [c: rod(mass = 1, length = 1) * 2]])] struct Pendulum;",
    ),
    (
        "normal_form_in_phase",
        "#[branched_pendulum(gravity = 1, emit(normal_form), in_phase(b),
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2])] struct Pendulum;",
    ),
    (
        "normal_form_of_unequal_copies",
        "#[branched_pendulum(gravity = 1, emit(normal_form),
    a: rod(mass = 1, length = 1) [b: rod(mass = each(1, 2), length = 1) * 2])] struct Pendulum;",
    ),
    (
        "normal_form_off_axis",
        "#[branched_pendulum(gravity = 1, emit(normal_form(all)),
    a(mass = 1, com = (1, 0.1), inertia = 1, joint = 1) [b: rod(mass = 1, length = 1)])] struct Pendulum;",
    ),
    (
        "normal_form_with_a_rest_angle",
        "#[branched_pendulum(gravity = 1, emit(normal_form),
    a: rod(mass = 1, length = 1, spring = 1, rest = 0.1))] struct Pendulum;",
    ),
    (
        "normal_form_with_springs_between",
        "#[branched_pendulum(gravity = 1, emit(normal_form), siblings(b, spring = 1),
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1) * 2])] struct Pendulum;",
    ),
    (
        "normal_form_without_gravity",
        "#[branched_pendulum(gravity = 0, emit(normal_form), a: rod(mass = 1, length = 1))] struct Pendulum;",
    ),
    (
        "normal_form_of_independent_links",
        "#[branched_pendulum(gravity = 1, emit(normal_form),
    a: rod(mass = 1, length = 1) [b: rod(mass = 1, length = 1, at = 0) * 2])] struct Pendulum;",
    ),
];
