//! Whole trees behind reduced models.

use core::fmt;

use crate::scalar::Scalar;

/// The whole tree that a reduced model represents: for each link of the tree, the link of the model
/// that it follows.
///
/// A description with `in_phase(…)` or `locked(…)` gives a model of fewer links; its constant
/// `WHOLE` converts a state of the model to one of the tree as described. This is exact: the whole
/// tree, started in that state, moves like the model.
///
/// ```
/// # #[cfg(feature = "macros")] {
/// use branched_pendulum::branched_pendulum;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     stem: rod(mass = 0.2, length = 0.3) [twig: rod(mass = 0.1, length = 0.2) * 2],
///     in_phase(twig)
/// )]
/// struct Branch;
///
/// let mut whole = [0.0; 3];
/// Branch::WHOLE.angles(&[0.1, 0.7], &mut whole).unwrap();
/// assert_eq!(whole, [0.1, 0.7, 0.7]);
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WholeTree {
    model: usize,
    links: usize,
    by_generations: bool,
    orbits: &'static [WholeOrbit],
}

/// Orbit of a whole tree: all links that are copies of the same node of the description.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WholeOrbit {
    /// Number of copies under each copy of the parent.
    pub copies: usize,
    /// True if the copies under one parent move in phase.
    pub in_phase: bool,
    /// Index after the last node of the orbit's subtree.
    pub end: usize,
    /// Motion of the copies relative to the model's links.
    pub motion: WholeMotion,
}

/// How a link of the whole tree moves relative to the model's links.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WholeMotion {
    /// The link moves like a link of the model. The index of the first copy is that of its parent
    /// plus `offset`; the index of each further copy that moves independently is larger by
    /// `stride`.
    Moving {
        /// Index of the first copy minus index of its parent.
        offset: usize,
        /// Difference of the indices of two consecutive copies.
        stride: usize,
    },
    /// The link is locked to its parent and moves with it.
    Locked {
        /// Constant angle relative to the parent, in rad.
        angle: f64,
    },
}

/// Error: a slice does not have one number per link of the model, or per link of the whole tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct WholeLengthError {
    /// Length of the slice given for the model's links.
    pub given: usize,
    /// Number of links of the model.
    pub model: usize,
    /// Length of the slice given for the links of the whole tree.
    pub room: usize,
    /// Number of links of the whole tree.
    pub whole: usize,
}

impl fmt::Display for WholeLengthError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            given,
            model,
            room,
            whole,
        } = self;
        write!(
            f,
            "{given} values and room for {room}, but the model has {model} links and its whole \
             tree {whole}"
        )
    }
}

impl core::error::Error for WholeLengthError {}

impl WholeTree {
    /// Creates a whole tree whose links are in depth-first order.
    #[doc(hidden)]
    #[must_use]
    pub const fn depth_first(model: usize, links: usize, orbits: &'static [WholeOrbit]) -> Self {
        Self {
            model,
            links,
            by_generations: false,
            orbits,
        }
    }

    /// Creates a whole tree whose links are ordered by generation, with all copies in phase.
    #[doc(hidden)]
    #[must_use]
    pub const fn by_generations(model: usize, links: usize, orbits: &'static [WholeOrbit]) -> Self {
        Self {
            model,
            links,
            by_generations: true,
            orbits,
        }
    }

    /// Returns the number of links of the whole tree, which is larger than that of the model.
    #[must_use]
    pub const fn links(&self) -> usize {
        self.links
    }

    /// Calls `visit` for each link of the whole tree, in order, with the index of the model's link
    /// that it moves with, and the constant angle (rad) between the two links. Takes time
    /// proportional to the number of links.
    pub fn for_each(&self, mut visit: impl FnMut(usize, f64)) {
        if self.by_generations {
            let (mut copies, mut link) = (1, 0);
            for orbit in self.orbits {
                copies *= orbit.copies;
                if let WholeMotion::Moving { offset, .. } = orbit.motion {
                    link += offset;
                }
                for _ in 0..copies {
                    visit(link, 0.0);
                }
            }
        } else {
            self.visit(0, LinkInModel::default(), &mut visit);
        }
    }

    /// Visits all copies of a node under one link, each with its subtree.
    fn visit(&self, orbit: usize, above: LinkInModel, visit: &mut impl FnMut(usize, f64)) {
        let Some(&WholeOrbit {
            copies,
            in_phase,
            end,
            motion,
        }) = self.orbits.get(orbit)
        else {
            return;
        };
        for copy in 0..copies {
            let apart = match in_phase {
                true => above.apart,
                false => above.apart * copies + copy,
            };
            let place = match motion {
                WholeMotion::Moving { offset, stride } => LinkInModel {
                    link: above.link + offset + apart * stride,
                    ..LinkInModel::default()
                },
                WholeMotion::Locked { angle } => LinkInModel {
                    link: above.link,
                    angle: above.angle + angle,
                    apart,
                },
            };
            visit(place.link, place.angle);
            let mut child = orbit + 1;
            while child < end {
                self.visit(child, place, visit);
                let behind = self.orbits.get(child).map_or(end, |child| child.end);
                child = behind.max(child + 1);
            }
        }
    }

    /// Writes, for each link of the model, how many links of the whole tree follow it.
    pub fn counts(&self, counts: &mut [usize]) {
        counts.fill(0);
        self.for_each(|link, _| {
            if let Some(count) = counts.get_mut(link) {
                *count += 1;
            }
        });
    }

    /// Writes the angles (rad) of all links of the whole tree, given the angles of the model's
    /// links.
    ///
    /// # Errors
    /// [`WholeLengthError`] if the slices have other lengths than the model and the whole tree have
    /// links; nothing is written then.
    pub fn angles<T: Scalar>(&self, model: &[T], whole: &mut [T]) -> Result<(), WholeLengthError> {
        self.expand(model, whole, |value, angle| match angle == 0.0 {
            true => value,
            false => value + T::from_f64(angle),
        })
    }

    /// Writes the angular velocities or accelerations of all links of the whole tree given those of
    /// the model.
    ///
    /// # Errors
    /// Errors of [`angles`](Self::angles).
    pub fn velocities<T: Scalar>(
        &self,
        model: &[T],
        whole: &mut [T],
    ) -> Result<(), WholeLengthError> {
        self.expand(model, whole, |value, _| value)
    }

    /// Converts torques (N m) on the links of the whole tree to torques on the model's links with
    /// the same power: each is the sum over the links that follow the model's link.
    ///
    /// # Errors
    /// Errors of [`angles`](Self::angles).
    pub fn torques<T: Scalar>(&self, whole: &[T], model: &mut [T]) -> Result<(), WholeLengthError> {
        self.check(model.len(), whole.len())?;
        model.fill(T::from_f64(0.0));
        let mut whole = whole.iter();
        self.for_each(|link, _| {
            if let (Some(&torque), Some(sum)) = (whole.next(), model.get_mut(link)) {
                *sum = *sum + torque;
            }
        });
        Ok(())
    }

    fn check(&self, given: usize, room: usize) -> Result<(), WholeLengthError> {
        if given == self.model && room == self.links {
            return Ok(());
        }
        Err(WholeLengthError {
            given,
            model: self.model,
            room,
            whole: self.links,
        })
    }

    fn expand<T: Copy>(
        &self,
        model: &[T],
        whole: &mut [T],
        value: impl Fn(T, f64) -> T,
    ) -> Result<(), WholeLengthError> {
        self.check(model.len(), whole.len())?;
        let mut room = whole.iter_mut();
        self.for_each(|link, angle| {
            if let (Some(slot), Some(given)) = (room.next(), model.get(link)) {
                *slot = value(*given, angle);
            }
        });
        Ok(())
    }
}

/// Link of the model that a link of the whole tree follows.
#[derive(Clone, Copy, Default)]
struct LinkInModel {
    /// Index of the link in the model.
    link: usize,
    /// Constant angle between the two links, in rad.
    angle: f64,
    /// Index of this copy among the copies of locked links on the same link of the model.
    apart: usize,
}
