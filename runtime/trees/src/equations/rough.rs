// Expanded from rough.rs by `branched-pendulum` 0.1.0. Do not edit.
//! The equations of a link that may have all that links can have, friction that is not viscous
//! among it.

#[allow(unused_imports)]
use branched_pendulum::prelude::*;

/// Lends its equations. Every property is a parameter, so that each link may have its own.
///
/// A planar tree of 4 rigid links. Angles are absolute, in radians from the
/// downward vertical, in the order of `LINK_NAMES`; SI units throughout.
///
/// The code is a loop over the links, O(links), of the equations that are shown
/// where they stand. Energies can be asked for with `emit(energies)`.
///
/// Driven by a torque on the root.
///
/// ```text
/// τ = torque
/// ```
///
/// <details><summary>LaTeX</summary>
///
/// ```latex
/// \tau = \mathrm{torque}
/// ```
/// </details>
#[derive(::core::clone::Clone, ::core::fmt::Debug, ::core::cmp::PartialEq)]
pub struct Rough<T = f64> {
    tree: ::branched_pendulum::tree::Tree<RoughEquations, T>,
    torque: T,
}

/// Parameters of [`Rough`]. SI units.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq
)]
pub struct RoughParameters<T = f64> {
    /// gravity, m/s².
    pub g: T,
    /// mass of `trunk`, kg; mass of `bough`, kg; mass of `twig`, kg; mass of `leaf`,
    /// kg.
    pub m: T,
    /// centre of mass of `trunk`, m; centre of mass of `bough`, m; centre of mass of
    /// `twig`, m; centre of mass of `leaf`, m.
    pub d: T,
    /// lateral centre of mass of `trunk`, m; lateral centre of mass of `bough`, m;
    /// lateral centre of mass of `twig`, m; lateral centre of mass of `leaf`, m.
    pub e: T,
    /// inertia of `trunk`, kg m²; inertia of `bough`, kg m²; inertia of `twig`, kg m²;
    /// inertia of `leaf`, kg m².
    pub i: T,
    /// spring of `trunk`, N m; spring of `bough`, N m; spring of `twig`, N m; spring of
    /// `leaf`, N m.
    pub s: T,
    /// rest of `trunk`, rad; rest of `bough`, rad; rest of `twig`, rad; rest of `leaf`,
    /// rad.
    pub r: T,
    /// friction of `trunk`, N m s; friction of `bough`, N m s; friction of `twig`, N m
    /// s; friction of `leaf`, N m s.
    pub c: T,
    /// Coulomb friction of `trunk`, N m; Coulomb friction of `bough`, N m; Coulomb
    /// friction of `twig`, N m; Coulomb friction of `leaf`, N m.
    pub f: T,
    /// quadratic friction of `trunk`, N m s²; quadratic friction of `bough`, N m s²;
    /// quadratic friction of `twig`, N m s²; quadratic friction of `leaf`, N m s².
    pub q: T,
    /// width of friction of `trunk`, rad/s; width of friction of `bough`, rad/s; width
    /// of friction of `twig`, rad/s; width of friction of `leaf`, rad/s.
    pub u: T,
    /// drag of `trunk`, N m s; drag of `bough`, N m s; drag of `twig`, N m s; drag of
    /// `leaf`, N m s.
    pub k: T,
    /// quadratic drag of `trunk`, N m s²; quadratic drag of `bough`, N m s²; quadratic
    /// drag of `twig`, N m s²; quadratic drag of `leaf`, N m s².
    pub p: T,
    /// width of drag of `trunk`, rad/s; width of drag of `bough`, rad/s; width of drag
    /// of `twig`, rad/s; width of drag of `leaf`, rad/s.
    pub v: T,
    /// pivot of `bough`, m; pivot of `twig`, m; lateral pivot of `leaf`, m.
    pub l: T,
    /// lateral pivot of `bough`, m; lateral pivot of `twig`, m; pivot of `leaf`, m.
    pub w: T,
    /// torque on the root, N m.
    pub torque: T,
}

#[allow(dead_code, clippy::possible_missing_comma)]
impl<T: ::branched_pendulum::scalar::Real> Rough<T> {
    /// The model for the given parameters, which are checked in
    /// double precision.
    ///
    /// # Errors
    /// A parameter that is not finite, one that makes a mass, an
    /// inertia or a friction coefficient impossible, or ones that
    /// make the mass matrix singular.
    pub fn new(
        parameters: RoughParameters<T>,
    ) -> ::core::result::Result<Self, ::branched_pendulum::ParameterError> {
        let given = parameters;
        let parameters = RoughParameters::<f64> {
            g: ::branched_pendulum::scalar::Real::to_f64(given.g),
            m: ::branched_pendulum::scalar::Real::to_f64(given.m),
            d: ::branched_pendulum::scalar::Real::to_f64(given.d),
            e: ::branched_pendulum::scalar::Real::to_f64(given.e),
            i: ::branched_pendulum::scalar::Real::to_f64(given.i),
            s: ::branched_pendulum::scalar::Real::to_f64(given.s),
            r: ::branched_pendulum::scalar::Real::to_f64(given.r),
            c: ::branched_pendulum::scalar::Real::to_f64(given.c),
            f: ::branched_pendulum::scalar::Real::to_f64(given.f),
            q: ::branched_pendulum::scalar::Real::to_f64(given.q),
            u: ::branched_pendulum::scalar::Real::to_f64(given.u),
            k: ::branched_pendulum::scalar::Real::to_f64(given.k),
            p: ::branched_pendulum::scalar::Real::to_f64(given.p),
            v: ::branched_pendulum::scalar::Real::to_f64(given.v),
            l: ::branched_pendulum::scalar::Real::to_f64(given.l),
            w: ::branched_pendulum::scalar::Real::to_f64(given.w),
            torque: ::branched_pendulum::scalar::Real::to_f64(given.torque),
        };
        ::branched_pendulum::emitted::require_finite("parameter `g`", parameters.g)?;
        ::branched_pendulum::emitted::require_finite("parameter `d`", parameters.d)?;
        ::branched_pendulum::emitted::require_finite("parameter `e`", parameters.e)?;
        ::branched_pendulum::emitted::require_finite("parameter `r`", parameters.r)?;
        ::branched_pendulum::emitted::require_finite("parameter `l`", parameters.l)?;
        ::branched_pendulum::emitted::require_finite("parameter `w`", parameters.w)?;
        ::branched_pendulum::emitted::require_finite(
            "parameter `torque`",
            parameters.torque,
        )?;
        ::branched_pendulum::emitted::require_non_negative(
            "mass of `trunk`",
            parameters.m,
        )?;
        ::branched_pendulum::emitted::require_non_negative(
            "inertia of `trunk`",
            parameters.i,
        )?;
        ::branched_pendulum::emitted::require_non_negative(
            "spring of `trunk`",
            parameters.s,
        )?;
        ::branched_pendulum::emitted::require_non_negative(
            "friction of `trunk`",
            parameters.c,
        )?;
        ::branched_pendulum::emitted::require_non_negative(
            "Coulomb friction of `trunk`",
            parameters.f,
        )?;
        ::branched_pendulum::emitted::require_non_negative(
            "quadratic friction of `trunk`",
            parameters.q,
        )?;
        ::branched_pendulum::emitted::require_positive(
            "width of friction of `trunk`",
            parameters.u,
        )?;
        ::branched_pendulum::emitted::require_non_negative(
            "drag of `trunk`",
            parameters.k,
        )?;
        ::branched_pendulum::emitted::require_non_negative(
            "quadratic drag of `trunk`",
            parameters.p,
        )?;
        ::branched_pendulum::emitted::require_positive(
            "width of drag of `trunk`",
            parameters.v,
        )?;
        ::branched_pendulum::emitted::require_regular(
            &[
                ::branched_pendulum::emitted::LinkBody {
                    what: "moment of inertia of `trunk` about its pivot, in some configuration,",
                    parent: ::core::option::Option::None,
                    mass: parameters.m,
                    inertia: parameters.i,
                    com: [parameters.d, parameters.e],
                    pivot: [0.0, 0.0],
                },
                ::branched_pendulum::emitted::LinkBody {
                    what: "moment of inertia of `bough` about its pivot, in some configuration,",
                    parent: ::core::option::Option::Some(0),
                    mass: parameters.m,
                    inertia: parameters.i,
                    com: [parameters.d, parameters.e],
                    pivot: [parameters.l, parameters.w],
                },
                ::branched_pendulum::emitted::LinkBody {
                    what: "moment of inertia of `twig` about its pivot, in some configuration,",
                    parent: ::core::option::Option::Some(1),
                    mass: parameters.m,
                    inertia: parameters.i,
                    com: [parameters.d, parameters.e],
                    pivot: [parameters.l, parameters.w],
                },
                ::branched_pendulum::emitted::LinkBody {
                    what: "moment of inertia of `leaf` about its pivot, in some configuration,",
                    parent: ::core::option::Option::Some(0),
                    mass: parameters.m,
                    inertia: parameters.i,
                    com: [parameters.d, parameters.e],
                    pivot: [parameters.w, parameters.l],
                },
            ],
        )?;
        ::core::result::Result::Ok(Self::from_parameters_unchecked(given))
    }
}

impl<T: ::branched_pendulum::Scalar> ::branched_pendulum::Parametric<T> for Rough<T> {
    const PARAMETERS: &'static [&'static str] = &[
        "g",
        "m",
        "d",
        "e",
        "i",
        "s",
        "r",
        "c",
        "f",
        "q",
        "u",
        "k",
        "p",
        "v",
        "l",
        "w",
        "torque",
    ];

    fn with_parameters<S: ::branched_pendulum::Scalar>(
        values: impl ::core::ops::Fn(usize) -> S,
    ) -> Rough<S> {
        Rough::from_parameters_unchecked(RoughParameters {
            g: values(0),
            m: values(1),
            d: values(2),
            e: values(3),
            i: values(4),
            s: values(5),
            r: values(6),
            c: values(7),
            f: values(8),
            q: values(9),
            u: values(10),
            k: values(11),
            p: values(12),
            v: values(13),
            l: values(14),
            w: values(15),
            torque: values(16),
        })
    }

    fn check_parameters(
        values: impl ::core::ops::Fn(usize) -> f64,
    ) -> ::core::result::Result<(), ::branched_pendulum::ParameterError> {
        ::core::result::Result::map(
            Rough::<
                f64,
            >::new(RoughParameters {
                g: values(0),
                m: values(1),
                d: values(2),
                e: values(3),
                i: values(4),
                s: values(5),
                r: values(6),
                c: values(7),
                f: values(8),
                q: values(9),
                u: values(10),
                k: values(11),
                p: values(12),
                v: values(13),
                l: values(14),
                w: values(15),
                torque: values(16),
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
/// M = m d² + m e² + I + σ ℓ² + σ w²
/// h = m d + σ ℓ
/// h_⊥ = m e + σ w
/// J = 2 ℓ w cos θ_i sin θ_i N_xx − 2 ℓ w cos θ_i sin θ_i N_yy
///     − 2 ℓ w cos² θ_i N_xy + 2 ℓ w sin² θ_i N_xy − 2 ℓ² cos θ_i sin θ_i N_xy
///     − ℓ² cos² θ_i N_xx − ℓ² sin² θ_i N_yy + 2 w² cos θ_i sin θ_i N_xy
///     − w² cos² θ_i N_yy − w² sin² θ_i N_xx + M
/// b_x = −ℓ cos θ_i N_xx − ℓ sin θ_i N_xy − w cos θ_i N_xy + w sin θ_i N_xx
///     + h cos θ_i − h_⊥ sin θ_i
/// b_y = −ℓ cos θ_i N_xy − ℓ sin θ_i N_yy − w cos θ_i N_yy + w sin θ_i N_xy
///     + h sin θ_i + h_⊥ cos θ_i
/// f_x = −ℓ cos θ_i N_xy ω_i² + ℓ sin θ_i N_xx ω_i² + w cos θ_i N_xx ω_i²
///     + w sin θ_i N_xy ω_i² − h sin θ_i ω_i² − h_⊥ cos θ_i ω_i² + γ_x
/// f_y = −ℓ cos θ_i N_yy ω_i² + ℓ sin θ_i N_xy ω_i² + w cos θ_i N_xy ω_i²
///     + w sin θ_i N_yy ω_i² + h cos θ_i ω_i² − h_⊥ sin θ_i ω_i² + γ_y
/// κ = 4 ℓ w cos θ_i sin θ_i N_xy ω_i² + ℓ w cos² θ_i N_xx ω_i²
///     − ℓ w cos² θ_i N_yy ω_i² − ℓ w sin² θ_i N_xx ω_i² + ℓ w sin² θ_i N_yy ω_i²
///     + ℓ cos θ_i γ_x + ℓ sin θ_i γ_y + ℓ² cos θ_i sin θ_i N_xx ω_i²
///     − ℓ² cos θ_i sin θ_i N_yy ω_i² − ℓ² cos² θ_i N_xy ω_i²
///     + ℓ² sin² θ_i N_xy ω_i² + w cos θ_i γ_y − w sin θ_i γ_x
///     − w² cos θ_i sin θ_i N_xx ω_i² + w² cos θ_i sin θ_i N_yy ω_i²
///     + w² cos² θ_i N_xy ω_i² − w² sin² θ_i N_xy ω_i² − Q
/// N'_xx = N_xx + b_x² / J
/// N'_xy = N_xy + b_x b_y / J
/// N'_yy = N_yy + b_y² / J
/// γ'_x = −b_x κ / J + f_x
/// γ'_y = −b_y κ / J + f_y
/// α_i = −(b_x a_x,i + b_y a_y,i + κ) / J
/// a'_x,i = ℓ cos θ_i α_i − ℓ sin θ_i ω_i² − w cos θ_i ω_i² − w sin θ_i α_i + a_x,i
/// a'_y,i = ℓ cos θ_i ω_i² + ℓ sin θ_i α_i + w cos θ_i α_i − w sin θ_i ω_i² + a_y,i
/// ```
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq,
)]
pub struct RoughEquations;

#[allow(clippy::many_single_char_names, clippy::possible_missing_comma)]
impl ::branched_pendulum::tree::LinkEquations for RoughEquations {
    type Constants<T: ::branched_pendulum::Scalar> = [T; 19];
    type Response<T: ::branched_pendulum::Scalar> = [T; 6];
    type Sums<T: ::branched_pendulum::Scalar> = [T; 10];
    type Elimination<T: ::branched_pendulum::Scalar> = [T; 3];
    type Carried<T: ::branched_pendulum::Scalar> = [T; 4];
    const COPIES: &'static [usize] = &[];
    const NAMES: &'static [&'static str] = &[];
    const JOINTS: bool = true;
    const TORQUE: bool = true;
    const FORCED: bool = true;

    /// The response of a link without children: N and γ, and the torque of its joint on
    /// the parent where joints have torques.
    ///
    /// Cost: 24 ×, 13 ±, 1 ÷, 2 √; 8 of the ± take a × along where the scalar fuses.
    #[inline(always)]
    fn leaf<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
    ) -> Self::Response<T> {
        let [
            inertia, _, _, _, gain_along, gain_across, _, _, _, friction, drag, spring,
            rest, coulomb, quadratic_friction, friction_width, quadratic_drag, drag_width,
            _,
        ] = *constants;
        let ::branched_pendulum::tree::LinkMotion {
            sine,
            cosine,
            omega,
            joint_angle,
            joint_rate,
            outside_torque,
        } = link;
        let speed_joint = friction_width
            .mul_add(friction_width, joint_rate * joint_rate)
            .sqrt();
        let joint_torque = friction * joint_rate;
        let joint_torque = quadratic_friction
            .mul_add(speed_joint, coulomb / speed_joint)
            .mul_add(joint_rate, joint_torque);
        let joint_torque = spring.mul_add(joint_angle - rest, joint_torque);
        let omega_squared = omega * omega;
        let speed_ground = drag_width.mul_add(drag_width, omega_squared).sqrt();
        let sum_with_outside_torque = outside_torque
            - (joint_torque
                + (quadratic_drag * speed_ground).mul_add(omega, drag * omega));
        let gain_x = gain_along * cosine - gain_across * sine;
        let gain_y = gain_across.mul_add(cosine, gain_along * sine);
        let first_moment_x = inertia * gain_x;
        let first_moment_y = inertia * gain_y;
        let deficit_xx = first_moment_x * gain_x;
        let deficit_xy = first_moment_x * gain_y;
        let deficit_yy = first_moment_y * gain_y;
        let bias_force_x = sum_with_outside_torque * gain_x
            - omega_squared * first_moment_y;
        let bias_force_y = sum_with_outside_torque
            .mul_add(gain_y, omega_squared * first_moment_x);
        [deficit_xx, deficit_xy, deficit_yy, bias_force_x, bias_force_y, joint_torque]
    }

    /// The response of a child about the pivot of its parent, whose motion is given: as
    /// it is where all children share one pivot.
    ///
    /// Cost: 21 ×, 13 ±; 8 of the ± take a × along where the scalar fuses.
    #[inline(always)]
    fn attach<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        response: Self::Response<T>,
    ) -> Self::Sums<T> {
        let [_, _, _, _, _, _, _, along, across, _, _, _, _, _, _, _, _, _, _] = *constants;
        let ::branched_pendulum::tree::LinkMotion { sine, cosine, omega, .. } = link;
        let [
            deficit_xx_child, deficit_xy_child, deficit_yy_child, bias_force_x_child,
            bias_force_y_child, joint_torque_child,
        ] = response;
        let omega_squared = omega * omega;
        let attachment_x = along * cosine - across * sine;
        let attachment_y = across.mul_add(cosine, along * sine);
        let deficit_trace = deficit_xx_child + deficit_yy_child;
        let minus_centrifugal_moment = deficit_trace * along;
        let minus_lateral_centrifugal_moment = deficit_trace * across;
        let deficit_moment_x = deficit_xy_child
            .mul_add(attachment_y, deficit_xx_child * attachment_x);
        let deficit_moment_y = deficit_yy_child
            .mul_add(attachment_y, deficit_xy_child * attachment_x);
        let sum_with_bias_force_x_child = (-omega_squared)
            .mul_add(
                deficit_moment_y
                    - minus_lateral_centrifugal_moment
                        .mul_add(cosine, minus_centrifugal_moment * sine),
                bias_force_x_child,
            );
        let sum_with_bias_force_y_child = omega_squared
            .mul_add(
                minus_lateral_centrifugal_moment * sine
                    - minus_centrifugal_moment * cosine + deficit_moment_x,
                bias_force_y_child,
            );
        [
            deficit_xx_child,
            deficit_xy_child,
            deficit_yy_child,
            deficit_moment_x,
            deficit_moment_y,
            attachment_y.mul_add(deficit_moment_y, attachment_x * deficit_moment_x),
            sum_with_bias_force_x_child,
            sum_with_bias_force_y_child,
            attachment_y
                .mul_add(
                    sum_with_bias_force_y_child,
                    attachment_x * sum_with_bias_force_x_child,
                ),
            joint_torque_child,
        ]
    }

    /// The response of a link with children, and b/J and κ/J, which `accelerate` takes.
    ///
    /// Cost: 25 ×, 26 ±, 2 ÷, 2 √, 1 negation; 14 of the ± take a × along where the
    /// scalar fuses.
    #[inline(always)]
    fn inner<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        below: Self::Sums<T>,
    ) -> (Self::Response<T>, Self::Elimination<T>) {
        let [
            inertia, moment, lateral_moment, mass, _, _, _, _, _, friction, drag, spring,
            rest, coulomb, quadratic_friction, friction_width, quadratic_drag, drag_width,
            drive_torque,
        ] = *constants;
        let ::branched_pendulum::tree::LinkMotion {
            sine,
            cosine,
            omega,
            joint_angle,
            joint_rate,
            outside_torque,
        } = link;
        let [
            deficit_xx_below, deficit_xy_below, deficit_yy_below, moment_x_below,
            moment_y_below, inertia_below, force_x_below, force_y_below, torque_below,
            joint_torque_below,
        ] = below;
        let speed_joint = friction_width
            .mul_add(friction_width, joint_rate * joint_rate)
            .sqrt();
        let joint_torque = friction * joint_rate;
        let joint_torque = quadratic_friction
            .mul_add(speed_joint, coulomb / speed_joint)
            .mul_add(joint_rate, joint_torque);
        let joint_torque = spring.mul_add(joint_angle - rest, joint_torque);
        let omega_squared = omega * omega;
        let speed_ground = drag_width.mul_add(drag_width, omega_squared).sqrt();
        let sum_with_moment = moment * cosine - lateral_moment * sine;
        let sum_with_moment_2 = lateral_moment.mul_add(cosine, moment * sine);
        let first_moment_x = sum_with_moment - moment_x_below;
        let first_moment_y = sum_with_moment_2 - moment_y_below;
        let joint_inertia = inertia - inertia_below;
        let held_force_x = (-omega_squared).mul_add(sum_with_moment_2, force_x_below);
        let held_force_y = omega_squared.mul_add(sum_with_moment, force_y_below);
        let torque = joint_torque_below + drive_torque + outside_torque
            - (joint_torque
                + (quadratic_drag * speed_ground).mul_add(omega, drag * omega))
            - torque_below;
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
            [
                deficit_xx,
                deficit_xy,
                deficit_yy,
                bias_force_x,
                bias_force_y,
                joint_torque,
            ],
            [gain_x, gain_y, -minus_offset],
        )
    }

    /// The apparent gravity at a child's pivot.
    ///
    /// Cost: 4 ×, 4 ±; 1 of the ± take a × along where the scalar fuses.
    #[inline(always)]
    fn pivot<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        carried: Self::Carried<T>,
    ) -> [T; 2] {
        let [_, _, _, _, _, _, _, along, across, _, _, _, _, _, _, _, _, _, _] = *constants;
        let _ = link;
        let [gravity_x, gravity_y, end_x, end_y] = carried;
        [
            gravity_x - (along * end_x - across * end_y),
            gravity_y - across.mul_add(end_x, along * end_y),
        ]
    }

    /// The angular acceleration (in rad/s²) of a link with children, and what it hands
    /// them.
    ///
    /// Cost: 7 ×, 4 ±; 3 of the ± take a × along where the scalar fuses.
    #[inline(always)]
    fn accelerate<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        elimination: Self::Elimination<T>,
        pivot: [T; 2],
    ) -> (T, Self::Carried<T>) {
        let _ = constants;
        let ::branched_pendulum::tree::LinkMotion { sine, cosine, omega, .. } = link;
        let [gain_x, gain_y, offset] = elimination;
        let [gravity_x, gravity_y] = pivot;
        let omega_squared = omega * omega;
        let tangential = gain_x.mul_add(gravity_x, -offset);
        let tangential = gain_y.mul_add(gravity_y, tangential);
        (
            tangential,
            [
                gravity_x,
                gravity_y,
                tangential * cosine - omega_squared * sine,
                omega_squared.mul_add(cosine, tangential * sine),
            ],
        )
    }

    /// The angular acceleration (in rad/s²) of a link without children.
    ///
    /// Cost: 18 ×, 13 ±, 1 ÷, 2 √; 9 of the ± take a × along where the scalar fuses.
    #[inline(always)]
    fn accelerate_leaf<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        pivot: [T; 2],
    ) -> T {
        let [
            _, _, _, _, gain_along, gain_across, inverse_inertia, _, _, friction, drag,
            spring, rest, coulomb, quadratic_friction, friction_width, quadratic_drag,
            drag_width, _,
        ] = *constants;
        let ::branched_pendulum::tree::LinkMotion {
            sine,
            cosine,
            omega,
            joint_angle,
            joint_rate,
            outside_torque,
        } = link;
        let [gravity_x, gravity_y] = pivot;
        let speed_joint = friction_width
            .mul_add(friction_width, joint_rate * joint_rate)
            .sqrt();
        let joint_torque = friction * joint_rate;
        let joint_torque = quadratic_friction
            .mul_add(speed_joint, coulomb / speed_joint)
            .mul_add(joint_rate, joint_torque);
        let joint_torque = spring.mul_add(joint_angle - rest, joint_torque);
        let omega_squared = omega * omega;
        let speed_ground = drag_width.mul_add(drag_width, omega_squared).sqrt();
        let gain_x = gain_along * cosine - gain_across * sine;
        let gain_y = gain_across.mul_add(cosine, gain_along * sine);
        let minus_offset = (outside_torque
            - (joint_torque
                + (quadratic_drag * speed_ground).mul_add(omega, drag * omega)))
            * inverse_inertia;
        gain_y.mul_add(gravity_y, gain_x.mul_add(gravity_x, minus_offset))
    }
}

#[allow(clippy::possible_missing_comma)]
#[allow(dead_code)]
impl<T: ::branched_pendulum::Scalar> Rough<T> {
    /// Angular accelerations (in rad/s²) at `time` (in s), angles `theta` (in rad) and
    /// angular velocities `omega` (in rad/s), in fused arithmetic where the machine has
    /// it. O(links).
    #[must_use]
    pub fn accelerations(&self, time: T, theta: &[T; 4], omega: &[T; 4]) -> [T; 4] {
        let mut alpha = [T::from_f64(0.0); 4];
        self.tree
            .accelerations_into(
                ::core::option::Option::Some(self.root_drive(time)),
                theta,
                omega,
                &mut alpha,
            );
        alpha
    }

    /// Angular accelerations (in rad/s²) as [`accelerations`](Self::accelerations),
    /// with generalized `torques` Q (in N m) from outside: M(θ) θ̈ + b(θ, ω, t) = Q.
    /// Q_i is a couple on link i; forces have those of `centre_torques` and its like
    /// (`emit(positions)`).
    ///
    /// The power of the torques is Q·ω. In canonical variables they add to the rates of
    /// the momenta.
    #[must_use]
    pub fn accelerations_under(
        &self,
        time: T,
        theta: &[T; 4],
        omega: &[T; 4],
        torques: &[T; 4],
    ) -> [T; 4] {
        let mut alpha = [T::from_f64(0.0); 4];
        let mut workspace = ::branched_pendulum::system::Workspace::new();
        let given: [&[T]; 3] = [theta, omega, torques];
        self.tree
            .accelerations_under_with(
                &mut workspace,
                ::core::option::Option::Some(self.root_drive(time)),
                given,
                &mut alpha,
            );
        alpha
    }

    /// The drive at `time` (in s): acceleration a_x, a_y (in m/s²) of the root's pivot,
    /// torque τ (in N m) on the root.
    ///
    /// ```text
    /// τ = torque
    /// ```
    ///
    /// <details><summary>LaTeX</summary>
    ///
    /// ```latex
    /// \tau = \mathrm{torque}
    /// ```
    /// </details>
    ///
    /// Cost: none.
    #[inline(always)]
    pub fn drive(&self, time: T) -> [T; 3] {
        let _ = time;
        let zero = T::from_f64(0.0);
        [zero, zero, self.torque]
    }

    /// What the drive adds to the apparent gravity at the root's pivot at `time` (in
    /// s), −a_x/l and −a_y/l, and its torque τ/(m l²) on the root.
    ///
    /// ```text
    /// τ = torque
    /// ```
    ///
    /// <details><summary>LaTeX</summary>
    ///
    /// ```latex
    /// \tau = \mathrm{torque}
    /// ```
    /// </details>
    ///
    /// Cost: none.
    #[inline(always)]
    fn root_drive(&self, time: T) -> ::branched_pendulum::tree::RootDrive<T> {
        let [gravity_x, gravity_y, torque] = {
            let _ = time;
            let zero = T::from_f64(0.0);
            [zero, zero, self.torque]
        };
        ::branched_pendulum::tree::RootDrive {
            pivot: [gravity_x, gravity_y],
            torque,
        }
    }
}

impl<T: ::branched_pendulum::Scalar> ::branched_pendulum::Pendulum<T> for Rough<T> {
    const LINKS: usize = 4;
    const LINK_NAMES: &'static [&'static str] = &["trunk", "bough", "twig", "leaf"];

    fn accelerations_into(&self, time: T, theta: &[T], omega: &[T], alpha: &mut [T]) {
        self.tree
            .accelerations_into(
                ::core::option::Option::Some(self.root_drive(time)),
                theta,
                omega,
                alpha,
            );
    }

    fn accelerations_with(
        &self,
        workspace: &mut ::branched_pendulum::system::Workspace<T>,
        time: T,
        theta: &[T],
        omega: &[T],
        alpha: &mut [T],
    ) {
        self.tree
            .accelerations_with(
                workspace,
                ::core::option::Option::Some(self.root_drive(time)),
                theta,
                omega,
                alpha,
            );
    }
}

impl<T: ::branched_pendulum::Scalar> ::branched_pendulum::Cast<T> for Rough<T> {
    type Of<S: ::branched_pendulum::Scalar> = Rough<S>;

    fn cast<S: ::branched_pendulum::Scalar>(
        &self,
        convert: impl ::core::ops::Fn(T) -> S,
    ) -> Rough<S> {
        Rough {
            tree: self.tree.cast(&convert),
            torque: convert(self.torque),
        }
    }

    #[inline(always)]
    fn evaluate(
        &self,
        time: T,
        theta: impl ::core::ops::Fn(usize) -> T,
        omega: impl ::core::ops::Fn(usize) -> T,
        alpha: impl ::core::ops::FnMut(usize, T),
    ) {
        self.tree
            .evaluate(
                ::core::option::Option::Some(self.root_drive(time)),
                theta,
                omega,
                alpha,
            );
    }

    fn room(&self) -> usize {
        self.tree.room()
    }

    #[inline(always)]
    fn in_registers<R: ::branched_pendulum::emitted::Simd<T>>(
        &self,
        time: T,
        room: &mut [T],
    ) -> impl ::branched_pendulum::system::InRegisters<R> {
        self.tree.in_registers(::core::option::Option::Some(self.root_drive(time)), room)
    }
}

impl<T: ::branched_pendulum::Scalar> ::branched_pendulum::Forced<T> for Rough<T> {
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
        time: T,
        theta: &[T],
        omega: &[T],
        torques: &[T],
        alpha: &mut [T],
    ) {
        let given = [theta, omega, torques];
        self.tree
            .accelerations_under_with(
                workspace,
                ::core::option::Option::Some(self.root_drive(time)),
                given,
                alpha,
            );
    }

    #[inline(always)]
    fn accelerations_under_of<S: ::branched_pendulum::Scalar>(
        pendulum: &Rough<S>,
        time: S,
        theta: &[S],
        omega: &[S],
        torques: &[S],
        alpha: &mut [S],
    ) {
        pendulum
            .tree
            .evaluate_under(
                ::core::option::Option::Some(pendulum.root_drive(time)),
                [theta, omega, torques],
                alpha,
            );
    }
}

#[allow(dead_code, clippy::possible_missing_comma)]
impl<T: ::branched_pendulum::Scalar> Rough<T> {
    /// The model for the given parameters, taken as they are: for
    /// scalars without an order by which masses could be checked,
    /// as lanes and dual numbers. Others have `new`.
    #[must_use]
    pub fn from_parameters_unchecked(parameters: RoughParameters<T>) -> Self {
        /// The parent of each link, which stands before it; the root has none.
        static PARENTS: [u32; 4] = [0, 0, 1, 0];

        /// Constants of the equations, a row for each link, the root's first; of every
        /// number the nearest `f64` and what remains. Columns:
        ///
        /// 1. `inertia`: M/(L² m), moment of inertia about the pivot
        /// 2. `moment`: h/(L m), first moment of mass about the pivot
        /// 3. `lateral_moment`: first moment across the link over L m
        /// 4. `mass`: mass over m that is not in the constants of the parent
        /// 5. `gain_along`: h L/M of a leaf
        /// 6. `gain_across`: first moment of a leaf across the link, times L/M
        /// 7. `inverse_inertia`: L² m/M of a leaf
        /// 8. `along`: place of the attachment along the link, over L
        /// 9. `across`: place of the attachment across the link, over L
        /// 10. `friction`: friction in the pivot over m l²
        /// 11. `drag`: drag against the ground over m l²
        /// 12. `spring`: stiffness of the torsion spring over m l²
        /// 13. `rest`: angle at which the torsion spring is at rest
        /// 14. `coulomb`: Coulomb friction in the pivot over m l²
        /// 15. `quadratic_friction`: quadratic friction in the pivot over m l²
        /// 16. `friction_width`: width of friction in the pivot, rad/s
        /// 17. `quadratic_drag`: quadratic drag over m l²
        /// 18. `drag_width`: width of drag, rad/s
        /// 19. `drive_torque`: torque on the root over m l², stated by each evaluation
        static STRIPS: [[[f64; 2]; 19]; 4] = [
            [
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
            ],
            [
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
            ],
            [
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
            ],
            [
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
                [0.0, 0.0],
            ],
        ];
        let m_d_squared = parameters.m * parameters.d * parameters.d;
        let m_e_squared = parameters.m * parameters.e * parameters.e;
        let m_d_squared_plus_m_e_squared = m_d_squared + m_e_squared;
        let m_d_squared_plus_m_e_squared_plus_i = m_d_squared_plus_m_e_squared
            + parameters.i;
        let m_d = parameters.m * parameters.d;
        let m_e = parameters.m * parameters.e;
        let w_squared_m = parameters.w * parameters.w * parameters.m;
        let l_squared_m = parameters.l * parameters.l * parameters.m;
        let w_squared_m_plus_l_squared_m = w_squared_m + l_squared_m;
        let m_d_squared_plus_m_e_squared_plus_i_plus_w_squared_m_plus_l_squared_m = m_d_squared_plus_m_e_squared_plus_i
            + w_squared_m_plus_l_squared_m;
        let w_m = parameters.w * parameters.m;
        let m_d_plus_w_m = m_d + w_m;
        let l_m = parameters.l * parameters.m;
        let m_e_plus_l_m = m_e + l_m;
        let twice_m = T::from_f64(2.0) * parameters.m;
        let l_squared_m_plus_w_squared_m = l_squared_m + w_squared_m;
        let m_d_squared_plus_m_e_squared_plus_i_plus_l_squared_m_plus_w_squared_m = m_d_squared_plus_m_e_squared_plus_i
            + l_squared_m_plus_w_squared_m;
        let m_d_plus_l_m = m_d + l_m;
        let m_e_plus_w_m = m_e + w_m;
        let reduced_moment_trunk = m_d_plus_w_m;
        let reduced_lateral_moment_trunk = m_e_plus_l_m;
        let reduced_inertia_trunk = m_d_squared_plus_m_e_squared_plus_i_plus_w_squared_m_plus_l_squared_m;
        let reduced_moment_bough = m_d_plus_l_m;
        let reduced_lateral_moment_bough = m_e_plus_w_m;
        let reduced_inertia_bough = m_d_squared_plus_m_e_squared_plus_i_plus_l_squared_m_plus_w_squared_m;
        let reduced_moment_twig = m_d;
        let reduced_lateral_moment_twig = m_e;
        let reduced_inertia_twig = m_d_squared_plus_m_e_squared_plus_i;
        let reduced_gravity = parameters.g;
        let reduced_moment_twig_over_reduced_inertia_twig = reduced_moment_twig
            / reduced_inertia_twig;
        let reduced_lateral_moment_twig_over_reduced_inertia_twig = reduced_lateral_moment_twig
            / reduced_inertia_twig;
        let inverse_reduced_inertia_twig = T::from_f64(1.0) / reduced_inertia_twig;
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
                    strips[2] = reduced_lateral_moment_trunk;
                    strips[3] = twice_m;
                    strips[9] = parameters.c;
                    strips[10] = parameters.k;
                    strips[11] = parameters.s;
                    strips[12] = parameters.r;
                    strips[13] = parameters.f;
                    strips[14] = parameters.q;
                    strips[15] = parameters.u;
                    strips[16] = parameters.p;
                    strips[17] = parameters.v;
                    strips[19] = reduced_inertia_bough;
                    strips[20] = reduced_moment_bough;
                    strips[21] = reduced_lateral_moment_bough;
                    strips[22] = twice_m;
                    strips[26] = parameters.l;
                    strips[27] = parameters.w;
                    strips[28] = parameters.c;
                    strips[29] = parameters.k;
                    strips[30] = parameters.s;
                    strips[31] = parameters.r;
                    strips[32] = parameters.f;
                    strips[33] = parameters.q;
                    strips[34] = parameters.u;
                    strips[35] = parameters.p;
                    strips[36] = parameters.v;
                    strips[38] = reduced_inertia_twig;
                    strips[39] = reduced_moment_twig;
                    strips[40] = reduced_lateral_moment_twig;
                    strips[42] = reduced_moment_twig_over_reduced_inertia_twig;
                    strips[43] = reduced_lateral_moment_twig_over_reduced_inertia_twig;
                    strips[44] = inverse_reduced_inertia_twig;
                    strips[45] = parameters.l;
                    strips[46] = parameters.w;
                    strips[47] = parameters.c;
                    strips[48] = parameters.k;
                    strips[49] = parameters.s;
                    strips[50] = parameters.r;
                    strips[51] = parameters.f;
                    strips[52] = parameters.q;
                    strips[53] = parameters.u;
                    strips[54] = parameters.p;
                    strips[55] = parameters.v;
                    strips[57] = reduced_inertia_twig;
                    strips[58] = reduced_moment_twig;
                    strips[59] = reduced_lateral_moment_twig;
                    strips[61] = reduced_moment_twig_over_reduced_inertia_twig;
                    strips[62] = reduced_lateral_moment_twig_over_reduced_inertia_twig;
                    strips[63] = inverse_reduced_inertia_twig;
                    strips[64] = parameters.w;
                    strips[65] = parameters.l;
                    strips[66] = parameters.c;
                    strips[67] = parameters.k;
                    strips[68] = parameters.s;
                    strips[69] = parameters.r;
                    strips[70] = parameters.f;
                    strips[71] = parameters.q;
                    strips[72] = parameters.u;
                    strips[73] = parameters.p;
                    strips[74] = parameters.v;
                    strips
                },
                [T::from_f64(0.0), minus_reduced_gravity],
            ),
            torque: parameters.torque,
        }
    }
}
