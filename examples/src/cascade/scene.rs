//! The trees: every rod carries two or three, each lighter and shorter.

use branched_pendulum::ParameterError;
use branched_pendulum::prelude::*;
use branched_pendulum::sectors::{Scales, degrees_of_freedom};

/// Length of the root, m.
const LENGTH: f64 = 0.3;

/// A tree by rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// Number of generations.
    pub generations: usize,
    /// Rods that hang from each one.
    pub branching: usize,
    /// Mass of a rod over that of its parent.
    pub mass_ratio: f64,
    /// Length of a rod over that of its parent.
    pub length_ratio: f64,
}

impl Shape {
    /// Number of rods in a generation.
    pub fn width(&self, generation: usize) -> usize {
        self.branching.pow(generation as u32)
    }

    /// Number of rods.
    pub fn links(&self) -> usize {
        (0..self.generations).map(|g| self.width(g)).sum()
    }

    /// Length of a rod, m.
    pub fn length(&self, generation: usize) -> f64 {
        LENGTH * self.length_ratio.powi(generation as i32)
    }

    /// Number of the rod at a place of a generation.
    pub fn link(&self, generation: usize, place: usize) -> usize {
        (0..generation).map(|g| self.width(g)).sum::<usize>() + place
    }

    /// Degrees of freedom of a scale: 0 the means, s the differences between rods of
    /// generation s under one parent, with all that hangs from them.
    pub fn degrees_of_freedom(&self, scale: usize) -> usize {
        let mut copies = vec![self.branching; self.generations];
        copies[0] = 1;
        degrees_of_freedom(&copies, scale)
    }
}

/// A model of such trees, with friction.
pub trait RodTree: Forced<f64> + Scales<f64> + Sync + std::fmt::Debug {
    /// The tree whose youngest pivots have the friction `friction`, N m s, and those of
    /// every generation `ratio` times that of the one above.
    ///
    /// # Errors
    /// [`ParameterError`] of values that overflow.
    fn of(shape: &Shape, friction: f64, ratio: f64) -> Result<Self, ParameterError>;
}

/// The trees, by number of children and of generations: a module for each.
macro_rules! trees {
    ($($module:ident $branching:tt $generations:tt)*) => {
        /// Number of children and of generations of all trees that there are.
        pub const TREES: &[(usize, usize)] = &[$(($branching, $generations)),*];

        $(
            /// Rods by rule.
            pub mod $module {
                use branched_pendulum::prelude::*;

                /// Rods by rule.
                #[branched_pendulum(
                    gravity = 9.80665,
                    parameters(mass_ratio, length_ratio, friction, friction_ratio),
                    arm: generations(count = $generations, branching = $branching, shape = rod,
                        mass = 0.12, length = 0.3, mass_ratio = mass_ratio,
                        length_ratio = length_ratio, friction = friction,
                        friction_ratio = friction_ratio, code = loops),
                    emit(energies, forces, budget(parseval, scales)),
                )]
                pub struct Tree;
            }

            impl RodTree for $module::Tree {
                fn of(shape: &Shape, friction: f64, ratio: f64) -> Result<Self, ParameterError> {
                    Self::new($module::TreeParameters {
                        mass_ratio: shape.mass_ratio,
                        length_ratio: shape.length_ratio,
                        friction: friction * ratio.powi(1 - $generations),
                        friction_ratio: ratio,
                    })
                }
            }
        )*
    };
}

trees! {
    binary_3 2 3
    binary_4 2 4
    binary_5 2 5
    binary_6 2 6
    binary_7 2 7
    binary_8 2 8
    ternary_3 3 3
    ternary_4 3 4
    ternary_5 3 5
}

/// Calls a function of a tree with the one of this shape: `of_shape!(shape, f(…))` is
/// `f::<Tree>(…)`.
macro_rules! of_shape {
    ($shape:expr, $function:ident($($argument:expr),*)) => {
        match ($shape.branching, $shape.generations) {
            (2, 3) => $function::<$crate::cascade::scene::binary_3::Tree>($($argument),*),
            (2, 4) => $function::<$crate::cascade::scene::binary_4::Tree>($($argument),*),
            (2, 6) => $function::<$crate::cascade::scene::binary_6::Tree>($($argument),*),
            (2, 7) => $function::<$crate::cascade::scene::binary_7::Tree>($($argument),*),
            (2, 8) => $function::<$crate::cascade::scene::binary_8::Tree>($($argument),*),
            (3, 3) => $function::<$crate::cascade::scene::ternary_3::Tree>($($argument),*),
            (3, 4) => $function::<$crate::cascade::scene::ternary_4::Tree>($($argument),*),
            (3, 5) => $function::<$crate::cascade::scene::ternary_5::Tree>($($argument),*),
            // The command line has no other.
            _ => $function::<$crate::cascade::scene::binary_5::Tree>($($argument),*),
        }
    };
}
pub(super) use of_shape;
