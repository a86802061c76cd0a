// Expanded from plain.rs by `cargo branched-pendulum` 0.1.0. Do not edit.
//! The equations of a link without torques in its joint and without lateral offsets, whose
//! children share a pivot.

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
pub(crate) struct PlainEquations;

#[allow(clippy::many_single_char_names, clippy::possible_missing_comma)]
impl ::branched_pendulum::tree::LinkEquations for PlainEquations {
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
    /// Cost: 12 ×, 2 ±; 1 of the ± can be fused with a × if the scalar supports it.
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
    /// Cost: 26 ×, 21 ±, 1 ÷, 1 negation; 17 of the ± can be fused with a × if the
    /// scalar supports it.
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
        let minus_bias_torque = outside_torque
            - attachment_y.mul_add(held_force_y, attachment_x * held_force_x);
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
    /// Cost: 9 ×, 6 ±; 6 of the ± can be fused with a × if the scalar supports it.
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
    /// Cost: 5 ×, 2 ±; 2 of the ± can be fused with a × if the scalar supports it.
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

/// The constants of a link that the equations read.
#[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
pub(crate) struct PlainRow<T> {
    /// M/(L² m), moment of inertia about the pivot.
    pub(crate) inertia: T,
    /// H/(L m), first moment of mass about the pivot.
    pub(crate) moment: T,
    /// Mass over m that is not in the constants of the parent.
    pub(crate) mass: T,
    /// H L/M of a leaf.
    pub(crate) gain_along: T,
    /// L² m/M of a leaf.
    pub(crate) inverse_inertia: T,
    /// Place of the attachment along the link, over L.
    pub(crate) along: T,
}

impl<T> PlainRow<T> {
    /// Returns the constants in the order of the columns.
    pub(crate) fn into_array(self) -> [T; 6] {
        let Self { inertia, moment, mass, gain_along, inverse_inertia, along } = self;
        [inertia, moment, mass, gain_along, inverse_inertia, along]
    }
}
