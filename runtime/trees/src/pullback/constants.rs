//! Constants of a tree on which the virtual power depends, and their derivatives by the parameters.

use std::cell::RefCell;

use branched_pendulum::friction::FrictionLaw;
use branched_pendulum::scalar::{Double, Dual, Scalar};
use branched_pendulum::spring_dampers::SpringDamper;
use branched_pendulum::translational::TranslationalSpringDamper;
use branched_pendulum_codegen::scene::{
    self, FrictionContact, LAW_CONSTANTS, PassiveTorques, Quantity, Scene,
};

use crate::between::Between;
use crate::drive::Courses;
use crate::numbers::{self, LinkNumbers, law};
use crate::tree::constant;

/// Constants of one link. The torques that its joint and the ground exert are those of a spring with
/// friction.
#[derive(Clone, Debug)]
pub(super) struct LinkConstants<T> {
    pub(super) numbers: LinkNumbers<T>,
    pub(super) joint: SpringDamper<T>,
    pub(super) ground: SpringDamper<T>,
}

/// Constants of a tree.
#[derive(Clone, Debug)]
pub(super) struct Constants<T> {
    pub(super) gravity: T,
    pub(super) links: Vec<LinkConstants<T>>,
    pub(super) springs: Vec<SpringDamper<T>>,
    pub(super) lines: Vec<TranslationalSpringDamper<T>>,
}

impl<T: Scalar> LinkConstants<T> {
    /// Creates the constants; the friction at a contact has a law if `laws` says so.
    fn of(numbers: LinkNumbers<T>, laws: [bool; 2]) -> Self {
        let PassiveTorques {
            friction,
            drag,
            spring,
            rest,
            laws: given,
        } = numbers.passive;
        let [joint, ground] = FrictionContact::ALL
            .map(|contact| laws[contact as usize].then(|| law(given[contact as usize])));
        let zero = T::from_f64(0.0);
        let passive =
            |[spring, rest, friction]: [T; 3], law: Option<FrictionLaw<T>>| SpringDamper {
                links: [0, 0],
                spring,
                rest,
                friction,
                law,
            };
        Self {
            numbers,
            joint: passive([spring, rest, friction], joint),
            ground: passive([zero, zero, drag], ground),
        }
    }
}

impl<T: Scalar> Constants<T> {
    /// Returns the constants of a tree for the values of its parameters.
    pub(super) fn of_tree(scene: &Scene, values: &[f64]) -> Self {
        let values: Vec<Double> = values.iter().copied().map(Double::from_f64).collect();
        // No value of a parameter makes a law that is absent: NaN is not zero.
        let any = vec![Double::from_f64(f64::NAN); values.len()];
        let laws = numbers::links_as_given(scene, &any).into_iter().map(|own| {
            let zero = Double::from_f64(0.0);
            let laws = own.passive.laws.each_ref();
            laws.map(|law| law.strengths().into_iter().any(|own| *own != zero))
        });
        let links = numbers::links_as_given(scene, &values);
        let between = Between::of(scene, links.len(), &values).cast(constant);
        let links = links.into_iter().zip(laws);
        Self {
            gravity: constant(numbers::value(&scene.gravity, &values)),
            links: links
                .map(|(link, laws)| LinkConstants::of(link.map(constant), laws))
                .collect(),
            springs: between.torsional.iter().collect(),
            lines: between.translational.iter().collect(),
        }
    }
}

/// Derivatives of the constants of a tree by its parameters.
#[derive(Clone, Debug)]
pub(super) struct ParameterSlopes<T> {
    pub(super) gravity: Slopes<T>,
    pub(super) links: Vec<Slopes<T>>,
    pub(super) springs: Vec<Slopes<T>>,
    pub(super) lines: Vec<Slopes<T>>,
}

/// Derivatives of some constants by parameters, without those that are zero.
#[derive(Clone, Debug)]
pub(super) struct Slopes<T>(Vec<Slope<T>>);

#[derive(Clone, Copy, Debug)]
struct Slope<T> {
    /// Index of the constant.
    constant: usize,
    parameter: usize,
    slope: T,
}

impl<T: Scalar> Slopes<T> {
    fn none() -> Self {
        Self(Vec::new())
    }

    /// Adds the derivatives of constants by one parameter.
    fn take(&mut self, parameter: usize, constants: impl IntoIterator<Item = Dual<Double, 1>>) {
        let all = constants.into_iter().enumerate();
        self.0.extend(all.filter_map(|(index, own)| {
            let [slope] = own.tangents;
            (slope != Double::from_f64(0.0)).then(|| Slope {
                constant: index,
                parameter,
                slope: constant(slope),
            })
        }));
    }

    /// Adds to the derivatives by the parameters those that go through some constants, given the
    /// derivatives by these.
    pub(super) fn add(&self, by_constants: &[T], by_parameters: &mut [T]) {
        for own in &self.0 {
            if let (Some(sum), Some(&by)) = (
                by_parameters.get_mut(own.parameter),
                by_constants.get(own.constant),
            ) {
                *sum = *sum + by * own.slope;
            }
        }
    }

    /// Returns true if no constant depends on a parameter.
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl<T: Scalar> ParameterSlopes<T> {
    /// Returns the derivatives for the values of the parameters.
    pub(super) fn of(scene: &Scene, values: &[f64]) -> Self {
        let count = |of: usize| vec![Slopes::none(); of];
        let values: Vec<Double> = values.iter().copied().map(Double::from_f64).collect();
        let links = numbers::links_as_given(scene, &values).len();
        let between = Between::of(scene, links, &values);
        let mut slopes = Self {
            gravity: Slopes::none(),
            links: count(links),
            springs: count(between.torsional.iter().count()),
            lines: count(between.translational.iter().count()),
        };
        for parameter in 0..values.len() {
            let values = varied(&values, parameter);
            let gravity = numbers::value(&scene.gravity, &values);
            slopes.gravity.take(parameter, [gravity]);
            let own = numbers::links_as_given(scene, &values);
            for (slopes, own) in slopes.links.iter_mut().zip(&own) {
                slopes.take(parameter, own.numbers());
            }
            let between = Between::of(scene, links, &values);
            for (slopes, own) in slopes.springs.iter_mut().zip(between.torsional.iter()) {
                slopes.take(parameter, numbers_of_spring(&own));
            }
            for (slopes, own) in slopes.lines.iter_mut().zip(between.translational.iter()) {
                slopes.take(parameter, numbers_of_line(&own));
            }
        }
        slopes
    }
}

/// Returns the values of the parameters as dual numbers, of which one varies.
fn varied(values: &[Double], parameter: usize) -> Vec<Dual<Double, 1>> {
    let mut varied: Vec<_> = values.iter().copied().map(Dual::constant).collect();
    if let Some(own) = varied.get_mut(parameter) {
        *own = Dual::variable(own.value, 0);
    }
    varied
}

/// Returns the drive of a scene with its derivative by each parameter on which it depends.
pub(super) fn drives<T: Scalar>(
    scene: &Scene,
    values: &[f64],
) -> Vec<(usize, Courses<Dual<T, 1>>)> {
    let values: Vec<Double> = values.iter().copied().map(Double::from_f64).collect();
    let of = |parameter: usize| {
        let values = varied(&values, parameter);
        let varies = RefCell::new(false);
        let at = |quantity: &Quantity| {
            let own = numbers::value(quantity, &values);
            let tangents = own.tangents.map(constant);
            *varies.borrow_mut() |= own.tangents != [Double::from_f64(0.0)];
            Dual {
                value: constant(own.value),
                tangents,
            }
        };
        let drive = Courses::of(scene, &at)?;
        varies.into_inner().then_some((parameter, drive))
    };
    (0..values.len()).filter_map(of).collect()
}

impl<T: Copy> LinkNumbers<T> {
    /// Returns the constants of the link one after the other.
    pub(super) fn numbers(&self) -> [T; 10 + 2 * LAW_CONSTANTS] {
        let Self {
            parent: _,
            mass,
            inertia,
            com: [along, across],
            pivot: [place_along, place_across],
            // No force acts there.
            end: _,
            passive,
        } = *self;
        let PassiveTorques {
            friction,
            drag,
            spring,
            rest,
            laws: [joint, ground],
        } = passive;
        let body = [mass, inertia, along, across, place_along, place_across];
        let torques = [friction, drag, spring, rest];
        let laws = [joint, ground].map(scene::FrictionLaw::into_constants);
        let own = body.into_iter().chain(torques);
        let mut all = own.chain(laws.into_iter().flatten());
        // There are as many constants as places.
        std::array::from_fn(|_| all.next().unwrap_or(mass))
    }
}

/// Returns the constants of a spring-damper one after the other.
pub(super) fn numbers_of_spring<T: Scalar>(own: &SpringDamper<T>) -> [T; 3 + LAW_CONSTANTS] {
    let zero = T::from_f64(0.0);
    let law = own
        .law
        .map_or([zero; LAW_CONSTANTS], FrictionLaw::into_constants);
    let own = [own.spring, own.rest, own.friction];
    let mut all = own.into_iter().chain(law);
    // There are as many constants as places.
    std::array::from_fn(|_| all.next().unwrap_or(zero))
}

/// Returns the constants of a line one after the other: of the arms, of the fixed part, and of the
/// force.
pub(super) fn numbers_of_line<T: Copy>(own: &TranslationalSpringDamper<T>) -> Vec<T> {
    let numbers = RefCell::new(Vec::new());
    let _ = own.map(|number| numbers.borrow_mut().push(number));
    numbers.into_inner()
}
