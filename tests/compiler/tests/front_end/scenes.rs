//! Descriptions and scenes of small trees, as text.

use branched_pendulum_codegen::scene::{Quantity, Scene};

use branched_pendulum_compiler_tests::front_end::{run, run_source, scene};

const PAPER: &str = "#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = 2e-5) * 2
    ],
    emit(energies, momenta, modes, symmetric, transfer(angle = 1, amplitude = 2, exact)),
)]
/// The paper's apparatus.
#[derive(Debug)]
pub(crate) struct BranchedDouble;";

const PARAMETERS: &str = "#[branched_pendulum(
    crate = my::pendulums,
    gravity = g,
    arm(mass = m, com = (l / 2, e), inertia = m * l^2 / 12, joint = (l, -e), friction = c) [
        hand(mass = m / 2 + 0.1, com = -l * 2 / 4, inertia = 0.5e-3, at = (l - 0.01 - 2 * e, 0)),
        weight: disc(mass = mw, length = 0, radius = r, friction = 0),
    ],
)]
struct Robot;";

const RULE: &str = "#[branched_pendulum(
    gravity = 9.8,
    stem: rod(mass = 1, length = 1) [
        tree: generations(count = 3, branching = 2, shape = rod, mass = 0.12, length = 0.3,
            mass_ratio = 1 / 2, length_ratio = q, friction = 1e-5, at = 0.9),
    ],
)]
struct Tree;";

const NESTED: &str = "#[branched_pendulum(
    gravity = 9.8,
    body: rod(mass = 1, length = 1) [
        arm: rod(mass = 0.5, length = 0.5) [
            hand: point(mass = 0.1, length = 0.1) * 3,
            watch: point(mass = 0.05, length = 0.01, at = 0.4),
        ] * 2,
        head: ball(mass = 0.2, length = 0.1, radius = 0.1, at = -0.2),
    ],
    emit(symmetric),
)]
struct Person;";

const SHAPES: &str = "#[branched_pendulum(
    gravity = 9.8,
    hub(mass = 1, com = 0, inertia = 1, joint = 0) [
        point: point(mass = 2, length = 3),
        rod: rod(mass = 2, length = 3),
        rod_with_bob: rod_with_bob(mass = 2, length = 3, bob_mass = 1),
        cylinder: cylinder(mass = 2, length = 3, radius = 1),
        plate: plate(mass = 2, length = 3, width = 1),
        holes: plate(mass = 2, length = 3, width = 1, margin = 0.1) [
            lower: point(mass = 1, length = 1),
        ],
        disc: disc(mass = 2, length = 3, radius = 1),
        ring: ring(mass = 2, length = 3, radius = 1),
        ball: ball(mass = 2, length = 3, radius = 1),
        shell: shell(mass = 2, length = 3, radius = 1),
        trimmed: rod(mass = 2, length = 3, com = (1, 0.1), inertia = 1, joint = (2, 0.2)) [
            tip: point(mass = 1, length = 1),
        ],
    ],
)]
struct Shapes;";

fn description(source: &str) -> String {
    let description = run_source(source).description;
    description.expect("the item is a struct").to_string()
}

#[test]
fn paper() {
    insta::assert_snapshot!("paper_description", description(PAPER));
    insta::assert_snapshot!("paper_scene", scene(PAPER));
}

#[test]
fn parameters() {
    insta::assert_snapshot!("parameters_description", description(PARAMETERS));
    insta::assert_snapshot!("parameters_scene", scene(PARAMETERS));
}

#[test]
fn generation_rule() {
    insta::assert_snapshot!("rule_description", description(RULE));
    insta::assert_snapshot!("rule_scene", scene(RULE));
}

#[test]
fn nested_copies() {
    insta::assert_snapshot!("nested_scene", scene(NESTED));
}

#[test]
fn shapes() {
    insta::assert_snapshot!("shapes_scene", scene(SHAPES));
}

/// Invariants on which later stages rely.
fn assert_invariants(scene: &Scene) {
    for (i, link) in scene.links.iter().enumerate() {
        assert_eq!(link.parent.is_none(), i == 0);
        assert!(link.parent.is_none_or(|parent| parent.0 < i));
        assert!(
            scene.orbits[link.orbit.0]
                .links
                .iter()
                .any(|copy| copy.0 == i)
        );
        let subtree_is_contiguous = (i..scene.links.len())
            .skip(1)
            .map(|j| ancestors(scene, j).contains(&i))
            .is_sorted_by(|a, b| a >= b);
        assert!(subtree_is_contiguous);
    }
    for orbit in &scene.orbits {
        let first = &scene.links[orbit.links[0].0];
        for &copy in &orbit.links {
            let copy_link = &scene.links[copy.0];
            assert_eq!(ancestors(scene, copy.0).len(), orbit.depth);
            assert_eq!(copy_link.mass, first.mass);
            assert_eq!(copy_link.inertia, first.inertia);
            assert_eq!(copy_link.com, first.com);
            assert_eq!(copy_link.pivot, first.pivot);
            assert_eq!(copy_link.passive, first.passive);
        }
    }
    for group in &scene.groups {
        assert!(group.copies.len() > 1);
        let orbit = scene.links[group.copies[0].0].orbit;
        for copy in &group.copies {
            assert_eq!(scene.links[copy.0].parent, group.parent);
            assert_eq!(scene.links[copy.0].orbit, orbit);
        }
    }
}

fn ancestors(scene: &Scene, mut link: usize) -> Vec<usize> {
    let mut ancestors = Vec::new();
    while let Some(parent) = scene.links[link].parent {
        link = parent.0;
        ancestors.push(link);
    }
    ancestors
}

#[test]
fn invariants_hold() {
    for source in [PAPER, PARAMETERS, RULE, NESTED, SHAPES] {
        assert_invariants(&scene(source));
    }
}

/// Moment of inertia about the pivot of a body of many small pieces, given as
/// (mass, along, lateral) from the pivot.
fn second_moment(pieces: impl Iterator<Item = (f64, f64, f64)>) -> (f64, f64, f64) {
    let (mut mass, mut first, mut second) = (0.0, 0.0, 0.0);
    for (m, x, y) in pieces {
        mass += m;
        first += m * x;
        second += m * (x * x + y * y);
    }
    (mass, first / mass, second)
}

/// The formulas of the shapes against sums over their pieces; mass 2, length 3.
#[test]
fn shapes_have_the_inertia_of_their_pieces() {
    const N: usize = 400;
    let middle = |i: usize| (i as f64 + 0.5) / N as f64;
    let square = || (0..N * N).map(move |i| (middle(i / N), middle(i % N)));
    let piece = 2.0 / (N * N) as f64;
    let rod = || (0..N).map(|i| (2.0 / N as f64, 3.0 * middle(i), 0.0));
    let turn = std::f64::consts::TAU;
    // A piece of a round body of radius 1 at the distance r of its axis.
    let round = |r: f64, phi: f64| (piece, 3.0 + r * phi.cos(), r * phi.sin());
    let expected = [
        ("rod", second_moment(rod())),
        (
            "rod_with_bob",
            second_moment(rod().chain([(1.0, 3.0, 0.0)])),
        ),
        (
            "plate",
            second_moment(square().map(|(x, y)| (piece, 3.0 * x, y - 0.5))),
        ),
        (
            "holes",
            second_moment(square().map(|(x, y)| (piece, 3.0 * x - 0.1, y - 0.5))),
        ),
        (
            "disc",
            second_moment(square().map(|(a, b)| round(a.sqrt(), turn * b))),
        ),
        (
            "ring",
            second_moment(square().map(|(_, b)| round(1.0, turn * b))),
        ),
        (
            "shell",
            second_moment(square().map(|(a, b)| {
                // Pieces of equal height have equal area.
                let height = 2.0 * a - 1.0;
                round((1.0 - height * height).sqrt(), turn * b)
            })),
        ),
        (
            // Slices of equal height are discs that weigh as their area; a disc
            // has the second moment of a ring of 1/√2 of its radius.
            "ball",
            second_moment(square().map(|(a, b)| {
                let height = 2.0 * a - 1.0;
                let area = 1.0 - height * height;
                let (_, x, y) = round((area / 2.0).sqrt(), turn * b);
                (1.5 * piece * area, x, y)
            })),
        ),
        (
            // A slice across the axis is a disc, as above a ring of radius
            // 1/√2, and only its extent in the plane of motion counts.
            "cylinder",
            second_moment(
                square().map(|(a, b)| (piece, 3.0 * a, (turn * b).cos() / 2.0_f64.sqrt())),
            ),
        ),
    ];
    let scene = scene(SHAPES);
    for (name, (mass, com, second)) in expected {
        let link = scene.links.iter().find(|link| link.name == name);
        let link = link.expect("the scene has a link of every shape");
        let value = |quantity: &Quantity| quantity.exact().expect("a literal").to_f64();
        let (m, d, i) = (
            value(&link.mass),
            value(&link.com.along),
            value(&link.inertia),
        );
        // The midpoint rule is wrong by a few parts in N².
        let close = |a: f64, b: f64| (a - b).abs() < 4.0 / (N * N) as f64 * b.abs();
        let about_pivot = i + m * d * d;
        assert!(close(m, mass), "{name}: mass {m}, {mass}");
        assert!(close(d, com), "{name}: com {d}, {com}");
        assert!(
            close(about_pivot, second),
            "{name}: {about_pivot}, {second}"
        );
    }
}

#[test]
fn the_struct_survives() {
    let description = run_source(PAPER).description.expect("the item is a struct");
    let item = description.item;
    assert_eq!(item.ident, "BranchedDouble");
    let (vis, attrs) = (&item.vis, &item.attrs);
    let kept = quote::quote!(#(#attrs)* #vis).to_string();
    let written: proc_macro2::TokenStream =
        "#[doc = \" The paper's apparatus.\"] #[derive(Debug)] pub(crate)"
            .parse()
            .expect("these are tokens");
    assert_eq!(kept, written.to_string());
}

/// A fragment from `macro_rules!` is one value: `$x * 2` is twice all of it.
#[test]
fn fragments_keep_together() {
    use proc_macro2::{Delimiter, Group, TokenTree};
    let fragment: TokenTree = Group::new(Delimiter::None, quote::quote!(1 + 2)).into();
    let attribute = quote::quote!(
        gravity = #fragment * 2,
        bob: point(mass = 1, length = 1)
    );
    let scene = run(
        attribute,
        quote::quote!(
            struct Bob;
        ),
    )
    .scene;
    let gravity = scene.expect("nothing is wrong").gravity;
    assert_eq!(gravity, Quantity::integer(6));
}

/// Unlike in Rust, `^` is a power and binds tighter than all else.
#[test]
fn powers_bind_tightest() {
    for (value, expected) in [
        ("-2^2 + 10", 6),
        ("2 * 3^2", 18),
        ("18 / 3^2 / -2 + 4", 3),
        ("8 - 3 - 2", 3),
        ("1 - -2", 3),
        ("(1 + 1)^(3)", 8),
        ("36 * 6^-1", 6),
        ("1e1 / 2.5 * 4", 16),
    ] {
        let source = format!(
            "#[branched_pendulum(gravity = {value}, a: rod(mass = 1, length = 1))] struct A;"
        );
        assert_eq!(
            scene(&source).gravity,
            Quantity::integer(expected),
            "{value}"
        );
    }
}

#[test]
fn every_property_of_a_rule_has_a_ratio() {
    let by_rule = scene(
        "#[branched_pendulum(gravity = 9.8,
            a: generations(count = 3, branching = 1, shape = plate, mass = 0.4, length = 0.3,
                width = 0.1, margin = 0.02, mass_ratio = 0.5, length_ratio = 0.8,
                width_ratio = 0.9, margin_ratio = 0.5, joint = (0.2, 0.01), joint_ratio = 0.7,
                friction = 1e-3, friction_ratio = 0.6, drag = 2e-3, drag_ratio = 3,
                spring = 0.1, spring_ratio = 0.25, rest = 0.2, rest_ratio = -1),
        )] struct Chain;",
    );
    let link = |n: i32, children: &str| {
        format!(
            "a_{n}: plate(mass = 0.4 * 0.5^{n}, length = 0.3 * 0.8^{n}, width = 0.1 * 0.9^{n},
                margin = 0.02 * 0.5^{n}, joint = (0.2 * 0.7^{n}, 0.01 * 0.7^{n}),
                friction = 1e-3 * 0.6^{n}, drag = 2e-3 * 3^{n}, spring = 0.1 * 0.25^{n},
                rest = 0.2 * (-1)^{n}) [{children}]"
        )
    };
    let links = link(0, &link(1, &link(2, "")));
    let source = format!("#[branched_pendulum(gravity = 9.8, {links})] struct Chain;");
    let written = scene(&source);
    for (by_rule, written) in by_rule.links.iter().zip(&written.links) {
        let named = branched_pendulum_codegen::scene::Link {
            name: written.name.clone(),
            ..by_rule.clone()
        };
        assert_eq!(named, *written);
    }
    assert_eq!(by_rule.links.len(), 3);
}

#[test]
fn declared_parameters_stand_in_their_order() {
    let scene = scene(
        "#[branched_pendulum(gravity = g, parameters(m, l, g,),
            parameters: rod(mass = m, length = l) [b: rod(mass = 2 * m, length = l)],
        )] struct Pendulum;",
    );
    let names: Vec<&str> = scene.parameters.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["m", "l", "g"]);
    assert_eq!(scene.links[0].name, "parameters");
    assert_eq!(scene.parameters[2].doc, "gravity, m/s²");
}

#[test]
fn gravity_may_point_up() {
    let scene = scene(
        "#[branched_pendulum(gravity = -9.8,
            a: rod(mass = 1, length = 1, spring = 10, rest = 0.1))] struct Upright;",
    );
    assert!(scene.gravity.exact().is_some_and(|g| g.is_negative()));
}

/// A tree stands where a minus is written before all of its gravity.
#[test]
fn gravity_says_whether_a_tree_stands() {
    for (gravity, stands) in [
        ("9.8", false),
        ("-9.8", true),
        ("0", false),
        ("3 - 12.8", true),
        ("g", false),
        ("-g", true),
        ("g * -2", true),
        ("-g / k", true),
        ("-g - 1", true),
        ("1 - g", false),
        ("-(g - k)", true),
        ("-(-g)", false),
        ("g^3", false),
    ] {
        let scene = scene(&format!(
            "#[branched_pendulum(gravity = {gravity}, a: rod(mass = 1, length = 1))] struct A;"
        ));
        assert_eq!(scene.stands(), stands, "{gravity}");
        assert_eq!(scene.requirements.is_empty(), scene.parameters.is_empty());
    }
}
