//! Constants of a tree on which the virtual power depends, and their derivatives by the parameters.

use std::cell::RefCell;

use branched_pendulum::friction::FrictionLaw;
use branched_pendulum::scalar::{Double, Dual, Scalar};
use branched_pendulum::spring_dampers::SpringDamper;
use branched_pendulum::translational::TranslationalSpringDamper;
use branched_pendulum::tree::{ParameterSlopes, PassiveLink, Shape, VirtualPower};
use branched_pendulum_codegen::scene::{
    self, FrictionContact, LAW_CONSTANTS, PassiveTorques, Quantity, Scene,
};

use crate::between::Between;
use crate::drive::Courses;
use crate::numbers::{self, LinkNumbers};
use crate::tree::constant;

/// Returns the virtual power of a tree for the values of its parameters, with the derivatives of its
/// constants by these.
pub(super) fn virtual_power<T: Scalar>(scene: &Scene, values: &[f64]) -> VirtualPower<T> {
    let values: Vec<Double> = values.iter().copied().map(Double::from_f64).collect();
    // No value of a parameter makes a law that is absent: NaN is not zero.
    let any = vec![Double::from_f64(f64::NAN); values.len()];
    let laws = numbers::links_as_given(scene, &any).into_iter().map(|own| {
        let zero = Double::from_f64(0.0);
        let is_law = |contact: FrictionContact| {
            let mut strengths = own.passive.law(contact).strengths().into_iter();
            strengths.any(|own| *own != zero)
        };
        FrictionContact::ALL.map(is_law)
    });
    let links = numbers::links_as_given(scene, &values);
    // The index of a link fits, as that of a link in the equations.
    let parents = links.iter().map(|link| link.parent.unwrap_or(0) as u32);
    let shape = Shape::Shared(parents.collect());
    let between = Between::of(scene, links.len(), &values).cast(constant);
    let links = links.iter().zip(laws);
    let links =
        links.map(|(link, laws)| PassiveLink::from_row(&link.map(constant).numbers(), laws));
    let gravity = constant(numbers::value(&scene.gravity, &values));
    VirtualPower::new(shape, gravity, links.collect())
        .with_forces_between(between.torsional, between.translational)
        .with_slopes(slopes(scene, &values))
}

/// Returns the derivatives of the constants of a tree by its parameters.
fn slopes<T: Scalar>(scene: &Scene, values: &[Double]) -> ParameterSlopes<T> {
    let (mut places, mut slopes) = (Vec::new(), Vec::new());
    for parameter in 0..values.len() {
        let values = varied(values, parameter);
        let mut group = 0;
        let mut take = |constants: &[Dual<Double, 1>]| {
            for (index, own) in constants.iter().enumerate() {
                let [slope] = own.tangents;
                if slope != Double::from_f64(0.0) {
                    places.push([group, index, parameter]);
                    slopes.push(constant(slope));
                }
            }
            group += 1;
        };
        take(&[numbers::value(&scene.gravity, &values)]);
        let links = numbers::links_as_given(scene, &values);
        links.iter().for_each(|own| take(&own.numbers()));
        for (own, _) in numbers::spring_dampers(scene, &values) {
            take(&numbers_of_spring(&own));
        }
        let between = Between::of(scene, links.len(), &values);
        for own in between.translational.iter() {
            take(&numbers_of_line(&own));
        }
    }
    ParameterSlopes::new(values.len(), &places, &slopes)
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
    /// Returns the constants of the link in the order of [`PassiveLink::from_row`].
    fn numbers(&self) -> [T; 10 + 2 * LAW_CONSTANTS] {
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
fn numbers_of_spring<T: Scalar>(own: &SpringDamper<T>) -> Vec<T> {
    let law = own.law.into_iter().flat_map(FrictionLaw::into_constants);
    let own = [own.spring, own.rest, own.friction];
    own.into_iter().chain(law).collect()
}

/// Returns the constants of a line one after the other: of the arms, of the fixed part, and of the
/// force.
fn numbers_of_line<T: Copy>(own: &TranslationalSpringDamper<T>) -> Vec<T> {
    let numbers = RefCell::new(Vec::new());
    let _ = own.map(|number| numbers.borrow_mut().push(number));
    numbers.into_inner()
}
