//! Parameters for targets, of functions whose solutions are known.

use branched_pendulum_measure::design::{
    Design, DesignError, DesignSearch, DesignTarget, DesignVariable, Goal, Side,
};

fn search(variables: &[(&str, [f64; 2], f64)], goals: &[Goal]) -> DesignSearch {
    let variable = |(name, range, present): &(&str, [f64; 2], f64)| {
        DesignVariable::new(*name, *range).with_present(*present)
    };
    let goals = goals.iter().enumerate();
    let goals = goals.map(|(index, goal)| DesignTarget::new(format!("t{index}"), *goal));
    DesignSearch::new(variables.iter().map(variable).collect(), goals.collect()).unwrap()
}

fn near(found: &[f64], expected: &[f64], error: f64) {
    assert_eq!(found.len(), expected.len());
    let mut both = found.iter().zip(expected);
    assert!(
        both.all(|(a, b)| (a - b).abs() < error),
        "{found:?} {expected:?}"
    );
}

/// From the present value, no step downhill leads to the solutions.
#[test]
fn a_local_minimum_is_no_answer() {
    // The minimum next to −1 is 0.5; the zeros are on both sides of 2.
    let valley = |x: f64| (x + 1.0).powi(2) * (x - 2.0).powi(2) - 0.5 * x;
    let design = search(&[("x", [-3.0, 3.0], -1.0)], &[Goal::Equal(0.0)]);
    let found = design.run(&|x| Ok(vec![valley(x[0])])).unwrap();
    assert!(found.is_reached && found.others.len() == 1, "{found:?}");
    let solutions = [found.parameters[0], found.others[0][0]];
    assert!(
        solutions.iter().all(|x| valley(*x).abs() < 1e-6),
        "{found:?}"
    );
    assert!(1.5 < solutions[0] && solutions[0] < 2.0 && 2.0 < solutions[1]);
}

#[test]
fn the_solution_nearest_to_the_present_values_comes_first() {
    let design = search(&[("x", [-4.0, 3.0], 1.0)], &[Goal::Equal(4.0)]);
    let found = design.run(&|x| Ok(vec![x[0] * x[0]])).unwrap();
    near(&found.parameters, &[2.0], 1e-6);
    near(&found.others[0], &[-2.0], 1e-6);
    near(&found.sensitivities[0], &[4.0], 1e-5);
    assert!(found.is_isolated() && found.cause(design.variables()).is_none());
}

#[test]
fn more_parameters_than_targets_leave_a_direction_open() {
    // The point of 2x + y = 5 nearest to (1, 1), and the direction (1, −2), of which y changes by
    // its width.
    let variables = [("x", [0.0, 4.0], 1.0), ("y", [0.0, 4.0], 1.0)];
    let design = search(&variables, &[Goal::Equal(5.0)]);
    let found = design.run(&|x| Ok(vec![2.0 * x[0] + x[1]])).unwrap();
    near(&found.parameters, &[1.8, 1.4], 1e-3);
    let [open] = found.open_directions.as_slice() else {
        panic!("{found:?}");
    };
    assert!((open[1] / open[0] + 2.0).abs() < 1e-6 && (open[1].abs() - 4.0).abs() < 1e-9);
    assert!(!found.is_isolated());
}

#[test]
fn limits_hold_without_becoming_equations() {
    let variables = [("x", [0.0, 4.0], 1.0), ("y", [0.0, 4.0], 1.0)];
    let goals = [Goal::Equal(6.0), Goal::AtLeast(2.5), Goal::AtMost(3.0)];
    let design = search(&variables, &goals);
    let found = design.run(&|x| Ok(vec![x[0] + x[1], x[0], x[1]])).unwrap();
    near(&found.parameters, &[3.0, 3.0], 1e-3);
    assert!(found.has_slack && found.values[1] >= 2.5);
}

#[test]
fn the_bound_that_holds_the_target_is_named() {
    let variables = [("x", [0.0, 2.0], 1.0), ("y", [1.0, 3.0], 2.0)];
    let design = search(&variables, &[Goal::Equal(10.0), Goal::Equal(1.5)]);
    let found = design.run(&|x| Ok(vec![x[0] * x[0], x[1]])).unwrap();
    assert!(!found.is_reached);
    near(&found.parameters, &[2.0, 1.5], 1e-5);
    assert_eq!(found.bounds, [Some(Side::Upper), None]);
    assert_eq!(found.holds, [true, false]);
    let cause = found.cause(design.variables()).unwrap();
    assert!(
        cause.contains("`x` is held at 2") && cause.contains("widen"),
        "{cause}"
    );
}

#[test]
fn targets_that_exclude_each_other_are_missed_without_a_bound() {
    let design = search(
        &[("x", [0.0, 9.0], 1.0)],
        &[Goal::Equal(2.0), Goal::Equal(3.0)],
    );
    let found = design.run(&|x| Ok(vec![x[0], x[0]])).unwrap();
    // Misses are relative: (x/2 − 1)² + (x/3 − 1)² is smallest at 30/13.
    near(&found.parameters, &[30.0 / 13.0], 1e-5);
    let cause = found.cause(design.variables()).unwrap();
    assert!(cause.contains("exclude each other"), "{cause}");
}

#[test]
fn the_end_of_the_values_is_no_bound() {
    let design = search(&[("x", [0.0, 2.0], 0.5)], &[Goal::Equal(1.8)]);
    let until = |x: &[f64]| match x[0] < 1.25 {
        true => Ok(vec![x[0]]),
        false => Err("the series does not converge".to_owned()),
    };
    let found = design.run(&until).unwrap();
    assert!((1.24..1.25).contains(&found.parameters[0]), "{found:?}");
    assert!(found.starts[1] > 0 && found.starts[1] < found.starts[0]);
    let cause = found.cause(design.variables()).unwrap();
    assert!(cause.contains("does not converge"), "{cause}");
    let nowhere = design.run(&|_| Err("unphysical".to_owned()));
    let error = nowhere.unwrap_err();
    assert!(matches!(error, DesignError::Undefined { starts: 26, .. }));
    assert!(error.to_string().ends_with("unphysical"));
}

#[test]
fn ranges_and_goals_are_checked() {
    let new = |range: [f64; 2], goal: f64| {
        let variables = vec![DesignVariable::new("x", range)];
        DesignSearch::new(variables, vec![DesignTarget::new("t", Goal::Equal(goal))])
    };
    let message = |range, goal| new(range, goal).unwrap_err().to_string();
    assert!(message([2.0, 1.0], 1.0).contains("`x` cannot vary from 2 to 1"));
    assert!(message([f64::NAN, 1.0], 1.0).contains("finite"));
    assert!(message([0.0, 1.0], f64::INFINITY).contains("`t`"));
    let twice = vec![DesignVariable::new("x", [0.0, 1.0]); 2];
    let target = vec![DesignTarget::new("t", Goal::Equal(1.0))];
    let error = DesignSearch::new(twice, target).unwrap_err();
    assert_eq!(
        error,
        DesignError::Twice {
            name: "x".to_owned()
        }
    );
    assert_eq!(
        DesignSearch::new(Vec::new(), Vec::new()),
        Err(DesignError::Nothing)
    );
    assert_eq!(Design::TOLERANCE, 1e-6);
}
