//! Apparatus whose modes in phase resonate with each other.

use super::{SIX, grid, of, snapped, tongues};

/// f_2 is nearly 3 f_1: the motion in phase is resonant itself. Edges of both tongues by simulation.
#[test]
fn six_has_both_tongues() {
    let form = of(SIX, 8);
    let resonances = form.form().resonances().iter();
    let names: Vec<String> = resonances.map(ToString::to_string).collect();
    assert!(names.contains(&"3 f_1 = f_2".to_owned()), "{names:?}");
    for (part, edges) in [([12.0, 20.0], [14.0, 18.0]), ([31.0, 42.0], [32.5, 40.5])] {
        let found = tongues(&form, 20.0, &grid(part[0], part[1]));
        let [own] = found.tongues.as_slice() else {
            panic!("{found:?}")
        };
        assert!(found.refused.is_empty(), "{found:?}");
        for (own, edge) in snapped(own).iter().zip(edges) {
            assert!((own - edge).abs() <= 0.5, "{own} {edge}");
        }
    }
}
