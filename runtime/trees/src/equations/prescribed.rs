// Expanded from prescribed.rs by `cargo branched-pendulum` 0.1.0. Do not edit.
//! The equations of a link that may have all that links can have and whose motion may be given
//! from outside.

/// The equations of one link, by articulated-body recursion in the plane
/// (Featherstone, Rigid Body Dynamics Algorithms, 2008, ch. 7).
///
/// Subtrees that hang at (ℓ, w) respond to the acceleration **a** of their pivot
/// with the force σ **a** + γ − N **a**. Their articulated inertia is σ − N; σ is
/// the mass of those subtrees that are single links. J is the moment of inertia
/// about the joint, b the first moment, κ the bias torque, f the force if the joint
/// does not move. A prime marks N and γ of the subtree that begins with the link,
/// and the acceleration of its children's pivot. The code uses −**a**, the apparent
/// gravity. Masses and lengths are divided by the mass m and length l of the most
/// frequent kind of leaf, and accelerations of a link are multiplied by its own
/// unit of length.
///
/// For a prescribed (held) link, the angular acceleration replaces the external
/// torque among the arguments, and nothing is eliminated (ch. 9); in the place of
/// its acceleration, the torque that it needs is returned, in N m.
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
pub(crate) struct PrescribedEquations;

#[allow(clippy::many_single_char_names, clippy::possible_missing_comma)]
impl ::branched_pendulum::tree::LinkEquations for PrescribedEquations {
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
    const PRESCRIBED: bool = true;

    /// The response of a link without children: N and γ, and the torque of its joint on
    /// the parent where joints have torques.
    ///
    /// Cost: 31 ×, 18 ±, 1 ÷, 2 √; 11 of the ± can be fused with a × if the scalar
    /// supports it.
    #[inline(always)]
    fn leaf<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
    ) -> Self::Response<T> {
        let [
            _, moment, lateral_moment, _, inverse_inertia, _, _, friction, drag, spring,
            rest, coulomb, quadratic_friction, static_excess, stribeck_rate,
            friction_width, quadratic_drag, drag_width, _,
        ] = *constants;
        let ::branched_pendulum::tree::LinkMotion {
            sine,
            cosine,
            omega,
            joint_angle,
            joint_rate,
            outside_torque,
            prescribed,
        } = link;
        let joint_rate_squared = joint_rate * joint_rate;
        let speed_joint = friction_width
            .mul_add(friction_width, joint_rate_squared)
            .sqrt();
        let stribeck_rate_squared = stribeck_rate * stribeck_rate;
        let stribeck_speed_squared_joint = stribeck_rate_squared + joint_rate_squared;
        let joint_torque = friction * joint_rate;
        let joint_torque = quadratic_friction
            .mul_add(
                speed_joint,
                static_excess
                    .mul_add(
                        stribeck_rate_squared,
                        coulomb * stribeck_speed_squared_joint,
                    ) / (stribeck_speed_squared_joint * speed_joint),
            )
            .mul_add(joint_rate, joint_torque);
        let joint_torque = spring.mul_add(joint_angle - rest, joint_torque);
        let omega_squared = omega * omega;
        let speed_ground = drag_width.mul_add(drag_width, omega_squared).sqrt();
        let minus_bias_torque = (-prescribed).mul_add(outside_torque, outside_torque)
            - (joint_torque
                + (quadratic_drag * speed_ground).mul_add(omega, drag * omega));
        let first_moment_x = moment * cosine - lateral_moment * sine;
        let first_moment_y = lateral_moment.mul_add(cosine, moment * sine);
        let yielding = (T::from_f64(1.0) - prescribed) * inverse_inertia;
        let yielding_times_first_moment_y = yielding * first_moment_y;
        let deficit_xx = first_moment_x * (yielding * first_moment_x);
        let deficit_xy = first_moment_x * yielding_times_first_moment_y;
        let deficit_yy = first_moment_y * yielding_times_first_moment_y;
        let sum_with_yielding = prescribed
            .mul_add(outside_torque, yielding * minus_bias_torque);
        let bias_force_x = sum_with_yielding * first_moment_x
            - omega_squared * first_moment_y;
        let bias_force_y = sum_with_yielding
            .mul_add(first_moment_y, omega_squared * first_moment_x);
        [deficit_xx, deficit_xy, deficit_yy, bias_force_x, bias_force_y, joint_torque]
    }

    /// The response of a child about the pivot of its parent, whose motion is given: as
    /// it is where all children share one pivot.
    ///
    /// Cost: 21 ×, 13 ±; 8 of the ± can be fused with a × if the scalar supports it.
    #[inline(always)]
    fn attach<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        response: Self::Response<T>,
    ) -> Self::Sums<T> {
        let [_, _, _, _, _, along, across, _, _, _, _, _, _, _, _, _, _, _, _] = *constants;
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
    /// Cost: 35 ×, 33 ±, 2 ÷, 2 √; 15 of the ± can be fused with a × if the scalar
    /// supports it.
    #[inline(always)]
    fn inner<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        below: Self::Sums<T>,
    ) -> (Self::Response<T>, Self::Elimination<T>) {
        let [
            inertia, moment, lateral_moment, mass, _, _, _, friction, drag, spring, rest,
            coulomb, quadratic_friction, static_excess, stribeck_rate, friction_width,
            quadratic_drag, drag_width, drive_torque,
        ] = *constants;
        let ::branched_pendulum::tree::LinkMotion {
            sine,
            cosine,
            omega,
            joint_angle,
            joint_rate,
            outside_torque,
            prescribed,
        } = link;
        let [
            deficit_xx_below, deficit_xy_below, deficit_yy_below, moment_x_below,
            moment_y_below, inertia_below, force_x_below, force_y_below, torque_below,
            joint_torque_below,
        ] = below;
        let one = T::from_f64(1.0);
        let joint_rate_squared = joint_rate * joint_rate;
        let speed_joint = friction_width
            .mul_add(friction_width, joint_rate_squared)
            .sqrt();
        let stribeck_rate_squared = stribeck_rate * stribeck_rate;
        let stribeck_speed_squared_joint = stribeck_rate_squared + joint_rate_squared;
        let joint_torque = friction * joint_rate;
        let joint_torque = quadratic_friction
            .mul_add(
                speed_joint,
                static_excess
                    .mul_add(
                        stribeck_rate_squared,
                        coulomb * stribeck_speed_squared_joint,
                    ) / (stribeck_speed_squared_joint * speed_joint),
            )
            .mul_add(joint_rate, joint_torque);
        let joint_torque = spring.mul_add(joint_angle - rest, joint_torque);
        let omega_squared = omega * omega;
        let speed_ground = drag_width.mul_add(drag_width, omega_squared).sqrt();
        let prescribed_times_outside_torque = prescribed * outside_torque;
        let first_moment_x = moment * cosine - lateral_moment * sine;
        let first_moment_y = lateral_moment.mul_add(cosine, moment * sine);
        let first_moment_x_2 = first_moment_x - moment_x_below;
        let first_moment_y_2 = first_moment_y - moment_y_below;
        let inertia_minus_inertia_below = inertia - inertia_below;
        let minus_bias_torque = joint_torque_below + drive_torque
            + (outside_torque - prescribed_times_outside_torque)
            - (joint_torque
                + (quadratic_drag * speed_ground).mul_add(omega, drag * omega))
            - torque_below;
        let yielding = (one - prescribed) * (one / inertia_minus_inertia_below);
        let yielding_plus_prescribed = yielding + prescribed;
        let gain_x = yielding_plus_prescribed * first_moment_x_2;
        let gain_y = yielding_plus_prescribed * first_moment_y_2;
        let offset = inertia_minus_inertia_below * prescribed_times_outside_torque
            - yielding_plus_prescribed * minus_bias_torque;
        let yielding_times_first_moment_y_2 = yielding * first_moment_y_2;
        let sum_with_yielding = yielding * minus_bias_torque
            + prescribed_times_outside_torque;
        let deficit_yy = first_moment_y_2
            .mul_add(yielding_times_first_moment_y_2, deficit_yy_below - mass);
        let deficit_xx = first_moment_x_2
            .mul_add(yielding * first_moment_x_2, deficit_xx_below - mass);
        let deficit_xy = first_moment_x_2
            .mul_add(yielding_times_first_moment_y_2, deficit_xy_below);
        let bias_force_x = (-omega_squared).mul_add(first_moment_y, force_x_below);
        let bias_force_x = sum_with_yielding.mul_add(first_moment_x_2, bias_force_x);
        let bias_force_y = omega_squared.mul_add(first_moment_x, force_y_below);
        let bias_force_y = sum_with_yielding.mul_add(first_moment_y_2, bias_force_y);
        (
            [
                deficit_xx,
                deficit_xy,
                deficit_yy,
                bias_force_x,
                bias_force_y,
                joint_torque,
            ],
            [gain_x, gain_y, offset],
        )
    }

    /// The apparent gravity at a child's pivot.
    ///
    /// Cost: 4 ×, 4 ±; 1 of the ± can be fused with a × if the scalar supports it.
    #[inline(always)]
    fn pivot<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        carried: Self::Carried<T>,
    ) -> [T; 2] {
        let [_, _, _, _, _, along, across, _, _, _, _, _, _, _, _, _, _, _, _] = *constants;
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
    /// Cost: 10 ×, 7 ±; 4 of the ± can be fused with a × if the scalar supports it.
    #[inline(always)]
    fn accelerate<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        elimination: Self::Elimination<T>,
        pivot: [T; 2],
    ) -> (T, Self::Carried<T>) {
        let _ = constants;
        let ::branched_pendulum::tree::LinkMotion {
            sine,
            cosine,
            omega,
            outside_torque,
            prescribed,
            ..
        } = link;
        let [gain_x, gain_y, offset] = elimination;
        let [gravity_x, gravity_y] = pivot;
        let omega_squared = omega * omega;
        let tangential = gain_x.mul_add(gravity_x, -offset);
        let tangential = gain_y.mul_add(gravity_y, tangential);
        let one_minus_prescribed_times_tangential = (T::from_f64(1.0) - prescribed)
            * tangential;
        let sum_with_one_minus_prescribed_times_tangential = prescribed
            .mul_add(outside_torque, one_minus_prescribed_times_tangential);
        (
            one_minus_prescribed_times_tangential - prescribed * tangential,
            [
                gravity_x,
                gravity_y,
                sum_with_one_minus_prescribed_times_tangential * cosine
                    - omega_squared * sine,
                omega_squared
                    .mul_add(
                        cosine,
                        sum_with_one_minus_prescribed_times_tangential * sine,
                    ),
            ],
        )
    }

    /// The angular acceleration (in rad/s²) of a link without children.
    ///
    /// Cost: 29 ×, 20 ±, 1 ÷, 2 √; 11 of the ± can be fused with a × if the scalar
    /// supports it.
    #[inline(always)]
    fn accelerate_leaf<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        pivot: [T; 2],
    ) -> T {
        let [
            inertia, moment, lateral_moment, _, inverse_inertia, _, _, friction, drag,
            spring, rest, coulomb, quadratic_friction, static_excess, stribeck_rate,
            friction_width, quadratic_drag, drag_width, _,
        ] = *constants;
        let ::branched_pendulum::tree::LinkMotion {
            sine,
            cosine,
            omega,
            joint_angle,
            joint_rate,
            outside_torque,
            prescribed,
        } = link;
        let [gravity_x, gravity_y] = pivot;
        let joint_rate_squared = joint_rate * joint_rate;
        let speed_joint = friction_width
            .mul_add(friction_width, joint_rate_squared)
            .sqrt();
        let stribeck_rate_squared = stribeck_rate * stribeck_rate;
        let stribeck_speed_squared_joint = stribeck_rate_squared + joint_rate_squared;
        let joint_torque = friction * joint_rate;
        let joint_torque = quadratic_friction
            .mul_add(
                speed_joint,
                static_excess
                    .mul_add(
                        stribeck_rate_squared,
                        coulomb * stribeck_speed_squared_joint,
                    ) / (stribeck_speed_squared_joint * speed_joint),
            )
            .mul_add(joint_rate, joint_torque);
        let joint_torque = spring.mul_add(joint_angle - rest, joint_torque);
        let omega_squared = omega * omega;
        let speed_ground = drag_width.mul_add(drag_width, omega_squared).sqrt();
        let prescribed_times_outside_torque = prescribed * outside_torque;
        let minus_bias_torque = outside_torque - prescribed_times_outside_torque
            - (joint_torque
                + (quadratic_drag * speed_ground).mul_add(omega, drag * omega));
        let one_minus_prescribed = T::from_f64(1.0) - prescribed;
        let first_moment_x = moment * cosine - lateral_moment * sine;
        let first_moment_y = lateral_moment.mul_add(cosine, moment * sine);
        let sum_with_one_minus_prescribed = one_minus_prescribed
            .mul_add(inverse_inertia, prescribed);
        let gain_x = sum_with_one_minus_prescribed * first_moment_x;
        let gain_y = sum_with_one_minus_prescribed * first_moment_y;
        let tangential = sum_with_one_minus_prescribed * minus_bias_torque
            - inertia * prescribed_times_outside_torque;
        let tangential = gain_x.mul_add(gravity_x, tangential);
        let tangential = gain_y.mul_add(gravity_y, tangential);
        one_minus_prescribed * tangential - prescribed * tangential
    }
}

/// The constants of a link that the equations read.
#[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
pub(crate) struct PrescribedRow<T> {
    /// M/(L² m), moment of inertia about the pivot.
    pub(crate) inertia: T,
    /// H/(L m), first moment of mass about the pivot.
    pub(crate) moment: T,
    /// First moment across the link over L m.
    pub(crate) lateral_moment: T,
    /// Mass over m that is not in the constants of the parent.
    pub(crate) mass: T,
    /// L² m/M of a leaf.
    pub(crate) inverse_inertia: T,
    /// Place of the attachment along the link, over L.
    pub(crate) along: T,
    /// Place of the attachment across the link, over L.
    pub(crate) across: T,
    /// Friction in the pivot over m l².
    pub(crate) friction: T,
    /// Drag against the ground over m l².
    pub(crate) drag: T,
    /// Stiffness of the torsion spring over m l².
    pub(crate) spring: T,
    /// Angle at which the torsion spring is at rest.
    pub(crate) rest: T,
    /// Coulomb friction in the pivot over m l².
    pub(crate) coulomb: T,
    /// Quadratic friction in the pivot over m l².
    pub(crate) quadratic_friction: T,
    /// Excess of static over Coulomb friction over m l².
    pub(crate) static_excess: T,
    /// Stribeck rate of friction in the pivot, rad/s.
    pub(crate) stribeck_rate: T,
    /// Width of friction in the pivot, rad/s.
    pub(crate) friction_width: T,
    /// Quadratic drag over m l².
    pub(crate) quadratic_drag: T,
    /// Width of drag, rad/s.
    pub(crate) drag_width: T,
    /// Torque on the root over m l², stated by each evaluation.
    pub(crate) drive_torque: T,
}

impl<T> PrescribedRow<T> {
    /// Returns the constants in the order of the columns.
    pub(crate) fn into_array(self) -> [T; 19] {
        let Self {
            inertia,
            moment,
            lateral_moment,
            mass,
            inverse_inertia,
            along,
            across,
            friction,
            drag,
            spring,
            rest,
            coulomb,
            quadratic_friction,
            static_excess,
            stribeck_rate,
            friction_width,
            quadratic_drag,
            drag_width,
            drive_torque,
        } = self;
        [
            inertia,
            moment,
            lateral_moment,
            mass,
            inverse_inertia,
            along,
            across,
            friction,
            drag,
            spring,
            rest,
            coulomb,
            quadratic_friction,
            static_excess,
            stribeck_rate,
            friction_width,
            quadratic_drag,
            drag_width,
            drive_torque,
        ]
    }
}
