//! Combinations of phases that stay slow together.

use super::resonance::Resonance;

/// Integer multiples of the phases of the modes in phase.
pub(super) type Multiples = Vec<i64>;

/// Returns independent combinations of the phases in phase on which the motion depends: those of
/// the resonances, without the phases of the differences. Two resonances of one difference, as
/// 2 d = f_1 + f_2 and 2 d = 2 f_1, leave the multiples (1, −1).
pub(super) fn slow_phases<'a>(
    resonances: impl IntoIterator<Item = &'a Resonance>,
) -> Vec<Multiples> {
    let row = |own: &Resonance| -> Vec<i64> {
        let both = own.differences.iter().chain(&own.in_phase);
        both.map(|n| i64::from(*n)).collect()
    };
    let mut rows: Vec<Vec<i64>> = Vec::new();
    let mut of_differences = 0;
    for resonance in resonances {
        of_differences = resonance.differences.len();
        rows.push(row(resonance));
    }
    let columns = rows.first().map_or(0, Vec::len);
    let mut independent = Vec::new();
    for column in 0..columns {
        let Some(place) = rows.iter().position(|row| row[column] != 0) else {
            continue;
        };
        let pivot = rows.swap_remove(place);
        for row in &mut rows {
            let [own, other] = [row[column], pivot[column]];
            for (value, pivot_value) in row.iter_mut().zip(&pivot) {
                *value = *value * other - own * pivot_value;
            }
            make_primitive(row);
        }
        if column >= of_differences {
            let mut own = pivot[of_differences..].to_vec();
            make_primitive(&mut own);
            independent.push(own);
        }
    }
    independent
}

/// Divides integers by their greatest common divisor.
fn make_primitive(row: &mut [i64]) {
    let divisor = row.iter().fold(0, |divisor, own| gcd(divisor, *own).0);
    if divisor > 1 {
        row.iter_mut().for_each(|own| *own /= divisor);
    }
}

/// Returns integers h with g·h = 1 for primitive multiples g.
pub(super) fn one_turn(multiples: &[i64]) -> Vec<i64> {
    let mut turn: Vec<i64> = Vec::with_capacity(multiples.len());
    let mut divisor = 0;
    for own in multiples {
        let (next, before, here) = gcd(divisor, *own);
        turn.iter_mut().for_each(|value| *value *= before);
        turn.push(here);
        divisor = next;
    }
    turn
}

/// Returns the greatest common divisor d ≥ 0 of two integers, and x and y with x a + y b = d.
fn gcd(a: i64, b: i64) -> (i64, i64, i64) {
    let (mut one, mut two) = ((a, 1, 0), (b, 0, 1));
    while two.0 != 0 {
        let quotient = one.0 / two.0;
        let next = (
            one.0 - quotient * two.0,
            one.1 - quotient * two.1,
            one.2 - quotient * two.2,
        );
        (one, two) = (two, next);
    }
    match one.0 < 0 {
        true => (-one.0, -one.1, -one.2),
        false => one,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn resonance(in_phase: &[i32], differences: &[i32]) -> Resonance {
        Resonance {
            in_phase: in_phase.to_vec(),
            differences: differences.to_vec(),
        }
    }

    #[test]
    fn differences_are_eliminated() {
        let pumps = [resonance(&[1, 1], &[-2]), resonance(&[4, 0], &[-2])];
        let [own] = slow_phases(&pumps).try_into().unwrap();
        assert_eq!(
            own.iter().map(|n| n * own[0].signum()).collect::<Vec<_>>(),
            [3, -1]
        );
        // The internal resonance is the same combination.
        let all = [pumps.as_slice(), &[resonance(&[6, -2], &[0])]].concat();
        assert_eq!(slow_phases(&all).len(), 1);
        let other = [pumps.as_slice(), &[resonance(&[2, -1], &[0])]].concat();
        assert_eq!(slow_phases(&other).len(), 2);
        assert!(slow_phases(&pumps[..1]).is_empty());
        assert!(
            slow_phases(&[resonance(&[2, 0], &[-1, -1]), resonance(&[0, 0], &[1, -1])]).is_empty()
        );
    }

    #[test]
    fn a_turn_of_the_slow_phase_has_integer_phases() {
        for multiples in [vec![3, -1], vec![6, 10, 15], vec![0, 1], vec![-4, 9, 0]] {
            let turn = one_turn(&multiples);
            assert_eq!(
                multiples.iter().zip(&turn).map(|(a, b)| a * b).sum::<i64>(),
                1
            );
        }
    }
}
