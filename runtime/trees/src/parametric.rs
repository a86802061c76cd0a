//! Descriptions as families of trees: equations of motion as functions of the parameters, and what
//! each parameter is used for.

use branched_pendulum::scalar::{Double, Scalar};
use branched_pendulum::system::{Ode, Workspace};
use branched_pendulum_codegen::scene::{
    DescribedTranslationalSpringDamper, Link, ParameterId, PassiveTorques, Quantity, QuantityAtom,
    Scene,
};

use crate::between::Between;
use crate::description::TreeDescription;
use crate::drive::Courses;
use crate::equations::Form;
use crate::error::TreeError;
use crate::forms::{Acting, Equations};
use crate::numbers::{self, LinkNumbers};
use crate::rows;
use crate::scales::springs_across_scales;
use crate::tree::PendulumTree;

/// Equations of motion of a tree in the links' angles, with constants of type `T`. The state is the
/// angles (rad), followed by the angular velocities (rad/s).
#[derive(Clone, Debug)]
pub struct EquationsOfMotion<T> {
    links: usize,
    equations: Equations<T>,
    drive: Option<Courses<T>>,
}

impl<T: Scalar> Ode<T> for EquationsOfMotion<T> {
    fn dimension(&self) -> usize {
        2 * self.links
    }

    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        self.rates_with(&mut Workspace::new(), time, state, rates);
    }

    fn rates_with(&self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]) {
        if [state.len(), rates.len()] != [2 * self.links; 2] {
            return rates.fill(T::from_f64(f64::NAN));
        }
        let (theta, omega) = state.split_at(self.links);
        let (velocities, alpha) = rates.split_at_mut(self.links);
        velocities.copy_from_slice(omega);
        let drive = self.drive.as_ref().map(|drive| drive.root(time));
        let torques = None;
        let acting = Acting { drive, torques };
        self.equations
            .accelerate(workspace, acting, [theta, omega], alpha);
    }
}

/// A use of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ParameterUse {
    /// Gravity.
    Gravity,
    /// A mass.
    Mass,
    /// The position of a centre of mass, a pivot or an end, or the attachment point of a straight
    /// spring.
    Place,
    /// A moment of inertia.
    Inertia,
    /// Viscous friction in a pivot, or drag against the air.
    ViscousFriction,
    /// Coulomb or static friction.
    CoulombFriction,
    /// Friction that grows with the square of the velocity.
    QuadraticFriction,
    /// Stiffness of a spring, its rest angle or rest length, the strength of a repulsion, or the
    /// width or the Stribeck rate of a friction law.
    Joint,
    /// The drive.
    Drive,
}

impl ParameterUse {
    /// Returns true if the parameter is used as a coefficient of friction.
    #[must_use]
    pub fn is_friction(&self) -> bool {
        match self {
            Self::ViscousFriction | Self::CoulombFriction | Self::QuadraticFriction => true,
            Self::Gravity
            | Self::Mass
            | Self::Place
            | Self::Inertia
            | Self::Joint
            | Self::Drive => false,
        }
    }
}

/// Node of a description, with the links that are created from it.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct DescribedNode {
    /// Name of the node: `child` for the links `child_1` and `child_2`.
    pub name: String,
    /// Indices of the links created from the node, in the order of the angles: one link, or all
    /// copies.
    pub links: Vec<usize>,
    /// Names of the parameters that give the viscous friction in the pivots of these links.
    pub friction: Vec<String>,
}

impl TreeDescription {
    /// Returns the nodes of the description, in the order of their first links.
    pub fn nodes(&self) -> Vec<DescribedNode> {
        let mut nodes: Vec<DescribedNode> = Vec::new();
        for (index, place) in numbers::link_copies(&self.scene).into_iter().enumerate() {
            let Some(link) = self.scene.links.get(place.link) else {
                continue;
            };
            let Some(orbit) = self.scene.orbits.get(link.orbit.0) else {
                continue;
            };
            if let Some(own) = nodes.iter_mut().find(|own| own.name == orbit.node) {
                own.links.push(index);
                continue;
            }
            let friction = link.passive.friction.atoms().into_iter();
            let friction = friction.filter_map(|atom| match atom {
                QuantityAtom::Parameter(id) => self.scene.parameters.get(id.0),
                QuantityAtom::Exact(_) => None,
            });
            nodes.push(DescribedNode {
                name: orbit.node.clone(),
                links: vec![index],
                friction: friction.map(|own| own.name.clone()).collect(),
            });
        }
        nodes
    }

    /// Returns the clauses of straight springs, as in `between(a, b)`, one for each of
    /// [`translational_spring_dampers`](PendulumTree::translational_spring_dampers). The clause of
    /// springs between siblings is repeated for each pair of siblings.
    pub fn straight_springs(&self) -> impl Iterator<Item = &str> {
        let lines = self.scene.lines().into_iter();
        lines.filter_map(|line| {
            let own = self.scene.translational.get(line.spring_damper)?;
            Some(own.what.as_str())
        })
    }

    /// Returns the clauses of springs that do not belong to a single scale, as in `between(a, b)`.
    /// A tree with such a spring has no energies by scale.
    pub fn springs_across_scales(&self) -> impl Iterator<Item = &str> {
        springs_across_scales(&self.scene)
    }

    /// Returns the names of the links, in the order of the angles.
    pub fn links(&self) -> Vec<String> {
        numbers::names(&self.scene)
    }

    /// Returns the parent of each link, as an index; `None` for the root.
    pub fn parents(&self) -> Vec<Option<usize>> {
        let places = numbers::link_copies(&self.scene).into_iter();
        places.map(|place| place.parent).collect()
    }

    /// Returns what a parameter is used for; empty if there is no such parameter.
    pub fn uses_of(&self, name: &str) -> Vec<ParameterUse> {
        use ParameterUse::{
            CoulombFriction, Drive, Gravity, Inertia, Joint, Mass, Place, QuadraticFriction,
            ViscousFriction,
        };
        let Ok(place) = self.place(name) else {
            return Vec::new();
        };
        let scene = &*self.scene;
        let passive = || {
            let links = scene.links.iter().map(|link| &link.passive);
            links.chain(scene.spring_dampers.iter().map(|own| &own.torques))
        };
        let is_in = |quantity: &Quantity| {
            let own = QuantityAtom::Parameter(ParameterId(place));
            quantity.atoms().contains(&&own)
        };
        let of_links = |of: &dyn Fn(&Link) -> bool| scene.links.iter().any(of);
        let of_laws = |of: fn(&PassiveTorques) -> [&Quantity; 2]| {
            passive().any(|own| of(own).map(is_in).contains(&true))
        };
        let [ties, dampers, springs] = straight_uses(&scene.translational, is_in);
        let uses = [
            (Gravity, is_in(&scene.gravity)),
            (Mass, of_links(&|link| is_in(&link.mass))),
            (
                Place,
                of_links(&|link| {
                    let offsets = [&link.com, &link.pivot, &link.end];
                    let mut parts = offsets.iter().flat_map(|own| [&own.along, &own.lateral]);
                    parts.any(is_in)
                }) || ties,
            ),
            (Inertia, of_links(&|link| is_in(&link.inertia))),
            (
                ViscousFriction,
                of_laws(|own| [&own.friction, &own.drag]) || dampers,
            ),
            (
                CoulombFriction,
                of_laws(|own| own.laws.each_ref().map(|law| &law.coulomb))
                    || of_laws(|own| own.laws.each_ref().map(|law| &law.excess)),
            ),
            (
                QuadraticFriction,
                of_laws(|own| own.laws.each_ref().map(|law| &law.quadratic)),
            ),
            (
                Joint,
                of_laws(|own| [&own.spring, &own.rest])
                    || of_laws(|own| own.laws.each_ref().map(|law| &law.width))
                    || of_laws(|own| own.laws.each_ref().map(|law| &law.stribeck))
                    || springs,
            ),
            (Drive, is_in_drive(scene, is_in)),
        ];
        let uses = uses.into_iter().filter(|(_, is_one)| *is_one);
        uses.map(|(of, _)| of).collect()
    }

    /// Returns the equations of motion for the given values of the parameters, in order and in SI
    /// units. Values are not checked. They can be of any scalar type; with dual numbers, results
    /// include derivatives with respect to the parameters.
    ///
    /// If a value is missing, all rates are NaN.
    ///
    /// # Examples
    ///
    /// The derivative of a pendulum's acceleration with respect to its length:
    ///
    /// ```
    /// use branched_pendulum::scalar::Dual;
    /// use branched_pendulum::system::Ode;
    /// use branched_pendulum_trees::TreeDescription;
    ///
    /// let rod = TreeDescription::parse("gravity = 9.81, rod: rod(mass = 0.2, length = l)")?;
    /// let length = Dual::<f64, 1>::variable(0.5, 0);
    /// let [angle, rate] = [0.1, 0.0].map(Dual::constant);
    /// let mut rates = [rate; 2];
    /// rod.equations(&[length]).rates(rate, &[angle, rate], &mut rates);
    /// // −3 g sin θ/(2 l) and its derivative.
    /// let expected = -1.5 * 9.81 * 0.1_f64.sin() / 0.5;
    /// assert!((rates[1].value - expected).abs() < 1e-13);
    /// assert!((rates[1].tangents[0] + expected / 0.5).abs() < 1e-13);
    /// # Ok::<(), branched_pendulum_trees::TreeError>(())
    /// ```
    pub fn equations<T: Scalar>(&self, values: &[T]) -> EquationsOfMotion<T> {
        let scene: &Scene = &self.scene;
        // No value of a parameter makes a form that lacks something: NaN is not zero.
        let any = vec![Double::from_f64(f64::NAN); scene.parameters.len()];
        let form = Form::of(&numbers::links_as_given(scene, &any), scene.drive.is_some());
        let links: Vec<LinkNumbers<T>> = numbers::links_as_given(scene, values);
        let (parents, carries) = rows::parents(&links);
        let rows = form.rows(&links, &carries);
        let above = -numbers::value(&scene.gravity, values);
        let between = Between::of(scene, links.len(), values);
        EquationsOfMotion {
            links: links.len(),
            equations: Equations::new(form, &parents, rows, above, between),
            drive: Courses::of(scene, &|quantity| numbers::value(quantity, values)),
        }
    }

    /// Returns the tree for the given values of the parameters, in order and in SI units. Values
    /// that [`tree`](Self::tree) would reject, such as negative friction, are accepted.
    ///
    /// # Errors
    /// [`TreeError::MissingValues`] for fewer values than there are parameters.
    pub fn tree_as_given(&self, values: &[f64]) -> Result<PendulumTree, TreeError> {
        let named: Vec<(&str, f64)> = self.parameters().zip(values.iter().copied()).collect();
        let values = self.values(&named)?;
        let parameters: Vec<Double> = values.iter().copied().map(Double::from_f64).collect();
        let links = numbers::links_as_given(&self.scene, &parameters);
        Ok(PendulumTree::of_links(self.clone(), values, &links))
    }
}

/// Returns three flags: true if quantities with the property `is_one` occur in the attachment
/// points of straight springs, in their dampers, and in their energies.
fn straight_uses(
    all: &[DescribedTranslationalSpringDamper],
    is_one: impl Fn(&Quantity) -> bool,
) -> [bool; 3] {
    let stored = all.iter().flat_map(|own| &own.potentials);
    let mut stored = stored.flat_map(|own| own.quantities());
    [
        all.iter()
            .any(|own| own.end_components().into_iter().any(&is_one)),
        all.iter().any(|own| is_one(&own.friction)),
        stored.any(|(_, quantity, _)| is_one(quantity)),
    ]
}

/// Returns true if a constant in the functions of the drive has the property `is_one`.
fn is_in_drive(scene: &Scene, is_one: impl Fn(&Quantity) -> bool) -> bool {
    let found = std::cell::Cell::new(false);
    if let Some(drive) = &scene.drive {
        drive.map(&|quantity| found.set(found.get() || is_one(quantity)));
    }
    found.get()
}
