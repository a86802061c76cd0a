//! Hamilton's equations.

use branched_pendulum::emitted::no_answer;
use branched_pendulum::scalar::{Dual, Scalar};
use branched_pendulum::system::functions::CanonicalRates;
use branched_pendulum::system::{At, Computes, LinkProperties, Model, Workspace};
use branched_pendulum_codegen::scene::{FrictionLaw, LAW_CONSTANTS, PassiveTorques};

use crate::between::Between;
use crate::equations::Form;
use crate::forms::{Acting, Equations};
use crate::numbers::LinkNumbers;
use crate::rows;
use crate::tree::PendulumTree;

impl<T: Scalar> PendulumTree<T> {
    /// Returns the equations of the same links at rest, without gravity, springs and friction. With
    /// these, torques p cause the accelerations M⁻¹ p.
    pub(crate) fn inertia_alone(&self) -> Equations<T> {
        let zero = T::from_f64(0.0);
        let none = FrictionLaw::of_constants([zero; LAW_CONSTANTS]);
        let properties = (0..self.links()).map_while(|link| self.properties.of(link));
        let links = properties.map(|own: LinkProperties<T>| LinkNumbers {
            parent: own.parent,
            mass: own.mass,
            inertia: own.inertia,
            com: own.centre,
            pivot: own.pivot,
            end: own.end,
            passive: PassiveTorques {
                friction: zero,
                drag: zero,
                spring: zero,
                rest: zero,
                laws: [none; 2],
            },
        });
        let links: Vec<LinkNumbers<T>> = links.collect();
        let (parents, carries) = rows::parents(&links);
        let rows = Form::General.rows(&links, &carries);
        Equations::new(
            Form::General,
            &parents,
            rows,
            zero,
            Between::none(links.len()),
        )
    }
}

/// Velocities are M⁻¹ p. The rates of the momenta are the derivative of the momenta along the
/// motion, so that this code needs no knowledge of friction, springs and drive. O(links²);
/// allocates. One state and lanes agree to rounding: the momenta of one state are not computed in
/// fused arithmetic.
impl<T: Scalar> Computes<CanonicalRates, T> for PendulumTree<T> {
    type On<S: Scalar> = PendulumTree<S>;

    fn on<S: Scalar>(&self, convert: impl Fn(T) -> S) -> PendulumTree<S> {
        self.on_scalar(&convert)
    }

    #[inline(always)]
    fn compute(&self, at: At<T>, given: &[&[T]], results: &mut [&mut [T]]) {
        self.canonical(
            at.time,
            given,
            results,
            |equations, acting, given, alpha| {
                equations.evaluate_with(&mut Workspace::new(), acting, given, alpha);
            },
        );
    }

    fn compute_with(
        &self,
        workspace: &mut Workspace<T>,
        at: At<T>,
        given: &[&[T]],
        results: &mut [&mut [T]],
    ) {
        self.canonical(
            at.time,
            given,
            results,
            |equations, acting, given, alpha| {
                equations.accelerate(workspace, acting, given, alpha);
            },
        );
    }
}

impl<T: Scalar> PendulumTree<T> {
    /// Computes canonical rates from accelerations that `accelerate` computes by given equations.
    #[inline(always)]
    fn canonical(
        &self,
        time: T,
        given: &[&[T]],
        results: &mut [&mut [T]],
        mut accelerate: impl FnMut(&Equations<T>, Acting<'_, T>, [&[T]; 2], &mut [T]),
    ) {
        let (&[theta, momenta], [q_rates, p_rates]) = (given, &mut *results) else {
            return no_answer(results);
        };
        let n = self.links();
        if [theta.len(), momenta.len(), q_rates.len(), p_rates.len()] != [n; 4] {
            return no_answer(results);
        }
        // M ω = p.
        let still = vec![T::from_f64(0.0); n];
        let acting = Acting {
            drive: None,
            torques: Some(momenta),
        };
        accelerate(&self.inertia_alone(), acting, [theta, &still], q_rates);
        let mut alpha = still;
        let acting = self.acting(time, None);
        accelerate(&self.equations, acting, [theta, &**q_rates], &mut alpha);
        let along = |values: &[T], rates: &[T]| -> Vec<Dual<T, 1>> {
            let pairs = values.iter().zip(rates);
            let moving = |(&value, &rate): (&T, &T)| Dual {
                value,
                tangents: [rate],
            };
            pairs.map(moving).collect()
        };
        let (theta, omega) = (along(theta, q_rates), along(q_rates, &alpha));
        let moving = self.cast(Dual::<T, 1>::constant).momenta(&theta, &omega);
        for (rate, momentum) in p_rates.iter_mut().zip(moving) {
            [*rate] = momentum.tangents;
        }
    }
}
