//! Sources that the compiler must refuse, each for its reason.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::{env, fs};

/// The runtime that this test was built with: the newest in its folder.
fn runtime() -> PathBuf {
    let folder = env::current_exe().unwrap();
    let built = fs::read_dir(folder.parent().unwrap()).unwrap();
    let built = built.map(|entry| entry.unwrap().path()).filter(|path| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        name.starts_with("libbranched_pendulum-") && name.ends_with(".rlib")
    });
    let newest = built.max_by_key(|path| fs::metadata(path).unwrap().modified().unwrap());
    newest.expect("cargo leaves a library beside its tests")
}

/// Compiles a source down to machine code, since some constants are looked at there alone.
fn compile(source: &Path, runtime: &Path) -> Output {
    let text = fs::read_to_string(source).unwrap();
    let name = source.file_stem().unwrap();
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let compiler = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let mut process = Command::new(compiler)
        .args(["--edition=2024", "--crate-type=bin", "--emit=obj", "-"])
        .args(["--crate-name=attack", "--cap-lints=warn"])
        .arg("-o")
        .arg(out.with_extension("o"))
        .arg("-L")
        .arg(format!(
            "dependency={}",
            runtime.parent().unwrap().display()
        ))
        .arg("--extern")
        .arg(format!("branched_pendulum={}", runtime.display()))
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("cargo comes with rustc");
    let source = include_str!("common.rs").to_owned() + &text;
    process
        .stdin
        .take()
        .unwrap()
        .write_all(source.as_bytes())
        .unwrap();
    process.wait_with_output().unwrap()
}

#[test]
fn attacks_are_not_compiled() {
    let runtime = runtime();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/doors");
    // The rest of these sources is in order.
    let accepted = compile(&folder.join("accepted.rs"), &runtime);
    let errors = String::from_utf8_lossy(&accepted.stderr);
    assert!(accepted.status.success(), "{errors}");
    let sources = fs::read_dir(folder.join("refused")).unwrap();
    let mut sources: Vec<PathBuf> = sources.map(|entry| entry.unwrap().path()).collect();
    sources.sort();
    assert!(sources.len() >= 20, "{sources:?}");
    for source in sources {
        let text = fs::read_to_string(&source).unwrap();
        let first = text
            .lines()
            .next()
            .and_then(|line| line.strip_prefix("// error: "));
        let reasons = first.expect("the first line says why it is refused");
        let refused = compile(&source, &runtime);
        let errors = String::from_utf8_lossy(&refused.stderr);
        assert!(!refused.status.success(), "{source:?} is compiled");
        for reason in reasons.split(" | ") {
            assert!(
                errors.contains(reason),
                "{source:?}: no {reason} in {errors}"
            );
        }
        assert!(!errors.contains("internal compiler error"), "{errors}");
    }
}
