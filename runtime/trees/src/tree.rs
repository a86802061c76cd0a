//! Pendulum trees that are described at run time.

use std::fmt;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::{Arc, OnceLock};

use branched_pendulum::scalar::{Double, Scalar};
use branched_pendulum::system::{Model, Pendulum, Workspace};
use branched_pendulum::taylor::SeriesTree;
use branched_pendulum::tree::{PropertyTable, Shape};

use crate::between::Between;
use crate::carried::{LinkBodies, bodies};
use crate::description::TreeDescription;
use crate::drive::Courses;
use crate::equations::{Form, GeneralEquations, NonViscousBodyRow};
use crate::error::TreeError;
use crate::forms::{Acting, Equations};
use crate::numbers::{self, LinkNumbers};
#[cfg(feature = "strips")]
use crate::prescribed::PrescribedLinks;
use crate::rows;
use crate::scales::TreeScales;
use crate::series::series_of;
use crate::symmetric::Symmetry;

/// A pendulum tree of any shape, created at run time from a description in text, with numbers of
/// type `T`.
///
/// It is a [`Model`] like a compiled one, but its number of links is not part of its type.
/// [`AbsoluteAngles(&tree)`](branched_pendulum::system::AbsoluteAngles) is its system of equations;
/// all methods integrate it, and ensembles compute several states at once in vector registers.
///
/// The code consists of the equations of one link, which the compiler derived and wrote; a tree
/// stores their constants. The links are in the same order as in a model that is compiled from the
/// text.
///
/// # Examples
///
/// ```
/// use branched_pendulum::prelude::*;
/// use branched_pendulum_trees::PendulumTree;
///
/// let tree = PendulumTree::parse(
///     "gravity = 9.80665,
///      parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
///          child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
///      ]",
/// )?;
/// assert_eq!(tree.names(), ["parent", "child_1", "child_2"]);
/// let start = State::at_rest(0.0, &[0.8, 0.1, -0.1]);
/// let method = Dop853::new(Options::with_tolerance(1e-12));
/// let system = AbsoluteAngles(&tree);
/// let end = method.run(&system, &start, 10.0)?.state;
/// let energy = |state: &State<f64>| tree.energy_of(state.positions(), state.velocities());
/// assert!((energy(&end) - energy(&start)).abs() < 1e-10 * energy(&start));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Mistakes are shown as the compiler shows those of an attribute:
///
/// ```
/// use branched_pendulum_trees::PendulumTree;
///
/// let error = PendulumTree::parse("gravity = 9.81, rod(mas = 0.2, com = 0.3, inertia = 0)");
/// let text = error.unwrap_err().to_string();
/// assert!(text.contains("--> 1:21"), "{text}");
/// assert!(text.contains("did you mean `mass`?"), "{text}");
/// ```
#[derive(Clone, Debug)]
pub struct PendulumTree<T = f64> {
    pub(crate) described: Arc<Described>,
    pub(crate) equations: Equations<T>,
    pub(crate) bodies: LinkBodies<T>,
    pub(crate) properties: PropertyTable<GeneralEquations, T>,
    pub(crate) drive: Option<Courses<T>>,
    pub(crate) scales: Option<TreeScales<T>>,
    pub(crate) series: SeriesTree<T>,
    #[cfg(feature = "strips")]
    pub(crate) prescribed: PrescribedLinks<T>,
}

/// Description and symmetry, shared by a tree's versions on different scalar types.
pub(crate) struct Described {
    description: TreeDescription,
    values: Vec<f64>,
    names: Vec<String>,
    /// Number that identifies the shape; trees of different shapes have different numbers.
    pub(crate) shape: usize,
    /// Symmetry of the tree, computed when it is first needed.
    symmetry: OnceLock<Symmetry>,
}

impl Described {
    pub(crate) fn values(&self) -> &[f64] {
        &self.values
    }

    pub(crate) fn symmetry(&self) -> &Symmetry {
        self.symmetry
            .get_or_init(|| Symmetry::of(&self.description.scene))
    }
}

impl fmt::Debug for Described {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            description: _,
            values,
            names,
            shape: _,
            symmetry: _,
        } = self;
        f.debug_struct("Described")
            .field("values", values)
            .field("names", names)
            .finish_non_exhaustive()
    }
}

impl PendulumTree<f64> {
    /// Creates a tree from a description without parameters: the text that is written between the
    /// parentheses of the attribute `branched_pendulum`. For descriptions with parameters, see
    /// [`TreeDescription`].
    ///
    /// # Errors
    /// [`TreeError::Description`] with all mistakes, [`TreeError::MissingValues`] if it contains
    /// parameters, [`TreeError::Value`] if its values are physically impossible.
    pub fn parse(text: &str) -> Result<Self, TreeError> {
        TreeDescription::parse(text)?.tree(&[])
    }
}

impl<T: Scalar> PendulumTree<T> {
    pub(crate) fn of(description: TreeDescription, values: Vec<f64>) -> Result<Self, TreeError> {
        let scene = &description.scene;
        let parameters: Vec<Double> = values.iter().copied().map(Double::from_f64).collect();
        numbers::check(scene, &parameters)?;
        let links = numbers::links(scene, &parameters)?;
        Ok(Self::of_links(description, values, &links))
    }

    /// Creates the tree of a description from its links, which have been computed with the
    /// parameters `values`.
    pub(crate) fn of_links(
        description: TreeDescription,
        values: Vec<f64>,
        links: &[LinkNumbers],
    ) -> Self {
        let scene = &description.scene;
        let parameters: Vec<Double> = values.iter().copied().map(Double::from_f64).collect();
        let gravity = numbers::value(&scene.gravity, &parameters);
        let (parents, carries) = rows::parents(links);
        let (drive, stands) = (scene.drive.as_ref(), scene.stands());
        let above = constant(-gravity);
        let form = Form::of(links, drive.is_some());
        let rows = in_numbers(&form.rows(links, &carries));
        let scales = TreeScales::of(scene, links, &carries, gravity);
        let between = Between::of(scene, links.len(), &parameters);
        let series = series_of(links, &between, gravity, drive.is_some());
        #[cfg(feature = "strips")]
        let prescribed = in_numbers(&rows::prescribed(links, &carries));
        #[cfg(feature = "strips")]
        let prescribed = PrescribedLinks::of(scene, &parents, above, &prescribed);
        let pairs = between.shape();
        let equations = Equations::new(form, &parents, rows, above, between.cast(constant));
        // All that is no constant: trees in the lanes of one share it.
        let functions = drive.map(|drive| format!("{:?}", drive.map(&|_| ())));
        let held_sets: Vec<Vec<usize>> = scene
            .prescribed
            .iter()
            .map(|set| set.links.iter().map(|link| link.0).collect())
            .collect();
        let mut hasher = DefaultHasher::new();
        (&parents, form, functions, stands, held_sets, pairs).hash(&mut hasher);
        let shape = Shape::Shared(parents.into());
        let bodies = bodies(links, gravity).into_iter();
        let bodies: Vec<Double> = bodies.flat_map(NonViscousBodyRow::into_array).collect();
        let described = Described {
            names: numbers::names(scene),
            shape: hasher.finish() as usize,
            symmetry: OnceLock::new(),
            description: description.clone(),
            values,
        };
        Self {
            described: Arc::new(described),
            equations,
            bodies: LinkBodies::new(shape.clone(), in_numbers(&bodies)),
            properties: PropertyTable::new(shape, in_numbers(&rows::properties(links)))
                .standing(stands),
            drive: Courses::of(scene, &|quantity| {
                constant(numbers::value(quantity, &parameters))
            }),
            scales,
            series,
            #[cfg(feature = "strips")]
            prescribed,
        }
    }

    /// Returns the tree with one parameter changed.
    ///
    /// # Errors
    /// Fails if no parameter has this name, or if the value is physically impossible.
    pub fn with(&self, name: &str, value: f64) -> Result<Self, TreeError> {
        let description = self.described.description.clone();
        let place = description.place(name)?;
        let mut values = self.described.values.clone();
        if let Some(own) = values.get_mut(place) {
            *own = value;
        }
        Self::of(description, values)
    }

    /// Returns the description.
    pub fn description(&self) -> &TreeDescription {
        &self.described.description
    }

    /// Returns the value of a parameter, in SI units.
    pub fn value(&self, name: &str) -> Option<f64> {
        let place = self.described.description.place(name).ok()?;
        self.described.values.get(place).copied()
    }

    /// Returns the names of the links, in the order of the angles.
    pub fn names(&self) -> &[String] {
        &self.described.names
    }

    /// Returns the tree on another scalar type; `convert` should change the type of its constants
    /// but not their values. The function is compiled only once for each scalar type, even if it is
    /// used often.
    pub(crate) fn on_scalar<S: Scalar>(&self, convert: &dyn Fn(T) -> S) -> PendulumTree<S> {
        PendulumTree {
            described: Arc::clone(&self.described),
            equations: self.equations.cast(convert),
            bodies: self.bodies.cast(convert),
            properties: self.properties.cast(convert),
            drive: self.drive.as_ref().map(|drive| drive.cast(convert)),
            scales: self.scales.as_ref().map(|scales| scales.cast(convert)),
            series: self.series.cast(convert),
            #[cfg(feature = "strips")]
            prescribed: self.prescribed.cast(convert),
        }
    }

    /// Returns the angular accelerations (rad/s²) at angles `theta` (rad) and angular velocities
    /// `omega` (rad/s). `time` (s) only matters if the tree has a drive. NaN if a slice does not
    /// have one value per link.
    #[must_use]
    pub fn accelerations(&self, time: T, theta: &[T], omega: &[T]) -> Vec<T> {
        let mut alpha = vec![T::from_f64(0.0); self.links()];
        self.accelerations_with(&mut Workspace::new(), time, theta, omega, &mut alpha);
        alpha
    }

    // With its caller, so that what is given goes through memory once; where code has to be
    // small it is compiled once for a tree under torques and one without.
    #[cfg_attr(target_family = "wasm", inline(never))]
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    pub(crate) fn accelerate(
        &self,
        workspace: &mut Workspace<T>,
        acting: Acting<'_, T>,
        given: [&[T]; 2],
        alpha: &mut [T],
    ) {
        self.equations.accelerate(workspace, acting, given, alpha);
    }

    #[inline(always)]
    pub(crate) fn acting<'a>(&self, time: T, torques: Option<&'a [T]>) -> Acting<'a, T> {
        let drive = self.drive.as_ref().map(|drive| drive.root(time));
        Acting { drive, torques }
    }
}

/// Converts a constant to the tree's type of numbers.
pub(crate) fn constant<T: Scalar>(value: Double) -> T {
    T::from_parts(value.high(), value.low())
}

pub(crate) fn in_numbers<T: Scalar>(rows: &[Double]) -> Vec<T> {
    rows.iter().copied().map(constant).collect()
}
