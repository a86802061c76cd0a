//! Laws of non-viscous friction: Coulomb, Stribeck and quadratic (physics §17).
//!
//! [`FrictionLaw`] is the only implementation of these laws at run time; it is used for friction
//! between links, Taylor series and energy transfers.

use core::fmt::{self, Display, Formatter};

use crate::scalar::Scalar;

/// Number of constants of a [`FrictionLaw`].
pub const LAW_CONSTANTS: usize = 5;

/// Law of non-viscous friction: the torque (A/s + q s) w against the rate w, with the smoothed
/// speed s = √(w² + ε²) and A = C + ΔC ϖ²/(ϖ² + w²).
///
/// A, the friction between dry surfaces, falls from the static friction C + ΔC to the Coulomb
/// friction C as the rate passes the Stribeck rate ϖ.
///
/// # Examples
///
/// ```
/// use branched_pendulum::friction::FrictionLaw;
///
/// let coulomb = FrictionLaw { coulomb: 0.1_f64, width: 1e-3, ..FrictionLaw::none() };
/// assert!((coulomb.torque(5.0) - 0.1).abs() < 1e-8);
/// assert_eq!(coulomb.torque(0.0), 0.0);
///
/// let stribeck = FrictionLaw { excess: 0.05, stribeck: 0.5, ..coulomb };
/// assert!((stribeck.torque(0.5) - 0.125).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionLaw<T> {
    /// Coulomb torque C, in N m.
    pub coulomb: T,
    /// Quadratic coefficient q, in N m s².
    pub quadratic: T,
    /// Width ε of the smoothing, in rad/s; must be positive.
    pub width: T,
    /// Excess ΔC of static over Coulomb friction, in N m.
    pub excess: T,
    /// Stribeck rate ϖ, in rad/s; must be positive. Half of the excess is left at this rate.
    pub stribeck: T,
}

impl<T> FrictionLaw<T> {
    /// Creates the law from the constants C (N m), q (N m s²), ε (rad/s), ΔC (N m) and ϖ (rad/s).
    pub const fn of_constants(
        [coulomb, quadratic, width, excess, stribeck]: [T; LAW_CONSTANTS],
    ) -> Self
    where
        T: Copy,
    {
        Self {
            coulomb,
            quadratic,
            width,
            excess,
            stribeck,
        }
    }

    /// Returns the constants in the order of [`of_constants`](Self::of_constants).
    pub fn into_constants(self) -> [T; LAW_CONSTANTS] {
        let Self {
            coulomb,
            quadratic,
            width,
            excess,
            stribeck,
        } = self;
        [coulomb, quadratic, width, excess, stribeck]
    }

    /// Converts the constants with `convert`, in their order.
    #[must_use]
    pub fn map<S>(self, convert: impl FnMut(T) -> S) -> FrictionLaw<S> {
        let [coulomb, quadratic, width, excess, stribeck] = self.into_constants().map(convert);
        FrictionLaw {
            coulomb,
            quadratic,
            width,
            excess,
            stribeck,
        }
    }
}

/// Lists the constants with their units; those of static friction only if there is an excess.
impl Display for FrictionLaw<f64> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self {
            coulomb,
            quadratic,
            width,
            excess,
            stribeck,
        } = self;
        write!(
            f,
            "Coulomb friction {coulomb} N m, quadratic friction {quadratic} N m s², width {width} \
             rad/s"
        )?;
        match *excess == 0.0 {
            true => Ok(()),
            false => write!(
                f,
                ", static excess {excess} N m, Stribeck rate {stribeck} rad/s"
            ),
        }
    }
}

impl<T: Scalar> FrictionLaw<T> {
    /// Returns the law of a contact without friction, with a width and a Stribeck rate of 1 rad/s.
    #[must_use]
    pub fn none() -> Self {
        let [zero, one] = [0.0, 1.0].map(T::from_f64);
        Self::of_constants([zero, zero, one, zero, one])
    }

    /// Returns the law with all torques multiplied by `factor`.
    #[must_use]
    pub fn times(self, factor: T) -> Self {
        Self {
            coulomb: self.coulomb * factor,
            quadratic: self.quadratic * factor,
            width: self.width,
            excess: self.excess * factor,
            stribeck: self.stribeck,
        }
    }

    /// Returns true if the torque of the law is zero at any rate.
    pub fn is_none(&self) -> bool
    where
        T: PartialEq,
    {
        [self.coulomb, self.quadratic, self.excess] == [T::from_f64(0.0); 3]
    }

    /// Returns the torque (N m) of friction against the angular velocity `rate` (rad/s).
    #[inline(always)]
    #[must_use]
    pub fn torque(&self, rate: T) -> T {
        let speed = self.speed(rate);
        let square = self.stribeck * self.stribeck;
        let sum = square + rate * rate;
        let strength = (self.coulomb * sum + self.excess * square) / (sum * speed);
        (strength + self.quadratic * speed) * rate
    }

    /// Returns the smoothed speed √(w² + ε²) (rad/s) of a rate w.
    #[inline(always)]
    pub(crate) fn speed(&self, rate: T) -> T {
        (rate * rate + self.width * self.width).sqrt()
    }

    /// Returns the ratio A/s + q s of torque and rate, given s, 1/s and 1/[(ϖ² + w²) s]. It is
    /// linear in these, so that their Taylor coefficients give the Taylor coefficient of the ratio.
    #[inline(always)]
    pub(crate) fn factor(&self, speed: T, inverse: T, product: T) -> T {
        let excess = self.excess * self.stribeck * self.stribeck;
        self.coulomb * inverse + excess * product + self.quadratic * speed
    }
}
