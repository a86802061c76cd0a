//! Advice about directions, units and friction.

use std::f64::consts::PI;

use branched_pendulum_data::{Table, TableOptions};

use super::super::{Arguments, Source};
use super::causes::{CHAIN, RADIANS, camera, dots, judge, starts};
use super::hung;
use crate::frame::command_line::parse_line;

/// A unit in the header is right: no advice overrules it, and an option that does is doubtful.
#[test]
fn a_unit_in_the_header_is_not_overruled() {
    for (record, (header, unit, other)) in starts().iter().zip([
        ("t [s],a [deg],b [deg]", "degrees", "rad"),
        ("t [s],a (rad),b (rad)", "radians", "deg"),
        ("t [s],a (rad),b", "radians", "deg"),
    ]) {
        let text = record.table(header, |_, a| match unit {
            "degrees" => a.to_vec(),
            _ => a.map(f64::to_degrees).to_vec(),
        });
        let table = Table::parse("swing.csv", &text, &TableOptions::default()).unwrap();
        let arguments: Arguments = parse_line(&format!("swing.csv {CHAIN}")).unwrap();
        match unit {
            "degrees" => {
                let (verdict, closing) = judge(&text, CHAIN);
                assert!(!verdict.closes());
                let is_of_unit = |option: &String| option.contains("--unit");
                assert!(!closing.iter().any(is_of_unit), "{closing:?}");
            }
            // Degrees that are taken for radians jump, and are refused.
            _ => assert!(Source::read(&table, &arguments, &hung(&arguments)).is_err()),
        }
        let line = format!("swing.csv {CHAIN} --unit {other}");
        let arguments: Arguments = parse_line(&line).unwrap();
        let source = Source::read(&table, &arguments, &hung(&arguments)).unwrap();
        let doubts = source.findings.iter().map(ToString::to_string);
        let doubts: Vec<String> = doubts.filter(|own| own.starts_with("doubtful")).collect();
        assert!(
            doubts
                .iter()
                .any(|own| own.contains(&format!("columns name {unit}"))),
            "{doubts:?}"
        );
    }
}

/// Angles from the x axis, to the right or to the left, of moderate swings and of turns.
#[test]
fn angles_from_the_horizontal_are_named() {
    for (record, side) in starts().iter().zip([-0.5, 0.5, -0.5]) {
        let text = record.table(RADIANS[0], |_, a| a.map(|a| a + side * PI).to_vec());
        let tilt = format!("--tilt {}", 180.0 * side);
        let (verdict, closing) = judge(&text, CHAIN);
        assert!(!verdict.closes());
        assert_eq!(closing.first(), Some(&format!("{tilt} --zero down")));
        // The vertical is looked for in angles that have lost the tilt.
        if side < 0.0 {
            assert!(
                judge(&text, &format!("{CHAIN} {tilt} --zero down"))
                    .0
                    .closes()
            );
        }
    }
    let [one, ..] = starts();
    let text = one.table(RADIANS[0], |_, a| a.map(|a| a - 0.5 * PI).to_vec());
    assert!(judge(&text, &format!("{CHAIN} --tilt -90")).0.closes());
}

/// y downwards with friction that is not known: both are named, the larger one first.
fn assert_two_causes(films: &[(f64, f64, u64)]) {
    for (angle, friction, seed) in films {
        let record = camera(
            &format!("--real viscous_1={friction},viscous_2={friction}"),
            *angle,
            *seed,
        );
        let options = "--tree apparatus --set viscous_1=0,viscous_2=0";
        let (verdict, closing) = judge(&dots(&record, -1.0, true), options);
        assert!(!verdict.closes());
        let first = closing.first().map_or("", String::as_str);
        assert!(first.starts_with("--y-down --set "), "{closing:?}");
    }
}

#[test]
fn two_causes_are_named_together() {
    assert_two_causes(&[(75.0, 3e-4, 2)]);
}

#[test]
#[ignore = "`.ci/more` runs it"]
fn also_of_other_films_two_causes_are_named_together() {
    assert_two_causes(&[(60.0, 5e-4, 3), (47.8, 4e-4, 1)]);
}
