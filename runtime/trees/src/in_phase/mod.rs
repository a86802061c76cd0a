//! Trees whose copies move in phase, with small differences between two of them.

mod evaluation;
mod growth;
mod merged;
mod sweep;

use std::cell::RefCell;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;

use branched_pendulum::analysis::growth::TransverseSystem;
use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::scalar::{Double, Dual, Scalar};
use branched_pendulum::sectors::Sectors;
use branched_pendulum::system::{AbsoluteAngles, CastOde, LaneOde, Model, Ode, State, Workspace};

pub use self::growth::DifferenceGrowth;
use self::merged::{Member, MergedLinks};
use crate::between::Between;
use crate::drive::Courses;
use crate::equations::Form;
use crate::error::TreeError;
use crate::numbers::{self, LinkNumbers};
use crate::rows;
use crate::tree::{PendulumTree, constant, in_numbers};

/// A tree whose copies move in phase, as one link for all copies of it: as heavy, as stiff and
/// with as much friction as they are together. On demand it has small differences between two
/// copies beside that motion ([`with_differences`](Self::with_differences)).
///
/// The motion is a system of equations in the angles of its links and their rates, for every method and
/// in lanes. With differences the state is the angles, the differences, the angular velocities
/// and the rates of the differences, as that of a
/// [`TransverseOde`](branched_pendulum::system::TransverseOde) of a compiled model, and
/// [`Growth`](branched_pendulum::analysis::growth::Growth) and
/// [`Floquet`](branched_pendulum::analysis::growth::Floquet) take it.
///
/// Differences leave all that holds the copies as it is, since their forces on it are opposite. So
/// their equations, which are linear, are those of one copy whose pivot moves in a given way: the
/// recursion of the motion in phase gives them with dual numbers in that copy alone
/// (physics (12.2)). Effort: that of the tree with one of each copies.
///
/// # Examples
///
/// ```
/// use branched_pendulum::analysis::growth::{Growth, frequency_at_rest};
/// use branched_pendulum::analysis::variational::Copies;
/// use branched_pendulum::prelude::*;
/// use branched_pendulum_trees::PendulumTree;
///
/// let tree = PendulumTree::parse(
///     "gravity = 9.80665,
///      parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
///          child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
///      ]",
/// )?;
/// let children = Copies::of_links(&[None, Some(0), Some(0)], &[&[1, 2]]).unwrap();
/// let in_phase = tree.in_phase(&children)?;
/// assert_eq!(in_phase.dimension(), 4);
/// assert_eq!(in_phase.whole(&[0.8, 0.3]), [0.8, 0.3, 0.3]);
///
/// // Growth of a small difference within 10 s of two releases.
/// let system = in_phase.with_differences(&children)?;
/// let release = |degrees: f64| State::at_rest(0.0, &[degrees.to_radians(), 0.0, 0.0]);
/// let releases = [42.0, 44.0].map(|degrees| {
///     (&system, system.start(&release(degrees)).expect("the children have one angle"))
/// });
/// let growth = Growth {
///     frequency_hz: frequency_at_rest(&system),
///     horizons: vec![10.0],
///     tolerance: 1e-9,
/// };
/// assert!((growth.frequency_hz - 1.2581).abs() < 1e-4);
/// let grown = growth.in_lanes(&Ensemble::new(), &releases);
/// let [Ok(below), Ok(above)] = grown.as_slice() else { panic!("{grown:?}") };
/// assert!(below.factors[0].value < 10.0 && above.factors[0].value > 16.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct InPhaseTree<T = f64> {
    structure: Arc<Structure>,
    form: Form,
    /// Constants of the equations, a row for each link.
    rows: Vec<T>,
    /// Acceleration of the root's pivot against gravity.
    above: T,
    drive: Option<Courses<T>>,
    /// Of the whole tree, in numbers with their changes.
    between: Between<Dual<T, 1>>,
}

/// What merged trees on all scalars share.
#[derive(Clone, Debug)]
struct Structure {
    merged: MergedLinks,
    /// Of the whole tree.
    links: Vec<LinkNumbers>,
    shape: usize,
}

impl PendulumTree<f64> {
    /// Returns all copies in the tree, as parts of a state of angles followed by angular
    /// velocities: groups are empty where there are none.
    pub fn all_copies(&self) -> Copies {
        let means = self.sectors().first();
        let means = means.into_iter().flat_map(|means| means.coordinates());
        let alike = means.map(|mean| mean.weights().iter().map(|(link, _)| *link));
        let groups: Vec<Vec<usize>> = alike.map(Iterator::collect).collect();
        let groups = groups.into_iter().filter(|group| group.len() > 1);
        let angles: Vec<Vec<usize>> = groups.collect();
        let rates = angles.iter();
        let rates = rates.map(|group| group.iter().map(|link| self.links() + link).collect());
        Copies::new(angles.iter().cloned().chain(rates).collect())
    }

    /// Returns the motion in which copies are in phase. Copies that
    /// [`Copies::groups`] does not name move each in its own way.
    ///
    /// # Errors
    /// [`TreeError::NotInPhase`] where links are no copies, or do not move alike when they start
    /// alike.
    pub fn in_phase(&self, copies: &Copies) -> Result<InPhaseTree, TreeError> {
        let system = AbsoluteAngles(self);
        let rest = State::new(0.0, vec![0.0; system.dimension()]);
        if copies.groups().is_empty() || !copies.are_in_phase(&system, &rest) {
            return Err(TreeError::NotInPhase);
        }
        let (scene, values) = (&self.description().scene, self.described.values());
        let parameters: Vec<Double> = values.iter().copied().map(Double::from_f64).collect();
        let links = numbers::links(scene, &parameters)?;
        let parents: Vec<Option<usize>> = links.iter().map(|link| link.parent).collect();
        let merged = MergedLinks::of(&parents, copies);
        let one_of_each = merged.numbers(&links);
        let form = Form::of(&one_of_each, self.drive.is_some());
        let (_, carries) = rows::parents(&one_of_each);
        let gravity = numbers::value(&scene.gravity, &parameters);
        Ok(InPhaseTree {
            form,
            rows: in_numbers(&form.rows(&one_of_each, &carries)),
            above: constant(-gravity),
            drive: self.drive.clone(),
            between: self.between().cast(Dual::constant),
            structure: Arc::new(Structure {
                merged,
                links,
                shape: self.described.shape,
            }),
        })
    }
}

impl<T: Scalar> InPhaseTree<T> {
    /// Returns the same motion with small differences between the first two `copies` beside it:
    /// half that between their angles, and between those of all that hangs from them. Other
    /// copies may be in phase besides.
    ///
    /// # Errors
    /// [`TreeError::NotInPhase`] of links that are not in phase here, and of those that hang from
    /// two links in phase, which their difference sets apart.
    pub fn with_differences(&self, copies: &Copies) -> Result<Self, TreeError> {
        let mut structure = Structure::clone(&self.structure);
        let Structure { merged, links, .. } = &mut structure;
        let differing = merged.differing(links, copies);
        differing.ok_or(TreeError::NotInPhase)?;
        Ok(Self {
            structure: Arc::new(structure),
            ..self.clone()
        })
    }

    /// Returns the number of links: copies that move in phase are one.
    pub fn links(&self) -> usize {
        self.structure.merged.links.len()
    }

    /// Returns the number of differences; zero without any.
    fn differing(&self) -> usize {
        self.structure.merged.differences
    }

    /// Returns the angles of all links of the whole tree at those of the links in phase, or their
    /// rates likewise. Links without a given value have NaN.
    pub fn whole(&self, own: &[T]) -> Vec<T> {
        let value = |member: &Member| own.get(member.merged).copied();
        let members = self.structure.merged.members.iter();
        let values = members.map(|member| value(member).unwrap_or(T::from_f64(f64::NAN)));
        values.collect()
    }

    fn cast_to<S: Scalar>(&self, convert: &dyn Fn(T) -> S) -> InPhaseTree<S> {
        InPhaseTree {
            structure: Arc::clone(&self.structure),
            form: self.form,
            rows: self.rows.iter().map(|&number| convert(number)).collect(),
            above: convert(self.above),
            drive: self.drive.as_ref().map(|drive| drive.cast(convert)),
            between: (self.between).cast(|own| Dual::constant(convert(own.value))),
        }
    }
}

impl InPhaseTree<f64> {
    /// Returns the angles of the links in phase at those of all links of the whole tree, or their
    /// rates likewise: the inverse of [`whole`](Self::whole). None for another number of links,
    /// and where copies differ.
    pub fn of_whole(&self, whole: &[f64]) -> Option<Vec<f64>> {
        let MergedLinks { links, members, .. } = &self.structure.merged;
        if whole.len() != members.len() {
            return None;
        }
        let own = links.iter().map(|link| whole.get(link.first).copied());
        let own: Vec<f64> = own.collect::<Option<_>>()?;
        let is_alike = |(member, value): (&Member, &f64)| {
            // What is no number is left to the integration.
            let own = own.get(member.merged);
            own.is_some_and(|own| own == value || own.is_nan() && value.is_nan())
        };
        members.iter().zip(whole).all(is_alike).then_some(own)
    }

    /// Returns the state in phase of a state of all links, angles followed by angular velocities;
    /// all differences are 1 and at rest. None for a state of another length, and where copies
    /// are not in one state.
    pub fn start(&self, whole: &State<f64>) -> Option<State<f64>> {
        let (theta, omega) = whole.values.split_at(whole.values.len() / 2);
        let differences = |size: f64| vec![size; self.differing()];
        let (angles, rates) = (self.of_whole(theta)?, self.of_whole(omega)?);
        let values = [angles, differences(1.0), rates, differences(0.0)].concat();
        Some(State::new(whole.time, values))
    }
}

impl<T: Scalar> Ode<T> for InPhaseTree<T> {
    fn dimension(&self) -> usize {
        2 * (self.links() + self.differing())
    }

    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        self.rates_with(&mut Workspace::new(), time, state, rates);
    }

    fn rates_with(&self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]) {
        let (room, _) = workspace.with_inner(self.room());
        self.write(room, time, state, rates);
    }
}

/// A tree in the lanes of one thread, with room for its evaluations.
#[allow(unreachable_pub)]
#[derive(Debug)]
pub struct InPhaseLanes<T> {
    tree: InPhaseTree<T>,
    room: RefCell<Vec<T>>,
}

impl<T: Scalar> LaneOde<T> for InPhaseTree<T> {
    type Of<S: Scalar> = InPhaseLanes<S>;

    fn on_scalar<S: Scalar>(&self, convert: impl Fn(T) -> S) -> InPhaseLanes<S> {
        let tree = self.cast_to(&convert);
        let room = RefCell::new(vec![S::from_f64(0.0); tree.room()]);
        InPhaseLanes { tree, room }
    }

    #[inline(always)]
    fn rates_of<S: Scalar>(system: &InPhaseLanes<S>, time: S, state: &[S], rates: &mut [S]) {
        let mut room = system.room.borrow_mut();
        system.tree.write(&mut room, time, state, rates);
    }

    fn shape(&self) -> usize {
        let mut hasher = DefaultHasher::new();
        (
            self.structure.shape,
            self.structure.merged.shape(),
            self.form,
        )
            .hash(&mut hasher);
        hasher.finish() as usize
    }
}

impl<T: Scalar, S: Scalar> CastOde<T, S> for InPhaseTree<T> {
    type Of = InPhaseTree<S>;

    fn cast(&self, convert: impl Fn(T) -> S) -> InPhaseTree<S> {
        self.cast_to(&convert)
    }
}

impl TransverseSystem for InPhaseTree<f64> {
    fn differences(&self) -> usize {
        self.differing()
    }
}
