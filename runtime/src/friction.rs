//! Laws of non-viscous friction: Coulomb and quadratic (physics §17).
//!
//! [`FrictionLaw`] is the only implementation of these laws at run time; it is used for friction
//! between links, Taylor series and energy transfers.

use core::fmt::{self, Display, Formatter};

use crate::scalar::Scalar;

/// Law of non-viscous friction: the torque (C/s + q s) w against the rate w, with the smoothed
/// speed s = √(w² + ε²).
///
/// # Examples
///
/// ```
/// use branched_pendulum::friction::FrictionLaw;
///
/// let law = FrictionLaw { coulomb: 0.1_f64, quadratic: 0.0, width: 1e-3 };
/// assert!((law.torque(5.0) - 0.1).abs() < 1e-8);
/// assert_eq!(law.torque(0.0), 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionLaw<T> {
    /// Coulomb torque C, in N m.
    pub coulomb: T,
    /// Quadratic coefficient q, in N m s².
    pub quadratic: T,
    /// Width ε of the smoothing, in rad/s; must be positive.
    pub width: T,
}

impl<T> FrictionLaw<T> {
    /// Creates the law from the constants C (N m), q (N m s²) and ε (rad/s).
    pub const fn of_constants([coulomb, quadratic, width]: [T; 3]) -> Self
    where
        T: Copy,
    {
        Self {
            coulomb,
            quadratic,
            width,
        }
    }

    /// Returns the constants in the order of [`of_constants`](Self::of_constants).
    pub fn into_constants(self) -> [T; 3] {
        [self.coulomb, self.quadratic, self.width]
    }

    /// Converts the constants with `convert`, in their order.
    #[must_use]
    pub fn map<S>(self, convert: impl FnMut(T) -> S) -> FrictionLaw<S> {
        let [coulomb, quadratic, width] = self.into_constants().map(convert);
        FrictionLaw {
            coulomb,
            quadratic,
            width,
        }
    }
}

impl<T: Display> Display for FrictionLaw<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self {
            coulomb,
            quadratic,
            width,
        } = self;
        write!(
            f,
            "Coulomb friction {coulomb} N m, quadratic friction {quadratic} N m s², width {width} \
             rad/s"
        )
    }
}

impl<T: Scalar> FrictionLaw<T> {
    /// Returns the law of a contact without friction. Its width is 1 rad/s.
    #[must_use]
    pub fn none() -> Self {
        let [zero, one] = [0.0, 1.0].map(T::from_f64);
        Self::of_constants([zero, zero, one])
    }

    /// Returns the law with all torques multiplied by `factor`.
    #[must_use]
    pub fn times(self, factor: T) -> Self {
        Self {
            coulomb: self.coulomb * factor,
            quadratic: self.quadratic * factor,
            width: self.width,
        }
    }

    /// Returns true if the torque of the law is zero at any rate.
    pub fn is_none(&self) -> bool
    where
        T: PartialEq,
    {
        [self.coulomb, self.quadratic] == [T::from_f64(0.0); 2]
    }

    /// Returns the torque (N m) of friction against the angular velocity `rate` (rad/s).
    #[inline(always)]
    #[must_use]
    pub fn torque(&self, rate: T) -> T {
        let speed = self.speed(rate);
        (self.coulomb / speed + self.quadratic * speed) * rate
    }

    /// Returns the smoothed speed √(w² + ε²) (rad/s) of a rate w.
    #[inline(always)]
    pub(crate) fn speed(&self, rate: T) -> T {
        (rate * rate + self.width * self.width).sqrt()
    }

    /// Returns the ratio C/s + q s of torque and rate, given 1/s and s. It is linear in both, so
    /// that Taylor coefficients of 1/s and s give the Taylor coefficient of the ratio.
    #[inline(always)]
    pub(crate) fn factor(&self, inverse: T, speed: T) -> T {
        self.coulomb * inverse + self.quadratic * speed
    }
}
