//! Positions and velocities of points of links, and torques of forces that act there.

use alloc::vec;
use alloc::vec::Vec;

use super::Pendulum;
use super::by_reference::by_reference;
use crate::model::Transfer;
use crate::scalar::Scalar;

/// A point that every link has: pivot, centre of mass or end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinkPoint {
    /// The pivot at which the link is attached to its parent.
    Pivot,
    /// The centre of mass.
    Centre,
    /// The end of the link: the `joint` of its description, or the end of its shape; for a link
    /// with neither, the centre of mass.
    End,
}

impl LinkPoint {
    /// All points.
    pub const ALL: [Self; 3] = [Self::Pivot, Self::Centre, Self::End];
}

/// Mass, inertia and points of a link, in SI units. Vectors are [along, across] the link: at angle
/// 0, along is downwards (upwards in a tree that [stands](Positions::stands)), and across is to the
/// side to which positive angles move the link's end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkProperties<T> {
    /// Index of the parent link; `None` for the root.
    pub parent: Option<usize>,
    /// Mass, kg.
    pub mass: T,
    /// Moment of inertia about the centre of mass, kg m².
    pub inertia: T,
    /// Centre of mass relative to the link's pivot, m.
    pub centre: [T; 2],
    /// Pivot by which the link hangs on its parent, relative to the parent's pivot, in m.
    pub pivot: [T; 2],
    /// End relative to the link's pivot, m.
    pub end: [T; 2],
}

/// Number of values in a row of link properties.
pub(crate) const COLUMNS: usize = 8;

impl<T: Scalar> LinkProperties<T> {
    /// Returns the distance (m) from the link's pivot to its end.
    #[must_use]
    pub fn length(&self) -> T {
        let [along, across] = self.end;
        (along * along + across * across).sqrt()
    }

    /// Creates the properties from a row of values in the order of the fields.
    pub(crate) fn from_row(parent: Option<usize>, row: &[T; COLUMNS]) -> Self {
        let &[
            mass,
            inertia,
            c_along,
            c_across,
            p_along,
            p_across,
            e_along,
            e_across,
        ] = row;
        Self {
            parent,
            mass,
            inertia,
            centre: [c_along, c_across],
            pivot: [p_along, p_across],
            end: [e_along, e_across],
        }
    }

    /// Returns the values as a row, in the order of the fields.
    #[doc(hidden)]
    #[must_use]
    pub fn into_row(self) -> [T; COLUMNS] {
        let Self {
            parent: _,
            mass,
            inertia,
            centre: [c_along, c_across],
            pivot: [p_along, p_across],
            end: [e_along, e_across],
        } = self;
        [
            mass, inertia, c_along, c_across, p_along, p_across, e_along, e_across,
        ]
    }

    /// Returns the position (m) of a point of the link relative to its pivot; `None` for the pivot
    /// itself.
    pub(crate) fn offset_from_pivot(&self, point: LinkPoint) -> Option<[T; 2]> {
        match point {
            LinkPoint::Pivot => None,
            LinkPoint::Centre => Some(self.centre),
            LinkPoint::End => Some(self.end),
        }
    }
}

/// Positions and velocities of links, and the torques of forces on them. Emitted code implements
/// this trait with `emit(positions)`.
///
/// Vectors are \[x, y\] from the root's pivot: x to the side to which positive angles move a link's
/// end, y upwards. If the root's pivot is driven, they are in the frame of reference that moves
/// with it. All slices have one number for each link; for other lengths the results are NaN.
///
/// The axes are the same if the description's gravity is negative and the tree
/// [stands](Self::stands): at angle 0 ends are above their pivots, and positive angles turn a link
/// clockwise. The torque on a link of a force F at r = [x, y] from its pivot is x F_y − y F_x in a
/// hanging tree, and y F_x − x F_y in a standing one.
///
/// # Examples
///
/// This branch is in the wind, whose drag acts at the ends of its links, and a thread pulls at a
/// point of its twig:
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::LinkPoint;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     limb: rod(mass = 0.4, length = 0.5) [twig: rod(mass = 0.1, length = 0.3)],
///     emit(positions),
/// )]
/// struct Branch;
///
/// let branch = Branch::new();
/// let (theta, omega) = ([0.3, 0.5], [1.0, -2.0]);
/// let velocities = branch.end_velocities(&theta, &omega);
/// let wind = velocities.map(|[x, y]| [0.02 * (5.0 - x), -0.02 * y]);
/// let mut torques = branch.end_torques(&theta, &wind);
///
/// // The power of the forces is that of the torques.
/// let power = |(v, f): ([f64; 2], [f64; 2])| v[0] * f[0] + v[1] * f[1];
/// let of_forces: f64 = velocities.into_iter().zip(wind).map(power).sum();
/// let of_torques = torques[0] * omega[0] + torques[1] * omega[1];
/// assert!((of_forces - of_torques).abs() < 1e-15);
///
/// // A force on another point of a link: as on its pivot, and its moment about that.
/// let (twig, thread) = (1, [0.3, 0.1]);
/// let pivot = branch.pivots(&theta)[twig];
/// let point = [pivot[0] + 0.05, pivot[1] - 0.1];
/// let mut pull = [[0.0; 2]; 2];
/// pull[twig] = thread;
/// for (sum, torque) in torques.iter_mut().zip(branch.pivot_torques(&theta, &pull)) {
///     *sum += torque;
/// }
/// torques[twig] += (point[0] - pivot[0]) * thread[1] - (point[1] - pivot[1]) * thread[0];
///
/// // The tree as data.
/// let link = branch.properties_of(twig).expect("it has two links");
/// assert_eq!((link.parent, link.mass, link.length()), (Some(0), 0.1, 0.3));
/// assert_eq!(branch.children(0).collect::<Vec<_>>(), [1]);
/// // For any model in generic code:
/// let mut ends = [[0.0; 2]; Branch::<f64>::LINKS];
/// branch.points_into(LinkPoint::End, &theta, &mut ends);
/// assert_eq!(ends, branch.ends(&theta));
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not know where its links are",
    note = "a model knows it with `emit(positions)` in its attribute"
)]
pub trait Positions<T: Scalar>: Pendulum<T> {
    /// Returns true if angles are measured from the upward vertical, as for a negative gravity in
    /// the description.
    fn stands(&self) -> bool {
        false
    }

    /// Returns the mass, inertia, points and parent of a link; `None` if there is no such link.
    fn properties_of(&self, link: usize) -> Option<LinkProperties<T>>;

    /// Iterates over the children of a link. Searches all links that come after it.
    fn children(&self, link: usize) -> impl Iterator<Item = usize> {
        let behind = link.saturating_add(1)..self.links();
        behind.filter(move |&other| {
            let properties = self.properties_of(other);
            properties.is_some_and(|properties| properties.parent == Some(link))
        })
    }

    /// Writes the position (m) of one point of each link at the angles `theta` (rad).
    fn points_into(&self, point: LinkPoint, theta: &[T], points: &mut [[T; 2]]);

    /// Writes the velocity (m/s) of one point of each link at the angles `theta` (rad) and angular
    /// velocities `omega` (rad/s).
    fn point_velocities_into(
        &self,
        point: LinkPoint,
        theta: &[T],
        omega: &[T],
        velocities: &mut [[T; 2]],
    );

    /// Writes the generalized torques Q = Jᵀ F (N m) of `forces` F (N) that act on one point of
    /// each link at the angles `theta` (rad). The power of the forces is Q·ω.
    fn point_torques_into(
        &self,
        point: LinkPoint,
        theta: &[T],
        forces: &[[T; 2]],
        torques: &mut [T],
    );

    /// Returns the positions that [`points_into`](Self::points_into) writes. Allocates.
    #[must_use]
    fn points(&self, point: LinkPoint, theta: &[T]) -> Vec<[T; 2]> {
        let mut points = vec![[T::from_f64(0.0); 2]; self.links()];
        self.points_into(point, theta, &mut points);
        points
    }

    /// Returns the velocities that [`point_velocities_into`](Self::point_velocities_into)
    /// writes. Allocates.
    #[must_use]
    fn point_velocities(&self, point: LinkPoint, theta: &[T], omega: &[T]) -> Vec<[T; 2]> {
        let mut velocities = vec![[T::from_f64(0.0); 2]; self.links()];
        self.point_velocities_into(point, theta, omega, &mut velocities);
        velocities
    }

    /// Returns the torques that [`point_torques_into`](Self::point_torques_into) writes.
    /// Allocates.
    #[must_use]
    fn point_torques(&self, point: LinkPoint, theta: &[T], forces: &[[T; 2]]) -> Vec<T> {
        let mut torques = vec![T::from_f64(0.0); self.links()];
        self.point_torques_into(point, theta, forces, &mut torques);
        torques
    }
}

by_reference! {
    impl<T: Scalar> Positions<T> for &P {
        fn stands(&self) -> bool;
        fn properties_of(&self, link: usize) -> Option<LinkProperties<T>>;
        fn points_into(&self, point: LinkPoint, theta: &[T], points: &mut [[T; 2]]);
        fn point_velocities_into(
            &self, point: LinkPoint, theta: &[T], omega: &[T], velocities: &mut [[T; 2]]
        );
        fn point_torques_into(
            &self, point: LinkPoint, theta: &[T], forces: &[[T; 2]], torques: &mut [T]
        );
    }
}

/// A number or a vector of numbers that can be NaN, which marks an undefined result.
pub trait Unknown {
    /// Returns NaN.
    fn unknown() -> Self;
}

impl<T: Scalar> Unknown for T {
    fn unknown() -> Self {
        T::from_f64(f64::NAN)
    }
}

impl<T: Scalar> Unknown for [T; 2] {
    fn unknown() -> Self {
        [T::unknown(); 2]
    }
}

impl<T: Scalar> Unknown for Transfer<T> {
    fn unknown() -> Self {
        Self {
            kinetic: T::unknown(),
            potential: T::unknown(),
        }
    }
}

/// Writes the result of a function of two arrays to a slice; writes NaN if lengths differ.
#[inline]
pub fn fill<A, B, C: Copy + Unknown, const N: usize>(
    first: &[A],
    second: &[B],
    output: &mut [C],
    function: impl FnOnce(&[A; N], &[B; N]) -> [C; N],
) {
    match (first.try_into(), second.try_into()) {
        (Ok(first), Ok(second)) if output.len() == N => {
            output.copy_from_slice(&function(first, second));
        }
        _ => unknown(output),
    }
}

/// Converts slices to arrays of `N` elements; `None` if a slice has another length.
#[inline(always)]
pub fn arrays<T, const N: usize, const A: usize>(slices: [&[T]; A]) -> Option<[&[T; N]; A]> {
    const { assert!(N > 0) }
    let mut arrays = [slices.first()?.first_chunk()?; A];
    for (array, slice) in arrays.iter_mut().zip(slices) {
        *array = slice.try_into().ok()?;
    }
    Some(arrays)
}

/// Fills a slice with NaN.
#[inline(always)]
pub fn unknown<C: Copy + Unknown>(output: &mut [C]) {
    output.fill(C::unknown());
}

/// Fills slices with NaN.
pub fn no_answer<C: Copy + Unknown>(outputs: &mut [&mut [C]]) {
    for output in outputs {
        unknown(output);
    }
}

/// Copies values to a slice; fills the slice with NaN if lengths differ.
#[inline(always)]
pub fn write<C: Copy + Unknown>(output: &mut [C], values: &[C]) {
    match output.len() == values.len() {
        true => output.copy_from_slice(values),
        false => unknown(output),
    }
}

/// Copies values to as many slices; fills all of them with NaN if a length differs.
#[inline(always)]
pub fn write_each<C: Copy + Unknown, const N: usize>(outputs: [&mut [C]; N], values: [&[C]; N]) {
    let fit = outputs.each_ref().map(|output| output.len()) == values.map(<[C]>::len);
    for (output, values) in outputs.into_iter().zip(values) {
        write(output, if fit { values } else { &[] });
    }
}

/// Returns the properties of a link, from the parents and rows of constants of a tree.
pub fn properties<T: Scalar>(
    parents: &[Option<usize>],
    rows: &[[T; COLUMNS]],
    link: usize,
) -> Option<LinkProperties<T>> {
    Some(LinkProperties::from_row(
        *parents.get(link)?,
        rows.get(link)?,
    ))
}
