//! Motions of a model, written as systems of first-order equations.

use core::fmt;
use core::marker::PhantomData;

use super::function::{At, Computes, SliceCounts, compute_in};
use super::model::twice;
use super::ode::halves;
use super::{CastOde, LaneOde, Model, Ode, Workspace};
use crate::scalar::Scalar;

/// Motion of a model `M` as a first-order system. `F` is the function that computes the
/// accelerations, `A` the external action. The state is the coordinates followed by their
/// velocities. [`UnderTorques`](super::UnderTorques), [`PrescribedOde`](super::PrescribedOde),
/// [`TransverseOde`](super::TransverseOde), [`SmallOde`](type@super::SmallOde),
/// [`SmallUnderTorques`](super::SmallUnderTorques) and
/// [`SymmetricCoordinates`](type@super::SymmetricCoordinates) are motions of this type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion<M, F, A> {
    pub(super) model: M,
    function: PhantomData<F>,
    /// Index of the sector, or of the set of prescribed links, to which the function applies.
    pub(super) index: usize,
    /// Number of difference coordinates, which follow the angles of the model's links.
    pub(super) differences: usize,
    pub(super) action: A,
}

/// Number of coordinates of a motion that a function computes, if the type of the model determines
/// it.
pub trait MotionFunction<M, T>: SliceCounts {
    /// Number of coordinates.
    const COORDINATES: Option<usize>;
}

/// External action on a motion: nothing, torques, or a prescribed motion of some links.
pub trait Action<T: Scalar>: Sized {
    /// Writes the velocities and the accelerations of a motion. With a workspace, they are computed
    /// in fused arithmetic (one rounding per multiply–add), without one in the arithmetic of `T`.
    fn rates<F: SliceCounts, M: Computes<F, T>>(
        motion: &Motion<M, F, Self>,
        workspace: Option<&mut Workspace<T>>,
        time: T,
        state: [&[T]; 2],
        rates: [&mut [T]; 2],
    );
}

/// External action whose constants can be converted to any scalar type.
pub trait CastAction<T: Scalar>: Action<T> {
    /// Action on other scalars.
    type On<S: Scalar>: Action<S>;

    /// Returns the action with each constant converted by `convert`.
    fn on<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::On<S>;
}

/// Wrapper of a caller's value that need not implement `Debug`.
#[derive(Clone, Copy)]
pub struct Opaque<A>(pub(super) A);

impl<A> fmt::Debug for Opaque<A> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("..")
    }
}

/// No action from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Free;

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
    pub(super) fn accelerate<T: Scalar>(
        &self,
        workspace: Option<&mut Workspace<T>>,
        time: T,
        [angles, velocities]: [&[T]; 2],
        torques: &[T],
        accelerations: &mut [T],
    ) where
        F: SliceCounts,
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
        let index = self.index;
        let results = &mut [accelerations];
        compute_in(&self.model, workspace, At { time, index }, given, results);
    }

    /// Writes the velocities and the accelerations of a motion without external action.
    #[inline(always)]
    pub(super) fn rates_freely<T: Scalar>(
        &self,
        workspace: Option<&mut Workspace<T>>,
        time: T,
        [angles, velocities]: [&[T]; 2],
        [first, second]: [&mut [T]; 2],
    ) where
        F: SliceCounts,
        M: Computes<F, T>,
    {
        first.copy_from_slice(velocities);
        self.accelerate(workspace, time, [angles, velocities], &[], second);
    }

    #[inline(always)]
    fn write<T: Scalar>(
        &self,
        workspace: Option<&mut Workspace<T>>,
        time: T,
        state: &[T],
        rates: &mut [T],
    ) where
        F: SliceCounts,
        M: Computes<F, T>,
        A: Action<T>,
    {
        if let Some((state, rates)) = halves(self.coordinates::<T>(), state, rates) {
            A::rates(self, workspace, time, state, rates);
        }
    }
}

impl<T: Scalar> Action<T> for Free {
    #[inline(always)]
    fn rates<F: SliceCounts, M: Computes<F, T>>(
        motion: &Motion<M, F, Self>,
        workspace: Option<&mut Workspace<T>>,
        time: T,
        [angles, velocities]: [&[T]; 2],
        [first, second]: [&mut [T]; 2],
    ) {
        motion.rates_freely(workspace, time, [angles, velocities], [first, second]);
    }
}

impl<T: Scalar> CastAction<T> for Free {
    type On<S: Scalar> = Self;

    fn on<S: Scalar>(&self, _: impl Fn(T) -> S) -> Self {
        Self
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
    F: SliceCounts,
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

impl<T, M, F, A> LaneOde<T> for Motion<M, F, A>
where
    T: Scalar,
    F: MotionFunction<M, T>,
    M: Computes<F, T>,
    A: CastAction<T>,
{
    type Of<S: Scalar> = Motion<M::On<S>, F, A::On<S>>;

    const DIMENSION: Option<usize> = twice(F::COORDINATES);

    fn on_scalar<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S> {
        let (model, action) = (self.model.on(&convert), self.action.on(&convert));
        Motion::new_of(model, self.index, self.differences, action)
    }

    #[inline(always)]
    fn rates_of<S: Scalar>(system: &Self::Of<S>, time: S, state: &[S], rates: &mut [S]) {
        system.write(None, time, state, rates);
    }

    // The links of a prescribed set in lane 0 are those of all lanes.
    fn shape(&self) -> usize {
        self.model.shape().wrapping_add(self.index)
    }
}

impl<T, S, M, F, A> CastOde<T, S> for Motion<M, F, A>
where
    T: Scalar,
    S: Scalar,
    F: MotionFunction<M, T>,
    M: Computes<F, T>,
    A: CastAction<T>,
{
    type Of = Motion<M::On<S>, F, A::On<S>>;

    fn cast(&self, convert: impl Fn(T) -> S) -> Self::Of {
        self.on_scalar(convert)
    }
}
