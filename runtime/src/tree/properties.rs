//! Positions, velocities and torques of points of links, for trees that are computed in loops.

use alloc::vec;
use alloc::vec::Vec;
use core::marker::PhantomData;

use super::bodies::PointEquations;
use super::equations::LinkMotion;
use super::shape::Shape;
use crate::scalar::Scalar;
use crate::system::positions::COLUMNS;
use crate::system::{LinkPoint, LinkProperties};

/// Table of the properties of all links of a tree that is computed in loops. Emitted models contain
/// it if positions are requested.
///
/// All functions except [`of`](Self::of) take O(links) operations and allocate some numbers for
/// each link. Points are those of [`PointEquations`], with the opposite y in trees that
/// [stand](Self::standing).
#[derive(Clone, Debug, PartialEq)]
pub struct PropertyTable<E, T> {
    shape: Shape,
    /// Properties of all links, or of one link per generation, one row after the other.
    rows: Vec<T>,
    /// Sign of y in the results: 1, or −1 in trees that stand upright.
    up: T,
    equations: PhantomData<E>,
}

/// A link in the order from the root to the leaves: its index, its parent, its properties.
type Visited<T> = (usize, Option<usize>, LinkProperties<T>);

impl<E: PointEquations, T: Scalar> PropertyTable<E, T> {
    /// Creates the table from the constants of each link or of each generation, one row after the
    /// other, in SI units, in the order of the fields of [`LinkProperties`].
    #[must_use]
    pub fn new(shape: Shape, rows: Vec<T>) -> Self {
        Self {
            shape,
            rows,
            up: T::from_f64(1.0),
            equations: PhantomData,
        }
    }

    /// Returns the same links in a tree that stands (angles from the upward vertical) or hangs
    /// (angles from the downward vertical, the default).
    #[must_use]
    pub fn standing(self, stands: bool) -> Self {
        let up = T::from_f64(if stands { -1.0 } else { 1.0 });
        Self { up, ..self }
    }

    /// Returns the same links with constants of another scalar type.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> PropertyTable<E, S> {
        PropertyTable {
            shape: self.shape.clone(),
            rows: self.rows.iter().map(|&value| convert(value)).collect(),
            up: convert(self.up),
            equations: PhantomData,
        }
    }

    /// Returns the row of properties with this number, if it exists.
    #[inline(always)]
    fn row(&self, number: usize) -> Option<&[T; COLUMNS]> {
        let (rows, _) = self.rows.as_chunks();
        rows.get(number)
    }

    /// Returns the properties of a link; `None` if it does not exist.
    #[must_use]
    pub fn of(&self, link: usize) -> Option<LinkProperties<T>> {
        let (parent, row) = self.shape.link(link)?;
        Some(LinkProperties::from_row(parent, self.row(row)?))
    }

    /// Writes positions as
    /// [`Positions::points_into`](crate::Positions::points_into).
    pub fn points_into(&self, point: LinkPoint, theta: &[T], points: &mut [[T; 2]]) {
        self.along_tree(point, [theta, theta], points, E::point);
    }

    /// Writes velocities as
    /// [`Positions::point_velocities_into`](crate::Positions::point_velocities_into).
    pub fn velocities_into(
        &self,
        point: LinkPoint,
        theta: &[T],
        omega: &[T],
        velocities: &mut [[T; 2]],
    ) {
        self.along_tree(point, [theta, omega], velocities, E::point_velocity);
    }

    /// Computes, for each link, the sum of `step` over the links on the path from the root to a
    /// point of this link.
    fn along_tree(
        &self,
        point: LinkPoint,
        [theta, omega]: [&[T]; 2],
        sums: &mut [[T; 2]],
        step: impl Fn(LinkMotion<T>, [T; 2]) -> [T; 2],
    ) {
        let links = self.shape.links();
        if [theta.len(), omega.len(), sums.len()] != [links; 3] {
            return sums.fill([T::from_f64(f64::NAN); 2]);
        }
        let directions = directions(theta);
        let mut pivots = vec![[T::from_f64(0.0); 2]; links];
        for (link, parent, properties) in self.visited() {
            let from = |start: [T; 2], place, carrier: usize| {
                let (sine, cosine) = directions[carrier];
                let motion = LinkMotion::turning(sine, cosine, omega[carrier]);
                let [x, y] = step(motion, place);
                [start[0] + x, start[1] + self.up * y]
            };
            if let Some(parent) = parent {
                pivots[link] = from(pivots[parent], properties.pivot, parent);
            }
            sums[link] = match properties.offset_from_pivot(point) {
                Some(place) => from(pivots[link], place, link),
                None => pivots[link],
            };
        }
    }

    /// Writes torques as
    /// [`Positions::point_torques_into`](crate::Positions::point_torques_into).
    pub fn torques_into(
        &self,
        point: LinkPoint,
        theta: &[T],
        forces: &[[T; 2]],
        torques: &mut [T],
    ) {
        let links = self.shape.links();
        if [theta.len(), forces.len(), torques.len()] != [links; 3] {
            return torques.fill(T::from_f64(f64::NAN));
        }
        torques.fill(T::from_f64(0.0));
        let directions = directions(theta);
        // Sum of the forces on the subtree of each link.
        let mut sums = forces.to_vec();
        for (link, parent, properties) in self.visited().into_iter().rev() {
            let torque = |[along, across]: [T; 2], carrier: usize, [x, y]: [T; 2]| {
                let (sine, cosine) = directions[carrier];
                let resting = LinkMotion::turning(sine, cosine, T::from_f64(0.0));
                let [torque] = E::point_torque(resting, [along, across, x, self.up * y]);
                torque
            };
            if let Some(place) = properties.offset_from_pivot(point) {
                torques[link] = torques[link] + torque(place, link, forces[link]);
            }
            if let Some(parent) = parent {
                let [x, y] = sums[link];
                let own = torque(properties.pivot, parent, [x, y]);
                torques[parent] = torques[parent] + own;
                sums[parent] = [sums[parent][0] + x, sums[parent][1] + y];
            }
        }
    }

    /// Returns all links in an order in which parents come before children.
    fn visited(&self) -> Vec<Visited<T>> {
        let mut visited = Vec::with_capacity(self.shape.links());
        for strip in self.shape.strips() {
            if let Some(row) = self.row(strip.row) {
                let visit = |(link, parent)| (link, parent, LinkProperties::from_row(parent, row));
                visited.extend(strip.each().map(visit));
            }
        }
        visited
    }
}

impl Shape {
    /// Returns the parent of a link (`None` for the root) and the index of its row of properties.
    fn link(&self, link: usize) -> Option<(Option<usize>, usize)> {
        let listed = |parents: &[u32]| {
            let &parent = parents.get(link)?;
            Some(((link > 0).then_some(parent as usize), link))
        };
        match self {
            Self::Parents(parents) => listed(parents),
            Self::Shared(parents) => listed(parents),
            Self::Generations(copies) => {
                let (generation, number) = super::copies::generation_and_index(copies, link)?;
                // Number of links of the generation above, which come before this one.
                let above: usize = copies.iter().take(generation).product();
                let parent = || link - number - above + number % above;
                Some(((generation > 0).then(parent), generation))
            }
        }
    }
}

/// Returns the sine and cosine of each angle.
fn directions<T: Scalar>(theta: &[T]) -> Vec<(T, T)> {
    theta.iter().map(|angle| angle.sin_cos()).collect()
}
