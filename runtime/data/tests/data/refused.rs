//! Tables that are not what they are taken for.

use std::f64::consts::{FRAC_PI_4, TAU};

use branched_pendulum_data::{AngleColumns, AngleUnit, AngleZero, Basis, Markers, read_angles};

use super::{assert_read, by_columns, table};

/// Rows of so many numbers that swing with other sizes and phases.
fn rows(header: &str, columns: usize) -> String {
    let mut text = format!("{header}\n");
    for row in 0..40 {
        let time = 0.02 * f64::from(row);
        text += &format!("{time}");
        for column in 0..columns {
            let size = 0.31 + 0.2 * column as f64;
            text += &format!(",{}", size * (4.0 * time + size).cos());
        }
        text.push('\n');
    }
    text
}

/// Named columns win, whatever else the table has; where nothing is named and it has angles
/// and points, it is asked which.
#[test]
fn named_columns_win_over_points() {
    for header in [
        "t,theta1,theta2,tip_x,tip_y",
        "t,tip_x,tip_y,theta1,theta2",
        "t,theta1,theta2,a_x,a_y,b_x,b_y",
        "t,theta1,x_a,y_a,x_b,y_b,theta2",
    ] {
        let text = rows(header, header.matches(',').count());
        let read = by_columns(&text, &["theta2", "theta1"]).expect(header);
        let names: Vec<&str> = read.links.iter().map(|link| link.name.as_str()).collect();
        assert_eq!(names, ["theta2", "theta1"]);
        let error = by_columns(&text, &[]).unwrap_err();
        assert!(
            error.starts_with(
                "swing.csv: there are columns of angles (`theta1`, `theta2`) and points ("
            ),
            "{error}"
        );
    }
}

/// What is called like something else is no angle, unless it is named as one.
#[test]
fn names_of_other_quantities_are_no_angles() {
    for (header, column, quantity) in [
        ("t,pos1,pos2,vel1,vel2,tau1,tau2", "vel1", "a velocity"),
        ("t,theta,omega", "omega", "a velocity"),
        (
            "t,theta1,theta2,theta1_dot,theta2_dot",
            "theta1_dot",
            "a velocity",
        ),
        ("t,phi,dphi", "dphi", "a velocity"),
        ("t,theta,ddtheta", "ddtheta", "an acceleration"),
        ("t,angle,angular velocity", "angular velocity", "a velocity"),
        ("t,theta,v,a", "v", "a velocity"),
        ("t,theta,a", "a", "an acceleration"),
        ("t,θ1,ω1", "ω1", "a velocity"),
        ("t,joint,torque", "torque", "a torque"),
        ("t,q1,q2,current1", "current1", "a current or a voltage"),
        ("t,arm,Force", "Force", "a force"),
        ("t,x,theta", "x", "a coordinate"),
        ("t,x_cart,arm", "x_cart", "a coordinate"),
        ("t,arm,z", "z", "a coordinate"),
        ("time,x1,v1,x2,v2", "x1", "a coordinate"),
        ("t,th1,th2,w1,w2", "w1", "a velocity"),
        ("t,theta1,theta2,E", "E", "an energy or a power"),
        ("t,phi,p", "p", "a momentum"),
        ("t,jointPos,jointVel", "jointVel", "a velocity"),
        ("t,theta1,theta1Dot", "theta1Dot", "a velocity"),
        ("t,angle,AngVel", "AngVel", "a velocity"),
        ("t,arm,accel", "accel", "an acceleration"),
        ("t,arm,likelihood", "likelihood", "a score"),
    ] {
        let text = rows(header, header.matches(',').count());
        let error = by_columns(&text, &[]).unwrap_err();
        let expected = format!(
            "swing.csv: the name of column `{column}` suggests {quantity}, not an angle; name the \
             columns of the angles, or the points"
        );
        assert_eq!(error, expected);
        assert_eq!(by_columns(&text, &[column]).unwrap().links.len(), 1);
    }
    // Components of a rate are no points either.
    let text = rows("t,Gyroscope x (rad/s),Gyroscope y (rad/s)", 2);
    let error = by_columns(&text, &[]).unwrap_err();
    assert!(
        error.contains("`Gyroscope x` is in `rad/s`, which is not a unit"),
        "{error}"
    );
    for header in [
        "t,a,b",
        "t,p,q",
        "t,upper,lower",
        "t,pos1,pos2",
        "t,q1,q2",
        "t,left a,left b",
        "t,angle_x,angle_y",
    ] {
        let read = by_columns(&rows(header, 2), &[]).expect(header);
        assert_eq!(read.links.len(), 2, "{header}");
    }
}

/// The coordinates of a bob in metres are no angles, whatever they are called.
#[test]
fn an_arc_is_no_pair_of_angles() {
    let arc = |header: &str, radius: f64, centre: f64| {
        let mut text = header.to_owned();
        for row in 0..60 {
            let time = 0.02 * f64::from(row);
            let angle = 0.6 * (5.0 * time).cos();
            // Some noise of a tracker.
            let noise = 0.002 * radius * f64::from((row * 7) % 5 - 2);
            let [x, y] = [radius * angle.sin() + noise, centre - radius * angle.cos()];
            text += &format!("{time},{x},{y}\n");
        }
        text
    };
    for (text, names) in [
        (arc("t,first,second\n", 0.25, 0.0), "`first` and `second`"),
        (arc("", 0.5, 0.0), "`column 2` and `column 3`"),
        (arc("t,p,q\n", 0.3, 0.8), "`p` and `q`"),
    ] {
        let error = by_columns(&text, &[]).unwrap_err();
        let expected = format!("swing.csv: columns {names} lie on a circle of radius 0.");
        assert!(error.starts_with(&expected), "{error}");
    }
    // A unit says that they are angles.
    let named = by_columns(&arc("t,p [rad],q [rad]\n", 0.3, 0.8), &[]);
    assert_eq!(named.unwrap().links.len(), 2);
    assert_eq!(
        by_columns(&arc("t,p,q\n", 0.3, 0.8), &["p", "q"])
            .unwrap()
            .links
            .len(),
        2
    );
}

/// Two angles of a smooth motion are read, be they on an arc for a while or not.
#[test]
fn pairs_of_angles_are_no_points() {
    for case in 0..400 {
        let [one, two] = [0.37, 0.59].map(|part| TAU * (part * f64::from(case)).fract());
        let size = 0.4 + 0.002 * f64::from(case);
        let length = 12 + case % 97;
        let rate = [100.0, 240.0, 1000.0][case as usize % 3];
        let mut text = String::from("t,p,q\n");
        for row in 0..length {
            let time = f64::from(row) / rate;
            let a = size * (6.1 * time + one).cos() + 0.1 * (14.7 * time).cos();
            let b = 0.7 * (5.3 * time + two).cos() - 0.3 * (14.7 * time).cos();
            text += &format!("{time},{a:.5},{b:.5}\n");
        }
        let read = by_columns(&text, &[]);
        assert_eq!(read.map(|read| read.links.len()), Ok(2), "{case}");
    }
}

/// Angles without a unit are radians where they may be, with a doubt that comes first, and
/// are asked about where they hardly are.
#[test]
fn angles_without_a_unit_are_doubtful() {
    let swing = |size: f64, digits: usize| {
        let mut text = "t,a\n".to_owned();
        for row in 0..100 {
            let time = 0.01 * f64::from(row);
            text += &format!("{time},{:.digits$}\n", size * (6.0 * time).cos());
        }
        text
    };
    for (size, digits) in [(0.8, 4), (2.1, 5), (0.05, 3), (1.5, 2)] {
        let read = by_columns(&swing(size, digits), &[]).unwrap();
        assert_eq!(read.findings[0].basis, Basis::Doubtful);
        assert!(
            read.findings[0]
                .text
                .starts_with("angles in radians, since")
        );
        let first: f64 = format!("{size:.digits$}").parse().unwrap();
        assert_eq!(read.links[0].angle(0), Some(first));
    }
    // Beyond a turn, to and fro by more than one, in whole numbers, in tenths.
    for (size, digits) in [(12.0, 4), (6.3, 3), (5.0, 4), (3.3, 3), (4.0, 0), (2.5, 1)] {
        let text = swing(size, digits);
        let error = by_columns(&text, &[]).unwrap_err();
        let expected = "swing.csv: column `a` names no unit, and its values, up to ";
        assert!(error.starts_with(expected), "{error}");
        assert!(
            error.ends_with("may be degrees or radians; give the unit"),
            "{error}"
        );
        for (unit, size_of) in [
            (AngleUnit::Radians, 1.0),
            (AngleUnit::Degrees, 1_f64.to_radians()),
        ] {
            let columns = AngleColumns {
                unit: Some(unit),
                zero: Some(AngleZero::Down),
                ..AngleColumns::default()
            };
            let read = columns.read(&table(&text)).unwrap();
            let first: f64 = format!("{size:.digits$}").parse().unwrap();
            assert_eq!(read.links[0].angle(0), Some(first * size_of));
            assert!(
                read.findings
                    .iter()
                    .all(|f| !f.text.contains("since no column"))
            );
        }
    }
    // Jumps of a turn are those of radians.
    let mut text = "t,a\n".to_owned();
    for row in 0..100 {
        let time = 0.01 * f64::from(row);
        let angle = 9.0 * time + 1.0;
        text += &format!("{time},{:.4}\n", angle - TAU * (angle / TAU).round());
    }
    let read = by_columns(&text, &[]).unwrap();
    let reported: Vec<String> = read.findings.iter().map(ToString::to_string).collect();
    assert!(
        reported.contains(&"assumed: angles in radians".to_owned()),
        "{reported:?}"
    );
}

/// Options that contradict each other or the table.
#[test]
fn options_that_cannot_apply_are_refused() {
    let text = rows("t,a,b,note", 2)
        .replace("\n", ",on\n")
        .replacen(",on", "", 1);
    for (columns, expected) in [
        (
            &["a", "a"][..],
            "column `a` is named twice; each link has one of its own",
        ),
        (
            &["a", "b", "a"],
            "column `a` is named twice; each link has one of its own",
        ),
        (
            &["t", "a"],
            "column `t` is the time; name the columns of the angles",
        ),
    ] {
        assert_eq!(
            by_columns(&text, columns).unwrap_err(),
            format!("swing.csv: {expected}")
        );
    }
    let error = by_columns(&text, &["a", "note"]).unwrap_err();
    assert_eq!(
        error,
        "swing.csv, line 2, column 4 (`note`): `on` is not a number"
    );
    let error = by_columns("t,a,b\n0.0,1.01,\n0.1,1.02,\n0.2,1.03,\n", &["b"]).unwrap_err();
    assert_eq!(error, "swing.csv: column `b` holds no number");

    let points = table(&rows("t,p_x,p_y,q_x,q_y", 4));
    let pivot = Markers {
        pivot: Some([0.0; 2]),
        ..Markers::default()
    };
    let y_down = Markers {
        y_down: Some(true),
        ..Markers::default()
    };
    let zero = AngleColumns {
        zero: Some(AngleZero::Up),
        ..AngleColumns::default()
    };
    let named = AngleColumns {
        columns: vec!["p_x".to_owned()],
        ..AngleColumns::default()
    };
    for (columns, markers) in [(&zero, &pivot), (&named, &y_down), (&named, &pivot)] {
        let error = read_angles(&points, columns, markers).unwrap_err();
        assert!(
            error.to_string().contains("are asked for together"),
            "{error}"
        );
    }
    // What is said of columns or of points alone is not dropped for the others.
    let error = read_angles(&points, &zero, &Markers::default()).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("the name of column `p_x` suggests a coordinate"),
        "{error}"
    );
    let angles = table(&rows("t,a,b", 2));
    let error = read_angles(&angles, &AngleColumns::default(), &y_down).unwrap_err();
    assert!(
        error.to_string().contains("0 tracks; a link needs two"),
        "{error}"
    );
    let links = Markers {
        links: vec![branched_pendulum_data::LinkMarkers {
            upper: "p".to_owned(),
            lower: "q".to_owned(),
        }],
        ..pivot
    };
    let error = links.read(&points).unwrap_err();
    assert!(
        error.to_string().contains("the pivot next to named points"),
        "{error}"
    );
}

/// A link that is read by its name alone has the numbers of its column.
#[test]
fn a_named_column_is_that_column() {
    let text = "t,x,y,theta [deg]\n0.0,1,2,45\n0.1,1,2,22.5\n0.2,1,2,-45\n";
    let read = by_columns(text, &["theta"]).unwrap();
    assert_read(
        &read,
        &[0.0, 0.1, 0.2],
        &[&[FRAC_PI_4], &[0.5 * FRAC_PI_4], &[-FRAC_PI_4]],
    );
}
