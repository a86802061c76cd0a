//! No input makes the macro panic, and none gets away without code or a message.

mod expansion;
mod grammar;
mod smaller;
mod verdict;
mod words;

use std::sync::{Mutex, MutexGuard, PoisonError};

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

use branched_pendulum_codegen::stages;

use branched_pendulum_compiler_tests::front_end::{Outcome, run, split};
use branched_pendulum_compiler_tests::random::Random;

/// Keeps these tests apart: they measure the processor time of the whole process.
fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::new(());
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Descriptions to start from.
const SEEDS: &[&str] = &[
    "#[branched_pendulum(
        gravity = 9.80665,
        parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
            child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = 2e-5) * 2
        ],
        emit(energies, momenta, modes, symmetric, transfer(angle = 1, amplitude = 2, exact)),
    )]
    pub(crate) struct BranchedDouble;",
    "#[branched_pendulum(
        crate = ::bp,
        gravity = g,
        arm: rod(mass = m, length = l / 2 + 0.1) [
            hand: disc(mass = 2 * m^2, length = l, radius = -(-0.1)^1, at = (l, 0.02)) [
                finger: point(mass = 0.1, length = 0.2),
            ] * 3,
            weight: plate(mass = 1, length = 0.3, width = 0.1, margin = 0.01, at = 0.1),
        ],
    )]
    #[derive(Debug)] pub(crate) struct Robot {}",
    "#[branched_pendulum(
        gravity = 1,
        tree: generations(
            count = 3, branching = 2, shape = rod_with_bob,
            mass = 0.12, bob_mass = 0.1, length = 0.3, mass_ratio = 0.5, length_ratio = 0.7,
        ),
        emit(transfer),
    )]
    struct Tree;",
    "#[branched_pendulum(
        gravity = 9.8,
        rod: rod(mass = 1, length = 1),
        drive(torque = a * cos(w * t + p) + 0.1, x = b * t^2 / 2, y = -sin(2 * w * t) / w),
    )]
    struct Driven;",
    "#[branched_pendulum(
        gravity = g,
        a: rod(mass = m, length = 1) [ b: rod(mass = 1, length = 1) * 2 ],
        emit(momenta),
        observe(twist = sin(theta_b_1 - theta_b_2)^2 / (1 + m^2), power = p_d * sqrt(omega_a) / gravity),
    )]
    struct Watched;",
    "#[branched_pendulum(
        gravity = 9.8,
        a: rod(mass = 1, length = 1) [
            b(mass = each(left, 0.2), com = each(0.1, (0.1, 0.02)), inertia = each(1e-3, 2e-3)) * 2
        ],
        emit(energies, symmetric, transfer(exact)),
    )]
    struct Unequal;",
    "#[branched_pendulum(
        gravity = 9.8,
        a: rod(mass = 1, length = 1, friction(viscous = 0.1, coulomb = c, quadratic = q)) [
            b: rod(mass = 1, length = 1, friction(coulomb = 2, width = 0.1), drag(quadratic = 3)) * 2
        ],
        emit(energies, symmetric, transfer(exact)),
    )]
    struct Braked;",
    "#[branched_pendulum(
        gravity = g,
        mast: rod(mass = 0.3, length = 0.4) [
            left: rod(mass = 0.12, length = 0.3, at = (0, -0.1)),
            right: rod(mass = 0.12, length = 0.3, at = (0, 0.1)) [leaf: rod(mass = 0.1, length = 0.1) * 2],
        ],
        between(left, right, at = each(0.3, (0.2, 0.01)), spring = k, rest = 0.2, repulsion = 3e-5, exponent = 3),
        siblings(leaf, at = 0.1, spring = 4, friction = 0.1),
        guy(mast, at = 0.4, to = (-0.4, 0), spring = 60, rest = 0.5, friction = 0.2),
        emit(energies, momenta, modes, taylor),
    )]
    struct Guyed;",
];

/// Tokens to put in, beside those of the seeds.
const TOKENS: &str = "0 1 2 -1 0.5 1e300 1e-300 1e999 1e99999999999 4294967296 0x1F 1f64 \"text\" 'c' b\"b\" r#type \
     = == , ; : :: * ** / ^ + - ( ) [ ] { } (1, 2) (,) () [] {} (((1))) \
     mass com inertia joint at friction length radius width margin bob_mass count branching shape \
     mass_ratio length_ratio gravity drive torque x y t sin cos emit crate energies momenta transfer angle amplitude exact \
     viscous coulomb quadratic width friction(coulomb = 1) drag(quadratic = q, width = 0) \
     observe budget canonical parseval matrix each each(1, 2) \
     between siblings guy to spring rest repulsion exponent \
     sin cos sqrt theta_a theta_d omega_b_1 p_m twist kinetic_energy point rod disc generations parent child m g l pi self type Self _ é Ω true struct enum fn pub where <T> #";

/// Applies one random change somewhere in the tokens.
fn mutated(tokens: &[TokenTree], supply: &[TokenTree], random: &mut Random) -> Vec<TokenTree> {
    let mut tokens = tokens.to_vec();
    if tokens.is_empty() {
        tokens.push(random.pick(supply).clone());
        return tokens;
    }
    let at = random.below(tokens.len());
    if let TokenTree::Group(group) = &tokens[at]
        && random.below(5) > 0
    {
        let inside: Vec<TokenTree> = group.stream().into_iter().collect();
        let inside = mutated(&inside, supply, random);
        tokens[at] = Group::new(group.delimiter(), inside.into_iter().collect()).into();
        return tokens;
    }
    match random.below(7) {
        0 => drop(tokens.remove(at)),
        1 => tokens.insert(at, tokens[at].clone()),
        2 => {
            let other = random.below(tokens.len());
            tokens.swap(at, other);
        }
        3 => tokens[at] = random.pick(supply).clone(),
        4 => tokens.insert(at, random.pick(supply).clone()),
        5 => {
            let delimiters = [
                Delimiter::Parenthesis,
                Delimiter::Bracket,
                Delimiter::Brace,
                Delimiter::None,
            ];
            let inside = tokens.drain(at..).collect();
            tokens.push(Group::new(*random.pick(&delimiters), inside).into());
        }
        _ => tokens.truncate(at),
    }
    tokens
}

/// All tokens of a stream, those in groups and the groups included.
fn flattened(tokens: TokenStream, all: &mut Vec<TokenTree>) {
    for token in tokens {
        if let TokenTree::Group(group) = &token {
            flattened(group.stream(), all);
        }
        all.push(token);
    }
}

/// Mutates valid descriptions `count` times: each has a scene or messages, and texts for both.
fn mutate(count: usize) {
    let _alone = alone();
    let mut random = Random::new(20_250_101);
    let mut supply = Vec::new();
    // Brackets that do not match cannot be tokens.
    let words = TOKENS.split_whitespace();
    for word in words {
        if let Ok(tokens) = word.parse() {
            flattened(tokens, &mut supply);
        }
    }
    let mut seeds = Vec::new();
    for source in SEEDS {
        let (attribute, item) = split(source);
        flattened(attribute.clone(), &mut supply);
        let attribute: Vec<TokenTree> = attribute.into_iter().collect();
        let item: Vec<TokenTree> = item.into_iter().collect();
        seeds.push((attribute, item));
    }
    let (mut scenes, mut refusals, mut messages) = (0, 0, 0);
    for _ in 0..count {
        let (mut attribute, mut item) = random.pick(&seeds).clone();
        for _ in 0..1 + random.below(3) {
            if random.below(12) == 0 {
                item = mutated(&item, &supply, &mut random);
            } else {
                attribute = mutated(&attribute, &supply, &mut random);
            }
        }
        let attribute: TokenStream = attribute.into_iter().collect();
        let item: TokenStream = item.into_iter().collect();
        let shown = attribute.to_string();
        let Outcome {
            description,
            scene,
            report,
        } = run(attribute.clone(), item.clone());
        assert_ne!(scene.is_some(), !report.is_empty(), "{shown}");
        // Texts must not fail either.
        messages += report.diagnostics().len();
        assert_eq!(report.is_empty(), report.to_compile_errors().is_empty());
        assert_eq!(report.is_empty(), report.render(&shown).is_empty());
        assert!(description.is_none_or(|description| !description.to_string().is_empty()));
        match scene {
            Some(scene) => {
                assert!(!scene.to_string().is_empty());
                scenes += 1;
                // Larger ones take long and say no more.
                if scene.links.len() <= 8 {
                    let stages = stages(attribute, item);
                    let tokens = stages
                        .map(|stages| stages.tokens().clone())
                        .map_err(|(report, _)| report);
                    let tokens = tokens.unwrap_or_else(|report| panic!("{report:?}: {shown}"));
                    assert!(syn::parse2::<syn::File>(tokens).is_ok(), "{shown}");
                }
            }
            None => refusals += 1,
        }
    }
    // The mutations are neither all harmless nor all fatal at once.
    assert!(scenes > count / 33, "{scenes} scenes");
    assert!(refusals > count / 2, "{refusals} refusals");
    assert!(messages > refusals, "{messages} messages");
}

#[test]
fn mutated_descriptions_give_a_scene_or_messages() {
    mutate(1_000);
}

#[test]
#[ignore = "takes half a minute; `.ci/more` runs it"]
fn many_mutated_descriptions_give_a_scene_or_messages() {
    mutate(10_000);
}
