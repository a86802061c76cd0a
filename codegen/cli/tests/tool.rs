//! Runs the tool as its users run it.

use branched_pendulum_codegen::program::Pass;
use std::path::PathBuf;
use std::process::{Command, Output};

fn fixture(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../../tests/fixtures")
        .join(name)
}

fn expand(arguments: &[&std::ffi::OsStr]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_cargo-branched-pendulum"))
        .args(arguments)
        .output()
        .expect("the tool starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("the tool writes UTF-8")
}

fn temporary(name: &str, contents: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("expand-{}-{name}", std::process::id()));
    std::fs::write(&path, contents).expect("the temporary folder is writable");
    path
}

#[test]
fn committed_expansions_are_fresh() {
    let check = |[expanded, source]: [PathBuf; 2], more: &[&std::ffi::OsStr]| {
        let all: [&std::ffi::OsStr; 3] = ["check".as_ref(), source.as_ref(), expanded.as_ref()];
        let output = expand(&[&all, more].concat());
        assert!(output.status.success(), "{}", text(&output.stderr));
    };
    check(
        [fixture("expanded/paper.rs"), fixture("scenes/paper.rs")],
        &[],
    );
    let trees = fixture("../../runtime/trees");
    for name in [
        "by_rule.rs",
        "general.rs",
        "prescribed.rs",
        "non_viscous.rs",
        "plain.rs",
    ] {
        let folders = ["src/equations", "equations"];
        let equations = folders.map(|folder| trees.join(folder).join(name));
        check(equations, &["--emit".as_ref(), "equations".as_ref()]);
    }
}

#[test]
fn stale_expansion_is_told() {
    let committed = std::fs::read_to_string(fixture("expanded/paper.rs")).expect("it exists");
    let stale = temporary(
        "stale.rs",
        &committed.replacen("inertia_child", "inertia_kid", 1),
    );
    let output = expand(&[
        "check".as_ref(),
        fixture("scenes/paper.rs").as_ref(),
        stale.as_ref(),
    ]);
    assert_eq!(output.status.code(), Some(3));
    assert!(text(&output.stderr).contains(": stale: differs"));
    std::fs::remove_file(stale).expect("it is ours");
}

#[test]
fn processes_agree_and_keep_the_rest_of_the_file() {
    let source = "// A comment.\nuse branched_pendulum::branched_pendulum;\n\n/// A rod.\n\
        #[branched_pendulum(gravity = 9.8, rod: rod(mass = 1, length = 1))]\npub struct Rod;\n\n\
        // Below.\nfn below() {}\n";
    let path = temporary("keep.rs", source);
    let first = expand(&["expand".as_ref(), path.as_ref()]);
    let second = expand(&["expand".as_ref(), path.as_ref()]);
    assert!(first.status.success(), "{}", text(&first.stderr));
    let printed = text(&first.stdout);
    assert_eq!(printed, text(&second.stdout));
    assert!(
        printed.contains("// A comment.\n\n/// A rod.\n")
            && printed.ends_with("// Below.\nfn below() {}\n")
    );
    assert!(!printed.contains("use branched_pendulum::branched_pendulum"));
    assert!(printed.contains("pub struct Rod<T = f64>"));
    std::fs::remove_file(path).expect("it is ours");
}

/// The caret is below the wrong token, also after a tab and wide letters, and terminals and editors
/// can jump to the printed position.
#[test]
fn errors_name_file_line_and_column() {
    let source = "#[branched_pendulum(gravity = 9.8,\n/* 振り子 */\trod: rod(mass = -1, length = 1))]\nstruct Rod;";
    let path = temporary("wrong.rs", source);
    let output = expand(&["expand".as_ref(), path.as_ref()]);
    assert_eq!(output.status.code(), Some(1));
    let shown = text(&output.stderr);
    assert!(shown.starts_with("error: "), "{shown}");
    assert!(
        shown.contains(&format!("--> {}:2:", path.display())),
        "{shown}"
    );
    let lines: Vec<&str> = shown.lines().collect();
    let wrong = lines
        .iter()
        .position(|line| line.contains("mass = -1"))
        .expect("the line");
    // Wide letters take two columns, a tab takes four.
    let width = |c: char| match c {
        '\t' => 4,
        '振' | 'り' | '子' => 2,
        _ => 1,
    };
    let token = lines[wrong].find("-1").expect("the token");
    let column: usize = lines[wrong][..token].chars().map(width).sum();
    let caret = lines[wrong + 1].find('^').expect("a caret");
    assert_eq!(lines[wrong + 1][..caret].chars().count(), column, "{shown}");
    assert!(shown.contains("help: "), "{shown}");
    std::fs::remove_file(path).expect("it is ours");
}

#[test]
fn files_that_are_not_there_and_sources_that_are_no_rust() {
    let output = expand(&["expand".as_ref(), "nowhere.rs".as_ref()]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).starts_with("error: cannot read nowhere.rs: "));
    let path = temporary("no-rust.rs", "struct Rod {");
    let output = expand(&["expand".as_ref(), path.as_ref()]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        text(&output.stderr).contains("no-rust.rs:1:"),
        "{}",
        text(&output.stderr)
    );
    std::fs::write(&path, "fn main() {}").expect("it is ours");
    let output = expand(&["expand".as_ref(), path.as_ref()]);
    assert!(text(&output.stderr).contains("no struct with #[branched_pendulum(...)]"));
    std::fs::remove_file(path).expect("it is ours");
}

#[test]
fn the_output_is_written_whole_and_found_fresh() {
    let model = temporary("model.rs", "");
    let scene = fixture("scenes/simple.rs");
    let output: &std::ffi::OsStr = "--output".as_ref();
    let written = expand(&["expand".as_ref(), scene.as_ref(), output, model.as_ref()]);
    assert!(written.status.success());
    let checked = expand(&["check".as_ref(), scene.as_ref(), model.as_ref()]);
    assert!(checked.status.success());
    let both = expand(&["check".as_ref(), scene.as_ref(), output, model.as_ref()]);
    assert_eq!(both.status.code(), Some(2));
    // The arguments as Cargo passes them, with the name of the subcommand.
    let words = ["branched-pendulum", "check"].map(std::ffi::OsStr::new);
    let checked = expand(&[words[0], words[1], scene.as_ref(), model.as_ref()]);
    assert!(checked.status.success());
    std::fs::remove_file(model).expect("it is ours");
}

#[test]
fn passes_are_left_out_by_name() {
    let scene = fixture("scenes/chain.rs");
    let expand_without = |pass: &str| {
        expand(&[
            "stage".as_ref(),
            "program".as_ref(),
            scene.as_ref(),
            "--without".as_ref(),
            pass.as_ref(),
        ])
    };
    let all = expand(&["stage".as_ref(), "program".as_ref(), scene.as_ref()]);
    let without = expand_without("common-factors");
    assert!(without.status.success(), "{}", text(&without.stderr));
    assert_ne!(text(&without.stdout), text(&all.stdout));
    let unknown = expand_without("optimism");
    assert_eq!(unknown.status.code(), Some(2));
    assert!(text(&unknown.stderr).contains("[possible values: sharing, folding"));
    // The help lists all stages.
    let help = expand(&["stage".as_ref(), "--help".as_ref()]);
    let help = text(&help.stdout);
    for pass in Pass::ALL {
        assert!(help.contains(pass.name()), "{}", pass.name());
    }
}

#[test]
fn functions_are_written_in_other_languages() {
    let emit = |language: &str, scene: &str| {
        expand(&["emit".as_ref(), language.as_ref(), fixture(scene).as_ref()])
    };
    for (language, head) in [
        ("c", "void paper_accelerations(const double *k, "),
        ("numpy", "def accelerations(k, theta, omega):"),
        ("julia", "function accelerations(k, theta, omega)"),
        ("latex", "\\subsection*{accelerations}"),
    ] {
        let output = emit(language, "scenes/paper.rs");
        let shown = text(&output.stdout);
        assert!(
            output.status.success() && shown.contains(head),
            "{language}"
        );
    }
    for (output, scene, code) in [
        ("c", "scenes/driven_loops.rs", "unrolled"),
        ("equations", "scenes/simple.rs", "loops"),
    ] {
        let refused = emit(output, scene);
        assert_eq!(refused.status.code(), Some(1));
        let help = format!("help: write `code = {code}`");
        assert!(text(&refused.stderr).contains(&help));
    }
}

#[test]
fn stages_and_help() {
    for stage in ["description", "scene", "mechanics", "program"] {
        let output = expand(&[
            "stage".as_ref(),
            stage.as_ref(),
            fixture("scenes/chain.rs").as_ref(),
        ]);
        assert!(
            output.status.success() && !output.stdout.is_empty(),
            "{stage}"
        );
    }
    let help = expand(&["--help".as_ref()]);
    for option in ["expand", "check", "stage", "emit", "--help"] {
        assert!(text(&help.stdout).contains(option));
    }
    let unknown = expand(&["stage".as_ref(), "assembler".as_ref(), "x.rs".as_ref()]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(text(&unknown.stderr).contains("[possible values: description, scene"));
}
