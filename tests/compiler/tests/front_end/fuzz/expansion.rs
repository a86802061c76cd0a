//! Random descriptions through the whole pipeline: each is expanded within limits
//! of time and memory, or refused in our words.

use std::sync::{Arc, Mutex};
use std::time::Duration;

use proc_macro2::{TokenStream, TokenTree};

use super::grammar::description;
use super::smaller::smaller;
use super::verdict::{Verdict, judge, peak_memory, processor_time};
use super::{alone, flattened, mutated};
use branched_pendulum_compiler_tests::random::Random;

/// Most processor time for the expansion of one description, by an unoptimised Symbolica.
const TIME: Duration = Duration::from_secs(5);

/// Expands a description; one that takes longer than [`TIME`] is expanded once more, because other
/// processes on the same cores make the processor time longer. Returns the shorter time.
fn judged(attribute: &TokenStream, item: &TokenStream) -> (Verdict, Duration) {
    let (verdict, time) = judge(attribute, item);
    match time > TIME {
        true => (verdict, time.min(judge(attribute, item).1)),
        false => (verdict, time),
    }
}

/// Most memory for all of them.
const MEMORY: u64 = 1 << 30;

/// Description that is being expanded, and the processor time at its start.
type Present = Arc<Mutex<(Duration, String)>>;

/// Ends the process over a description that takes far too long: no test can.
fn watch(present: Present) {
    std::thread::spawn(move || {
        loop {
            std::thread::sleep(Duration::from_millis(500));
            // The test is over.
            if Arc::strong_count(&present) == 1 {
                return;
            }
            let Ok(present) = present.lock() else { return };
            let memory = peak_memory().unwrap_or(0);
            if processor_time().saturating_sub(present.0) > 4 * TIME || memory > 2 * MEMORY {
                eprintln!("far too much time or memory: {}", present.1);
                std::process::exit(1);
            }
        }
    });
}

/// Faults whose descriptions are made as short as can be, which takes some thousand
/// expansions each.
const SHORTENED: usize = 10;

/// What a description has broken, and the part of it that breaks the same.
fn shortened(attribute: &TokenStream, item: &TokenStream, what: &str, present: &Present) -> String {
    let rest = smaller(attribute.clone(), &mut |rest| {
        if let Ok(mut present) = present.lock() {
            *present = (processor_time(), rest.to_string());
        }
        matches!(judge(&rest, item).0, Verdict::Broken(other) if other == what)
    });
    format!("{what}: #[branched_pendulum({rest})] {item}")
}

/// Looks at `count` descriptions; gives those that broke something, with what.
fn broken(seed: u64, count: usize) -> Vec<String> {
    let _alone = alone();
    let mut random = Random::new(seed);
    let present: Present = Arc::default();
    watch(Arc::clone(&present));
    let (mut faults, mut expanded, mut refused) = (Vec::new(), 0, 0);
    let mut longest = (Duration::ZERO, String::new());
    for index in 0..count {
        let (attribute, item) = description(&mut random);
        let tokens = |text: &str| text.parse::<TokenStream>().unwrap_or_default();
        let mut attribute = tokens(&attribute);
        let item = tokens(&item);
        if random.below(4) == 0 {
            let mut supply = Vec::new();
            flattened(attribute.clone(), &mut supply);
            let mut trees: Vec<TokenTree> = attribute.into_iter().collect();
            for _ in 0..1 + random.below(3) {
                trees = mutated(&trees, &supply, &mut random);
            }
            attribute = trees.into_iter().collect();
        }
        let shown = format!("#[branched_pendulum({attribute})] {item}");
        if let Ok(mut present) = present.lock() {
            *present = (processor_time(), shown.clone());
        }
        let (verdict, time) = judged(&attribute, &item);
        if time > TIME {
            faults.push(format!("{index}: took {time:?}: {shown}"));
        }
        if time > longest.0 {
            longest = (time, shown.clone());
        }
        match verdict {
            Verdict::Expanded => expanded += 1,
            Verdict::Refused => refused += 1,
            Verdict::Broken(what) => {
                let fault = format!("{index}: {what}: {shown}");
                eprintln!("{fault}");
                // Of a fault that many have, few are looked at.
                let fault = match faults.len() {
                    0..SHORTENED => {
                        format!("{index}: {}", shortened(&attribute, &item, &what, &present))
                    }
                    _ => fault,
                };
                faults.push(fault);
            }
        }
        // Texts that were parsed are kept for the places of their tokens, which nobody asks for any more.
        proc_macro2::extra::invalidate_current_thread_spans();
        if (index + 1) % 10_000 == 0 {
            eprintln!("{} looked at, {} broken", index + 1, faults.len());
        }
    }
    let memory = peak_memory().unwrap_or(0);
    eprintln!(
        "{expanded} expanded, {refused} refused, {} broken; {memory} bytes at most; longest {:?}: {}",
        faults.len(),
        longest.0,
        longest.1,
    );
    if memory > MEMORY {
        faults.push(format!("{memory} bytes of memory"));
    }
    // Neither all right nor all wrong.
    assert!(expanded > count / 6 && refused > count / 5);
    faults
}

/// Descriptions that broke something once.
const CURED: &[&str] = &[
    "#[branched_pendulum(crate = ::r#type, gravity = 9.8, a: rod(mass = 1, length = 1))] struct A;",
    "#[branched_pendulum(gravity = 9.8, a(mass = m, com = 1e308, inertia = 0))] struct A;",
    "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = self))] struct A;",
    "#[branched_pendulum(gravity = crate, a: rod(mass = async, length = gen * _))] struct A;",
    "#[branched_pendulum(gravity = sin, a: rod(mass = cos, length = 1), emit(taylor))] struct A;",
    "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1),
        drive(x = 0.5 * ((t + p) * t)^3), emit(taylor))] struct A;",
    "#[branched_pendulum(gravity = 9.8,
        a: generations(count = 45, shape = rod, mass = m, length = l))] struct A;",
    "#[branched_pendulum(gravity = 9.8,
        a: generations(count = 4000, shape = rod, mass = m, length = 1))] struct A;",
    "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1), emit(taylor))] struct S;",
    "#[branched_pendulum(gravity = -1, a: rod(mass = 1, length = 1))] struct S;",
    "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1))] struct f64;",
    "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1),
        observe(accelerations = theta_a, friction_power = 1, z = omega_a))] struct A;",
    "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1) * 2,
        a: rod(mass = 1, length = 1) * 2)] struct A;",
    "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1)
        [r#type: rod(mass = 1, length = 1) * 3])] struct A;",
    "#[branched_pendulum(gravity = 9.8,
        a: generations(count = 4, branching = 3, shape = rod, mass = m, length = 1),
        emit(symmetric, budget))] struct A;",
    "#[branched_pendulum(gravity = 1, a: rod(mass = m, length = scale + -(scale),
        friction(coulomb = w, width = w)))] struct A;",
    "#[branched_pendulum(gravity = 2.5, a: rod(mass = 0.1, length = p) [
        b: rod_with_bob(mass = x, length = 0.084, bob_mass = -(x) * 1, at = -(b + 1e-3)) * 2])]
    struct A;",
    "#[branched_pendulum(gravity = 1, a: rod(mass = m, length = 2.5) [
        b: generations(mass = 2.5, radius = 0.25, length = -4 / k, shape = ball, count = 64,
            branching = 1, length_ratio = scale * 0.5 + 2.5e99)])] struct A;",
    "#[branched_pendulum(gravity = 1, arm: rod(mass = 1, length = b) [
        hand: rod(mass = 1, length = each(2.5, 9.80665, 3.7)) * 3,
        finger: rod(mass = x, length = 1.88e-3)], drive(x = 1e3 * x * t^2),
        emit(momenta, symmetric))] struct A;",
    "#[branched_pendulum(gravity = g, trunk: rod(mass = m, length = l, spring = k) [
        bough(mass = each(a, b), com = (c, d), inertia = i, joint = (l, n), drag = q) [
            twig: generations(mass = w, length = x, shape = rod, count = 3, branching = 2)] * 3],
        emit(momenta, symmetric, energies))] struct A;",
];

/// Others of them, which take more than a second of processor time each.
const CURED_AND_LONG: &[&str] = &[
    "#[branched_pendulum(gravity = g, a(mass = m, com = c, inertia = i, joint = l) [
        b(mass = n, com = d, inertia = k) * 3], emit(transfer(amplitude = 8, angle = 8)))] struct A;",
    "#[branched_pendulum(gravity = 9.8, a: rod(mass = 1, length = 1) [
        b: rod(mass = 1, length = 1) * 400], emit(budget))] struct A;",
    "#[branched_pendulum(gravity = g, a(mass = m, com = c, inertia = i, joint = l) [
        b(mass = each(x, y), com = d, inertia = k, joint = l) [
            e: rod(mass = each(1, 2, q), length = n) * 3] * 2],
        emit(symmetric, momenta, energies, modes))] struct A;",
    "#[branched_pendulum(gravity = q, a(mass = 0.084, com = -(2 + g), inertia = m, joint = 1) [
        b: generations(mass = k, length = 2, width = p, shape = plate, count = 30, branching = 1,
            mass_ratio = 0.1, spring_ratio = 2.5),
        c: cylinder(mass = -(0.25 + q), length = 1, radius = l) * 3],
        emit(momenta, forces, budget(rest, velocity)))] struct A;",
    "#[branched_pendulum(gravity = 9.80665, arm: point(mass = 2.5, length = 0.1) [
        hand: rod(mass = each(m, 0.1), length = n, drag = 0.1) [
            finger(mass = coupling_hand_arm, com = w * (n * 0.25 + 1), inertia = 9.80665,
                joint = (2.5, 1e-3 / 0.25 / w), drag = 4 * w + a / x) * 2,
            tip: generations(mass = 4, length = k, shape = point, count = 4, branching = 2,
                length_ratio = 0.27, spring = 1)] * 2],
        emit(momenta, symmetric))] struct A;",
    "#[branched_pendulum(gravity = 9.8, trunk: disc(mass = 1, length = l, radius = 0.1) [
        bough: rod(mass = 1, length = each(a, b + c, 2 * a), friction = q) [
            twig: rod(mass = m, length = 0.2, spring = k, rest = 0.1) [
                leaf: rod(mass = n, length = w, drag = p) * 2] * 2] * 3],
        emit(symmetric, modes))] struct A;",
    "#[branched_pendulum(gravity = 9.8, trunk: rod(mass = m, length = 1) [
        bough: rod(mass = each(1, n), length = l) [
            twig(mass = a, com = (b, 0.1), inertia = i, joint = (c, d), at = (l / 2, w)) [
                leaf: point(mass = q, length = k) * 2] * 2,
            tip: point(mass = 1, length = x) * 3] * 2],
        emit(symmetric, momenta, energies))] struct A;",
];

fn assert_cured(sources: &[&str]) {
    let _alone = alone();
    for source in sources {
        let (attribute, item) = branched_pendulum_compiler_tests::front_end::split(source);
        let (verdict, time) = judged(&attribute, &item);
        if let Verdict::Broken(what) = verdict {
            panic!("{what}: {source}");
        }
        assert!(time <= TIME, "{time:?}: {source}");
    }
}

#[test]
fn cured_descriptions_stay_cured() {
    assert_cured(CURED);
}

#[test]
#[ignore = "`.ci/more` runs it"]
fn also_long_descriptions_stay_cured() {
    assert_cured(CURED_AND_LONG);
}

#[test]
fn descriptions_are_expanded_or_refused() {
    let faults = broken(20_251_122, 200);
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// As many as the environment asks for; see `README.md`.
#[test]
#[ignore = "runs for hours"]
fn many_descriptions_are_expanded_or_refused() {
    let number = |name: &str, otherwise: u64| {
        let text = std::env::var(name).ok();
        text.map_or(otherwise, |text| text.parse().expect("a whole number"))
    };
    let count = number("FUZZ_COUNT", 1_000_000);
    let faults = broken(number("FUZZ_SEED", 1), count as usize);
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
