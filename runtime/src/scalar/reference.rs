//! Sine and cosine to 250 bits, as a reference for tests: fixed-point numbers, range reduction by
//! doubling and subtracting, Taylor series, π by Machin's formula. Slow, and independent of all
//! other code of this crate.

use std::vec::Vec;

/// A non-negative fixed-point number: one integer word, then `L − 1` words of fraction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Fixed<const L: usize>([u64; L]);

/// Number of 64-bit words that the range reduction of any `f64` needs: each of up to 1077 doublings
/// also doubles the error.
const LONG: usize = 24;
/// Number of 64-bit words that the Taylor series need.
pub(crate) const SHORT: usize = 7;

impl<const L: usize> Fixed<L> {
    pub(crate) const ZERO: Self = Self([0; L]);

    pub(crate) fn integer(value: u64) -> Self {
        let mut result = Self::ZERO;
        result.0[0] = value;
        result
    }

    pub(crate) fn add(self, other: Self) -> Self {
        let mut result = Self::ZERO;
        let mut carry = false;
        for i in (0..L).rev() {
            let (sum, first) = self.0[i].overflowing_add(other.0[i]);
            let (sum, second) = sum.overflowing_add(u64::from(carry));
            (result.0[i], carry) = (sum, first || second);
        }
        assert!(!carry, "a sum beyond the range");
        result
    }

    pub(crate) fn sub(self, other: Self) -> Self {
        let mut result = Self::ZERO;
        let mut borrow = false;
        for i in (0..L).rev() {
            let (rest, first) = self.0[i].overflowing_sub(other.0[i]);
            let (rest, second) = rest.overflowing_sub(u64::from(borrow));
            (result.0[i], borrow) = (rest, first || second);
        }
        assert!(!borrow, "a negative difference");
        result
    }

    fn mul(self, other: Self) -> Self {
        let mut product = std::vec![0_u64; 2 * L];
        for i in (0..L).rev() {
            let mut carry = 0_u128;
            for j in (0..L).rev() {
                let sum = u128::from(self.0[i]) * u128::from(other.0[j])
                    + u128::from(product[i + j + 1])
                    + carry;
                product[i + j + 1] = sum as u64;
                carry = sum >> 64;
            }
            product[i] = carry as u64;
        }
        // Two integer words; the first is zero for all numbers of this module.
        assert_eq!(product[0], 0, "a product beyond the range");
        let mut result = Self::ZERO;
        result.0.copy_from_slice(&product[1..=L]);
        result
    }

    fn div(self, divisor: u64) -> Self {
        let mut result = Self::ZERO;
        let mut rest = 0_u128;
        for i in 0..L {
            let value = rest << 64 | u128::from(self.0[i]);
            result.0[i] = (value / u128::from(divisor)) as u64;
            rest = value % u128::from(divisor);
        }
        result
    }

    /// Returns `mantissa` · 2^exponent, exactly.
    pub(crate) fn scaled(mantissa: u64, exponent: i32) -> Self {
        let mut result = Self::ZERO;
        // Bit 0 of the integer word is at position 63 from the front.
        let lowest = 63 - exponent;
        for bit in (0..64).filter(|bit| mantissa >> bit & 1 == 1) {
            let place = usize::try_from(lowest - bit).expect("a number beyond the range");
            result.0[place / 64] |= 1 << (63 - place % 64);
        }
        result
    }

    /// Returns the exact value of a finite, non-negative `value`.
    pub(crate) fn of(value: f64) -> Self {
        let (mantissa, exponent) = parts(value);
        Self::scaled(mantissa, exponent)
    }

    pub(crate) fn to_f64(self) -> f64 {
        let mut weight = 1.0;
        let mut sum = 0.0;
        for word in self.0 {
            sum += word as f64 * weight;
            weight *= 0.5_f64.powi(64);
        }
        sum
    }

    fn is_zero(&self) -> bool {
        self.0.iter().all(|word| *word == 0)
    }

    pub(crate) fn distance(self, other: Self) -> Self {
        if self > other {
            self.sub(other)
        } else {
            other.sub(self)
        }
    }
}

/// Returns the mantissa and the exponent of |value|, for a finite `value`.
pub(crate) fn parts(value: f64) -> (u64, i32) {
    let bits = value.abs().to_bits();
    let biased = (bits >> 52) as i32;
    let fraction = bits & ((1 << 52) - 1);
    if biased == 0 {
        (fraction, -1074)
    } else {
        (fraction | 1 << 52, biased - 1075)
    }
}

/// Computes π/2 = 8 arctan(1/5) − 2 arctan(1/239).
fn half_pi<const L: usize>() -> Fixed<L> {
    let arctangent = |inverse: u64, factor: u64| {
        let mut power = Fixed::<L>::integer(factor).div(inverse);
        let mut sum = power;
        for k in 1.. {
            power = power.div(inverse * inverse);
            let term = power.div(2 * k + 1);
            if term.is_zero() {
                break;
            }
            sum = if k % 2 == 1 {
                sum.sub(term)
            } else {
                sum.add(term)
            };
        }
        sum
    };
    arctangent(5, 8).sub(arctangent(239, 2))
}

/// Sine or cosine as sign and magnitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Signed {
    pub(crate) negative: bool,
    pub(crate) size: Fixed<SHORT>,
}

impl Signed {
    /// Returns |value − self|.
    pub(crate) fn error(&self, value: f64) -> f64 {
        let other = Fixed::of(value.abs());
        if value.is_sign_negative() == self.negative {
            self.size.distance(other).to_f64()
        } else {
            self.size.add(other).to_f64()
        }
    }
}

/// Computes reference values; stores π/2.
pub(crate) struct Reference {
    half_pi: Fixed<LONG>,
}

impl Reference {
    pub(crate) fn new() -> Self {
        Self { half_pi: half_pi() }
    }

    /// Returns the sine and cosine of the sum of finite positive numbers.
    pub(crate) fn sin_cos(&self, angle: &[f64]) -> (Signed, Signed) {
        let mut quarter = 0;
        let mut rest = Fixed::ZERO;
        for part in angle {
            let (more, reduced) = self.reduce(part.abs());
            if *part >= 0.0 {
                quarter += more;
                rest = rest.add(reduced);
                if rest >= self.half_pi {
                    rest = rest.sub(self.half_pi);
                    quarter += 1;
                }
            } else {
                quarter -= more;
                if rest < reduced {
                    rest = rest.add(self.half_pi);
                    quarter -= 1;
                }
                rest = rest.sub(reduced);
            }
        }
        let mut short = Fixed::<SHORT>::ZERO;
        short.0.copy_from_slice(&rest.0[..SHORT]);
        let (sine, cosine) = (series(short, 1), series(short, 0));
        let signed = |negative, size| Signed { negative, size };
        match quarter.rem_euclid(4) {
            0 => (signed(false, sine), signed(false, cosine)),
            1 => (signed(false, cosine), signed(true, sine)),
            2 => (signed(true, sine), signed(true, cosine)),
            _ => (signed(true, cosine), signed(false, sine)),
        }
    }

    /// Returns the number of quarter turns in an angle modulo 4, and the remainder.
    fn reduce(&self, angle: f64) -> (i32, Fixed<LONG>) {
        let (mantissa, exponent) = parts(angle);
        let unit = Fixed::<LONG>::scaled(1, exponent.min(0));
        let (mut quarter, mut rest) = (0, Fixed::ZERO);
        let bits = (0..53).rev().map(|bit| mantissa >> bit & 1 == 1);
        let zeros = (0..exponent.max(0)).map(|_| false);
        for bit in bits.chain(zeros) {
            quarter = 2 * quarter % 4;
            rest = rest.add(rest);
            if bit {
                rest = rest.add(unit);
            }
            while rest >= self.half_pi {
                rest = rest.sub(self.half_pi);
                quarter += 1;
            }
        }
        (quarter, rest)
    }
}

/// Computes Σ (−1)^k x^(2k+first)/(2k+first)!.
fn series(x: Fixed<SHORT>, first: u64) -> Fixed<SHORT> {
    let square = x.mul(x);
    let mut term = if first == 0 { Fixed::integer(1) } else { x };
    let (mut plus, mut minus) = (Fixed::ZERO, Fixed::ZERO);
    for k in 0_u64.. {
        if term.is_zero() {
            break;
        }
        if k % 2 == 0 {
            plus = plus.add(term);
        } else {
            minus = minus.add(term);
        }
        let n = 2 * k + first;
        term = term.mul(square).div((n + 1) * (n + 2));
    }
    // Negative only by rounding, if the true value is a hundred digits smaller than any that tests
    // need.
    if plus < minus {
        Fixed::ZERO
    } else {
        plus.sub(minus)
    }
}

/// Returns non-negative angles for tests: all exponents, neighbourhoods of multiples of π/2, dense
/// near zero.
pub(crate) fn angles(per_kind: usize) -> Vec<f64> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut random = move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state
    };
    let mut angles = std::vec![
        // Of all `f64`, the one closest to a multiple of π/2 (Muller, §11.3.2).
        6_381_956_970_095_103.0 * 2.0_f64.powi(797),
        f64::MAX,
        102_943.0,
        102_942.999_999_999_99,
        1_647_099.0,
    ];
    for _ in 0..per_kind {
        // Any finite number above 2⁻³⁰.
        let exponent = 993 + random() % (2047 - 993);
        angles.push(f64::from_bits(exponent << 52 | random() >> 12));
        // Up to half a turn, uniformly.
        angles.push((random() >> 11) as f64 * 2.0_f64.powi(-53) * std::f64::consts::PI);
        // The common range.
        angles.push((random() >> 11) as f64 * 2.0_f64.powi(-53) * 103_000.0);
        // Close to multiples of π/2.
        let multiple = (1 + random() % (1 << (1 + random() % 20))) as f64;
        let near = multiple * std::f64::consts::FRAC_PI_2;
        angles.push(f64::from_bits(near.to_bits().wrapping_add(random() % 3)));
    }
    angles
}

#[test]
fn the_reference_knows_pi_and_simple_angles() {
    let half_pi: Fixed<LONG> = half_pi();
    assert_eq!(half_pi.0[0], 1);
    // A. Hurwitz's digits of π in hexadecimal: 3.243F6A8885A308D31319…
    assert_eq!(half_pi.0[1], 0x921f_b544_42d1_8469);
    let (sine, cosine) = Reference::new().sin_cos(&[1.0]);
    assert_eq!(sine.size.to_f64(), 0.841_470_984_807_896_5);
    assert_eq!(cosine.size.to_f64(), 0.540_302_305_868_139_8);
    let (sine, cosine) = Reference::new().sin_cos(&[4.0, -1.0]);
    assert_eq!(sine.size.to_f64(), 0.141_120_008_059_867_2);
    assert!(cosine.negative && !sine.negative);
}
