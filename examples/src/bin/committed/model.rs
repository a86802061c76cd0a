// Expanded from scene.rs by `cargo branched-pendulum` 0.1.0. Do not edit.
//! The scene from which `model.rs` was generated.

#[allow(unused_imports)]
use branched_pendulum::prelude::*;

/// A rod with friction.
///
/// A planar tree of 1 rigid link; angles are absolute, from the downward vertical,
/// in the order `rod`. SI units throughout, angles in radians.
///
/// # Example
///
/// ```ignore
/// use branched_pendulum::prelude::*;
///
/// let model = Rod::new();
/// // Angles and angular velocities of rod.
/// let (theta, omega) = ([0.1; 1], [0.0; 1]);
/// let alpha = model.accelerations(&theta, &omega);
/// let kinetic = model.kinetic_energy(&theta, &omega);
/// let potential = model.potential_energy(&theta);
/// // The motion from there, at 1 s and at 2 s.
/// let start = State::at_rest(0.0, &theta);
/// let method = Dop853::new(Options::with_tolerance(1e-12));
/// let states = method.sample_to_vec(&AbsoluteAngles(&model), &start, &[1.0, 2.0])?;
/// ```
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq
)]
#[allow(unreachable_pub, clippy::pedantic, clippy::wrong_self_convention)]
pub struct Rod<T = f64> {
    inertia_rod: T,
    friction_rod: T,
    friction_rod_over_inertia_rod: T,
    minus_reduced_gravity: T,
    half_inertia_rod: T,
    gravity_rod: T,
}

#[allow(dead_code)]
#[allow(unreachable_pub, clippy::pedantic, clippy::wrong_self_convention)]
impl Rod<f64> {
    /// Creates the model in double precision, with constants that are
    /// rounded once from their exact values. `Default` creates it for
    /// other scalars.
    #[must_use]
    pub fn new() -> Self {
        <Self as ::core::default::Default>::default()
    }
}

#[allow(unreachable_pub, clippy::pedantic, clippy::wrong_self_convention)]
impl<T: ::branched_pendulum::Scalar> ::core::default::Default for Rod<T> {
    fn default() -> Self {
        let inertia_rod = T::from_parts(0.0165, -7.771561172376096e-19);
        let friction_rod = T::from_parts(0.0001, -4.79217360238593e-21);
        let friction_rod_over_inertia_rod = T::from_parts(
            0.006060606060606061,
            5.2567378059903245e-21,
        );
        let minus_reduced_gravity = T::from_parts(
            -29.717121212121214,
            1.4813739460695423e-15,
        );
        let half_inertia_rod = T::from_parts(0.00825, -3.885780586188048e-19);
        let gravity_rod = T::from_parts(0.4903325, -4.458655666894629e-18);
        Self {
            inertia_rod,
            friction_rod,
            friction_rod_over_inertia_rod,
            minus_reduced_gravity,
            half_inertia_rod,
            gravity_rod,
        }
    }
}

#[allow(dead_code, clippy::possible_missing_comma)]
#[allow(unreachable_pub, clippy::pedantic, clippy::wrong_self_convention)]
impl<T: ::branched_pendulum::Scalar> Rod<T> {
    /// Angular accelerations (in rad/s²) at angles `theta` (in rad) and angular
    /// velocities `omega` (in rad/s).
    ///
    /// Solves the Euler–Lagrange equations M(θ) θ̈ + b(θ, ω) = 0 by articulated
    /// recursion, from the leaves to the root and back (Featherstone, Rigid Body
    /// Dynamics Algorithms, 2008, chapter 7), in O(n) operations.
    ///
    /// ```text
    /// M[rod, rod] = M_rod
    /// b[rod] = G_rod sin θ_rod + c_rod ω_rod
    /// ```
    ///
    /// <details><summary>LaTeX</summary>
    ///
    /// ```latex
    /// M_{\mathrm{rod,rod}} = M_{\mathrm{rod}}
    /// b_{\mathrm{rod}} = G_{\mathrm{rod}}\,\sin\theta_{\mathrm{rod}} + c_{\mathrm{rod}}\,\omega_{\mathrm{rod}}
    /// ```
    /// </details>
    ///
    /// Cost: 1 sin_cos, 2 ×, 1 ±. By elimination: 1 sin_cos, 3 ×, 1 ±, 1 negation.
    /// Rounding error: at most 0.9 ulp of the largest result, at 16 states.
    #[inline(always)]
    pub fn accelerations(&self, theta: &[T; 1], omega: &[T; 1]) -> [T; 1] {
        let [theta_rod] = *theta;
        let [omega_rod] = *omega;
        let (sin_rod, _) = theta_rod.sin_cos();
        let offset_rod = self.friction_rod_over_inertia_rod * omega_rod;
        let alpha_rod = self.minus_reduced_gravity * sin_rod - offset_rod;
        [alpha_rod]
    }

    /// Kinetic energy K = ½ ωᵀ M(θ) ω (in J) at angles `theta` (in rad) and angular
    /// velocities `omega` (in rad/s).
    ///
    /// ```text
    /// K = M_rod ω_rod² / 2
    /// ```
    ///
    /// <details><summary>LaTeX</summary>
    ///
    /// ```latex
    /// K = \frac{M_{\mathrm{rod}}\,\omega_{\mathrm{rod}}^{2}}{2}
    /// ```
    /// </details>
    ///
    /// Cost: 2 ×. Rounding error: at most 1.0 ulp of the largest result, at 16 states.
    #[inline]
    pub fn kinetic_energy(&self, theta: &[T; 1], omega: &[T; 1]) -> T {
        let _ = theta;
        let [omega_rod] = *omega;
        let centripetal_rod = omega_rod * omega_rod;
        self.half_inertia_rod * centripetal_rod
    }

    /// Potential energy U (in J) at angles `theta` (in rad), zero if all are zero.
    ///
    /// ```text
    /// U = G_rod (1 − cos θ_rod)
    /// ```
    ///
    /// <details><summary>LaTeX</summary>
    ///
    /// ```latex
    /// U = G_{\mathrm{rod}}\,\left(1 - \cos\theta_{\mathrm{rod}}\right)
    /// ```
    /// </details>
    ///
    /// Cost: 1 sin_cos, 1 ×, 1 ±. Rounding error: at most 0.9 ulp of the largest
    /// result, at 16 states.
    #[inline]
    pub fn potential_energy(&self, theta: &[T; 1]) -> T {
        let [theta_rod] = *theta;
        let (_, cos_rod) = theta_rod.sin_cos();
        self.gravity_rod * (T::from_f64(1.0) - cos_rod)
    }
}

/// Constants of the model.
#[allow(dead_code)]
#[allow(unreachable_pub, clippy::pedantic, clippy::wrong_self_convention)]
impl<T: ::branched_pendulum::Scalar> Rod<T> {
    /// M_rod (in kg m²): moment of inertia of `rod` about its pivot, with what hangs
    /// from it as point masses at their pivots.
    ///
    /// M_rod = 0.0165
    #[inline]
    #[must_use]
    pub fn inertia_rod(&self) -> T {
        self.inertia_rod
    }

    /// c_rod (in N m s): viscous friction in the pivot of `rod`.
    ///
    /// c_rod = 0.0001
    #[inline]
    #[must_use]
    pub fn friction_rod(&self) -> T {
        self.friction_rod
    }

    /// G_rod (in J): weight that `rod` carries times its lever.
    ///
    /// G_rod = 0.4903325
    #[inline]
    #[must_use]
    pub fn gravity_rod(&self) -> T {
        self.gravity_rod
    }
}

#[allow(clippy::possible_missing_comma)]
#[allow(dead_code)]
#[allow(unreachable_pub, clippy::pedantic, clippy::wrong_self_convention)]
impl Rod<f64> {
    /// Number of links, each with one angle.
    pub const LINKS: usize = 1;

    /// Names of the links, in the order of the angles.
    pub const LINK_NAMES: &'static [&'static str] = &["rod"];
}

#[allow(unreachable_pub, clippy::pedantic, clippy::wrong_self_convention)]
impl<T: ::branched_pendulum::Scalar> ::branched_pendulum::Model<T> for Rod<T> {
    type Of<S: ::branched_pendulum::Scalar> = Rod<S>;
    const KNOWN_LINKS: ::core::option::Option<usize> = ::core::option::Option::Some(1);

    #[inline(always)]
    fn links(&self) -> usize {
        1
    }

    fn link_name(
        &self,
        index: usize,
    ) -> ::core::option::Option<::branched_pendulum::system::LinkName<'_>> {
        ::branched_pendulum::system::LinkName::in_list(<Rod<f64>>::LINK_NAMES, index)
    }

    #[inline(always)]
    fn cast<S: ::branched_pendulum::Scalar>(
        &self,
        convert: impl ::core::ops::Fn(T) -> S,
    ) -> Rod<S> {
        Rod {
            inertia_rod: convert(self.inertia_rod),
            friction_rod: convert(self.friction_rod),
            friction_rod_over_inertia_rod: convert(self.friction_rod_over_inertia_rod),
            minus_reduced_gravity: convert(self.minus_reduced_gravity),
            half_inertia_rod: convert(self.half_inertia_rod),
            gravity_rod: convert(self.gravity_rod),
        }
    }
}

#[allow(unreachable_pub, clippy::pedantic, clippy::wrong_self_convention)]
impl<T: ::branched_pendulum::Scalar> ::branched_pendulum::Pendulum<T> for Rod<T> {
    #[inline(always)]
    fn evaluate(
        &self,
        _time: T,
        theta: impl ::core::ops::Fn(usize) -> T,
        omega: impl ::core::ops::Fn(usize) -> T,
        mut alpha: impl ::core::ops::FnMut(usize, T),
    ) {
        let theta = ::core::array::from_fn(theta);
        let omega = ::core::array::from_fn(omega);
        let values = self.accelerations(&theta, &omega);
        for (link, value) in ::core::iter::Iterator::enumerate(
            ::core::iter::IntoIterator::into_iter(values),
        ) {
            alpha(link, value);
        }
    }
}

#[allow(unreachable_pub, clippy::pedantic, clippy::wrong_self_convention)]
impl<T: ::branched_pendulum::Scalar> ::branched_pendulum::Energy<T> for Rod<T> {
    #[inline]
    fn kinetic_energy_of(&self, theta: &[T], omega: &[T]) -> T {
        match ::branched_pendulum::emitted::arrays([theta, omega]) {
            ::core::option::Option::Some([theta, omega]) => {
                self.kinetic_energy(theta, omega)
            }
            _ => T::from_f64(f64::NAN),
        }
    }

    #[inline]
    fn potential_energy_of(&self, theta: &[T]) -> T {
        match ::branched_pendulum::emitted::arrays([theta]) {
            ::core::option::Option::Some([theta]) => self.potential_energy(theta),
            _ => T::from_f64(f64::NAN),
        }
    }
}
