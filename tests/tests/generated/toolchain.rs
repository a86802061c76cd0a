//! Several compilers at once. Symbolica's free mode aborts a second process,
//! so this test does what a user's machine does: two crates that use the macro
//! are built at the same time, with an editor's check running beside them.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::SystemTime;

/// Directory in which cargo put the dependencies of this test.
fn dependencies() -> PathBuf {
    let test = std::env::current_exe().expect("the test runs from a file");
    test.parent().expect("a file has a folder").to_owned()
}

pub(super) fn rustc(
    folder: &Path,
    name: &str,
    source: &str,
    external: &str,
    emit: &str,
) -> Command {
    let file = folder.join(format!("{name}.rs"));
    std::fs::write(&file, source).expect("the temporary folder is writable");
    let mut search = std::ffi::OsString::from("dependency=");
    search.push(dependencies());
    let mut command = Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()));
    command
        .args([
            "--edition",
            "2024",
            "--crate-type",
            "lib",
            "--crate-name",
            name,
        ])
        .arg(format!("--emit={emit}"))
        .args(["--extern", external])
        .arg("-L")
        .arg(search)
        .arg("--out-dir")
        .arg(folder)
        .arg(&file)
        // Each derives, as if it were the first.
        .env("BRANCHED_PENDULUM_CACHE", "off")
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

/// The newest build of the runtime that has the macro.
pub(super) fn runtime(folder: &Path) -> PathBuf {
    let mut candidates: Vec<(SystemTime, PathBuf)> = std::fs::read_dir(dependencies())
        .expect("the folder of the test exists")
        .filter_map(|entry| {
            let entry = entry.ok()?;
            let name = entry.file_name().into_string().ok()?;
            let right = name.starts_with("libbranched_pendulum-") && name.ends_with(".rlib");
            right.then_some((entry.metadata().ok()?.modified().ok()?, entry.path()))
        })
        .collect();
    candidates.sort();
    let probe = "pub use branched_pendulum::branched_pendulum;";
    for (_, path) in candidates.into_iter().rev() {
        let external = format!("branched_pendulum={}", path.display());
        let output = rustc(folder, "probe", probe, &external, "metadata").output();
        if output.is_ok_and(|output| output.status.success()) {
            return path;
        }
    }
    panic!("no build of the runtime with the feature `macros`");
}

const FIRST: &str = r#"
//! A user's crate.
#![deny(warnings, missing_docs)]
use branched_pendulum::prelude::*;

/// The paper's apparatus.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    emit(energies, momenta, modes, symmetric, transfer(angle = 1, amplitude = 2, exact)),
)]
pub struct BranchedDouble;
"#;

/// Renamed dependency, no standard library, no prelude.
const SECOND: &str = r#"
//! Another user's crate.
#![no_std]
#![no_implicit_prelude]
#![deny(warnings, missing_docs)]

/// Three leaves on a plate.
#[::renamed::branched_pendulum(
    crate = ::renamed,
    gravity = 9.80665,
    plate: plate(mass = 0.3, length = 0.3, width = 0.1, margin = 0.01) [
        leaf: rod(mass = mass, length = 0.2, friction = 1e-4) * 3
    ],
    emit(energies, momenta, modes, symmetric, transfer(amplitude = 2, exact)),
)]
pub struct Plate;
"#;

fn finish(name: &str, child: Child) {
    let output = child.wait_with_output().expect("the compiler runs");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{name}: {errors}");
    assert!(errors.is_empty(), "{name} warns: {errors}");
    let printed = String::from_utf8_lossy(&output.stdout);
    assert!(printed.is_empty(), "{name} prints: {printed}");
}

#[test]
fn two_crates_and_an_editor_at_once() {
    let folder = std::env::temp_dir().join(format!("branched-pendulum-{}", std::process::id()));
    let check = folder.join("check");
    std::fs::create_dir_all(&check).expect("the temporary folder is writable");
    let runtime = runtime(&folder);
    let plain = format!("branched_pendulum={}", runtime.display());
    let renamed = format!("renamed={}", runtime.display());
    let start = |mut command: Command| command.spawn().expect("the compiler starts");
    let mut running = Vec::new();
    for round in 0..3 {
        let name = |what: &str| format!("{what}_{round}");
        running.push(start(rustc(&folder, &name("first"), FIRST, &plain, "link")));
        running.push(start(rustc(
            &folder,
            &name("second"),
            SECOND,
            &renamed,
            "link",
        )));
        running.push(start(rustc(
            &check,
            &name("check"),
            FIRST,
            &plain,
            "metadata",
        )));
    }
    for child in running {
        finish("a crate", child);
    }
    std::fs::remove_dir_all(&folder).expect("the folder is ours");
}

/// Structs with attributes of the user's own: written out, in loops and with parameters.
const WITH_ATTRIBUTES: &str = r#"
//! A user's crate.
#![deny(warnings, missing_docs)]
use branched_pendulum::prelude::*;

/// A rod with a number for each value.
#[branched_pendulum(gravity = 9.80665, arm: rod(mass = 0.2, length = 0.3), emit(energies, momenta, modes))]
#[deprecated(note = "take the other one")]
#[non_exhaustive]
#[derive(Clone, Debug)]
pub struct Rod;

/// Two equal rods on one, with parameters.
#[branched_pendulum(
    gravity = g,
    arm: rod(mass = m, length = 0.3) [hand: rod(mass = 0.1, length = 0.2) * 2],
    emit(energies, symmetric, positions, forces, transfer(exact)),
)]
#[must_use]
#[deprecated]
#[doc(hidden)]
pub struct Pair;

/// Rods by rule, in loops.
#[branched_pendulum(
    gravity = 9.80665,
    a: generations(count = 3, branching = 2, shape = rod, mass = 0.1, length = 0.2, code = loops),
    emit(energies),
)]
#[cfg(all())]
#[deprecated = "take the other one"]
#[allow(clippy::module_name_repetitions)]
pub struct Loops;
"#;

#[test]
fn attributes_of_a_struct_cause_no_warnings() {
    let folder = std::env::temp_dir().join(format!("branched-pendulum-a{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("the temporary folder is writable");
    let external = format!("branched_pendulum={}", runtime(&folder).display());
    let output = rustc(
        &folder,
        "attributes",
        WITH_ATTRIBUTES,
        &external,
        "metadata",
    )
    .output();
    let output = output.expect("the compiler runs");
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    std::fs::remove_dir_all(&folder).expect("the folder is ours");
}

/// The runtime under another name: the error says what to write, and that is enough.
#[test]
fn a_renamed_runtime_is_named() {
    let folder = std::env::temp_dir().join(format!("branched-pendulum-r{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("the temporary folder is writable");
    let runtime = runtime(&folder);
    for name in ["bp", "pendulum", "branched"] {
        let external = format!("{name}={}", runtime.display());
        let source = FIRST.replace("branched_pendulum::prelude", &format!("{name}::prelude"));
        let compile = |source: &str| {
            let output = rustc(&folder, "user", source, &external, "metadata").output();
            let output = output.expect("the compiler runs");
            String::from_utf8_lossy(&output.stderr).into_owned()
        };
        let errors = compile(&source);
        let title = format!("the crate `branched_pendulum` is called `{name}` here");
        assert!(errors.contains(&title), "{errors}");
        assert!(
            errors.contains(&format!("write `crate = ::{name}`")),
            "{errors}"
        );
        assert!(!errors.contains("E0433"), "{errors}");
        let path = format!("crate = ::{name}, gravity");
        assert_eq!(compile(&source.replacen("gravity", &path, 1)), "");
    }
    std::fs::remove_dir_all(&folder).expect("the folder is ours");
}

/// A derive that does not exist.
const WRONG_DERIVE: &str = r#"
use branched_pendulum::prelude::*;

#[branched_pendulum(gravity = 9.80665, rod: rod(mass = 1, length = 1))]
#[derive(Nonexistent)]
pub struct Rod;
"#;

#[test]
fn an_unchanged_attribute_derives_nothing() {
    let folder = std::env::temp_dir().join(format!("branched-pendulum-k{}", std::process::id()));
    let kept = folder.join("kept");
    std::fs::create_dir_all(&folder).expect("the temporary folder is writable");
    let external = format!("branched_pendulum={}", runtime(&folder).display());
    // A file where the home should be: whoever derives cannot take the lock.
    let homeless = folder.join("home");
    std::fs::write(&homeless, "").expect("the folder is ours");
    let compile = |source: &str, derives: bool| {
        let mut command = rustc(&folder, "kept", source, &external, "mir");
        command.env("BRANCHED_PENDULUM_CACHE", &kept);
        if !derives {
            command.env("HOME", &homeless).env_remove("XDG_CACHE_HOME");
        }
        let output = command.output().expect("the compiler runs");
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        let file = folder.join("kept.mir");
        (errors, std::fs::read(&file).unwrap_or_default())
    };
    let (errors, _) = compile(FIRST, false);
    assert!(errors.contains("cannot write and lock"), "{errors}");
    let (errors, first) = compile(FIRST, true);
    assert_eq!(errors, "");
    let (errors, again) = compile(FIRST, false);
    assert_eq!(errors, "");
    assert!(!first.is_empty());
    assert!(
        first == again,
        "a kept expansion compiles to something else"
    );

    // Errors about the struct's own tokens stand where these are written.
    for derives in [true, false] {
        let (errors, _) = compile(WRONG_DERIVE, derives);
        assert!(errors.contains("kept.rs:5:10"), "{errors}");
    }

    // Damaged files answer nothing.
    for file in std::fs::read_dir(&kept).expect("it was made") {
        let path = file.expect("the folder is ours").path();
        let text = std::fs::read_to_string(&path).expect("it is text");
        std::fs::write(&path, text.replace("sin", "cos")).expect("the folder is ours");
    }
    let (errors, _) = compile(FIRST, false);
    assert!(errors.contains("cannot write and lock"), "{errors}");
    let (errors, anew) = compile(FIRST, true);
    assert_eq!(errors, "");
    assert!(first == anew, "a damaged file was an answer");
    std::fs::remove_dir_all(&folder).expect("the folder is ours");
}

/// One mistake, and a program that uses all that the description asked for.
const WRONG: &str = r#"
//! A user's crate in the middle of an edit.
use branched_pendulum::prelude::*;

/// A mass below zero.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.1, com = 0.1, inertia = 1e-3, joint = 0.3) [
        child(mass = -0.1, com = 0.04, inertia = 1e-4) * 2
    ],
    emit(energies, momenta, modes, symmetric, transfer),
)]
pub struct Wrong;

/// Calls everything.
pub fn use_it() -> f64 {
    let model = Wrong::new();
    let q = [0.1, 0.2, 0.3];
    let mut rates = [0.0; 6];
    AbsoluteAngles(&model).rates(0.0, &[0.0; 6], &mut rates);
    SymmetricCoordinates(&model).rates(0.0, &[0.0; 6], &mut rates);
    let p = model.symmetric_momenta(&model.to_symmetric(&q), &model.accelerations(&q, &q));
    let v = model.symmetric_velocities(&q, &model.velocities(&q, &model.momenta(&q, &p)));
    let energy = model.kinetic_energy(&q, &v) + model.potential_energy(&q);
    let transfer = model.transfer_angle_1(&q, &p).total()
        + model.transfer_amplitude_2(&q, &p).kinetic
        + model.transfer_exact(&q, &p).potential
        + model.transfer_exact_from_rates(&q, &v).total();
    energy + transfer + model.hamiltonian(&q, &p) + model.antiphase_energy(&q, &p)
        + model.mass_matrix(&q)[0][0] + model.stiffness_matrix(&q)[1][2]
        + model.from_symmetric(&model.transfer_quadratic_form(&q, &p))[0]
}
"#;

/// A user's crate with parameters.
const WRONG_WITH_PARAMETERS: &str = r#"
//! A user's crate in the middle of an edit.
use branched_pendulum::prelude::*;

/// A mass below zero.
#[branched_pendulum(
    gravity = g,
    parent(mass = 0.1, com = 0.1, inertia = 1e-3, joint = l / 2) [
        child(mass = -0.1, com = 0.04, inertia = 1e-4) * 2
    ],
)]
pub struct Wrong;

/// Builds it.
pub fn use_it() -> Result<[f64; 3], ParameterError> {
    let model = Wrong::new(WrongParameters { g: 9.8, l: 0.3 })?;
    Ok(model.accelerations(&[0.1; 3], &[0.0; 3]))
}
"#;

/// A user's crate with a drive, which gives functions a time.
const WRONG_WITH_DRIVE: &str = r#"
//! A user's crate in the middle of an edit.
use branched_pendulum::prelude::*;

/// A mass below zero.
#[branched_pendulum(
    gravity = 9.8,
    parent: rod(mass = 0.1, length = 0.2) [
        child(mass = -0.1, com = 0.04, inertia = 1e-4) * 2
    ],
    drive(torque = 0.1 * cos(w * t), y = 0.01 * sin(t)),
    emit(energies, transfer(exact)),
)]
pub struct Wrong;

/// Calls what has to do with the drive.
pub fn use_it() -> Result<f64, ParameterError> {
    let model = Wrong::new(WrongParameters { w: 9.8 })?;
    let (q, v) = ([0.1; 3], [0.0; 3]);
    let a = model.accelerations(0.0, &q, &model.symmetric_accelerations(0.0, &q, &v));
    let antiphase = model.antiphase_drive_power(0.0, &q, &a);
    Ok(model.drive_power(0.0, &q, &a) + model.friction_power(&a) + antiphase)
}
"#;

#[test]
fn one_mistake_is_one_error() {
    let folder = std::env::temp_dir().join(format!("branched-pendulum-w{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("the temporary folder is writable");
    let external = format!("branched_pendulum={}", runtime(&folder).display());
    for source in [WRONG, WRONG_WITH_PARAMETERS, WRONG_WITH_DRIVE] {
        let output = rustc(&folder, "wrong", source, &external, "metadata")
            .output()
            .expect("the compiler runs");
        let errors = String::from_utf8_lossy(&output.stderr);
        let lines: Vec<&str> = errors.lines().filter(|l| l.starts_with("error")).collect();
        assert!(
            matches!(lines.as_slice(), [mistake, last] if mistake.contains("mass of `child`")
                && last.contains("aborting due to 1 previous error")),
            "{errors}"
        );
        // At the value, not at the attribute.
        assert!(errors.contains("wrong.rs:9:22"), "{errors}");
    }
    std::fs::remove_dir_all(&folder).expect("the folder is ours");
}
