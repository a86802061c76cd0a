//! Taylor expansions of trees whose number of links is not a compile-time constant.

use super::buffer::FewLinkBuffers;
use super::caller_buffers::{CallerBuffers, buffer_quads};
use super::expand::{Expansion, workspace};
use super::friction::law_buffer_len;
use super::lines::line_buffer_len;
use super::links::TreeLinks;
use super::start::{Constants, Origin};
use super::torques::TreeTorques;
use super::tree::{SeriesTree, Topology};
use crate::scalar::Scalar;
use crate::scalar::kind::ByKind;
use crate::simd::{Kernel, Quad, Simd};

impl<T: Scalar> SeriesTree<T> {
    /// Returns the number of quads of workspace that [`expand`](Self::expand) needs to order
    /// `order`.
    #[must_use]
    pub fn workspace(&self, order: usize) -> usize {
        let links = self.inertias.len();
        let laws = self.non_viscous.len() * law_buffer_len(order);
        let lines = self.lines.iter().map(|line| line_buffer_len(line, order));
        workspace(links, order)
            + buffer_quads(links)
            + 3 * links.div_ceil(4)
            + laws
            + lines.sum::<usize>()
    }

    /// Writes the Taylor coefficients of the motion through angles `theta` and angular velocities
    /// `omega`. For each order these are the coefficients of the angles, then of the angular
    /// velocities.
    ///
    /// If the tree is driven, `drive` has, for each order, the coefficients of the acceleration of
    /// the root's pivot, across and along the direction of gravity (with gravity in order 0), and
    /// the torque on the root in N m; [`SeriesLink::weight`](super::SeriesLink::weight) is then a
    /// torque at a gravity of 1. If a length does not fit, all coefficients are NaN.
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
            // The velocities of order 1 follow later.
            if let (Some(own), Some(next)) = (halves.next(), halves.next()) {
                own.copy_from_slice(angles);
                next.copy_from_slice(omega);
            }
        }
        let (work, rest) = work.split_at_mut(workspace(links, order));
        let quads = links.div_ceil(4);
        let (free, rest) = rest.split_at_mut(buffer_quads(links));
        let (sines, rest) = rest.split_at_mut(quads);
        let (cosines, rest) = rest.split_at_mut(quads);
        let (first, rest) = rest.split_at_mut(quads);
        let (laws, lines) = rest.split_at_mut(self.non_viscous.len() * law_buffer_len(order));
        write_sines(theta, sines, cosines);
        let mut torques = TreeTorques {
            tree: self,
            drive,
            laws,
            buffer: law_buffer_len(order),
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
        T::by_kind(InBuffers {
            expansion,
            free,
            work,
            torques,
        });
    }
}

/// Runs an expansion in the kind of workspace that suits its number type.
struct InBuffers<'a, 'w, T> {
    expansion: Expansion<'w, T, &'a Topology, &'w [Quad<T>]>,
    free: &'w mut [Quad<T>],
    work: &'w mut [Quad<T>],
    torques: TreeTorques<'w, T>,
}

impl<T: Scalar> ByKind<T> for InBuffers<'_, '_, T> {
    type Output = ();

    #[inline(always)]
    fn of_any(self) {
        let links = self.expansion.links.count();
        // A few plain numbers fit into registers. Wider numbers do not, and compiling a separate
        // workspace for few of them would take twice the time.
        if const { size_of::<T>() <= size_of::<f64>() } {
            match links {
                1..=4 => {
                    let buffers = FewLinkBuffers::<4, 1> { links };
                    self.expansion.run(buffers, self.work, self.torques);
                }
                5..=8 => {
                    let buffers = FewLinkBuffers::<8, 2> { links };
                    self.expansion.run(buffers, self.work, self.torques);
                }
                _ => self.in_caller_buffer(),
            }
        } else {
            self.in_caller_buffer();
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

/// Runs the expansion of many states at once. This is a separate function because steps in lanes
/// are long, and compile time grows faster than the length of a function.
impl<W, T: Scalar> Kernel<W> for InBuffers<'_, '_, T> {
    type Output = ();

    #[inline(always)]
    fn run<V: Simd<W>>(self) {
        self.in_caller_buffer();
    }
}

impl<T: Scalar> InBuffers<'_, '_, T> {
    #[inline(always)]
    fn in_caller_buffer(self) {
        let links = self.expansion.links.count();
        let free = self.free;
        let buffers = CallerBuffers { free, links };
        self.expansion.run(buffers, self.work, self.torques);
    }
}

/// Writes sines and cosines of all links' angles to quads, padded with zeros.
#[inline(always)]
fn write_sines<T: Scalar>(theta: &[T], sines: &mut [Quad<T>], cosines: &mut [Quad<T>]) {
    for ((four, sines), cosines) in theta.chunks(4).zip(sines).zip(cosines) {
        let mut angles = [T::from_f64(0.0); 4];
        for (angle, own) in angles.iter_mut().zip(four) {
            *angle = *own;
        }
        (sines.0, cosines.0) = T::sin_cos_each(&angles);
    }
}
