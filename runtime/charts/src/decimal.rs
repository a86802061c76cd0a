/// Returns true if `digits` × 10^`exponent`, whose leading digit is in the decade `leading`, is
/// easier to read written out than with a power of ten.
pub(crate) const fn reads_plain(leading: i32) -> bool {
    -3 <= leading && leading <= 4
}

/// Returns the decade of the leading digit of `digits` × 10^`exponent`; for zero, the decade of the
/// unit.
pub(crate) fn leading_decade(digits: i64, exponent: i32) -> i32 {
    match digits.unsigned_abs().checked_ilog10() {
        Some(log) => exponent + log as i32,
        None => 0,
    }
}

/// Writes out `digits` × 10^`exponent` exactly, with a proper minus sign. Zero is `0` for every
/// exponent.
pub(crate) fn plain(digits: i64, exponent: i32) -> String {
    if digits == 0 {
        return "0".into();
    }
    let sign = if digits < 0 { "−" } else { "" };
    let text = digits.unsigned_abs().to_string();
    if exponent >= 0 {
        let zeros = "0".repeat(exponent.unsigned_abs() as usize);
        return format!("{sign}{text}{zeros}");
    }
    let decimals = exponent.unsigned_abs() as usize;
    let padded = format!("{text:0>width$}", width = decimals + 1);
    let (whole, fraction) = padded.split_at(padded.len() - decimals);
    format!("{sign}{whole}.{fraction}")
}

/// Returns the power of ten as label markup.
pub(crate) fn power(exponent: i32) -> String {
    format!("10^{{{}}}", plain(i64::from(exponent), 0))
}

/// Returns `digits` × 10^`exponent` as label markup: written out if that is easy to read, otherwise
/// with a power of ten.
pub(crate) fn number(mut digits: i64, mut exponent: i32) -> String {
    while digits != 0 && digits % 10 == 0 {
        digits /= 10;
        exponent += 1;
    }
    let leading = leading_decade(digits, exponent);
    if reads_plain(leading) {
        return plain(digits, exponent);
    }
    if digits == 1 {
        return power(leading);
    }
    let mantissa = plain(digits, exponent - leading);
    format!("{mantissa}×{}", power(leading))
}
