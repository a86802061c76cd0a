// Expanded from general.rs by `cargo branched-pendulum` 0.1.0. Do not edit.
//! The equations of a link that may have all that links can have.

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
pub(crate) struct GeneralEquations;

#[allow(clippy::many_single_char_names, clippy::possible_missing_comma)]
impl ::branched_pendulum::tree::LinkEquations for GeneralEquations {
    type Constants<T: ::branched_pendulum::Scalar> = [T; 14];
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
    /// Cost: 17 ×, 8 ±; 4 of the ± can be fused with a × if the scalar supports it.
    #[inline(always)]
    fn leaf<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
    ) -> Self::Response<T> {
        let [
            inertia, _, _, _, gain_along, gain_across, _, _, _, friction, drag, spring,
            rest, _,
        ] = *constants;
        let ::branched_pendulum::tree::LinkMotion {
            sine,
            cosine,
            omega,
            joint_angle,
            joint_rate,
            outside_torque,
            ..
        } = link;
        let joint_torque = spring.mul_add(joint_angle - rest, friction * joint_rate);
        let sum_with_outside_torque = outside_torque - drag.mul_add(omega, joint_torque);
        let gain_x = gain_along * cosine - gain_across * sine;
        let gain_y = gain_across.mul_add(cosine, gain_along * sine);
        let first_moment_x = inertia * gain_x;
        let first_moment_y = inertia * gain_y;
        let omega_squared = omega * omega;
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
    /// Cost: 21 ×, 13 ±; 8 of the ± can be fused with a × if the scalar supports it.
    #[inline(always)]
    fn attach<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        response: Self::Response<T>,
    ) -> Self::Sums<T> {
        let [_, _, _, _, _, _, _, along, across, _, _, _, _, _] = *constants;
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
    /// Cost: 18 ×, 21 ±, 1 ÷, 1 negation; 10 of the ± can be fused with a × if the
    /// scalar supports it.
    #[inline(always)]
    fn inner<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        below: Self::Sums<T>,
    ) -> (Self::Response<T>, Self::Elimination<T>) {
        let [
            inertia, moment, lateral_moment, mass, _, _, _, _, _, friction, drag, spring,
            rest, drive_torque,
        ] = *constants;
        let ::branched_pendulum::tree::LinkMotion {
            sine,
            cosine,
            omega,
            joint_angle,
            joint_rate,
            outside_torque,
            ..
        } = link;
        let [
            deficit_xx_below, deficit_xy_below, deficit_yy_below, moment_x_below,
            moment_y_below, inertia_below, force_x_below, force_y_below, torque_below,
            joint_torque_below,
        ] = below;
        let joint_torque = spring.mul_add(joint_angle - rest, friction * joint_rate);
        let omega_squared = omega * omega;
        let sum_with_moment = moment * cosine - lateral_moment * sine;
        let sum_with_moment_2 = lateral_moment.mul_add(cosine, moment * sine);
        let first_moment_x = sum_with_moment - moment_x_below;
        let first_moment_y = sum_with_moment_2 - moment_y_below;
        let joint_inertia = inertia - inertia_below;
        let held_force_x = (-omega_squared).mul_add(sum_with_moment_2, force_x_below);
        let held_force_y = omega_squared.mul_add(sum_with_moment, force_y_below);
        let minus_bias_torque = joint_torque_below + drive_torque + outside_torque
            - drag.mul_add(omega, joint_torque) - torque_below;
        let inverse_joint_inertia = T::from_f64(1.0) / joint_inertia;
        let gain_x = inverse_joint_inertia * first_moment_x;
        let gain_y = inverse_joint_inertia * first_moment_y;
        let minus_offset = minus_bias_torque * inverse_joint_inertia;
        let deficit_yy = first_moment_y.mul_add(gain_y, deficit_yy_below - mass);
        let deficit_xx = first_moment_x.mul_add(gain_x, deficit_xx_below - mass);
        let deficit_xy = first_moment_x.mul_add(gain_y, deficit_xy_below);
        let bias_force_x = minus_bias_torque.mul_add(gain_x, held_force_x);
        let bias_force_y = minus_bias_torque.mul_add(gain_y, held_force_y);
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
    /// Cost: 4 ×, 4 ±; 1 of the ± can be fused with a × if the scalar supports it.
    #[inline(always)]
    fn pivot<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        carried: Self::Carried<T>,
    ) -> [T; 2] {
        let [_, _, _, _, _, _, _, along, across, _, _, _, _, _] = *constants;
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
    /// Cost: 7 ×, 4 ±; 3 of the ± can be fused with a × if the scalar supports it.
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
    /// Cost: 10 ×, 8 ±; 5 of the ± can be fused with a × if the scalar supports it.
    #[inline(always)]
    fn accelerate_leaf<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        pivot: [T; 2],
    ) -> T {
        let [
            _, _, _, _, gain_along, gain_across, inverse_inertia, _, _, friction, drag,
            spring, rest, _,
        ] = *constants;
        let ::branched_pendulum::tree::LinkMotion {
            sine,
            cosine,
            omega,
            joint_angle,
            joint_rate,
            outside_torque,
            ..
        } = link;
        let [gravity_x, gravity_y] = pivot;
        let joint_torque = spring.mul_add(joint_angle - rest, friction * joint_rate);
        let gain_x = gain_along * cosine - gain_across * sine;
        let gain_y = gain_across.mul_add(cosine, gain_along * sine);
        let minus_offset = (outside_torque - drag.mul_add(omega, joint_torque))
            * inverse_inertia;
        gain_y.mul_add(gravity_y, gain_x.mul_add(gravity_x, minus_offset))
    }
}

#[allow(clippy::many_single_char_names, clippy::possible_missing_comma)]
impl ::branched_pendulum::tree::PointEquations for GeneralEquations {
    /// Place of a point of the link, from the link's pivot, given how far along and
    /// across the link it is.
    ///
    /// ```text
    /// x = p sin θ_i + p_⊥ cos θ_i
    /// y = −p cos θ_i + p_⊥ sin θ_i
    /// ```
    ///
    /// <details><summary>LaTeX</summary>
    ///
    /// ```latex
    /// x = p\,\sin\theta_{\mathrm{i}} + p_{\perp}\,\cos\theta_{\mathrm{i}}
    /// y = -p\,\cos\theta_{\mathrm{i}} + p_{\perp}\,\sin\theta_{\mathrm{i}}
    /// ```
    /// </details>
    ///
    /// Cost: 4 ×, 2 ±.
    #[inline(always)]
    fn point<T: ::branched_pendulum::Scalar>(
        link: ::branched_pendulum::tree::LinkMotion<T>,
        given: [T; 2],
    ) -> [T; 2] {
        let ::branched_pendulum::tree::LinkMotion { sine, cosine, .. } = link;
        let [place_along, place_across] = given;
        [
            place_along * sine + place_across * cosine,
            place_across * sine - place_along * cosine,
        ]
    }

    /// Velocity of that point against the link's pivot.
    ///
    /// ```text
    /// ẋ = ω_i (p cos θ_i − p_⊥ sin θ_i)
    /// ẏ = ω_i (p sin θ_i + p_⊥ cos θ_i)
    /// ```
    ///
    /// <details><summary>LaTeX</summary>
    ///
    /// ```latex
    /// \dot x = \omega_{\mathrm{i}}\,\left(p\,\cos\theta_{\mathrm{i}} - p_{\perp}\,\sin\theta_{\mathrm{i}}\right)
    /// \dot y = \omega_{\mathrm{i}}\,\left(p\,\sin\theta_{\mathrm{i}} + p_{\perp}\,\cos\theta_{\mathrm{i}}\right)
    /// ```
    /// </details>
    ///
    /// Cost: 6 ×, 2 ±.
    #[inline(always)]
    fn point_velocity<T: ::branched_pendulum::Scalar>(
        link: ::branched_pendulum::tree::LinkMotion<T>,
        given: [T; 2],
    ) -> [T; 2] {
        let ::branched_pendulum::tree::LinkMotion { sine, cosine, omega, .. } = link;
        let [place_along, place_across] = given;
        [
            omega * (place_along * cosine - place_across * sine),
            omega * (place_along * sine + place_across * cosine),
        ]
    }

    /// Torque about the link's pivot of a force in that point.
    ///
    /// ```text
    /// Q = F_x (p cos θ_i − p_⊥ sin θ_i) + F_y (p sin θ_i + p_⊥ cos θ_i)
    /// ```
    ///
    /// <details><summary>LaTeX</summary>
    ///
    /// ```latex
    /// Q = F_x\,\left(p\,\cos\theta_{\mathrm{i}} - p_{\perp}\,\sin\theta_{\mathrm{i}}\right) + F_y\,\left(p\,\sin\theta_{\mathrm{i}} + p_{\perp}\,\cos\theta_{\mathrm{i}}\right)
    /// ```
    /// </details>
    ///
    /// Cost: 6 ×, 3 ±.
    #[inline(always)]
    fn point_torque<T: ::branched_pendulum::Scalar>(
        link: ::branched_pendulum::tree::LinkMotion<T>,
        given: [T; 4],
    ) -> [T; 1] {
        let ::branched_pendulum::tree::LinkMotion { sine, cosine, .. } = link;
        let [place_along, place_across, force_x, force_y] = given;
        [
            force_x * (place_along * cosine - place_across * sine)
                + force_y * (place_along * sine + place_across * cosine),
        ]
    }
}

/// The constants of a link that the equations read.
#[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
pub(crate) struct GeneralRow<T> {
    /// M/(L² m), moment of inertia about the pivot.
    pub(crate) inertia: T,
    /// H/(L m), first moment of mass about the pivot.
    pub(crate) moment: T,
    /// First moment across the link over L m.
    pub(crate) lateral_moment: T,
    /// Mass over m that is not in the constants of the parent.
    pub(crate) mass: T,
    /// H L/M of a leaf.
    pub(crate) gain_along: T,
    /// First moment of a leaf across the link, times L/M.
    pub(crate) gain_across: T,
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
    /// Torque on the root over m l², stated by each evaluation.
    pub(crate) drive_torque: T,
}

impl<T> GeneralRow<T> {
    /// Returns the constants in the order of the columns.
    pub(crate) fn into_array(self) -> [T; 14] {
        let Self {
            inertia,
            moment,
            lateral_moment,
            mass,
            gain_along,
            gain_across,
            inverse_inertia,
            along,
            across,
            friction,
            drag,
            spring,
            rest,
            drive_torque,
        } = self;
        [
            inertia,
            moment,
            lateral_moment,
            mass,
            gain_along,
            gain_across,
            inverse_inertia,
            along,
            across,
            friction,
            drag,
            spring,
            rest,
            drive_torque,
        ]
    }
}
