//! Remainders of large angles modulo π/2 (Payne and Hanek).

/// Bits of the number 2/π from the weight 2⁶³ downwards, enough for every `f64`.
const TWO_OVER_PI: [u64; 22] = [
    0,
    0xa2f9_836e_4e44_1529,
    0xfc27_57d1_f534_ddc0,
    0xdb62_9599_3c43_9041,
    0xfe51_63ab_debb_c561,
    0xb724_6e3a_424d_d2e0,
    0x0649_2eea_09d1_921c,
    0xfe1d_eb1c_b129_a73e,
    0xe882_35f5_2ebb_4484,
    0xe99c_7026_b45f_7e41,
    0x3991_d639_8353_39f4,
    0x9c84_5f8b_bdf9_283b,
    0x1ff8_97ff_de05_980f,
    0xef2f_118b_5a0a_6d1f,
    0x6d36_7ecf_27cb_09b7,
    0x4f46_3f66_9e5f_ea2d,
    0x7527_bac7_ebe5_f17b,
    0x3d07_39f7_8a52_92ea,
    0x6bfb_5fb1_1f8d_5d08,
    0x5603_3046_fc7b_6bab,
    0xf0cf_bc20_9af4_361d,
    0xa9e3_9161_5ee6_1b08,
];

/// The number π/2 · 2¹⁹¹, most significant word first.
const HALF_PI: [u64; 3] = [
    0xc90f_daa2_2168_c234,
    0xc4c6_628b_80dc_1cd1,
    0x2902_4e08_8a67_cc74,
];

/// Returns the number of the multiple of π/2 nearest to a finite `angle`, modulo 4, and the signed
/// distance from it as a sum of three numbers that do not overlap.
///
/// The distance is accurate to a factor of 1 ± 2⁻¹³⁰: the fraction of 2x/π is accurate to 2⁻²⁰⁰,
/// and no `f64` except zero comes closer to a multiple of π/2 than 2⁻⁶² (J.-M. Muller, Elementary
/// Functions, 3rd ed. 2016, §11.3.2).
pub(crate) fn modulo_half_pi(angle: f64) -> (u64, [f64; 3]) {
    let bits = angle.to_bits();
    let biased = ((bits >> 52) & 0x7ff) as usize;
    // Below 2⁻¹ an angle is its own remainder.
    if biased < 1022 {
        return (0, [angle, 0.0, 0.0]);
    }
    // |angle| = integer · 2^exponent with an integer of 53 bits.
    let integer = (bits & ((1 << 52) - 1)) | (1 << 52);
    // Bits of 2/π of weight above 2^(1 − exponent) give multiples of 4, so the window begins at
    // that weight. The table begins at 2⁶³.
    let start = biased + 63 - 1 - 1075;
    let mut fraction = product(integer, window(start));
    // Two integer bits, then the fraction of 2|x|/π.
    let mut quarter = fraction[0] >> 62;
    fraction = shift_left(fraction, 2);
    let above_half = fraction[0] >> 63 == 1;
    if above_half {
        quarter += 1;
        fraction = negate(fraction);
    }
    let zeros = leading_zeros(fraction);
    let [a, b, c, _] = shift_left(fraction, zeros);
    let distance = times_half_pi([a, b, c]);
    // times_half_pi returns units of 2⁻¹⁹¹.
    let mut scale = power_of_two(zeros);
    let negative = bits >> 63 == 1;
    if above_half != negative {
        scale = -scale;
    }
    if negative {
        quarter = quarter.wrapping_neg();
    }
    (quarter, components(distance, scale))
}

/// Returns 256 bits of the table of 2/π, from bit `start` on.
fn window(start: usize) -> [u64; 4] {
    let (word, shift) = (start / 64, start % 64);
    let at = |index: usize| TWO_OVER_PI.get(index).copied().unwrap_or(0);
    core::array::from_fn(|i| {
        let (high, low) = (at(word + i), at(word + i + 1));
        if shift == 0 {
            high
        } else {
            high << shift | low >> (64 - shift)
        }
    })
}

/// Returns the low 256 bits of `factor * number`.
fn product(factor: u64, number: [u64; 4]) -> [u64; 4] {
    let mut result = [0; 4];
    let mut carry = 0;
    for i in (0..4).rev() {
        let sum = u128::from(factor) * u128::from(number[i]) + carry;
        result[i] = low_word(sum);
        carry = sum >> 64;
    }
    result
}

/// Returns the high 192 bits of `number` · π/2, in units of 2⁻¹⁹¹ for a `number` in units of 2⁻¹⁹².
fn times_half_pi(number: [u64; 3]) -> [u64; 3] {
    let mut result = [0_u64; 6];
    for i in (0..3).rev() {
        let mut carry = 0;
        for j in (0..3).rev() {
            let place = i + j + 1;
            let sum =
                u128::from(number[i]) * u128::from(HALF_PI[j]) + u128::from(result[place]) + carry;
            result[place] = low_word(sum);
            carry = sum >> 64;
        }
        result[i] = low_word(carry);
    }
    let [a, b, c, ..] = result;
    [a, b, c]
}

#[allow(clippy::cast_possible_truncation)]
fn low_word(value: u128) -> u64 {
    value as u64
}

fn negate(number: [u64; 4]) -> [u64; 4] {
    let mut result = [0; 4];
    let mut carry = true;
    for i in (0..4).rev() {
        (result[i], carry) = (!number[i]).overflowing_add(u64::from(carry));
    }
    result
}

fn shift_left(number: [u64; 4], by: u32) -> [u64; 4] {
    let (words, bits) = ((by / 64) as usize, by % 64);
    let at = |index: usize| number.get(index).copied().unwrap_or(0);
    core::array::from_fn(|i| {
        let (high, low) = (at(i + words), at(i + words + 1));
        if bits == 0 {
            high
        } else {
            high << bits | low >> (64 - bits)
        }
    })
}

fn leading_zeros(number: [u64; 4]) -> u32 {
    let mut zeros = 0;
    for word in number {
        zeros += word.leading_zeros();
        if word != 0 {
            break;
        }
    }
    zeros
}

/// Returns 2⁻ⁿ, for n up to 256.
fn power_of_two(n: u32) -> f64 {
    f64::from_bits((1023 - u64::from(n)) << 52)
}

/// Converts 192 bits in units of 2⁻¹⁹¹, times `scale`, to three numbers that do not overlap.
#[allow(clippy::cast_precision_loss)]
fn components(number: [u64; 3], scale: f64) -> [f64; 3] {
    let [a, b, c] = number;
    // Pieces of 48 bits are exact, and so are the sums of neighbouring ones.
    const PIECE: u64 = (1 << 48) - 1;
    let pieces = [
        a >> 16,
        (a << 32 | b >> 32) & PIECE,
        (b << 16 | c >> 48) & PIECE,
        c & PIECE,
    ];
    let mut weight = scale * 2.0 * power_of_two(48);
    let mut sum = [0.0; 3];
    for piece in pieces {
        let mut term = piece as f64 * weight;
        for part in &mut sum {
            let high = *part + term;
            // Exact, because the terms decrease in magnitude.
            term -= high - *part;
            *part = high;
        }
        weight *= power_of_two(48);
    }
    sum
}
