//! The branch: 31 rods that stand upright on springs, all of different sizes.

use branched_pendulum::prelude::*;

/// A young tree without its leaves, 2.2 m high: lengths in m, masses in kg, springs in N m/rad,
/// friction in N m s/rad. Angles are measured from the upward vertical.
#[branched_pendulum(
    gravity = -9.80665,
    trunk: rod(mass = 0.8286, length = 0.737, spring = 110.0, friction = 1.2, rest = 0.06) [
        limb_1: rod(mass = 0.274, length = 0.493, spring = 22.0, friction = 0.16, rest = 0.427) [
            bough_1: rod(mass = 0.106, length = 0.45, spring = 5.0, friction = 0.03, rest = 0.399) [
                twig_1: rod(mass = 0.0353, length = 0.257, spring = 1.1, friction = 0.006, rest = 0.453) [
                    shoot_1: rod(mass = 0.0129, length = 0.18, spring = 0.28, friction = 0.0013, rest = 0.338),
                    shoot_2: rod(mass = 0.0149, length = 0.226, spring = 0.28, friction = 0.0013, rest = -0.326),
                ],
                twig_2: rod(mass = 0.0329, length = 0.305, spring = 1.1, friction = 0.006, rest = -0.461) [
                    shoot_3: rod(mass = 0.0146, length = 0.208, spring = 0.28, friction = 0.0013, rest = 0.344),
                    shoot_4: rod(mass = 0.0128, length = 0.223, spring = 0.28, friction = 0.0013, rest = -0.447),
                ],
            ],
            bough_2: rod(mass = 0.1001, length = 0.421, spring = 5.0, friction = 0.03, rest = -0.442) [
                twig_3: rod(mass = 0.0321, length = 0.278, spring = 1.1, friction = 0.006, rest = 0.336) [
                    shoot_5: rod(mass = 0.0141, length = 0.222, spring = 0.28, friction = 0.0013, rest = 0.463),
                    shoot_6: rod(mass = 0.0142, length = 0.225, spring = 0.28, friction = 0.0013, rest = -0.342),
                ],
                twig_4: rod(mass = 0.0351, length = 0.309, spring = 1.1, friction = 0.006, rest = -0.476) [
                    shoot_7: rod(mass = 0.0138, length = 0.206, spring = 0.28, friction = 0.0013, rest = 0.364),
                    shoot_8: rod(mass = 0.0149, length = 0.188, spring = 0.28, friction = 0.0013, rest = -0.316),
                ],
            ],
        ],
        limb_2: rod(mass = 0.3076, length = 0.475, spring = 22.0, friction = 0.16, rest = -0.347) [
            bough_3: rod(mass = 0.0994, length = 0.404, spring = 5.0, friction = 0.03, rest = 0.374) [
                twig_5: rod(mass = 0.0329, length = 0.322, spring = 1.1, friction = 0.006, rest = 0.369) [
                    shoot_9: rod(mass = 0.0144, length = 0.182, spring = 0.28, friction = 0.0013, rest = 0.363),
                    shoot_10: rod(mass = 0.0147, length = 0.191, spring = 0.28, friction = 0.0013, rest = -0.337),
                ],
                twig_6: rod(mass = 0.0378, length = 0.285, spring = 1.1, friction = 0.006, rest = -0.364) [
                    shoot_11: rod(mass = 0.0132, length = 0.174, spring = 0.28, friction = 0.0013, rest = 0.304),
                    shoot_12: rod(mass = 0.0133, length = 0.207, spring = 0.28, friction = 0.0013, rest = -0.43),
                ],
            ],
            bough_4: rod(mass = 0.0992, length = 0.361, spring = 5.0, friction = 0.03, rest = -0.385) [
                twig_7: rod(mass = 0.0378, length = 0.297, spring = 1.1, friction = 0.006, rest = 0.309) [
                    shoot_13: rod(mass = 0.0153, length = 0.214, spring = 0.28, friction = 0.0013, rest = 0.466),
                    shoot_14: rod(mass = 0.0153, length = 0.187, spring = 0.28, friction = 0.0013, rest = -0.288),
                ],
                twig_8: rod(mass = 0.0381, length = 0.272, spring = 1.1, friction = 0.006, rest = -0.455) [
                    shoot_15: rod(mass = 0.0134, length = 0.219, spring = 0.28, friction = 0.0013, rest = 0.403),
                    shoot_16: rod(mass = 0.013, length = 0.197, spring = 0.28, friction = 0.0013, rest = -0.321),
                ],
            ],
        ],
    ],
    emit(energies, forces, positions),
)]
pub struct Branch;

/// Number of links.
pub const LINKS: usize = Branch::LINKS;

/// Index of the link half way up, which the hand holds.
pub const HELD: usize = 2;
