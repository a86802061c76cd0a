// Expanded from straight.rs by `branched-pendulum` 0.1.0. Do not edit.
//! The equations of a link without torques in its joint and without lateral offsets, whose
//! children share a pivot.

#[allow(unused_imports)]
use branched_pendulum::prelude::*;

/// Lends its equations. Every property is a parameter, so that each link may have its own.
///
/// A planar tree of 3 rigid links. Angles are absolute, in radians from the
/// downward vertical, in the order of `LINK_NAMES`; SI units throughout.
///
/// The code is a loop over the links, O(links), of the equations that are shown
/// where they stand. Energies can be asked for with `emit(energies)`.
#[derive(::core::clone::Clone, ::core::fmt::Debug, ::core::cmp::PartialEq)]
pub struct Straight<T = f64> {
    tree: ::branched_pendulum::tree::Tree<StraightEquations, T>,
}

/// Parameters of [`Straight`]. SI units.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq
)]
pub struct StraightParameters<T = f64> {
    /// gravity, m/s².
    pub g: T,
    /// mass of `trunk`, kg; mass of `bough`, kg; mass of `twig`, kg.
    pub m: T,
    /// centre of mass of `trunk`, m; centre of mass of `bough`, m; centre of mass of
    /// `twig`, m.
    pub d: T,
    /// inertia of `trunk`, kg m²; inertia of `bough`, kg m²; inertia of `twig`, kg m².
    pub i: T,
    /// joint of `trunk`, m; joint of `bough`, m.
    pub l: T,
}

#[allow(dead_code, clippy::possible_missing_comma)]
impl<T: ::branched_pendulum::scalar::Real> Straight<T> {
    /// The model for the given parameters, which are checked in
    /// double precision.
    ///
    /// # Errors
    /// A parameter that is not finite, one that makes a mass, an
    /// inertia or a friction coefficient impossible, or ones that
    /// make the mass matrix singular.
    pub fn new(
        parameters: StraightParameters<T>,
    ) -> ::core::result::Result<Self, ::branched_pendulum::ParameterError> {
        let given = parameters;
        let parameters = StraightParameters::<f64> {
            g: ::branched_pendulum::scalar::Real::to_f64(given.g),
            m: ::branched_pendulum::scalar::Real::to_f64(given.m),
            d: ::branched_pendulum::scalar::Real::to_f64(given.d),
            i: ::branched_pendulum::scalar::Real::to_f64(given.i),
            l: ::branched_pendulum::scalar::Real::to_f64(given.l),
        };
        ::branched_pendulum::emitted::require_finite("parameter `g`", parameters.g)?;
        ::branched_pendulum::emitted::require_finite("parameter `d`", parameters.d)?;
        ::branched_pendulum::emitted::require_finite("parameter `l`", parameters.l)?;
        ::branched_pendulum::emitted::require_non_negative(
            "mass of `trunk`",
            parameters.m,
        )?;
        ::branched_pendulum::emitted::require_non_negative(
            "inertia of `trunk`",
            parameters.i,
        )?;
        ::branched_pendulum::emitted::require_regular(
            &[
                ::branched_pendulum::emitted::LinkBody {
                    what: "moment of inertia of `trunk` about its pivot, in some configuration,",
                    parent: ::core::option::Option::None,
                    mass: parameters.m,
                    inertia: parameters.i,
                    com: [parameters.d, 0.0],
                    pivot: [0.0, 0.0],
                },
                ::branched_pendulum::emitted::LinkBody {
                    what: "moment of inertia of `bough` about its pivot, in some configuration,",
                    parent: ::core::option::Option::Some(0),
                    mass: parameters.m,
                    inertia: parameters.i,
                    com: [parameters.d, 0.0],
                    pivot: [parameters.l, 0.0],
                },
                ::branched_pendulum::emitted::LinkBody {
                    what: "moment of inertia of `twig` about its pivot, in some configuration,",
                    parent: ::core::option::Option::Some(1),
                    mass: parameters.m,
                    inertia: parameters.i,
                    com: [parameters.d, 0.0],
                    pivot: [parameters.l, 0.0],
                },
            ],
        )?;
        ::core::result::Result::Ok(Self::from_parameters_unchecked(given))
    }
}

impl<T: ::branched_pendulum::Scalar> ::branched_pendulum::Parametric<T> for Straight<T> {
    const PARAMETERS: &'static [&'static str] = &["g", "m", "d", "i", "l"];

    fn with_parameters<S: ::branched_pendulum::Scalar>(
        values: impl ::core::ops::Fn(usize) -> S,
    ) -> Straight<S> {
        Straight::from_parameters_unchecked(StraightParameters {
            g: values(0),
            m: values(1),
            d: values(2),
            i: values(3),
            l: values(4),
        })
    }

    fn check_parameters(
        values: impl ::core::ops::Fn(usize) -> f64,
    ) -> ::core::result::Result<(), ::branched_pendulum::ParameterError> {
        ::core::result::Result::map(
            Straight::<
                f64,
            >::new(StraightParameters {
                g: values(0),
                m: values(1),
                d: values(2),
                i: values(3),
                l: values(4),
            }),
            |_| (),
        )
    }
}

/// The equations of one link, by articulated-body recursion in the plane
/// (Featherstone, Rigid Body Dynamics Algorithms, 2008, ch. 7).
///
/// Subtrees that hang at (ℓ, w) answer the acceleration **a** of their pivot with
/// the force σ **a** + γ − N **a**. Their articulated inertia is σ − N; σ is the
/// mass of those that are single links, and zero for others. J is the moment of
/// inertia that the joint feels, b the first moment, κ the bias torque, f the force
/// with the joint held; primed are N and γ of the subtree that the link carries,
/// and the acceleration of its children's pivot. The code carries −**a**, the
/// apparent gravity, has all masses over m and all lengths over l of the commonest
/// leaf, and angles of a link by its own length.
///
/// ```text
/// S = m + σ
/// M = m d² + I + σ ℓ²
/// h = m d + σ ℓ
/// J = −2 ℓ² cos θ_i sin θ_i N_xy − ℓ² cos² θ_i N_xx − ℓ² sin² θ_i N_yy + M
/// b_x = −ℓ cos θ_i N_xx − ℓ sin θ_i N_xy + h cos θ_i
/// b_y = −ℓ cos θ_i N_xy − ℓ sin θ_i N_yy + h sin θ_i
/// f_x = −ℓ cos θ_i N_xy ω_i² + ℓ sin θ_i N_xx ω_i² − h sin θ_i ω_i² + γ_x
/// f_y = −ℓ cos θ_i N_yy ω_i² + ℓ sin θ_i N_xy ω_i² + h cos θ_i ω_i² + γ_y
/// κ = ℓ cos θ_i γ_x + ℓ sin θ_i γ_y + ℓ² cos θ_i sin θ_i N_xx ω_i²
///     − ℓ² cos θ_i sin θ_i N_yy ω_i² − ℓ² cos² θ_i N_xy ω_i²
///     + ℓ² sin² θ_i N_xy ω_i² − Q
/// N'_xx = N_xx + b_x² / J
/// N'_xy = N_xy + b_x b_y / J
/// N'_yy = N_yy + b_y² / J
/// γ'_x = −b_x κ / J + f_x
/// γ'_y = −b_y κ / J + f_y
/// α_i = −(b_x a_x,i + b_y a_y,i + κ) / J
/// a'_x,i = ℓ cos θ_i α_i − ℓ sin θ_i ω_i² + a_x,i
/// a'_y,i = ℓ cos θ_i ω_i² + ℓ sin θ_i α_i + a_y,i
/// ```
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq,
)]
pub struct StraightEquations;

#[allow(clippy::many_single_char_names, clippy::possible_missing_comma)]
impl ::branched_pendulum::tree::LinkEquations for StraightEquations {
    type Constants<T: ::branched_pendulum::Scalar> = [T; 6];
    type Response<T: ::branched_pendulum::Scalar> = [T; 5];
    type Sums<T: ::branched_pendulum::Scalar> = [T; 5];
    type Elimination<T: ::branched_pendulum::Scalar> = [T; 3];
    type Carried<T: ::branched_pendulum::Scalar> = [T; 2];
    const COPIES: &'static [usize] = &[];
    const NAMES: &'static [&'static str] = &[];
    const JOINTS: bool = false;
    const TORQUE: bool = false;
    const FORCED: bool = true;

    /// The response of a link without children: N and γ, and the torque of its joint on
    /// the parent where joints have torques.
    ///
    /// Cost: 12 ×, 2 ±; 1 of the ± take a × along where the scalar fuses.
    #[inline(always)]
    fn leaf<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
    ) -> Self::Response<T> {
        let [inertia, _, _, gain_along, _, _] = *constants;
        let ::branched_pendulum::tree::LinkMotion {
            sine,
            cosine,
            omega,
            outside_torque,
            ..
        } = link;
        let gain_x = gain_along * cosine;
        let gain_y = gain_along * sine;
        let first_moment_x = inertia * gain_x;
        let first_moment_y = inertia * gain_y;
        let omega_squared = omega * omega;
        let deficit_xx = first_moment_x * gain_x;
        let deficit_xy = first_moment_x * gain_y;
        let deficit_yy = first_moment_y * gain_y;
        let bias_force_x = outside_torque * gain_x - omega_squared * first_moment_y;
        let bias_force_y = outside_torque
            .mul_add(gain_y, omega_squared * first_moment_x);
        [deficit_xx, deficit_xy, deficit_yy, bias_force_x, bias_force_y]
    }

    /// The response of a child about the pivot of its parent, whose motion is given: as
    /// it is where all children share one pivot.
    ///
    /// Cost: none.
    #[inline(always)]
    fn attach<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        response: Self::Response<T>,
    ) -> Self::Sums<T> {
        let _ = constants;
        let _ = link;
        response
    }

    /// The response of a link with children, and b/J and κ/J, which `accelerate` takes.
    ///
    /// Cost: 26 ×, 21 ±, 1 ÷, 1 negation; 17 of the ± take a × along where the scalar
    /// fuses.
    #[inline(always)]
    fn inner<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        below: Self::Sums<T>,
    ) -> (Self::Response<T>, Self::Elimination<T>) {
        let [inertia, moment, mass, _, _, along] = *constants;
        let ::branched_pendulum::tree::LinkMotion {
            sine,
            cosine,
            omega,
            outside_torque,
            ..
        } = link;
        let [
            deficit_xx_below, deficit_xy_below, deficit_yy_below, bias_force_x_below,
            bias_force_y_below,
        ] = below;
        let omega_squared = omega * omega;
        let attachment_x = along * cosine;
        let attachment_y = along * sine;
        let centrifugal_moment = (-(deficit_xx_below + deficit_yy_below))
            .mul_add(along, moment);
        let deficit_moment_x = deficit_xy_below
            .mul_add(attachment_y, deficit_xx_below * attachment_x);
        let deficit_moment_y = deficit_yy_below
            .mul_add(attachment_y, deficit_xy_below * attachment_x);
        let first_moment_x = moment.mul_add(cosine, -deficit_moment_x);
        let first_moment_y = moment.mul_add(sine, -deficit_moment_y);
        let joint_inertia = (-attachment_x).mul_add(deficit_moment_x, inertia);
        let joint_inertia = (-attachment_y).mul_add(deficit_moment_y, joint_inertia);
        let held_force_x = (-omega_squared)
            .mul_add(
                centrifugal_moment.mul_add(sine, deficit_moment_y),
                bias_force_x_below,
            );
        let held_force_y = omega_squared
            .mul_add(
                centrifugal_moment.mul_add(cosine, deficit_moment_x),
                bias_force_y_below,
            );
        let torque = outside_torque
            - attachment_y.mul_add(held_force_y, attachment_x * held_force_x);
        let inverse_joint_inertia = T::from_f64(1.0) / joint_inertia;
        let gain_x = inverse_joint_inertia * first_moment_x;
        let gain_y = inverse_joint_inertia * first_moment_y;
        let minus_offset = torque * inverse_joint_inertia;
        let deficit_yy = first_moment_y.mul_add(gain_y, deficit_yy_below - mass);
        let deficit_xx = first_moment_x.mul_add(gain_x, deficit_xx_below - mass);
        let deficit_xy = first_moment_x.mul_add(gain_y, deficit_xy_below);
        let bias_force_x = torque.mul_add(gain_x, held_force_x);
        let bias_force_y = torque.mul_add(gain_y, held_force_y);
        (
            [deficit_xx, deficit_xy, deficit_yy, bias_force_x, bias_force_y],
            [gain_x, gain_y, -minus_offset],
        )
    }

    /// The apparent gravity at a child's pivot.
    ///
    /// Cost: none.
    #[inline(always)]
    fn pivot<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        carried: Self::Carried<T>,
    ) -> [T; 2] {
        let _ = constants;
        let _ = link;
        carried
    }

    /// The angular acceleration (in rad/s²) of a link with children, and what it hands
    /// them.
    ///
    /// Cost: 9 ×, 6 ±; 6 of the ± take a × along where the scalar fuses.
    #[inline(always)]
    fn accelerate<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        elimination: Self::Elimination<T>,
        pivot: [T; 2],
    ) -> (T, Self::Carried<T>) {
        let [_, _, _, _, _, along] = *constants;
        let ::branched_pendulum::tree::LinkMotion { sine, cosine, omega, .. } = link;
        let [gain_x, gain_y, offset] = elimination;
        let [gravity_x, gravity_y] = pivot;
        let omega_squared = omega * omega;
        let attachment_x = along * cosine;
        let attachment_y = along * sine;
        let tangential = gain_x.mul_add(gravity_x, -offset);
        let tangential = gain_y.mul_add(gravity_y, tangential);
        (
            tangential,
            [
                (-tangential)
                    .mul_add(
                        attachment_x,
                        omega_squared.mul_add(attachment_y, gravity_x),
                    ),
                (-tangential)
                    .mul_add(
                        attachment_y,
                        (-omega_squared).mul_add(attachment_x, gravity_y),
                    ),
            ],
        )
    }

    /// The angular acceleration (in rad/s²) of a link without children.
    ///
    /// Cost: 5 ×, 2 ±; 2 of the ± take a × along where the scalar fuses.
    #[inline(always)]
    fn accelerate_leaf<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        pivot: [T; 2],
    ) -> T {
        let [_, _, _, gain_along, inverse_inertia, _] = *constants;
        let ::branched_pendulum::tree::LinkMotion { sine, cosine, outside_torque, .. } = link;
        let [gravity_x, gravity_y] = pivot;
        let gain_x = gain_along * cosine;
        let gain_y = gain_along * sine;
        let minus_offset = outside_torque * inverse_inertia;
        gain_y.mul_add(gravity_y, gain_x.mul_add(gravity_x, minus_offset))
    }
}

#[allow(dead_code)]
impl<T: ::branched_pendulum::Scalar> Straight<T> {
    /// Angular accelerations (in rad/s²) at angles `theta` (in rad) and angular
    /// velocities `omega` (in rad/s), in fused arithmetic where the machine has it.
    /// O(links).
    #[must_use]
    pub fn accelerations(&self, theta: &[T; 3], omega: &[T; 3]) -> [T; 3] {
        let mut alpha = [T::from_f64(0.0); 3];
        self.tree
            .accelerations_into(::core::option::Option::None, theta, omega, &mut alpha);
        alpha
    }

    /// Angular accelerations (in rad/s²) as [`accelerations`](Self::accelerations),
    /// with generalized `torques` Q (in N m) from outside: M(θ) θ̈ + b(θ, ω) = Q. Q_i
    /// is a couple on link i; forces have those of `centre_torques` and its like
    /// (`emit(positions)`).
    ///
    /// The power of the torques is Q·ω. In canonical variables they add to the rates of
    /// the momenta.
    #[must_use]
    pub fn accelerations_under(
        &self,
        theta: &[T; 3],
        omega: &[T; 3],
        torques: &[T; 3],
    ) -> [T; 3] {
        let mut alpha = [T::from_f64(0.0); 3];
        let mut workspace = ::branched_pendulum::system::Workspace::new();
        let given: [&[T]; 3] = [theta, omega, torques];
        self.tree
            .accelerations_under_with(
                &mut workspace,
                ::core::option::Option::None,
                given,
                &mut alpha,
            );
        alpha
    }
}

impl<T: ::branched_pendulum::Scalar> ::branched_pendulum::Pendulum<T> for Straight<T> {
    const LINKS: usize = 3;
    const LINK_NAMES: &'static [&'static str] = &["trunk", "bough", "twig"];

    fn accelerations_into(&self, _time: T, theta: &[T], omega: &[T], alpha: &mut [T]) {
        self.tree.accelerations_into(::core::option::Option::None, theta, omega, alpha);
    }

    fn accelerations_with(
        &self,
        workspace: &mut ::branched_pendulum::system::Workspace<T>,
        _time: T,
        theta: &[T],
        omega: &[T],
        alpha: &mut [T],
    ) {
        self.tree
            .accelerations_with(
                workspace,
                ::core::option::Option::None,
                theta,
                omega,
                alpha,
            );
    }
}

impl<T: ::branched_pendulum::Scalar> ::branched_pendulum::Cast<T> for Straight<T> {
    type Of<S: ::branched_pendulum::Scalar> = Straight<S>;

    fn cast<S: ::branched_pendulum::Scalar>(
        &self,
        convert: impl ::core::ops::Fn(T) -> S,
    ) -> Straight<S> {
        Straight {
            tree: self.tree.cast(&convert),
        }
    }

    #[inline(always)]
    fn evaluate(
        &self,
        _time: T,
        theta: impl ::core::ops::Fn(usize) -> T,
        omega: impl ::core::ops::Fn(usize) -> T,
        alpha: impl ::core::ops::FnMut(usize, T),
    ) {
        self.tree.evaluate(::core::option::Option::None, theta, omega, alpha);
    }

    fn room(&self) -> usize {
        self.tree.room()
    }

    #[inline(always)]
    fn in_registers<R: ::branched_pendulum::emitted::Simd<T>>(
        &self,
        _time: T,
        room: &mut [T],
    ) -> impl ::branched_pendulum::system::InRegisters<R> {
        self.tree.in_registers(::core::option::Option::None, room)
    }
}

impl<T: ::branched_pendulum::Scalar> ::branched_pendulum::Forced<T> for Straight<T> {
    fn accelerations_under_into(
        &self,
        time: T,
        theta: &[T],
        omega: &[T],
        torques: &[T],
        alpha: &mut [T],
    ) {
        let mut workspace = ::branched_pendulum::system::Workspace::new();
        ::branched_pendulum::Forced::accelerations_under_with(
            self,
            &mut workspace,
            time,
            theta,
            omega,
            torques,
            alpha,
        );
    }

    fn accelerations_under_with(
        &self,
        workspace: &mut ::branched_pendulum::system::Workspace<T>,
        _time: T,
        theta: &[T],
        omega: &[T],
        torques: &[T],
        alpha: &mut [T],
    ) {
        let given = [theta, omega, torques];
        self.tree
            .accelerations_under_with(
                workspace,
                ::core::option::Option::None,
                given,
                alpha,
            );
    }

    #[inline(always)]
    fn accelerations_under_of<S: ::branched_pendulum::Scalar>(
        pendulum: &Straight<S>,
        _time: S,
        theta: &[S],
        omega: &[S],
        torques: &[S],
        alpha: &mut [S],
    ) {
        pendulum
            .tree
            .evaluate_under(
                ::core::option::Option::None,
                [theta, omega, torques],
                alpha,
            );
    }
}

#[allow(dead_code, clippy::possible_missing_comma)]
impl<T: ::branched_pendulum::Scalar> Straight<T> {
    /// The model for the given parameters, taken as they are: for
    /// scalars without an order by which masses could be checked,
    /// as lanes and dual numbers. Others have `new`.
    #[must_use]
    pub fn from_parameters_unchecked(parameters: StraightParameters<T>) -> Self {
        /// The parent of each link, which stands before it; the root has none.
        static PARENTS: [u32; 3] = [0, 0, 1];

        /// Constants of the equations, a row for each link, the root's first; of every
        /// number the nearest `f64` and what remains. Columns:
        ///
        /// 1. `inertia`: M/(L² m), moment of inertia about the pivot
        /// 2. `moment`: h/(L m), first moment of mass about the pivot
        /// 3. `mass`: mass over m that is not in the constants of the parent
        /// 4. `gain_along`: h L/M of a leaf
        /// 5. `inverse_inertia`: L² m/M of a leaf
        /// 6. `along`: place of the attachment along the link, over L
        static STRIPS: [[[f64; 2]; 6]; 3] = [
            [[0.0, 0.0], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0]],
            [[0.0, 0.0], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0]],
            [[0.0, 0.0], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0]],
        ];
        let d_squared_m = parameters.d * parameters.d * parameters.m;
        let d_squared_m_plus_i = d_squared_m + parameters.i;
        let d_m = parameters.d * parameters.m;
        let l_squared_m = parameters.l * parameters.l * parameters.m;
        let d_squared_m_plus_i_plus_l_squared_m = d_squared_m_plus_i + l_squared_m;
        let l_m = parameters.l * parameters.m;
        let d_m_plus_l_m = d_m + l_m;
        let twice_m = T::from_f64(2.0) * parameters.m;
        let reduced_moment_trunk = d_m;
        let reduced_inertia_trunk = d_squared_m_plus_i;
        let reduced_moment_bough = d_m_plus_l_m;
        let reduced_inertia_bough = d_squared_m_plus_i_plus_l_squared_m;
        let reduced_gravity = parameters.g;
        let reduced_moment_trunk_over_reduced_inertia_trunk = reduced_moment_trunk
            / reduced_inertia_trunk;
        let inverse_reduced_inertia_trunk = T::from_f64(1.0) / reduced_inertia_trunk;
        let minus_reduced_gravity = T::from_f64(-1.0) * reduced_gravity;
        Self {
            tree: ::branched_pendulum::tree::Tree::with_parents(
                &PARENTS,
                &{
                    let mut strips = ::branched_pendulum::tree::numbers(
                        STRIPS.as_flattened(),
                    );
                    strips[0] = reduced_inertia_trunk;
                    strips[1] = reduced_moment_trunk;
                    strips[2] = parameters.m;
                    strips[5] = parameters.l;
                    strips[6] = reduced_inertia_bough;
                    strips[7] = reduced_moment_bough;
                    strips[8] = twice_m;
                    strips[11] = parameters.l;
                    strips[12] = reduced_inertia_trunk;
                    strips[13] = reduced_moment_trunk;
                    strips[15] = reduced_moment_trunk_over_reduced_inertia_trunk;
                    strips[16] = inverse_reduced_inertia_trunk;
                    strips
                },
                [T::from_f64(0.0), minus_reduced_gravity],
            ),
        }
    }
}
