//! Trees whose copies move in phase, optionally with small differences between two of them.

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
use branched_pendulum::sectors::{Sector, Sectors};
use branched_pendulum::system::{AbsoluteAngles, CastOde, Model, Ode, State, Workspace};

pub use self::growth::DifferenceGrowth;
use self::merged::{Member, MergedLinks};
use crate::between::Between;
use crate::drive::Courses;
use crate::equations::Form;
use crate::error::TreeError;
use crate::numbers::{self, LinkNumbers};
use crate::rows;
use crate::tree::{PendulumTree, constant, in_numbers};

/// A tree whose copies move in phase. All copies of a link are merged into one link with the sum of
/// their masses, stiffnesses and frictions. Optionally it includes small differences between two
/// copies ([`with_differences`](Self::with_differences)).
///
/// The motion is a system of equations in the angles of its links and their rates, for every method
/// and in lanes. With differences the state is the angles, the differences, the angular velocities
/// and the rates of the differences, as that of a
/// [`TransverseOde`](branched_pendulum::system::TransverseOde) of a compiled model, and
/// [`Growth`](branched_pendulum::analysis::growth::Growth) and
/// [`Floquet`](branched_pendulum::analysis::growth::Floquet) accept it.
///
/// Differences exert opposite forces on the links above the copies, and so do not change their
/// motion. Therefore their equations, which are linear, are those of one copy whose pivot has a
/// given motion: the recursion of the motion in phase computes them with dual numbers in that copy
/// only (physics (12.2)). The effort is that of the tree with one of each copies.
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
    /// Constants of the equations, one row per link.
    rows: Vec<T>,
    /// Acceleration of the root's pivot that is equivalent to gravity.
    above: T,
    drive: Option<Courses<T>>,
    /// Springs and friction between links of the whole tree, in dual numbers that carry the change
    /// by the differences.
    between: Between<Dual<T, 1>>,
}

/// Parts of an in-phase tree that do not depend on the scalar type.
#[derive(Clone, Debug)]
struct Structure {
    merged: MergedLinks,
    /// Links of the whole tree.
    links: Vec<LinkNumbers>,
    shape: usize,
}

impl PendulumTree<f64> {
    /// Returns all copies in the tree, as groups of components of states (angles followed by
    /// angular velocities). There are no groups if the tree has no copies.
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

    /// Returns the links that are copies nearest to the root. None for a tree without copies.
    pub fn first_copies(&self) -> Option<Vec<usize>> {
        let all = self.sectors();
        let first = all.iter().find(|sector| sector.name() != "in_phase")?;
        let weights = first.coordinates().first()?.weights();
        // The differences of a set of copies follow each other; that of the last one has all.
        let is_wider = |sector: &&Sector| {
            let own = sector
                .coordinates()
                .first()
                .map_or(&[][..], |own| own.weights());
            weights
                .iter()
                .all(|(link, _)| own.iter().any(|(other, _)| other == link))
        };
        let widest = all
            .iter()
            .filter(is_wider)
            .filter_map(|sector| sector.coordinates().first());
        let widest = widest.filter(|own| own.weights().iter().any(|(_, weight)| *weight < 0.0));
        let links = widest
            .max_by_key(|own| own.weights().len())?
            .weights()
            .iter();
        Some(links.map(|(link, _)| *link).collect())
    }

    /// Returns the motion in which copies are in phase. Links that are in no group of
    /// [`Copies::groups`] move independently.
    ///
    /// # Errors
    /// [`TreeError::NotInPhase`] if links are not copies of each other, or do not stay in phase
    /// after a start in phase.
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
    /// Returns the same tree with small differences between the first two `copies`: half the
    /// difference between their angles, and between the angles of the links below them. Further
    /// copies may be in phase too.
    ///
    /// # Errors
    /// [`TreeError::NotInPhase`] if the links are not in phase in this tree, or if the parents of
    /// the two copies are two different links that are in phase, because the difference would
    /// separate these.
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

    /// Returns the number of links, with copies in phase counted as one.
    pub fn links(&self) -> usize {
        self.structure.merged.links.len()
    }

    /// Returns the number of differences; zero if there are none.
    fn differing(&self) -> usize {
        self.structure.merged.differences
    }

    /// Returns the angles (or their rates) of all links of the whole tree, given those of the
    /// merged links. NaN for links whose value is missing.
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
    /// Returns the angles (or their rates) of the merged links, given those of all links of the
    /// whole tree: the inverse of [`whole`](Self::whole). `None` if the number of links is wrong or
    /// copies differ.
    pub fn of_whole(&self, whole: &[f64]) -> Option<Vec<f64>> {
        let MergedLinks { links, members, .. } = &self.structure.merged;
        if whole.len() != members.len() {
            return None;
        }
        let own = links.iter().map(|link| whole.get(link.first).copied());
        let own: Vec<f64> = own.collect::<Option<_>>()?;
        let is_alike = |(member, value): (&Member, &f64)| {
            // Accepts NaN, which the integration will report.
            let own = own.get(member.merged);
            own.is_some_and(|own| own == value || own.is_nan() && value.is_nan())
        };
        members.iter().zip(whole).all(is_alike).then_some(own)
    }

    /// Converts a state of the whole tree (angles, then angular velocities) to a state of this
    /// tree, in which all differences are 1 and their rates 0. `None` if the length is wrong or
    /// copies are not in phase.
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
        let (buffer, _) = workspace.with_inner(self.workspace_len());
        self.write(buffer, time, state, rates);
    }
}

/// An in-phase tree of one thread, with a buffer for its evaluations.
#[allow(unreachable_pub)]
#[derive(Debug)]
pub struct InPhaseLanes<T> {
    tree: InPhaseTree<T>,
    buffer: RefCell<Vec<T>>,
}

impl<T: Scalar> Ode<T> for InPhaseLanes<T> {
    fn dimension(&self) -> usize {
        self.tree.dimension()
    }

    #[inline(always)]
    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        let mut buffer = self.buffer.borrow_mut();
        self.tree.write(&mut buffer, time, state, rates);
    }
}

impl<T: Scalar> CastOde<T> for InPhaseTree<T> {
    type Of<S: Scalar> = InPhaseLanes<S>;

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> InPhaseLanes<S> {
        let tree = self.cast_to(&convert);
        let buffer = RefCell::new(vec![S::from_f64(0.0); tree.workspace_len()]);
        InPhaseLanes { tree, buffer }
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

impl TransverseSystem for InPhaseTree<f64> {
    fn differences(&self) -> usize {
        self.differing()
    }
}
