//! Implementations of the traits of compiled models for trees that are read at run time.

use branched_pendulum::emitted::{Simd, no_answer};
use branched_pendulum::scalar::Scalar;
use branched_pendulum::system::functions::AccelerationsUnderTorques;
use branched_pendulum::system::{
    At, Computes, Energy, InRegisters, LinkName, LinkPoint, LinkProperties, Model, Pendulum,
    Positions, Workspace,
};

use crate::energies::potential_energy;
use crate::tree::PendulumTree;

impl<T: Scalar> Model<T> for PendulumTree<T> {
    type Of<S: Scalar> = PendulumTree<S>;

    const KNOWN_LINKS: Option<usize> = None;

    fn links(&self) -> usize {
        self.names().len()
    }

    fn link_name(&self, index: usize) -> Option<LinkName<'_>> {
        self.names().get(index).map(|name| LinkName::listed(name))
    }

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> PendulumTree<S> {
        self.on_scalar(&convert)
    }

    fn shape(&self) -> usize {
        self.described.shape
    }
}

impl<T: Scalar> Pendulum<T> for PendulumTree<T> {
    #[inline(always)]
    fn evaluate(
        &self,
        time: T,
        theta: impl Fn(usize) -> T,
        omega: impl Fn(usize) -> T,
        alpha: impl FnMut(usize, T),
    ) {
        let drive = self.acting(time, None).drive;
        self.equations
            .evaluate(&mut Workspace::new(), drive, theta, omega, alpha);
    }

    #[inline(always)]
    fn evaluate_with(
        &self,
        workspace: &mut Workspace<T>,
        time: T,
        given: [&[T]; 2],
        alpha: &mut [T],
    ) {
        let acting = self.acting(time, None);
        self.equations
            .evaluate_with(workspace, acting, given, alpha);
    }

    fn accelerations_into(&self, time: T, theta: &[T], omega: &[T], alpha: &mut [T]) {
        self.accelerations_with(&mut Workspace::new(), time, theta, omega, alpha);
    }

    fn accelerations_with(
        &self,
        workspace: &mut Workspace<T>,
        time: T,
        theta: &[T],
        omega: &[T],
        alpha: &mut [T],
    ) {
        self.accelerate(workspace, self.acting(time, None), [theta, omega], alpha);
    }

    fn workspace_len(&self) -> usize {
        self.equations.workspace_len()
    }

    #[inline(always)]
    fn in_registers<R: Simd<T>>(&self, time: T, buffer: &mut [T]) -> impl InRegisters<R> {
        self.equations
            .in_registers(self.acting(time, None).drive, buffer)
    }
}

impl<T: Scalar> Computes<AccelerationsUnderTorques, T> for PendulumTree<T> {
    type On<S: Scalar> = PendulumTree<S>;

    fn on<S: Scalar>(&self, convert: impl Fn(T) -> S) -> PendulumTree<S> {
        self.on_scalar(&convert)
    }

    #[inline(always)]
    fn compute(&self, at: At<T>, given: &[&[T]], results: &mut [&mut [T]]) {
        let (&[theta, omega, torques], [alpha]) = (given, &mut *results) else {
            return no_answer(results);
        };
        let acting = self.acting(at.time, Some(torques));
        let workspace = &mut Workspace::new();
        self.equations
            .evaluate_with(workspace, acting, [theta, omega], alpha);
    }

    fn compute_with(
        &self,
        workspace: &mut Workspace<T>,
        at: At<T>,
        given: &[&[T]],
        results: &mut [&mut [T]],
    ) {
        let (&[theta, omega, torques], [alpha]) = (given, &mut *results) else {
            return no_answer(results);
        };
        let acting = self.acting(at.time, Some(torques));
        self.accelerate(workspace, acting, [theta, omega], alpha);
    }
}

impl<T: Scalar> Energy<T> for PendulumTree<T> {
    fn kinetic_energy_of(&self, theta: &[T], omega: &[T]) -> T {
        self.kinetic_energy_with(&mut Workspace::new(), theta, omega)
    }

    fn potential_energy_of(&self, theta: &[T]) -> T {
        self.potential_energy_with(&mut Workspace::new(), theta)
    }

    fn kinetic_energy_with(&self, workspace: &mut Workspace<T>, theta: &[T], omega: &[T]) -> T {
        self.bodies.kinetic_energy(workspace, theta, omega)
    }

    fn potential_energy_with(&self, workspace: &mut Workspace<T>, theta: &[T]) -> T {
        potential_energy(&self.bodies, self.between(), workspace, theta)
    }
}

impl<T: Scalar> Positions<T> for PendulumTree<T> {
    fn stands(&self) -> bool {
        self.description().scene.stands()
    }

    fn properties_of(&self, link: usize) -> Option<LinkProperties<T>> {
        self.properties.of(link)
    }

    fn points_into(&self, point: LinkPoint, theta: &[T], points: &mut [[T; 2]]) {
        self.properties.points_into(point, theta, points);
    }

    fn point_velocities_into(
        &self,
        point: LinkPoint,
        theta: &[T],
        omega: &[T],
        velocities: &mut [[T; 2]],
    ) {
        self.properties
            .velocities_into(point, theta, omega, velocities);
    }

    fn point_torques_into(
        &self,
        point: LinkPoint,
        theta: &[T],
        forces: &[[T; 2]],
        torques: &mut [T],
    ) {
        self.properties.torques_into(point, theta, forces, torques);
    }
}
