//! Points as trackers name them, and pivots that are none of them.

use branched_pendulum_data::{AngleColumns, FileKind, Markers, read_angles};

use super::{assert_read, by_points, table};

/// Two links of 0.5 and 1 that hang at two pairs of angles, from a pivot at (0.25, -1).
const PIVOT: [f64; 2] = [0.25, -1.0];

fn bobs() -> [[f64; 4]; 3] {
    [[0.3, -0.2], [0.25, -0.1], [0.2, 0.0]].map(|[one, two]: [f64; 2]| {
        let a = [PIVOT[0] + 0.5 * one.sin(), PIVOT[1] - 0.5 * one.cos()];
        [a[0], a[1], a[0] + two.sin(), a[1] - two.cos()]
    })
}

const EXPECTED: [&[f64]; 3] = [&[0.3, -0.2], &[0.25, -0.1], &[0.2, 0.0]];
const TIMES: [f64; 3] = [0.0, 0.5, 1.0];

/// A table of the pivot and both bobs, or of the bobs alone.
fn film(header: &str, has_pivot: bool) -> String {
    let mut text = format!("{header}\n");
    for (time, [a, b, c, d]) in TIMES.iter().zip(bobs()) {
        let [x, y] = PIVOT;
        let pivot = if has_pivot {
            format!("{x},{y},")
        } else {
            String::new()
        };
        text += &format!("{time},{pivot}{a},{b},{c},{d}\n");
    }
    text
}

#[test]
fn points_are_named_before_and_behind_their_axes() {
    for (header, [top, one, two]) in [
        (
            "t,top_x,top_y,red_x,red_y,blue_x,blue_y",
            ["top", "red", "blue"],
        ),
        (
            "t,x_top,y_top,x_red,y_red,x_blue,y_blue",
            ["top", "red", "blue"],
        ),
        (
            "t,top X,top Y,red X,red Y,blue X,blue Y",
            ["top", "red", "blue"],
        ),
        ("t,topX,topY,redX,redY,blueX,blueY", ["top", "red", "blue"]),
        ("t,x0,y0,x1,y1,x2,y2", ["0", "1", "2"]),
        ("t,X_0,Y_0,X_1,Y_1,X_2,Y_2", ["0", "1", "2"]),
        ("t,p0x,p0y,p1x,p1y,p2x,p2y", ["p0", "p1", "p2"]),
        (
            "t,x_m0 [m],y_m0 [m],x_m1 [m],y_m1 [m],x_m2 [m],y_m2 [m]",
            ["m0", "m1", "m2"],
        ),
        ("t,x_{0},y_{0},x_{1},y_{1},x_{2},y_{2}", ["0", "1", "2"]),
        (
            "t,top.x,top.y,left_bob.x,left_bob.y,end.x,end.y",
            ["top", "left bob", "end"],
        ),
    ] {
        let text = film(header, true);
        let read = by_points(&text, &[(top, one), (one, two)]).expect(header);
        assert_read(&read, &TIMES, &EXPECTED);
    }
}

/// Two points and a pivot that is none of them: by place, as the first of the links, in
/// Tracker's exports and others.
#[test]
fn a_pivot_is_a_place() {
    let place = format!("{},{}", PIVOT[0], PIVOT[1]);
    for header in [
        "t,a_x,a_y,b_x,b_y",
        "t,x1,y1,x2,y2",
        ",mass A,,mass B,\nt,x,y,x,y",
        "#multi:\n,mass_A,,mass_B,\nt,x,y,x,y",
    ] {
        let table = table(&film(header, false));
        let markers = Markers {
            pivot: Some(PIVOT),
            ..Markers::default()
        };
        let read = read_angles(&table, &AngleColumns::default(), &markers).expect(header);
        assert_read(&read, &TIMES, &EXPECTED);
        let [one, two] = [0, 1].map(|index| table.tracks()[index].name.clone());
        let links = [(place.as_str(), one.as_str()), (one.as_str(), two.as_str())];
        let read = by_points(&film(header, false), &links).expect(header);
        assert_read(&read, &TIMES, &EXPECTED);
    }
}

/// A single bob about the origin of the axes.
#[test]
fn a_bob_about_the_origin() {
    let angles = [0.3, 0.25, -0.2_f64];
    let rows: Vec<&[f64]> = angles.iter().map(std::slice::from_ref).collect();
    for (header, end, name) in [
        ("t,x,y", "", "point"),
        ("mass_A\nt,x,y", "", "mass A"),
        ("mass_A\nt,x,y,v_{x},v_{y}", ",0.1,0.2", "mass_A"),
        ("t [s],bob x [cm],bob y [cm],v [m/s]", ",0.3", "bob"),
        (
            "mass_A\nt,x,y,v_{x},v_{y},a_{x},a_{y},θ,ω",
            ",,,,,1,1",
            "mass_A",
        ),
    ] {
        let mut text = format!("{header}\n");
        for (time, angle) in TIMES.iter().zip(angles) {
            text += &format!("{time},{},{}{end}\n", 0.5 * angle.sin(), -0.5 * angle.cos());
        }
        let tracks = table(&text).tracks().len();
        assert_eq!(tracks, 1, "{header}");
        assert_read(
            &by_points(&text, &[("origin", name)]).expect(header),
            &TIMES,
            &rows,
        );
        let markers = Markers {
            pivot: Some([0.0; 2]),
            ..Markers::default()
        };
        let read = read_angles(&table(&text), &AngleColumns::default(), &markers).unwrap();
        assert_read(&read, &TIMES, &rows);
        assert!(read.links[0].name.starts_with("origin to "));
        // Without a word about the pivot it is no angle.
        let error = by_points(&text, &[]).unwrap_err();
        assert!(error.contains("or give the place of the pivot"), "{error}");
    }
}

/// Velocities beside the coordinates of Tracker's points are left alone.
#[test]
fn tracker_exports_velocities() {
    let text = "\tmass A\t\t\t\tmass B\nt\tx\ty\tv_{x}\tv_{y}\tx\ty\tv_{x}\tv_{y}\n\
        0\t0\t0\t\t\t0.3\t-0.4\t\t\n0.5\t0\t0\t1\t2\t0.4\t-0.3\t3\t4\n1\t0\t0\t\t\t0.5\t0\t\t\n";
    let table = table(text);
    assert_eq!(table.kind(), FileKind::Tracker);
    let names: Vec<&str> = table.columns().iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names[3..5], ["mass A v_x", "mass A v_y"]);
    let angles = [0.3_f64.atan2(0.4), 0.4_f64.atan2(0.3), 0.5_f64.atan2(0.0)];
    let rows: Vec<&[f64]> = angles.iter().map(std::slice::from_ref).collect();
    assert_read(&by_points(text, &[]).unwrap(), &TIMES, &rows);
    assert_read(
        &by_points(text, &[("mass_A", "mass B")]).unwrap(),
        &TIMES,
        &rows,
    );
}

/// Points that are not there are told with those that are, or with what is needed.
#[test]
fn points_that_are_missing_are_told() {
    let text = film("t,x1,y1,x2,y2", false);
    for (links, expected) in [
        (&[("0", "1")][..], "there is no track `0`; there are: 1, 2"),
        (
            &[("1", "2"), ("1", "2")],
            "the link from `1` to `2` is named twice",
        ),
        (
            &[("1", "3,nan")],
            "there is no track `3,nan`; there are: 1, 2",
        ),
    ] {
        assert_eq!(
            by_points(&text, links).unwrap_err(),
            format!("swing.csv: {expected}")
        );
    }
    let none = "t,alpha,beta\n0.0,1,2\n0.1,1,2\n0.2,1,2\n";
    assert_eq!(
        by_points(none, &[("red", "green")]).unwrap_err(),
        "swing.csv: there is no track `red`, nor another: the columns `t`, `alpha`, `beta` hold \
         no NAME_x beside a NAME_y"
    );
    let markers = Markers {
        pivot: Some([0.0, f64::NAN]),
        ..Markers::default()
    };
    let error = markers.read(&table(&text)).unwrap_err();
    assert_eq!(error.to_string(), "swing.csv: a pivot at (0, NaN)");
}
