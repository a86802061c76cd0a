//! Trees behind reduced models.

use core::fmt;

use crate::scalar::Scalar;

/// The whole tree behind a reduced model: which of its links move as which link of the
/// model.
///
/// A description with `in_phase(…)` or `locked(…)` gives a model of fewer links; its
/// constant `WHOLE` takes a state of the model to one of the tree as described. This is
/// exact: the whole tree, started so, moves so.
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

/// Links of a whole tree that are copies of one node of the description.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WholeOrbit {
    /// Copies under each copy of the parent.
    pub copies: usize,
    /// True if the copies under one parent move alike.
    pub in_phase: bool,
    /// Index behind the last node of the subtree.
    pub end: usize,
    /// Motion of the copies.
    pub motion: WholeMotion,
}

/// Motion of a link of a whole tree in terms of the model's links.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WholeMotion {
    /// As a link of the model: the first copy as the one `offset` places behind the link
    /// that it hangs from, each further one that moves by itself `stride` places later.
    Moving {
        /// Places between the first copy and the link that it hangs from.
        offset: usize,
        /// Places from one copy to the next.
        stride: usize,
    },
    /// As the link that it hangs from.
    Locked {
        /// Angle to that link, rad.
        angle: f64,
    },
}

/// Slices of other lengths than a model and its whole tree have links.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct WholeLengthError {
    /// Number of values of the model that were given.
    pub given: usize,
    /// Number of links of the model.
    pub model: usize,
    /// Room for values of the whole tree that was given.
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
    /// A tree whose links stand depth first.
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

    /// A tree whose links stand generation by generation, all copies in phase.
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

    /// Returns the number of links of the whole tree. The model has fewer.
    #[must_use]
    pub const fn links(&self) -> usize {
        self.links
    }

    /// Calls `visit` with the link of the model as which each link of the whole tree
    /// moves, and with its angle to that one (in rad), in the order of the whole tree's
    /// links. Linear in their number.
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

    /// Visits all copies of a node under one link, each with what hangs from it.
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

    /// Counts the links of the whole tree that move as each link of the model.
    pub fn counts(&self, counts: &mut [usize]) {
        counts.fill(0);
        self.for_each(|link, _| {
            if let Some(count) = counts.get_mut(link) {
                *count += 1;
            }
        });
    }

    /// Writes the angles of all links (in rad) at the angles of the model.
    ///
    /// # Errors
    /// Slices of other lengths than the model and the whole tree have links; nothing is
    /// written then.
    pub fn angles<T: Scalar>(&self, model: &[T], whole: &mut [T]) -> Result<(), WholeLengthError> {
        self.expand(model, whole, |value, angle| match angle == 0.0 {
            true => value,
            false => value + T::from_f64(angle),
        })
    }

    /// Writes the angular velocities or accelerations of all links at those of the model.
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

    /// Writes the torques on the links of the model that those on all links of the whole
    /// tree come to: on each the sum over the links that move as it. Their power is the
    /// same.
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

/// Where a link of the whole tree stands in the model.
#[derive(Clone, Copy, Default)]
struct LinkInModel {
    /// Link of the model.
    link: usize,
    /// Angle to that link.
    angle: f64,
    /// Number of this copy among those of locked links that hang from one link.
    apart: usize,
}
