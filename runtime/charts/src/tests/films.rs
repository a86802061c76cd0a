use crate::{ChartError, Film, FilmLink};

fn chain() -> [FilmLink; 2] {
    let link = |parent, pivot, end| FilmLink {
        parent,
        pivot: [pivot, 0.0],
        end: [end, 0.0],
    };
    [link(None, 0.0, 0.3), link(Some(0), 0.3, 0.2)]
}

#[test]
fn links_turn_by_the_angle_to_their_parents() {
    let pictures = [[0.5, 0.5], [0.5, 0.0]];
    let film = Film::new("Two", 0.1).tree("", &chain(), &pictures).unwrap();
    let svg = film.to_svg().unwrap();
    let degrees = 0.5_f64.to_degrees();
    // The root stays where it is; the other one hangs straight, then turns back.
    let values = svg.split("values=\"").skip(1);
    let values: Vec<&str> = values.map(|rest| rest.split('"').next().unwrap()).collect();
    assert_eq!(
        values,
        [
            format!("-{degrees:.2};-{degrees:.2}"),
            format!("0;{degrees:.2}")
        ]
    );
    assert!(svg.contains("dur=\"0.100s\""));
    assert_eq!(
        svg.matches("<g ").count() + svg.matches("<g>").count(),
        svg.matches("</g>").count()
    );
}

/// Every link lies within the picture, hanging or standing.
#[test]
fn a_film_holds_its_trees_at_all_times() {
    let pictures: Vec<[f64; 2]> = (0..50)
        .map(|i| [0.13 * f64::from(i), -0.4 * f64::from(i)])
        .collect();
    for turn in [0.0, std::f64::consts::PI] {
        let pictures = pictures
            .iter()
            .map(|angles| angles.map(|angle| turn - angle));
        let pictures: Vec<[f64; 2]> = pictures.collect();
        let mut film = Film::new("Three", 0.1).size(500.0, 2);
        for label in ["a", "b", "c"] {
            film = film.tree(label, &chain(), &pictures).unwrap();
        }
        let svg = film.to_svg().unwrap();
        let scale = film.scale().unwrap();
        // Turning round, the chain reaches half a metre from each pivot.
        let between = |name: &str| -> Vec<f64> {
            let found = svg.split(name).skip(1);
            let number = found.map(|rest| rest.split(['"', ' ', ')']).next().unwrap());
            number.filter_map(|number| number.parse().ok()).collect()
        };
        let width = between("width=\"")[0];
        let height = between("height=\"")[0];
        let roots: Vec<f64> = between("<g transform=\"translate(")
            .into_iter()
            .filter(|x| *x > 0.0)
            .collect();
        assert_eq!(width, 500.0);
        assert!(roots.len() >= 3 && roots.iter().all(|x| *x < width));
        assert!(scale > 0.0 && 2.0 * 0.5 * scale < width / 2.0 && 0.5 * scale * 2.0 < height);
    }
}

#[test]
fn what_cannot_be_filmed_is_said() {
    let film = || Film::new("Two", 0.1);
    let mut links = chain();
    links[0].parent = Some(1);
    let error = film().tree("", &links, &[[0.0; 2]]).unwrap_err();
    assert!(matches!(error, ChartError::Link { link: 0 }));
    let error = film()
        .tree("", &chain(), &[vec![0.0; 2], vec![0.0]])
        .unwrap_err();
    assert!(matches!(
        error,
        ChartError::Picture {
            picture: 1,
            found: 1,
            links: 2
        }
    ));
    let error = film().tree("", &chain(), &[[0.0, f64::NAN]]).unwrap_err();
    assert!(matches!(error, ChartError::Picture { picture: 0, .. }));
    assert!(matches!(film().to_svg(), Err(ChartError::Empty { .. })));
    assert!(matches!(film().to_png(), Err(ChartError::Empty { .. })));
    let still = film()
        .size(f64::NAN, 1)
        .tree("", &chain(), &[[0.0; 2]])
        .unwrap();
    assert!(matches!(still.to_svg(), Err(ChartError::Size { .. })));
}
