//! What `describe` says of trees, of small ones and of large ones.

use super::{Folder, Y, command};

#[test]
fn links_parameters_and_sectors_are_listed() {
    let folder = Folder::new("describe");
    let y = folder.file("y.txt", Y);
    let text = folder.answer(&["describe", "--tree", &y, "--set", "stiffness=4"]);
    for reported in [
        "y.txt: 3 links; the tree stands",
        "stiffness = 4: spring of `arm`, N m",
        "sectors: in_phase, d",
        "rests with all angles zero",
    ] {
        assert!(text.contains(reported), "{reported}: {text}");
    }
    assert!(folder.read("results/tree.svg").contains("<svg"));
}

#[test]
fn springs_between_links_are_described_with_their_numbers() {
    let folder = Folder::new("describe-between");
    let text =
        "gravity = 9.8, a: rod(mass = 0.1, length = 0.2) [b: rod(mass = 0.1, length = 0.2) * 2],
        siblings(b, friction = c), between(a, b_2, spring = 0.3, rest = 0.1)";
    let tree = folder.file("tree.txt", text);
    let printed = folder.answer(&["describe", "--tree", &tree, "--set", "c=1e-4"]);
    assert!(
        printed.contains("  b_1, b_2: friction 0.0001 N m s\n"),
        "{printed}"
    );
    assert!(
        printed.contains("  a, b_2: spring 0.3 N m, at rest at 0.1 rad\n"),
        "{printed}"
    );
    assert!(
        printed.contains("c = 0.0001: friction of `siblings(b)`, N m s"),
        "{printed}"
    );
}

/// Trees of tens of thousands of links, and springs between each two of 2,000 copies: what takes time in proportion to
/// the square of the links would need minutes, and a matrix of all entries gigabytes.
#[test]
fn large_trees_are_described() {
    let folder = Folder::new("describe-large");
    let rule = "gravity = 9.81, a: generations(count = 15, branching = 2, shape = rod, mass = 0.1, length = 0.3,
                 mass_ratio = 0.5, length_ratio = 0.8)";
    let copies = "gravity = 9.81, hub: rod(mass = 1, length = 0.5) [
        arm: rod(mass = 0.1, length = 0.2) * 2000
    ], siblings(arm, spring = 0.01)";
    for (name, text, links, reported) in [
        ("rule", rule, 32_767, "rests with all angles zero"),
        (
            "copies",
            copies,
            2_001,
            "arm_1, arm_2 … arm_1999, arm_2000 (1999000 pairs): spring 0.01",
        ),
    ] {
        let tree = folder.file(&format!("{name}.txt"), text);
        let output = command(&["describe", "--tree", &tree]).output().unwrap();
        let printed = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success(), "{name}");
        assert!(printed.contains(&format!("{links} links;")), "{name}");
        assert!(printed.contains(reported), "{name}: {printed:.2000}");
        assert!(printed.lines().count() > links);
    }
}

/// Straight springs are described, `simulate` takes them, and says why there is no W.
#[test]
fn straight_springs_are_described_and_taken() {
    let folder = Folder::new("describe-straight");
    let text =
        "gravity = 9.8, a: rod(mass = 0.1, length = 0.2) [b: rod(mass = 0.1, length = 0.2) * 2],
        guy(a, at = 0.2, to = (0.3, 0), spring = k, rest = 0.1, friction = 0.2),
        siblings(b, at = 0.1, spring = 2), between(a, b_1, at = 0.1, repulsion = m, exponent = 3)";
    let tree = folder.file("tree.txt", text);
    let tree = ["--tree", &tree, "--set", "k=3", "--set", "m=1e-5"];
    let printed = folder.answer(&[&["describe"][..], &tree].concat());
    for line in [
        "between points\n  guy(a): spring 3 N/m, at rest at 0.1 m; friction 0.2 N s/m\n",
        "  siblings(b): spring 2 N/m, at rest at 0 m\n",
        "  between(a, b_1): repulsion 0.00001 J m³\n",
        "k = 3: spring of `guy(a)`, N/m",
        "m = 0.00001: repulsion of `between(a, b_1)`, J m³",
    ] {
        assert!(printed.contains(line), "{line}: {printed}");
    }
    let words = ["--start", "20,40,-10", "--duration", "1"];
    let printed = folder.answer(&[&["simulate"][..], &tree, &words].concat());
    assert!(printed.contains("no H_d and no W"), "{printed}");
    assert!(printed.contains("straight spring `guy(a)`"), "{printed}");
}
