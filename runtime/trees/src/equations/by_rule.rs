// Expanded from by_rule.rs by `cargo branched-pendulum` 0.1.0. Do not edit.
//! The equations of a link in a tree by rule, for energies and transfers by scale.

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
pub(crate) struct ByRuleEquations;

#[allow(clippy::many_single_char_names, clippy::possible_missing_comma)]
impl ::branched_pendulum::tree::LinkEquations for ByRuleEquations {
    type Constants<T: ::branched_pendulum::Scalar> = [T; 37];
    type Response<T: ::branched_pendulum::Scalar> = [T; 6];
    type Sums<T: ::branched_pendulum::Scalar> = [T; 6];
    type Elimination<T: ::branched_pendulum::Scalar> = [T; 3];
    type Carried<T: ::branched_pendulum::Scalar> = [T; 2];
    const COPIES: &'static [usize] = &[1, 2, 2];
    const NAMES: &'static [&'static str] = &["tree_1", "tree_2", "tree_3"];
    const JOINTS: bool = true;
    const TORQUE: bool = true;

    /// The response of a link without children: N and γ, and the torque of its joint on
    /// the parent where joints have torques.
    ///
    /// Cost: 28 ×, 14 ±, 1 ÷, 2 √, 1 negation; 9 of the ± can be fused with a × if the
    /// scalar supports it.
    #[inline(always)]
    fn leaf<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
    ) -> Self::Response<T> {
        let [
            inertia, _, _, _, gain_along, gain_across, _, _, _, friction, drag, spring,
            rest, coulomb, quadratic_friction, static_excess, stribeck_rate,
            friction_width, quadratic_drag, drag_width, _, _, _, _, _, _, _, _, _, _, _,
            _, _, _, _, _, _,
        ] = *constants;
        let ::branched_pendulum::tree::LinkMotion {
            sine,
            cosine,
            omega,
            joint_angle,
            joint_rate,
            ..
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
        let sum_with_joint_torque = joint_torque
            + (quadratic_drag * speed_ground).mul_add(omega, drag * omega);
        let gain_x = gain_along * cosine - gain_across * sine;
        let gain_y = gain_across.mul_add(cosine, gain_along * sine);
        let first_moment_x = inertia * gain_x;
        let first_moment_y = inertia * gain_y;
        let deficit_xx = first_moment_x * gain_x;
        let deficit_xy = first_moment_x * gain_y;
        let deficit_yy = first_moment_y * gain_y;
        let minus_bias_force_x = sum_with_joint_torque
            .mul_add(gain_x, omega_squared * first_moment_y);
        let bias_force_y = omega_squared * first_moment_x
            - sum_with_joint_torque * gain_y;
        [
            deficit_xx,
            deficit_xy,
            deficit_yy,
            -minus_bias_force_x,
            bias_force_y,
            joint_torque,
        ]
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
    /// Cost: 50 ×, 42 ±, 2 ÷, 2 √, 1 negation; 25 of the ± can be fused with a × if the
    /// scalar supports it.
    #[inline(always)]
    fn inner<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        below: Self::Sums<T>,
    ) -> (Self::Response<T>, Self::Elimination<T>) {
        let [
            inertia, moment, lateral_moment, mass, _, _, _, along, across, friction, drag,
            spring, rest, coulomb, quadratic_friction, static_excess, stribeck_rate,
            friction_width, quadratic_drag, drag_width, _, _, _, _, _, _, _, _, _, _, _,
            _, _, _, _, _, drive_torque,
        ] = *constants;
        let ::branched_pendulum::tree::LinkMotion {
            sine,
            cosine,
            omega,
            joint_angle,
            joint_rate,
            ..
        } = link;
        let [
            deficit_xx_below, deficit_xy_below, deficit_yy_below, bias_force_x_below,
            bias_force_y_below, joint_torque_below,
        ] = below;
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
        let attachment_x = along * cosine - across * sine;
        let attachment_y = across.mul_add(cosine, along * sine);
        let deficit_trace = deficit_xx_below + deficit_yy_below;
        let centrifugal_moment = (-deficit_trace).mul_add(along, moment);
        let lateral_centrifugal_moment = (-deficit_trace)
            .mul_add(across, lateral_moment);
        let deficit_moment_x = deficit_xy_below
            .mul_add(attachment_y, deficit_xx_below * attachment_x);
        let deficit_moment_y = deficit_yy_below
            .mul_add(attachment_y, deficit_xy_below * attachment_x);
        let first_moment_x = moment * cosine - lateral_moment * sine - deficit_moment_x;
        let first_moment_y = lateral_moment.mul_add(cosine, moment * sine)
            - deficit_moment_y;
        let joint_inertia = (-attachment_x).mul_add(deficit_moment_x, inertia);
        let joint_inertia = (-attachment_y).mul_add(deficit_moment_y, joint_inertia);
        let held_force_x = (-omega_squared)
            .mul_add(
                lateral_centrifugal_moment.mul_add(cosine, centrifugal_moment * sine)
                    + deficit_moment_y,
                bias_force_x_below,
            );
        let held_force_y = omega_squared
            .mul_add(
                centrifugal_moment * cosine - lateral_centrifugal_moment * sine
                    + deficit_moment_x,
                bias_force_y_below,
            );
        let minus_bias_torque = joint_torque_below + drive_torque
            - (joint_torque
                + (quadratic_drag * speed_ground).mul_add(omega, drag * omega))
            - (along * lateral_moment - across * moment)
                .mul_add(
                    omega_squared,
                    attachment_y.mul_add(held_force_y, attachment_x * held_force_x),
                );
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
    /// Cost: 11 ×, 8 ±; 7 of the ± can be fused with a × if the scalar supports it.
    #[inline(always)]
    fn accelerate<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        elimination: Self::Elimination<T>,
        pivot: [T; 2],
    ) -> (T, Self::Carried<T>) {
        let [
            _, _, _, _, _, _, _, along, across, _, _, _, _, _, _, _, _, _, _, _, _, _, _,
            _, _, _, _, _, _, _, _, _, _, _, _, _, _,
        ] = *constants;
        let ::branched_pendulum::tree::LinkMotion { sine, cosine, omega, .. } = link;
        let [gain_x, gain_y, offset] = elimination;
        let [gravity_x, gravity_y] = pivot;
        let omega_squared = omega * omega;
        let attachment_x = along * cosine - across * sine;
        let attachment_y = across.mul_add(cosine, along * sine);
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
    /// Cost: 22 ×, 14 ±, 1 ÷, 2 √; 9 of the ± can be fused with a × if the scalar
    /// supports it.
    #[inline(always)]
    fn accelerate_leaf<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        pivot: [T; 2],
    ) -> T {
        let [
            _, _, _, _, gain_along, gain_across, inverse_inertia, _, _, friction, drag,
            spring, rest, coulomb, quadratic_friction, static_excess, stribeck_rate,
            friction_width, quadratic_drag, drag_width, _, _, _, _, _, _, _, _, _, _, _,
            _, _, _, _, _, _,
        ] = *constants;
        let ::branched_pendulum::tree::LinkMotion {
            sine,
            cosine,
            omega,
            joint_angle,
            joint_rate,
            ..
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
        let gain_x = gain_along * cosine - gain_across * sine;
        let gain_y = gain_across.mul_add(cosine, gain_along * sine);
        let offset = (joint_torque
            + (quadratic_drag * speed_ground).mul_add(omega, drag * omega))
            * inverse_inertia;
        gain_y.mul_add(gravity_y, gain_x * gravity_x - offset)
    }
}

#[allow(clippy::many_single_char_names, clippy::possible_missing_comma)]
impl ::branched_pendulum::tree::ScaleEquations for ByRuleEquations {
    const SPRINGS: bool = true;
    const FRICTION: bool = true;
    const DRAG: bool = true;
    const DRIVEN: bool = true;

    /// Strain ε of the spring in the link's pivot, the torques κ ε and c (ω − ω_parent)
    /// of the joint on the parent, and k ω on the ground; with friction that is not
    /// viscous where there is any.
    ///
    /// ```text
    /// strain = −ρ + φ
    /// spring torque = κ_i (−ρ + φ)
    /// friction torque = c φ̇ + D
    /// drag torque = k ω_i + D⁰
    /// ```
    ///
    /// <details><summary>LaTeX</summary>
    ///
    /// ```latex
    /// \epsilon = -\rho + \varphi
    /// \tau_{spring} = \kappa_i\,\left(-\rho + \varphi\right)
    /// \tau_{friction} = c\,\dot\varphi + D
    /// \tau_{drag} = k\,\omega_{\mathrm{i}} + D^{0}
    /// ```
    /// </details>
    ///
    /// Cost: 15 ×, 8 ±, 1 ÷, 2 √; 6 of the ± can be fused with a × if the scalar
    /// supports it.
    #[inline(always)]
    fn scale_torques<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
    ) -> [T; 4] {
        let [
            _, _, _, _, _, _, _, _, _, _, _, _, rest, _, _, _, stribeck_rate,
            friction_width, _, drag_width, _, _, _, _, _, _, _, _, _, stiffness,
            pivot_friction, ground_drag, pivot_coulomb, pivot_excess, pivot_quadratic,
            ground_quadratic, _,
        ] = *constants;
        let ::branched_pendulum::tree::LinkMotion {
            omega,
            joint_angle,
            joint_rate,
            ..
        } = link;
        let joint_rate_squared = joint_rate * joint_rate;
        let speed_joint = friction_width
            .mul_add(friction_width, joint_rate_squared)
            .sqrt();
        let stribeck_rate_squared = stribeck_rate * stribeck_rate;
        let stribeck_speed_squared_joint = stribeck_rate_squared + joint_rate_squared;
        let joint_angle_minus_rest = joint_angle - rest;
        let omega_squared = omega * omega;
        let speed_ground = drag_width.mul_add(drag_width, omega_squared).sqrt();
        [
            joint_angle_minus_rest,
            stiffness * joint_angle_minus_rest,
            pivot_quadratic
                .mul_add(
                    speed_joint,
                    pivot_excess
                        .mul_add(
                            stribeck_rate_squared,
                            pivot_coulomb * stribeck_speed_squared_joint,
                        ) / (stribeck_speed_squared_joint * speed_joint),
                )
                .mul_add(joint_rate, pivot_friction * joint_rate),
            (ground_quadratic * speed_ground).mul_add(omega, ground_drag * omega),
        ]
    }

    /// Velocity **V** of the centre of mass and **P**' of the children's pivot, given
    /// that of the link's own.
    ///
    /// ```text
    /// V_x = d cos θ_i ω_i − e sin θ_i ω_i + P_x
    /// V_y = d sin θ_i ω_i + e cos θ_i ω_i + P_y
    /// P'_x = ℓ cos θ_i ω_i − w sin θ_i ω_i + P_x
    /// P'_y = ℓ sin θ_i ω_i + w cos θ_i ω_i + P_y
    /// ```
    ///
    /// <details><summary>LaTeX</summary>
    ///
    /// ```latex
    /// V_x = d\,\cos\theta_{\mathrm{i}}\,\omega_{\mathrm{i}} - e\,\sin\theta_{\mathrm{i}}\,\omega_{\mathrm{i}} + P_x
    /// V_y = d\,\sin\theta_{\mathrm{i}}\,\omega_{\mathrm{i}} + e\,\cos\theta_{\mathrm{i}}\,\omega_{\mathrm{i}} + P_y
    /// P'_x = \ell\,\cos\theta_{\mathrm{i}}\,\omega_{\mathrm{i}} - w\,\sin\theta_{\mathrm{i}}\,\omega_{\mathrm{i}} + P_x
    /// P'_y = \ell\,\sin\theta_{\mathrm{i}}\,\omega_{\mathrm{i}} + w\,\cos\theta_{\mathrm{i}}\,\omega_{\mathrm{i}} + P_y
    /// ```
    /// </details>
    ///
    /// Cost: 12 ×, 8 ±; 6 of the ± can be fused with a × if the scalar supports it.
    #[inline(always)]
    fn scale_velocity<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        given: [T; 2],
    ) -> [T; 4] {
        let [
            _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, com_along,
            com_across, place_along, place_across, _, _, _, _, _, _, _, _, _, _, _,
        ] = *constants;
        let ::branched_pendulum::tree::LinkMotion { sine, cosine, omega, .. } = link;
        let [pivot_velocity_x, pivot_velocity_y] = given;
        [
            omega.mul_add(com_along * cosine - com_across * sine, pivot_velocity_x),
            omega
                .mul_add(com_across.mul_add(cosine, com_along * sine), pivot_velocity_y),
            omega.mul_add(place_along * cosine - place_across * sine, pivot_velocity_x),
            omega
                .mul_add(
                    place_across.mul_add(cosine, place_along * sine),
                    pivot_velocity_y,
                ),
        ]
    }

    /// **B**, of which **B**·v is the moment of the momentum of all that the link
    /// carries, and that momentum, given the velocity of the centre of mass and the
    /// momentum **C** of what hangs from the link.
    ///
    /// ```text
    /// B_x = m d V_x + m e V_y + ℓ C_x + w C_y
    /// B_y = m d V_y − m e V_x + ℓ C_y − w C_x
    /// C'_x = m V_x + C_x
    /// C'_y = m V_y + C_y
    /// ```
    ///
    /// <details><summary>LaTeX</summary>
    ///
    /// ```latex
    /// B_x = m\,d\,V_x + m\,e\,V_y + \ell\,C_x + w\,C_y
    /// B_y = m\,d\,V_y - m\,e\,V_x + \ell\,C_y - w\,C_x
    /// C'_x = m\,V_x + C_x
    /// C'_y = m\,V_y + C_y
    /// ```
    /// </details>
    ///
    /// Cost: 12 ×, 8 ±; 7 of the ± can be fused with a × if the scalar supports it.
    #[inline(always)]
    fn scale_moment<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        given: [T; 4],
    ) -> [T; 4] {
        let [
            _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, body_mass, _,
            com_along, com_across, place_along, place_across, _, _, _, _, _, _, _, _, _,
            _, _,
        ] = *constants;
        let _ = link;
        let [velocity_x, velocity_y, carried_x, carried_y] = given;
        let body_mass_times_com_along = body_mass * com_along;
        let body_mass_times_com_across = body_mass * com_across;
        [
            place_across
                .mul_add(
                    carried_y,
                    place_along
                        .mul_add(
                            carried_x,
                            body_mass_times_com_across
                                .mul_add(velocity_y, body_mass_times_com_along * velocity_x),
                        ),
                ),
            (-place_across)
                .mul_add(
                    carried_x,
                    place_along
                        .mul_add(
                            carried_y,
                            body_mass_times_com_along * velocity_y
                                - body_mass_times_com_across * velocity_x,
                        ),
                ),
            body_mass.mul_add(velocity_x, carried_x),
            body_mass.mul_add(velocity_y, carried_y),
        ]
    }

    /// Energy of the parts of **V**, ω, 1 − cos θ, sin θ and ε in a scale; δ_s0 is 1
    /// for the means, 0 for others.
    ///
    /// ```text
    /// E = m [V_x]² / 2 + m [V_y]² / 2 + I [ω]² / 2 + κ_i [strain]² / 2 + g_0 H [1
    ///     − cos θ]² / 2 + g_0 H [sin θ]² / 2 + g_0 H_⊥ δ_s0 [sin θ]
    /// ```
    ///
    /// <details><summary>LaTeX</summary>
    ///
    /// ```latex
    /// E = \frac{m\,[V_x]_s^{2}}{2} + \frac{m\,[V_y]_s^{2}}{2} + \frac{I\,[\omega]_s^{2}}{2} + \frac{\kappa_i\,[\epsilon]_s^{2}}{2} + \frac{g\,H\,[1-\cos\theta]_s^{2}}{2} + \frac{g\,H\,[\sin\theta]_s^{2}}{2} + g\,H_{\perp}\,\delta_{s0}\,[\sin\theta]_s
    /// ```
    /// </details>
    ///
    /// Cost: 17 ×, 6 ±; 6 of the ± can be fused with a × if the scalar supports it.
    #[inline(always)]
    fn scale_energy<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        given: [T; 7],
    ) -> [T; 1] {
        let [
            _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, body_mass,
            body_inertia, _, _, _, _, carried_moment, lateral_carried_moment, gravity,
            stiffness, _, _, _, _, _, _, _,
        ] = *constants;
        let _ = link;
        let [
            part_velocity_x, part_velocity_y, part_omega, part_rise, part_side,
            part_strain, means,
        ] = given;
        let half = T::from_f64(0.5);
        [
            (gravity * lateral_carried_moment * means)
                .mul_add(
                    part_side,
                    (half * gravity * carried_moment)
                        .mul_add(
                            part_side.mul_add(part_side, part_rise * part_rise),
                            half
                                .mul_add(
                                    (stiffness * part_strain)
                                        .mul_add(
                                            part_strain,
                                            body_inertia * part_omega * part_omega,
                                        ),
                                    half * body_mass
                                        * part_velocity_y
                                            .mul_add(part_velocity_y, part_velocity_x * part_velocity_x),
                                ),
                        ),
                ),
        ]
    }

    /// Deficit N of the articulated inertia of the subtree, b/J and 1/J, given N of
    /// what hangs from the link: the factors of M u = ∂E/∂ω, which all scales share.
    ///
    /// Cost: 19 ×, 15 ±, 1 ÷; 9 of the ± can be fused with a × if the scalar supports
    /// it.
    #[inline(always)]
    fn scale_factor<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        given: [T; 3],
    ) -> [T; 6] {
        let [
            inertia, moment, lateral_moment, mass, _, _, _, along, across, _, _, _, _, _,
            _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _,
        ] = *constants;
        let ::branched_pendulum::tree::LinkMotion { sine, cosine, .. } = link;
        let [deficit_xx_below, deficit_xy_below, deficit_yy_below] = given;
        let attachment_x = along * cosine - across * sine;
        let attachment_y = across.mul_add(cosine, along * sine);
        let deficit_moment_x = deficit_xy_below
            .mul_add(attachment_y, deficit_xx_below * attachment_x);
        let deficit_moment_y = deficit_yy_below
            .mul_add(attachment_y, deficit_xy_below * attachment_x);
        let first_moment_x = moment * cosine - lateral_moment * sine - deficit_moment_x;
        let first_moment_y = lateral_moment.mul_add(cosine, moment * sine)
            - deficit_moment_y;
        let joint_inertia = (-attachment_x).mul_add(deficit_moment_x, inertia);
        let joint_inertia = (-attachment_y).mul_add(deficit_moment_y, joint_inertia);
        let inverse_joint_inertia = T::from_f64(1.0) / joint_inertia;
        let gain_x = inverse_joint_inertia * first_moment_x;
        let gain_y = inverse_joint_inertia * first_moment_y;
        let deficit_yy = first_moment_y.mul_add(gain_y, deficit_yy_below - mass);
        let deficit_xx = first_moment_x.mul_add(gain_x, deficit_xx_below - mass);
        let deficit_xy = first_moment_x.mul_add(gain_y, deficit_xy_below);
        [deficit_xx, deficit_xy, deficit_yy, gain_x, gain_y, inverse_joint_inertia]
    }

    /// Response γ of the subtree to torques ∂E/∂ω of a scale at rest, and κ/J, given
    /// the factors, the parts of **B** and ω, and γ of what hangs from the link.
    ///
    /// ```text
    /// ∂E/∂ω = I [ω] + cos θ_i B_x + sin θ_i B_y
    /// ```
    ///
    /// <details><summary>LaTeX</summary>
    ///
    /// ```latex
    /// \partial E/\partial\omega = I\,[\omega]_s + \cos\theta_{\mathrm{i}}\,B_x + \sin\theta_{\mathrm{i}}\,B_y
    /// ```
    /// </details>
    ///
    /// Cost: 12 ×, 8 ±, 1 negation; 6 of the ± can be fused with a × if the scalar
    /// supports it.
    #[inline(always)]
    fn scale_eliminate<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        given: [T; 8],
    ) -> [T; 3] {
        let [
            _, _, _, _, _, _, _, along, across, _, _, _, _, _, _, _, _, _, _, _, _,
            body_inertia, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _,
        ] = *constants;
        let ::branched_pendulum::tree::LinkMotion { sine, cosine, .. } = link;
        let [
            gain_x, gain_y, inverse_inertia, part_moment_x, part_moment_y, part_omega,
            bias_force_x_below, bias_force_y_below,
        ] = given;
        let sum_with_body_inertia = sine
            .mul_add(
                part_moment_y,
                cosine.mul_add(part_moment_x, body_inertia * part_omega),
            )
            - across
                .mul_add(cosine, along * sine)
                .mul_add(
                    bias_force_y_below,
                    (along * cosine - across * sine) * bias_force_x_below,
                );
        [
            sum_with_body_inertia.mul_add(gain_x, bias_force_x_below),
            sum_with_body_inertia.mul_add(gain_y, bias_force_y_below),
            -(sum_with_body_inertia * inverse_inertia),
        ]
    }

    /// Angular velocity u along the flow of a scale's energy, M u = ∂E/∂ω; what is
    /// handed to the children; the changes **R** of velocities along the flow at
    /// constant ω, of the centre of mass and of the children's pivot.
    ///
    /// ```text
    /// R_x = −d sin θ_i u ω_i − e cos θ_i u ω_i + R_x
    /// R_y = d cos θ_i u ω_i − e sin θ_i u ω_i + R_y
    /// R'_x = −ℓ sin θ_i u ω_i − w cos θ_i u ω_i + R_x
    /// R'_y = ℓ cos θ_i u ω_i − w sin θ_i u ω_i + R_y
    /// ```
    ///
    /// <details><summary>LaTeX</summary>
    ///
    /// ```latex
    /// R_x = -d\,\sin\theta_{\mathrm{i}}\,u\,\omega_{\mathrm{i}} - e\,\cos\theta_{\mathrm{i}}\,u\,\omega_{\mathrm{i}} + R_x
    /// R_y = d\,\cos\theta_{\mathrm{i}}\,u\,\omega_{\mathrm{i}} - e\,\sin\theta_{\mathrm{i}}\,u\,\omega_{\mathrm{i}} + R_y
    /// R'_x = -\ell\,\sin\theta_{\mathrm{i}}\,u\,\omega_{\mathrm{i}} - w\,\cos\theta_{\mathrm{i}}\,u\,\omega_{\mathrm{i}} + R_x
    /// R'_y = \ell\,\cos\theta_{\mathrm{i}}\,u\,\omega_{\mathrm{i}} - w\,\sin\theta_{\mathrm{i}}\,u\,\omega_{\mathrm{i}} + R_y
    /// ```
    /// </details>
    ///
    /// Cost: 23 ×, 14 ±; 11 of the ± can be fused with a × if the scalar supports it.
    #[inline(always)]
    fn scale_flow<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        given: [T; 7],
    ) -> [T; 7] {
        let [
            _, _, _, _, _, _, _, along, across, _, _, _, _, _, _, _, _, _, _, _, _, _,
            com_along, com_across, place_along, place_across, _, _, _, _, _, _, _, _, _,
            _, _,
        ] = *constants;
        let ::branched_pendulum::tree::LinkMotion { sine, cosine, omega, .. } = link;
        let [
            gain_x, gain_y, offset, pivot_flow_x, pivot_flow_y, pivot_shift_x,
            pivot_shift_y,
        ] = given;
        let tangential = gain_x.mul_add(pivot_flow_x, -offset);
        let tangential = gain_y.mul_add(pivot_flow_y, tangential);
        let tangential_times_omega = tangential * omega;
        [
            tangential,
            (-tangential).mul_add(along * cosine - across * sine, pivot_flow_x),
            (-tangential).mul_add(across.mul_add(cosine, along * sine), pivot_flow_y),
            (-tangential)
                .mul_add(
                    omega * com_across.mul_add(cosine, com_along * sine),
                    pivot_shift_x,
                ),
            tangential_times_omega
                .mul_add(com_along * cosine - com_across * sine, pivot_shift_y),
            (-tangential)
                .mul_add(
                    omega * place_across.mul_add(cosine, place_along * sine),
                    pivot_shift_x,
                ),
            tangential_times_omega
                .mul_add(place_along * cosine - place_across * sine, pivot_shift_y),
        ]
    }

    /// z = ∂E/∂θ + **D**·v with the moment **D** of the changes **R**: {E_s, E_r} = Σ
    /// z_s u_r − u_s z_r.
    ///
    /// ```text
    /// z = g_0 H cos θ_i [sin θ] + g_0 H sin θ_i [1 − cos θ] + g_0 H_⊥ δ_s0 cos θ_i
    ///     + cos θ_i B_y ω_i + cos θ_i D_x − sin θ_i B_x ω_i + sin θ_i D_y + [springs]
    /// ```
    ///
    /// <details><summary>LaTeX</summary>
    ///
    /// ```latex
    /// z = g\,H\,\cos\theta_{\mathrm{i}}\,[\sin\theta]_s + g\,H\,\sin\theta_{\mathrm{i}}\,[1-\cos\theta]_s + g\,H_{\perp}\,\delta_{s0}\,\cos\theta_{\mathrm{i}} + \cos\theta_{\mathrm{i}}\,B_y\,\omega_{\mathrm{i}} + \cos\theta_{\mathrm{i}}\,D_x - \sin\theta_{\mathrm{i}}\,B_x\,\omega_{\mathrm{i}} + \sin\theta_{\mathrm{i}}\,D_y + [\tau]_s
    /// ```
    /// </details>
    ///
    /// Cost: 9 ×, 7 ±; 3 of the ± can be fused with a × if the scalar supports it.
    #[inline(always)]
    fn scale_slope<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        given: [T; 8],
    ) -> [T; 1] {
        let [
            _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _,
            carried_moment, lateral_carried_moment, gravity, _, _, _, _, _, _, _, _,
        ] = *constants;
        let ::branched_pendulum::tree::LinkMotion { sine, cosine, omega, .. } = link;
        let [
            part_moment_x, part_moment_y, part_rise, part_side, part_spring, means,
            shift_moment_x, shift_moment_y,
        ] = given;
        let gravity_times_carried_moment = gravity * carried_moment;
        [
            sine
                .mul_add(
                    gravity_times_carried_moment * part_rise - part_moment_x * omega
                        + shift_moment_y,
                    cosine
                        * (part_moment_y
                            .mul_add(
                                omega,
                                (gravity * lateral_carried_moment)
                                    .mul_add(means, gravity_times_carried_moment * part_side),
                            ) + shift_moment_x),
                ) + part_spring,
        ]
    }

    /// Torque of the inertial forces under the acceleration **A** of the root's pivot.
    ///
    /// ```text
    /// Q_moved = −H cos θ_i A_x − H sin θ_i A_y − H_⊥ cos θ_i A_y + H_⊥ sin θ_i A_x
    /// ```
    ///
    /// <details><summary>LaTeX</summary>
    ///
    /// ```latex
    /// Q_{moved} = -H\,\cos\theta_{\mathrm{i}}\,A_x - H\,\sin\theta_{\mathrm{i}}\,A_y - H_{\perp}\,\cos\theta_{\mathrm{i}}\,A_y + H_{\perp}\,\sin\theta_{\mathrm{i}}\,A_x
    /// ```
    /// </details>
    ///
    /// Cost: 8 ×, 3 ±; 3 of the ± can be fused with a × if the scalar supports it.
    #[inline(always)]
    fn scale_inertial<T: ::branched_pendulum::Scalar>(
        constants: &Self::Constants<T>,
        link: ::branched_pendulum::tree::LinkMotion<T>,
        given: [T; 2],
    ) -> [T; 1] {
        let [
            _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _, _,
            carried_moment, lateral_carried_moment, _, _, _, _, _, _, _, _, _,
        ] = *constants;
        let ::branched_pendulum::tree::LinkMotion { sine, cosine, .. } = link;
        let [acceleration_x, acceleration_y] = given;
        [
            (lateral_carried_moment * sine)
                .mul_add(
                    acceleration_x,
                    -(lateral_carried_moment * cosine)
                        .mul_add(
                            acceleration_y,
                            (carried_moment * sine)
                                .mul_add(
                                    acceleration_y,
                                    carried_moment * cosine * acceleration_x,
                                ),
                        ),
                ),
        ]
    }
}

/// The constants of a link that the equations read.
#[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
pub(crate) struct ByRuleRow<T> {
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
    /// Mass (kg).
    pub(crate) body_mass: T,
    /// Moment of inertia about the centre of mass (kg m²).
    pub(crate) body_inertia: T,
    /// Place of the centre of mass along the link (m).
    pub(crate) com_along: T,
    /// Place of the centre of mass across the link (m).
    pub(crate) com_across: T,
    /// Place of the children's pivot along the link (m).
    pub(crate) place_along: T,
    /// Place of the children's pivot across the link (m).
    pub(crate) place_across: T,
    /// First moment of all that the link carries (kg m).
    pub(crate) carried_moment: T,
    /// First moment of that across the link (kg m).
    pub(crate) lateral_carried_moment: T,
    /// Gravity (m/s²).
    pub(crate) gravity: T,
    /// Stiffness of the torsion spring (N m).
    pub(crate) stiffness: T,
    /// Friction in the pivot (N m s).
    pub(crate) pivot_friction: T,
    /// Drag against the ground (N m s).
    pub(crate) ground_drag: T,
    /// Coulomb friction in the pivot (N m).
    pub(crate) pivot_coulomb: T,
    /// Excess of static over Coulomb friction in the pivot (N m).
    pub(crate) pivot_excess: T,
    /// Quadratic friction in the pivot (N m s²).
    pub(crate) pivot_quadratic: T,
    /// Quadratic drag against the ground (N m s²).
    pub(crate) ground_quadratic: T,
    /// Torque on the root over m l², stated by each evaluation.
    pub(crate) drive_torque: T,
}

impl<T> ByRuleRow<T> {
    /// Returns the constants in the order of the columns.
    pub(crate) fn into_array(self) -> [T; 37] {
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
            coulomb,
            quadratic_friction,
            static_excess,
            stribeck_rate,
            friction_width,
            quadratic_drag,
            drag_width,
            body_mass,
            body_inertia,
            com_along,
            com_across,
            place_along,
            place_across,
            carried_moment,
            lateral_carried_moment,
            gravity,
            stiffness,
            pivot_friction,
            ground_drag,
            pivot_coulomb,
            pivot_excess,
            pivot_quadratic,
            ground_quadratic,
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
            coulomb,
            quadratic_friction,
            static_excess,
            stribeck_rate,
            friction_width,
            quadratic_drag,
            drag_width,
            body_mass,
            body_inertia,
            com_along,
            com_across,
            place_along,
            place_across,
            carried_moment,
            lateral_carried_moment,
            gravity,
            stiffness,
            pivot_friction,
            ground_drag,
            pivot_coulomb,
            pivot_excess,
            pivot_quadratic,
            ground_quadratic,
            drive_torque,
        ]
    }
}
