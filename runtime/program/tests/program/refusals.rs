//! What makes no sense is refused with its reason, and with what to write.

use super::{Folder, TRIPLE, command};

fn refusal(words: &[&str], code: i32) -> String {
    let output = command(words).output().unwrap();
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(code), "{words:?}: {text}");
    text
}

#[test]
fn trees_without_copies_have_no_differences() {
    let folder = Folder::new("refusals");
    let triple = folder.file("triple.txt", TRIPLE);
    for command in ["growth", "map", "transfer"] {
        let output = folder.run(&[command, "--tree", &triple]);
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{text}");
        assert!(
            text.contains("copies") && text.contains("* 2"),
            "{command}: {text}"
        );
    }
}

#[test]
fn mistakes_are_named_with_their_place() {
    let folder = Folder::new("mistakes");
    let wrong = folder.file(
        "wrong.txt",
        "gravity = 9.81,\narm: rod(mas = 0.2, length = 0.3)",
    );
    let text = refusal(&["describe", "--tree", &wrong], 1);
    assert!(
        text.contains("--> 2:10") && text.contains("did you mean `mass`?"),
        "{text}"
    );
    let chain = folder.file("chain.txt", "gravity = g, rod: rod(mass = 0.2, length = l)");
    let text = refusal(&["describe", "--tree", &chain, "--set", "g=9.8"], 1);
    assert!(text.contains("no value for `l`"), "{text}");
    let text = refusal(&["describe", "--tree", &chain, "--set", "g=9.8,l=-1"], 1);
    assert!(text.contains("must be finite and positive"), "{text}");
    for (words, code, reported) in [
        (
            &["describe", "--tree", "nowhere.txt"][..],
            1,
            "there is no tree `nowhere.txt`: it is neither a shipped tree (paper, apparatus, double-pendulum, \
             chain, triple, y, branch, coupled, cascade) nor",
        ),
        (
            &["simulate", "--start", "1,2"],
            1,
            "2 numbers for 3 links: parent, child_1, child_2",
        ),
        (
            &["simulate", "--start", "twig=3"],
            1,
            "there is no link `twig`",
        ),
        (
            &["simulate", "--duration", "0"],
            2,
            "must be from 0.01 to 100000 s",
        ),
        (&["simulate", "--set", "friction"], 2, "is not `NAME=VALUE`"),
        (
            &["growth", "--pair", "parent,child"],
            1,
            "are not copies of each other",
        ),
        (&["map", "--x", "child=0:10"], 2, "is not an axis"),
        (&["map", "--x", "mass=0:1:0.5"], 1, "is neither a link"),
        (&["map", "--link", "child"], 2, "add `--of flip`"),
        (&["map", "--x", "child=0:10:x2"], 2, "is not an axis"),
        (&["map", "--x", "child+mass=0:10:5"], 1, "no link `mass`"),
        (&["map", "--of", "flip", "--modes"], 2, "`--of growth`"),
        (&["map", "--mark", "3"], 2, "is not a point `X:Y`"),
        (&["map", "--tongues", "friction=0"], 1, "on neither axis"),
        (
            &["map", "--modes", "--x", "child_1=0:9:9"],
            1,
            "which are the two axes",
        ),
        (
            &["growth", "--quality", "friction=0.5"],
            2,
            "at least 1, not 0.5",
        ),
        (
            &["growth", "--tree", "apparatus", "--quality", "viscous_1=9"],
            1,
            "`viscous_1` is not a friction coefficient that damps",
        ),
        (
            &[
                "growth",
                "--tree",
                "apparatus",
                "--quality",
                "viscous_1=9",
                "--vary",
                "viscous_2=0",
            ],
            2,
            "cannot be used with",
        ),
        (
            &["transfer", "--against", "amplitude", "--rates", "3"],
            1,
            "leave out `--rates`",
        ),
        (
            &["transfer", "--states", "9"],
            2,
            "9 is not in 10..=1000000",
        ),
        (
            &["map", "--of", "flip", "--pair", "child"],
            2,
            "leave it out",
        ),
        (
            &["map", "--of", "flip", "--link", "child,twig"],
            1,
            "there is no link `twig`",
        ),
        (
            &["transfer", "--start", "parent=45", "--duration", "1"],
            1,
            "W into `d` is zero at all times, because copies that start in phase stay in phase",
        ),
        (&["transfer", "--into", "e"], 1, "the tree has in_phase, d"),
        (
            &["advise", "--right", "speed:1"],
            2,
            "outputs: angles, energy, pixels, transfer",
        ),
        (&["grow"], 2, "growth"),
        (
            &["simulate", "--figure-width", "2cm"],
            2,
            "it must be from 66 to 400 mm",
        ),
        (
            &["simulate", "--show", "5:2"],
            2,
            "it ends before it begins: write `2:5`",
        ),
        (
            &["simulate", "--duration", "3", "--show", "3:5"],
            2,
            "which lasts from 0 to 3 s: choose a span within these times",
        ),
        (
            &["transfer", "--against", "amplitude", "--show", "2:5"],
            1,
            "`--against amplitude` draws no chart against time: leave out `--show`",
        ),
        (
            &["growth", "--show", "2:5"],
            2,
            "unexpected argument '--show'",
        ),
        (
            &["modes", "--figure-width", "85mm"],
            2,
            "unexpected argument '--figure-width'",
        ),
    ] {
        let text = refusal(words, code);
        assert!(text.contains(reported), "{words:?}: {text}");
    }
}
