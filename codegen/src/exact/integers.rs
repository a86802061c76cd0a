//! Integers and fractions of arbitrary length. With the feature `symbolica` they are the types of
//! the computer algebra; without it they are the types of `num`, which add only a hundredth of that
//! code to a program and give identical results.

#[cfg(feature = "symbolica")]
pub(super) use numerica::domains::{integer::Integer, rational::Rational as Fraction};

#[cfg(not(feature = "symbolica"))]
pub(super) use plain::{Fraction, Integer};

#[cfg(not(feature = "symbolica"))]
mod plain {
    use std::fmt;
    use std::ops::{Add, Div, Mul, MulAssign, Neg, Sub};
    use std::str::FromStr;

    use num_bigint::{BigInt, ParseBigIntError};
    use num_rational::BigRational;
    use num_traits::{One as _, Signed as _, Zero as _};

    /// An integer of arbitrary length.
    #[derive(Clone, PartialEq, Eq, Hash)]
    pub(crate) struct Integer(BigInt);

    /// A fraction in lowest terms with a positive denominator.
    #[derive(Clone, PartialEq, Eq, Hash)]
    pub(crate) struct Fraction {
        numerator: Integer,
        denominator: Integer,
    }

    macro_rules! machine_integer {
        ($($number:ty),*) => {$(
            impl From<$number> for Integer {
                fn from(value: $number) -> Self {
                    Self(value.into())
                }
            }
        )*};
    }

    machine_integer!(i32, i64, i128);

    impl FromStr for Integer {
        type Err = ParseBigIntError;

        fn from_str(digits: &str) -> Result<Self, ParseBigIntError> {
            Ok(Self(digits.parse()?))
        }
    }

    impl fmt::Display for Integer {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            self.0.fmt(f)
        }
    }

    impl Integer {
        pub(crate) fn one() -> Self {
            Self(BigInt::one())
        }

        pub(crate) fn is_zero(&self) -> bool {
            self.0.is_zero()
        }

        pub(crate) fn abs(&self) -> Self {
            Self(self.0.abs())
        }

        pub(crate) fn significant_bits(&self) -> u64 {
            self.0.bits()
        }

        /// Returns `self ^ exponent`. An exponent beyond 2³² is read as `u32::MAX`: no memory holds
        /// such a power.
        pub(crate) fn pow(&self, exponent: u64) -> Self {
            Self(self.0.pow(u32::try_from(exponent).unwrap_or(u32::MAX)))
        }

        pub(crate) fn quot_rem(&self, divisor: &Self) -> (Self, Self) {
            (Self(&self.0 / &divisor.0), Self(&self.0 % &divisor.0))
        }
    }

    impl Mul<&Integer> for &Integer {
        type Output = Integer;

        fn mul(self, other: &Integer) -> Integer {
            Integer(&self.0 * &other.0)
        }
    }

    impl Mul for Integer {
        type Output = Self;

        fn mul(self, other: Self) -> Self {
            Self(self.0 * other.0)
        }
    }

    impl MulAssign for Integer {
        fn mul_assign(&mut self, other: Self) {
            self.0 *= other.0;
        }
    }

    impl From<BigRational> for Fraction {
        fn from(ratio: BigRational) -> Self {
            let (numerator, denominator) = ratio.into_raw();
            Self {
                numerator: Integer(numerator),
                denominator: Integer(denominator),
            }
        }
    }

    impl Fraction {
        pub(crate) fn new(numerator: impl Into<Integer>, denominator: impl Into<Integer>) -> Self {
            BigRational::new(numerator.into().0, denominator.into().0).into()
        }

        fn ratio(&self) -> BigRational {
            BigRational::new_raw(self.numerator.0.clone(), self.denominator.0.clone())
        }

        pub(crate) fn zero() -> Self {
            BigRational::zero().into()
        }

        pub(crate) fn one() -> Self {
            BigRational::one().into()
        }

        pub(crate) fn is_zero(&self) -> bool {
            self.numerator.is_zero()
        }

        pub(crate) fn is_one(&self) -> bool {
            self.numerator == self.denominator
        }

        pub(crate) fn is_negative(&self) -> bool {
            self.numerator.0.is_negative()
        }

        pub(crate) fn is_integer(&self) -> bool {
            self.denominator.0.is_one()
        }

        pub(crate) fn numerator_ref(&self) -> &Integer {
            &self.numerator
        }

        pub(crate) fn denominator_ref(&self) -> &Integer {
            &self.denominator
        }

        pub(crate) fn pow(&self, exponent: u64) -> Self {
            let [numerator, denominator] =
                [&self.numerator, &self.denominator].map(|part| part.pow(exponent));
            Self {
                numerator,
                denominator,
            }
        }

        pub(crate) fn inv(&self) -> Self {
            self.ratio().recip().into()
        }
    }

    impl Neg for Fraction {
        type Output = Self;

        fn neg(self) -> Self {
            (-self.ratio()).into()
        }
    }

    macro_rules! operator {
        ($trait:ident, $method:ident) => {
            impl $trait<&Fraction> for &Fraction {
                type Output = Fraction;

                fn $method(self, other: &Fraction) -> Fraction {
                    $trait::$method(self.ratio(), other.ratio()).into()
                }
            }
        };
    }

    operator!(Add, add);
    operator!(Sub, sub);
    operator!(Mul, mul);
    operator!(Div, div);
}
