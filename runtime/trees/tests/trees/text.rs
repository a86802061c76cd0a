//! Texts: messages with places, and any text at all.

use std::time::{Duration, Instant};

use branched_pendulum_trees::{PendulumTree, TreeDescription, TreeError};

fn message(text: &str) -> String {
    PendulumTree::parse(text).unwrap_err().to_string()
}

#[test]
fn mistakes_are_marked_in_the_text() {
    let text = "gravity = 9.81,\nupper: rod(mass = 0.2, length = 0.3) [\n    lower: rd(mass = 0.1, length = 0.2),\n]";
    assert_eq!(
        message(text),
        "error: unknown shape `rd`
 --> 3:12
  |
3 |     lower: rd(mass = 0.1, length = 0.2),
  |            ^^ no such shape
help: did you mean `rod`?"
    );
}
