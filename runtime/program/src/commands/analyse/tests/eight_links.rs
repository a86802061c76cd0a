//! A tree of eight links before the camera.

use super::{DRAWS, Way, estimate};
use crate::frame::command_line::parse_line;

/// Three arms with a hand each and a stone, on one trunk.
const TREE: &str = "gravity = 9.81, trunk: rod(mass = 0.3, length = 0.3) [
    arm: rod(mass = 0.1, length = 0.25) [hand: rod(mass = 0.05, length = 0.2)] * 3,
    stone: rod(mass = 0.2, length = 0.1)
]";

/// Rates by the equations are within their error bars, and far closer than by smoothness.
#[test]
fn rates_of_eight_links_are_within_their_bars() {
    let path = std::env::temp_dir().join(format!("branched-pendulum-eight-{}", std::process::id()));
    std::fs::write(&path, TREE).unwrap();
    let (mut within, mut count, mut squares) = (0, 0, [0.0; 2]);
    for seed in 1..=2 {
        let line = format!(
            "--start trunk=40 --rate 120 --duration 1 --noise 2e-4 --seed {seed} --tree {}",
            path.display()
        );
        let arguments = parse_line(&line).unwrap();
        let (source, all) = estimate(&arguments, DRAWS, &[Way::Smoothness, Way::Model]);
        for (index, truth) in source.truth.iter().enumerate() {
            for (link, truth) in truth.rates.iter().enumerate() {
                let errors = [0, 1].map(|way: usize| all[way].rates.means[index][link] - truth);
                let bar = 1.96 * all[1].rates.deviations[index][link];
                within += usize::from(errors[1].abs() < bar);
                count += 1;
                squares = [0, 1].map(|way| squares[way] + errors[way] * errors[way]);
            }
        }
    }
    std::fs::remove_file(&path).unwrap();
    let part = within as f64 / count as f64;
    assert!((0.9..=0.99).contains(&part), "{part}");
    let [smoothness, model] = squares.map(|squares| (squares / count as f64).sqrt());
    assert!(model < 0.1 * smoothness, "{model} {smoothness}");
}
