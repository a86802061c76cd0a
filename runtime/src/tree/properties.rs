//! Where the links of a tree in loops are.

use alloc::vec;
use alloc::vec::Vec;
use core::marker::PhantomData;

use super::bodies::PointEquations;
use super::equations::LinkMotion;
use super::shape::Shape;
use crate::scalar::Scalar;
use crate::system::positions::COLUMNS;
use crate::system::{LinkPoint, LinkProperties};

/// The links of a tree in loops as data. Emitted models hold them where positions are
/// asked for.
///
/// All functions but [`of`](Self::of) take O(links), and allocate some numbers for each
/// link. Points are those of [`PointEquations`], with the opposite y in trees that
/// [stand](Self::standing).
#[derive(Clone, Debug, PartialEq)]
pub struct PropertyTable<E, T> {
    shape: Shape,
    /// Rows of all links or generations, one after the other.
    rows: Vec<T>,
    /// 1, or −1 in trees that stand.
    up: T,
    equations: PhantomData<E>,
}

/// A link in the order from the root: its number, its parent, its properties.
type Visited<T> = (usize, Option<usize>, LinkProperties<T>);

impl<E: PointEquations, T: Scalar> PropertyTable<E, T> {
    /// Links with the constants of each or of each generation, one after the other, in
    /// SI units, in the order of the fields of [`LinkProperties`].
    #[must_use]
    pub fn new(shape: Shape, rows: Vec<T>) -> Self {
        Self {
            shape,
            rows,
            up: T::from_f64(1.0),
            equations: PhantomData,
        }
    }

    /// Returns the same links in a tree that stands, or hangs: angles are those from the
    /// upward vertical, or from the downward one as at first.
    #[must_use]
    pub fn standing(self, stands: bool) -> Self {
        let up = T::from_f64(if stands { -1.0 } else { 1.0 });
        Self { up, ..self }
    }

    /// Returns the same links on other scalars.
    #[must_use]
    pub fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> PropertyTable<E, S> {
        PropertyTable {
            shape: self.shape.clone(),
            rows: self.rows.iter().map(|&value| convert(value)).collect(),
            up: convert(self.up),
            equations: PhantomData,
        }
    }

    /// Returns a row, if there is one.
    #[inline(always)]
    fn row(&self, number: usize) -> Option<&[T; COLUMNS]> {
        let (rows, _) = self.rows.as_chunks();
        rows.get(number)
    }

    /// Returns the properties of a link.
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

    /// Sums, from the root to a point of each link, of what `step` says of a place on a
    /// link.
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
            sums[link] = match properties.place(point) {
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
        // Forces on the subtree of each link.
        let mut sums = forces.to_vec();
        for (link, parent, properties) in self.visited().into_iter().rev() {
            let torque = |[along, across]: [T; 2], carrier: usize, [x, y]: [T; 2]| {
                let (sine, cosine) = directions[carrier];
                let resting = LinkMotion::turning(sine, cosine, T::from_f64(0.0));
                let [torque] = E::point_torque(resting, [along, across, x, self.up * y]);
                torque
            };
            if let Some(place) = properties.place(point) {
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

    /// The links from the root to the leaves.
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
    /// Returns the parent of a link but the root's, and the number of its row.
    fn link(&self, link: usize) -> Option<(Option<usize>, usize)> {
        let listed = |parents: &[u32]| {
            let &parent = parents.get(link)?;
            Some(((link > 0).then_some(parent as usize), link))
        };
        match self {
            Self::Parents(parents) => listed(parents),
            Self::Shared(parents) => listed(parents),
            Self::Generations(copies) => {
                let (generation, number) = super::copies::place(copies, link)?;
                // Links of the generation above, in front of this one.
                let above: usize = copies.iter().take(generation).product();
                let parent = || link - number - above + number % above;
                Some(((generation > 0).then(parent), generation))
            }
        }
    }
}

/// Sines and cosines of the angles.
fn directions<T: Scalar>(theta: &[T]) -> Vec<(T, T)> {
    theta.iter().map(|angle| angle.sin_cos()).collect()
}
