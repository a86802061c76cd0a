//! Motions of a model, written as systems of first-order equations.

use core::fmt;
use core::marker::PhantomData;

use super::function::{At, Computes, MotionKind, SliceFunction, compute_in};
use super::model::twice;
use super::ode::halves;
use super::{Action, CastAction, CastOde, Model, Ode, Workspace};
use crate::scalar::Scalar;

/// Motion of a model `M` as a first-order system. `F` is the function that computes the rates, `A`
/// the external [`Action`]. The state is the coordinates followed by their velocities,
/// or by their momenta. [`UnderTorques`](super::UnderTorques), [`PrescribedOde`](super::PrescribedOde),
/// [`TransverseOde`](super::TransverseOde), [`SmallOde`](type@super::SmallOde),
/// [`SmallUnderTorques`](super::SmallUnderTorques),
/// [`SymmetricCoordinates`](type@super::SymmetricCoordinates) and
/// [`CanonicalVariables`](type@super::CanonicalVariables) are motions of this type.
#[derive(Clone, Copy, PartialEq)]
pub struct Motion<M, F, A> {
    pub(super) model: M,
    function: PhantomData<F>,
    /// Index of the sector, or of the set of prescribed links, to which the function applies.
    pub(super) index: usize,
    differences: usize,
    pub(super) action: A,
}

impl<M: fmt::Debug, F, A> fmt::Debug for Motion<M, F, A> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            model,
            function: _,
            index,
            differences,
            action: _,
        } = self;
        formatter
            .debug_struct("Motion")
            .field("model", model)
            .field("index", index)
            .field("differences", differences)
            .finish_non_exhaustive()
    }
}

impl<M, F, A> Motion<M, F, A> {
    pub(super) const fn new_of(model: M, index: usize, differences: usize, action: A) -> Self {
        Self {
            model,
            function: PhantomData,
            index,
            differences,
            action,
        }
    }

    /// Returns the number of difference coordinates, which follow the angles of the model's links.
    pub fn differences(&self) -> usize {
        self.differences
    }

    /// Returns the number of coordinates.
    fn coordinates<T: Scalar>(&self) -> usize
    where
        M: Model<T>,
    {
        self.model.links() + self.differences
    }

    /// Computes the accelerations by the function `F`, from angles, angular velocities, differences
    /// and their rates, and, if the function takes them, torques on links and on differences.
    #[inline(always)]
    fn accelerate<T: Scalar>(
        &self,
        workspace: Option<&mut Workspace<T>>,
        time: T,
        [angles, velocities]: [&[T]; 2],
        torques: &[T],
        accelerations: &mut [T],
    ) where
        F: SliceFunction,
        M: Computes<F, T>,
    {
        let links = self.model.links();
        let [theta, difference] = parts(links, angles);
        let [omega, difference_rate] = parts(links, velocities);
        let [on_links, on_differences] = parts(links, torques);
        // A function of three slices knows no differences.
        let all = match F::ARGUMENTS {
            3 => [theta, omega, on_links, &[], &[], &[]],
            _ => [
                theta,
                omega,
                difference,
                difference_rate,
                on_links,
                on_differences,
            ],
        };
        let given = all.get(..F::ARGUMENTS).unwrap_or_default();
        let results = &mut [accelerations];
        compute_in(&self.model, workspace, self.at(time), given, results);
    }

    #[inline(always)]
    pub(super) fn at<T>(&self, time: T) -> At<T> {
        let index = self.index;
        At { time, index }
    }

    /// Writes the rates of a state. With a workspace, they are computed in fused arithmetic (one
    /// rounding per multiply–add), without one in the arithmetic of `T`.
    #[inline(always)]
    fn write<T: Scalar>(
        &self,
        workspace: Option<&mut Workspace<T>>,
        time: T,
        state: &[T],
        rates: &mut [T],
    ) where
        F: SliceFunction,
        M: Computes<F, T>,
        A: Action<T>,
    {
        const { assert!(is_motion::<F>(), "the function describes no motion") }
        let halves = halves(self.coordinates::<T>(), state, rates);
        let Some(([angles, velocities], [first, second])) = halves else {
            return;
        };
        if const { follows::<F>(MotionKind::Free) } {
            first.copy_from_slice(velocities);
            self.accelerate(workspace, time, [angles, velocities], &[], second);
        } else if const { follows::<F>(MotionKind::UnderTorques) } {
            // The torques use the memory of the velocities until these are written.
            self.action.act(time, angles, velocities, first);
            self.accelerate(workspace, time, [angles, velocities], first, second);
            first.copy_from_slice(velocities);
        } else if const { follows::<F>(MotionKind::Prescribed) } {
            let (state, rates) = ([angles, velocities], [first, second]);
            self.write_prescribed(workspace, time, state, rates, None);
        } else {
            // The rates of canonical variables.
            let (given, results) = ([angles, velocities], &mut [first, second]);
            compute_in(&self.model, workspace, self.at(time), &given, results);
        }
    }

    /// Writes the velocities and accelerations of a motion with prescribed links and, if requested,
    /// the reactions.
    #[inline(always)]
    pub(super) fn write_prescribed<T: Scalar>(
        &self,
        workspace: Option<&mut Workspace<T>>,
        time: T,
        [theta, omega]: [&[T]; 2],
        [velocities, alpha]: [&mut [T]; 2],
        requested: Option<&mut [T]>,
    ) where
        F: SliceFunction,
        M: Computes<F, T>,
        A: Action<T>,
    {
        let set = self.action.prescribed_links();
        let (links, prescribed) = (theta.len(), set.len());
        let mut own = Workspace::new();
        let is_kept = workspace.is_some();
        let (room, inner) = workspace
            .unwrap_or(&mut own)
            .with_inner(3 * links + 5 * prescribed);
        let (all, rest) = room.split_at_mut(3 * links);
        let (angles, rest_of_links) = all.split_at_mut(links);
        let (rates, torques) = rest_of_links.split_at_mut(links);
        let (courses, rest) = rest.split_at_mut(3 * prescribed);
        let (prescribed, reactions) = rest.split_at_mut(prescribed);
        torques.fill(T::from_f64(0.0));
        angles.copy_from_slice(theta);
        rates.copy_from_slice(omega);
        self.action.act(time, theta, omega, courses);
        let (courses, _) = courses.as_chunks_mut::<3>();
        for ((&link, &mut [angle, rate, alpha]), prescribed) in
            set.iter().zip(courses).zip(&mut *prescribed)
        {
            *prescribed = alpha;
            if let (Some(own_angle), Some(own_rate)) = (angles.get_mut(link), rates.get_mut(link)) {
                (*own_angle, *own_rate) = (angle, rate);
            }
        }
        velocities.copy_from_slice(rates);
        let given: [&[T]; 4] = [angles, rates, torques, prescribed];
        let results = &mut [alpha, requested.unwrap_or(reactions)];
        let inner = is_kept.then_some(inner);
        compute_in(&self.model, inner, self.at(time), &given, results);
    }
}

/// Returns true if [`Motion::write`] has the code of the function's kind of motion.
const fn is_motion<F: SliceFunction>() -> bool {
    match F::MOTION {
        Some(
            MotionKind::Free
            | MotionKind::UnderTorques
            | MotionKind::Prescribed
            | MotionKind::Canonical,
        ) => true,
        None => false,
    }
}

/// Returns true if the rates of a motion follow from the function `F` in the given way. Its values
/// are constants of branches, so that each motion contains the code of one kind only.
const fn follows<F: SliceFunction>(kind: MotionKind) -> bool {
    match F::MOTION {
        Some(own) => own as u8 == kind as u8,
        None => false,
    }
}

/// Splits values into the values of the links and those of the differences.
#[inline(always)]
pub(super) fn parts<T>(links: usize, values: &[T]) -> [&[T]; 2] {
    let (of_links, of_differences) = values.split_at(links.min(values.len()));
    [of_links, of_differences]
}

impl<T, M, F, A> Ode<T> for Motion<M, F, A>
where
    T: Scalar,
    F: SliceFunction,
    M: Computes<F, T>,
    A: Action<T>,
{
    fn dimension(&self) -> usize {
        2 * self.coordinates::<T>()
    }

    #[inline]
    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        self.rates_with(&mut Workspace::new(), time, state, rates);
    }

    #[inline]
    fn rates_with(&self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]) {
        self.write(Some(workspace), time, state, rates);
    }
}

impl<T, M, F, A> CastOde<T> for Motion<M, F, A>
where
    T: Scalar,
    F: SliceFunction,
    M: Computes<F, T>,
    A: CastAction<T>,
{
    type Of<S: Scalar> = Motion<M::On<S>, F, A::Of<S>>;

    const DIMENSION: Option<usize> = twice(M::COORDINATES);

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S> {
        let (model, action) = (self.model.on(&convert), self.action.cast(&convert));
        Motion::new_of(model, self.index, self.differences, action)
    }

    #[inline(always)]
    fn rates_of<S: Scalar>(
        system: &Self::Of<S>,
        _: &mut Workspace<S>,
        time: S,
        state: &[S],
        rates: &mut [S],
    ) {
        system.write(None, time, state, rates);
    }

    // The links of a prescribed set in lane 0 are those of all lanes.
    fn shape(&self) -> usize {
        self.model.shape().wrapping_add(self.index)
    }
}
