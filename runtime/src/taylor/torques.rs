//! Taylor coefficients of all torques on a tree's links except gravity: friction, drag and springs
//! of links, spring-dampers and lines between links, and a drive.

use super::bias::{Bias, KnownState};
use super::lines::{LineSeries, line_buffer_len};
use super::links::TreeLinks;
use super::tree::SeriesTree;
use crate::scalar::Scalar;
use crate::simd::Quad;

/// Computes the torques on a tree, order by order, in an expansion.
pub(super) struct TreeTorques<'a, T> {
    pub(super) tree: &'a SeriesTree<T>,
    /// For each order, the coefficients of the acceleration of the root's pivot and of the torque
    /// on the root.
    pub(super) drive: Option<&'a [Quad<T>]>,
    /// Workspace of all friction laws, one after the other.
    pub(super) laws: &'a mut [Quad<T>],
    /// Workspace length of each friction law, in quads.
    pub(super) buffer: usize,
    /// Workspace of all lines between points, one after the other.
    pub(super) lines: &'a mut [Quad<T>],
    /// Last order.
    pub(super) last: usize,
}

impl<T: Scalar> TreeTorques<'_, T> {
    /// Writes the bias (order 0 of the torques) at the start.
    #[inline(always)]
    pub(super) fn start(&mut self, [theta, omega]: [&[T]; 2], bias: &mut [Quad<T>]) {
        self.add::<true>(0, [theta, omega], bias);
    }

    /// Adds the coefficients of one order of the torques to `bias`. `START` must be true for
    /// order 0.
    #[inline(always)]
    fn add<const START: bool>(
        &mut self,
        order: usize,
        [theta, omega]: [&[T]; 2],
        bias: &mut [Quad<T>],
    ) {
        let (tree, links) = (self.tree, &*self.tree.hanging);
        bias.fill(Quad::splat(T::from_f64(0.0)));
        // Torques against the motion count as positive.
        let mut oppose = |link: usize, torque: T| {
            let own = &mut bias[link / 4].0[link % 4];
            *own = *own + torque;
        };
        let relative = |numbers: &[T], link: usize| match link {
            0 => numbers[0],
            _ => numbers[link] - numbers[links.parent(link)],
        };
        for (link, &[friction, drag, spring, rest]) in tree.passive.iter().enumerate() {
            let mut angle = relative(theta, link);
            if START {
                angle = angle - rest;
            }
            let torque = friction * relative(omega, link) + spring * angle;
            oppose(link, torque + drag * omega[link]);
            if link > 0 {
                oppose(links.parent(link), -torque);
            }
        }
        for own in &tree.spring_dampers {
            let [a, b] = own.links;
            let mut angle = theta[a] - theta[b];
            if START {
                angle = angle - own.rest;
            }
            let torque = own.friction * (omega[a] - omega[b]) + own.spring * angle;
            oppose(a, torque);
            oppose(b, -torque);
        }
        for (law, buffer) in tree
            .non_viscous
            .iter()
            .zip(self.laws.chunks_exact_mut(self.buffer))
        {
            let rate = match law.other {
                None => omega[law.link],
                Some(other) => omega[law.link] - omega[other],
            };
            let torque = match START {
                true => law.start(rate, buffer),
                false => law.order(order, rate, buffer),
            };
            oppose(law.link, torque);
            if let Some(other) = law.other {
                oppose(other, -torque);
            }
        }
        let mut free = &mut *self.lines;
        for line in &tree.lines {
            let (buffer, rest) = free.split_at_mut(line_buffer_len(line, self.last));
            let last = self.last;
            let mut series = LineSeries { line, buffer, last };
            series.write::<START>(order, [theta, omega]);
            for (arm, own) in line.arms.iter().enumerate() {
                oppose(own.link, series.torque(arm, order));
            }
            free = rest;
        }
        if let Some(Quad([_, _, torque, _])) = self.drive.and_then(|drive| drive.get(order)) {
            oppose(0, -(*torque * tree.share));
        }
    }
}

impl<T: Scalar> Bias<T> for TreeTorques<'_, T> {
    const NEEDS_SINES: bool = false;

    #[inline(always)]
    fn moves(&self) -> bool {
        let SeriesTree {
            passive,
            spring_dampers,
            lines,
            non_viscous,
            ..
        } = self.tree;
        let own = [
            passive.is_empty(),
            spring_dampers.is_empty(),
            lines.is_empty(),
            non_viscous.is_empty(),
        ];
        own.contains(&false) || self.drive.is_some()
    }

    #[inline(always)]
    fn write(&mut self, known: KnownState<'_, T>, bias: &mut [Quad<T>]) {
        self.add::<false>(known.order, [known.theta, known.omega], bias);
    }

    #[inline(always)]
    fn acceleration_coefficients(&self, order: usize) -> Option<[T; 2]> {
        let Quad([x, y, _, _]) = self.drive?.get(order)?;
        Some([*x, *y])
    }
}
