//! Expansions of trees whose number of links no type tells.

use super::expand::{Expansion, workspace};
use super::friction::law_room;
use super::lent::{LentRooms, lent};
use super::lines::line_room;
use super::links::TreeLinks;
use super::room::RoomsOfFew;
use super::start::{Constants, Origin};
use super::torques::TreeTorques;
use super::tree::{Hanging, SeriesTree};
use crate::scalar::Scalar;
use crate::scalar::kind::ByKind;
use crate::simd::{Kernel, Quad, Simd};

impl<T: Scalar> SeriesTree<T> {
    /// Returns the number of quads that [`expand`](Self::expand) works in, to order `order`.
    #[must_use]
    pub fn workspace(&self, order: usize) -> usize {
        let links = self.inertias.len();
        let laws = self.rough.len() * law_room(order);
        let lines = self.lines.iter().map(|line| line_room(line, order));
        workspace(links, order) + lent(links) + 3 * links.div_ceil(4) + laws + lines.sum::<usize>()
    }

    /// Writes the Taylor coefficients of the motion through angles `theta` and angular
    /// velocities `omega`, order by order: those of the angles, then those of the angular
    /// velocities.
    ///
    /// `drive` has for each order the acceleration of the root's pivot, across and along the
    /// direction of gravity, with gravity in order 0, and the torque on the root in N m, if
    /// there is a drive; [`SeriesLink::weight`](super::SeriesLink::weight) is at a gravity of one
    /// then. Where lengths do not fit, all coefficients are NaN.
    #[inline(always)]
    pub fn expand(
        &self,
        [theta, omega]: [&[T]; 2],
        drive: Option<&[Quad<T>]>,
        coefficients: &mut [T],
        work: &mut [Quad<T>],
    ) {
        let links = self.inertias.len();
        let count = coefficients.len() / (2 * links).max(1);
        let order = count.saturating_sub(1);
        let fits = [theta.len(), omega.len()] == [links; 2]
            && coefficients.len() == 2 * links * count
            && work.len() >= self.workspace(order)
            && drive.is_none_or(|drive| drive.len() >= count);
        if !fits || links == 0 {
            coefficients.fill(T::from_f64(f64::NAN));
            return;
        }
        let mut halves = coefficients.chunks_exact_mut(links);
        for angles in [theta, omega] {
            // Velocities of order 1 follow.
            if let (Some(own), Some(next)) = (halves.next(), halves.next()) {
                own.copy_from_slice(angles);
                next.copy_from_slice(omega);
            }
        }
        let (work, rest) = work.split_at_mut(workspace(links, order));
        let quads = links.div_ceil(4);
        let (free, rest) = rest.split_at_mut(lent(links));
        let (sines, rest) = rest.split_at_mut(quads);
        let (cosines, rest) = rest.split_at_mut(quads);
        let (first, rest) = rest.split_at_mut(quads);
        let (laws, lines) = rest.split_at_mut(self.rough.len() * law_room(order));
        turn(theta, sines, cosines);
        let mut torques = TreeTorques {
            tree: self,
            drive,
            laws,
            room: law_room(order),
            lines,
            last: order,
        };
        torques.start([theta, omega], first);
        let expansion = Expansion {
            links: &*self.hanging,
            origin: Origin {
                omega,
                sines: &*sines,
                cosines: &*cosines,
                bias: &*first,
            },
            constants: Constants {
                inertias: &self.inertias,
                moments: &self.moments,
                attachments: &self.attachments,
                weights: &self.weights,
                lateral_weights: &self.lateral_weights,
            },
            coefficients,
            count,
        };
        T::by_kind(InRooms {
            expansion,
            free,
            work,
            torques,
        });
    }
}

/// Runs an expansion in the room that serves its numbers.
struct InRooms<'a, 'w, T> {
    expansion: Expansion<'w, T, &'a Hanging, &'w [Quad<T>]>,
    free: &'w mut [Quad<T>],
    work: &'w mut [Quad<T>],
    torques: TreeTorques<'w, T>,
}

impl<T: Scalar> ByKind<T> for InRooms<'_, '_, T> {
    type Output = ();

    #[inline(always)]
    fn of_any(self) {
        let links = self.expansion.links.count();
        // Few plain numbers lie in registers. Others are too many for these, and compiling room
        // for few of them apart would take twice the time.
        if const { size_of::<T>() <= size_of::<f64>() } {
            match links {
                1..=4 => {
                    let rooms = RoomsOfFew::<4, 1> { links };
                    self.expansion.run(rooms, self.work, self.torques);
                }
                5..=8 => {
                    let rooms = RoomsOfFew::<8, 2> { links };
                    self.expansion.run(rooms, self.work, self.torques);
                }
                _ => self.in_lent_room(),
            }
        } else {
            self.in_lent_room();
        }
    }

    #[inline(always)]
    fn of_wide<W: Scalar>(self)
    where
        T: Simd<W>,
    {
        T::in_own_function(self);
    }
}

/// For many states at once: in a function of its own, since compiling one takes longer than in
/// proportion to its length, and steps in lanes are long.
impl<W, T: Scalar> Kernel<W> for InRooms<'_, '_, T> {
    type Output = ();

    #[inline(always)]
    fn run<V: Simd<W>>(self) {
        self.in_lent_room();
    }
}

impl<T: Scalar> InRooms<'_, '_, T> {
    #[inline(always)]
    fn in_lent_room(self) {
        let links = self.expansion.links.count();
        let free = self.free;
        let rooms = LentRooms { free, links };
        self.expansion.run(rooms, self.work, self.torques);
    }
}

/// Writes sines and cosines of all links, zeros where there is no link.
#[inline(always)]
fn turn<T: Scalar>(theta: &[T], sines: &mut [Quad<T>], cosines: &mut [Quad<T>]) {
    for ((four, sines), cosines) in theta.chunks(4).zip(sines).zip(cosines) {
        let mut angles = [T::from_f64(0.0); 4];
        for (angle, own) in angles.iter_mut().zip(four) {
            *angle = *own;
        }
        (sines.0, cosines.0) = T::sin_cos_each(&angles);
    }
}
