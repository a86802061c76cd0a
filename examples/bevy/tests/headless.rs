//! The plugin in a game without a window, in steps of its own clock.

use std::time::Duration;

use bevy_app::App;
use bevy_ecs::entity::Entity;
use bevy_time::{TimePlugin, TimeUpdateStrategy};
use branched_pendulum_bevy_example::{Hand, Swaying, SwayingPlugin};

const BRANCH: &str = "gravity = 9.80665,
    limb: rod(mass = 0.4, length = 0.5) [twig: rod(mass = 0.1, length = 0.3) * 3]";

fn game(description: &str, angles: &[f32]) -> (App, Entity) {
    let mut app = App::new();
    app.add_plugins((TimePlugin, SwayingPlugin));
    // A frame is a fixed step of Bevy's, of 1/64 s.
    let frame = Duration::from_secs(1) / 64;
    app.insert_resource(TimeUpdateStrategy::ManualDuration(frame));
    let tree = Swaying::new(description, angles).expect("the description is right");
    let tree = app.world_mut().spawn(tree).id();
    // The first frame has no length.
    app.update();
    (app, tree)
}

fn tree(app: &App, entity: Entity) -> &Swaying {
    app.world().get(entity).expect("it is there")
}

#[test]
fn a_tree_without_friction_keeps_its_energy() {
    let (mut app, branch) = game(BRANCH, &[0.5, 0.3, -0.2, 0.1]);
    let (start, place) = (tree(&app, branch).energy(), tree(&app, branch).ends()[0]);
    let mut farthest = 0.0_f32;
    for _ in 0..640 {
        app.update();
        let tree = tree(&app, branch);
        assert!(
            (tree.energy() - start).abs() < 1e-5 * start,
            "{} {start}",
            tree.energy()
        );
        farthest = farthest.max((tree.ends()[0][0] - place[0]).abs());
    }
    assert!(farthest > 0.4, "{farthest}");
}

#[test]
fn a_hand_holds_an_end_and_lets_go() {
    let calm = BRANCH.replace("length = 0.5", "length = 0.5, friction = 0.02");
    let (mut app, branch) = game(&calm, &[0.0; 4]);
    let at = [0.3, -0.5];
    app.world_mut()
        .entity_mut(branch)
        .insert(Hand { link: 1, at });
    for _ in 0..256 {
        app.update();
        assert!(
            tree(&app, branch)
                .ends()
                .iter()
                .flatten()
                .all(|place| place.is_finite())
        );
    }
    let held = tree(&app, branch).ends()[1];
    // Its weight stretches the spring by some g (2 / 64 s)², 1 cm.
    let away = (held[0] - at[0]).hypot(held[1] - at[1]);
    assert!(away < 0.02, "{held:?}");
    app.world_mut().entity_mut(branch).remove::<Hand>();
    let energy = tree(&app, branch).energy();
    for _ in 0..640 {
        app.update();
    }
    assert!(tree(&app, branch).energy() < 0.9 * energy);
}

/// Out of reach, straight below: the pull is along the links, which gives way to nothing.
#[test]
fn a_hand_out_of_reach_moves_nothing() {
    let (mut app, branch) = game(BRANCH, &[0.0; 4]);
    let start = tree(&app, branch).ends();
    let hand = Hand {
        link: 1,
        at: [0.0, -1.2],
    };
    app.world_mut().entity_mut(branch).insert(hand);
    for _ in 0..64 {
        app.update();
    }
    assert_eq!(tree(&app, branch).ends(), start);
    assert_eq!(tree(&app, branch).energy(), 0.0);
}

#[test]
fn mistakes_in_a_description_are_shown() {
    let error = Swaying::new("gravity = 9.8, rod: rod(mas = 1, length = 1)", &[0.0]);
    let text = error
        .err()
        .map(|error| error.to_string())
        .unwrap_or_default();
    assert!(text.contains("did you mean `mass`?"), "{text}");
}
