//! The `expand` tool, run as its users run it.

use branched_pendulum_codegen::program::Pass;
use std::path::PathBuf;
use std::process::{Command, Output};

fn fixture(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../tests/fixtures")
        .join(name)
}

fn expand(arguments: &[&std::ffi::OsStr]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_expand"))
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
fn committed_expansion_is_fresh() {
    let output = expand(&[
        "--check".as_ref(),
        fixture("expanded/paper.rs").as_ref(),
        fixture("scenes/paper.rs").as_ref(),
    ]);
    assert!(output.status.success(), "{}", text(&output.stderr));
}

#[test]
fn stale_expansion_is_told() {
    let committed = std::fs::read_to_string(fixture("expanded/paper.rs")).expect("it exists");
    let stale = temporary(
        "stale.rs",
        &committed.replacen("inertia_child", "inertia_kid", 1),
    );
    let output = expand(&[
        "--check".as_ref(),
        stale.as_ref(),
        fixture("scenes/paper.rs").as_ref(),
    ]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("is stale from line"));
    std::fs::remove_file(stale).expect("it is ours");
}

#[test]
fn processes_agree_and_keep_the_rest_of_the_file() {
    let source = "// A comment.\nuse branched_pendulum::branched_pendulum;\n\n/// A rod.\n\
        #[branched_pendulum(gravity = 9.8, rod: rod(mass = 1, length = 1))]\npub struct Rod;\n\n\
        // Below.\nfn below() {}\n";
    let path = temporary("keep.rs", source);
    let first = expand(&[path.as_ref()]);
    let second = expand(&[path.as_ref()]);
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

#[test]
fn errors_name_line_and_column() {
    let source =
        "#[branched_pendulum(gravity = 9.8, rod: rod(mass = -1, length = 1))]\nstruct Rod;";
    let path = temporary("wrong.rs", source);
    let output = expand(&[path.as_ref()]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        text(&output.stderr).contains("--> 1:"),
        "{}",
        text(&output.stderr)
    );
    std::fs::remove_file(path).expect("it is ours");
}

#[test]
fn passes_are_left_out_by_name() {
    let scene = fixture("scenes/chain.rs");
    let expand_without = |pass: &str| {
        expand(&[
            "--without".as_ref(),
            pass.as_ref(),
            "--stage".as_ref(),
            "program".as_ref(),
            scene.as_ref(),
        ])
    };
    let all = expand(&["--stage".as_ref(), "program".as_ref(), scene.as_ref()]);
    let without = expand_without("common-factors");
    assert!(without.status.success(), "{}", text(&without.stderr));
    assert_ne!(text(&without.stdout), text(&all.stdout));
    let unknown = expand_without("optimism");
    assert_eq!(unknown.status.code(), Some(2));
    assert!(text(&unknown.stderr).contains("passes are sharing, folding"));
    // The help lists them all.
    let help = expand(&["--help".as_ref()]);
    let help = text(&help.stdout);
    for pass in Pass::ALL {
        assert!(help.contains(pass.name()), "{}", pass.name());
    }
}

#[test]
fn stages_and_help() {
    for stage in ["description", "scene", "mechanics", "program"] {
        let output = expand(&[
            "--stage".as_ref(),
            stage.as_ref(),
            fixture("scenes/chain.rs").as_ref(),
        ]);
        assert!(
            output.status.success() && !output.stdout.is_empty(),
            "{stage}"
        );
    }
    let help = expand(&["--help".as_ref()]);
    for option in ["--out", "--check", "--stage", "--without", "--help"] {
        assert!(text(&help.stdout).contains(option));
    }
    let unknown = expand(&["--stage".as_ref(), "assembler".as_ref(), "x.rs".as_ref()]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(text(&unknown.stderr).contains("stages are"));
}
