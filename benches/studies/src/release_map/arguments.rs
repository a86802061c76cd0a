//! The command line.

use clap::{Parser, ValueEnum};

use branched_pendulum_frame::command_line::number;

/// The plane of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Plane {
    /// angle of the parent and common angle of what hangs from it
    Releases,
    /// mass of the children over that of the paper's, and energy of a release with
    /// vertical children
    RatioEnergy,
}

/// A tree with a pair of equal branches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Scene {
    /// the paper's pendulum
    Paper,
    /// two jointed arms on a body
    Arms,
}

/// At which releases from rest does the antiphase mode grow, and how fast? Draws the
/// growth rate of a small difference between the copies over the plane of releases: the
/// angle of the parent and the common angle of its children. Through that of the paper's
/// pendulum go its two nonlinear normal modes and the line of the paper's releases; the
/// tongues of instability between the modes are listed with their frequencies.
///
/// Every value is computed at two tolerances; where they differ by more than 1 % it
/// counts as not determined, and is drawn all the same.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "release-map", version, verbatim_doc_comment)]
pub struct Arguments {
    /// the plane
    #[arg(long, value_name = "PLANE", default_value = "releases")]
    pub plane: Plane,
    /// the tree, of the plane of releases
    #[arg(long, value_name = "SCENE", default_value = "paper")]
    pub scene: Scene,
    /// largest angle of the parent, degrees from 1 to 180
    #[arg(long, value_name = "DEG", default_value = "90", value_parser = number(1.0..=180.0, "degrees"))]
    pub parent: f64,
    /// largest angle of the children, to both sides, degrees from 1 to 180
    #[arg(long, value_name = "DEG", default_value = "135", value_parser = number(1.0..=180.0, "degrees"))]
    pub children: f64,
    /// step of both angles, degrees from 0.05 to 90
    #[arg(long, value_name = "DEG", default_value = "0.5", value_parser = number(0.05..=90.0, "degrees"))]
    pub step: f64,
    /// time followed, s from 1 to 1000
    #[arg(long, value_name = "S", default_value = "15", value_parser = number(1.0..=1000.0, "s"))]
    pub span: f64,
    /// relative error of one integration step, 1e-12 to 1e-3; all is repeated with a
    /// hundredth of it, whose values are told
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "TOL",
        default_value = "1e-9",
        value_parser = number(1e-12..=1e-3, "")
    )]
    pub tolerance: f64,
}

impl branched_pendulum_frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("release-map-output");

    fn check(&self) -> Result<(), String> {
        if self.plane == Plane::RatioEnergy && self.scene != Scene::Paper {
            return Err("`--plane ratio-energy` is of the paper's pendulum alone".to_owned());
        }
        Ok(())
    }
}

impl Arguments {
    /// Angles of the parent, degrees: the other half mirrors these.
    pub fn parents(&self) -> Vec<f64> {
        let steps = (self.parent / self.step + 1e-9).floor() as u32;
        (0..=steps).map(|k| f64::from(k) * self.step).collect()
    }

    /// Angles of the children, degrees.
    pub fn children(&self) -> Vec<f64> {
        let steps = (self.children / self.step + 1e-9).floor() as i32;
        (-steps..=steps).map(|k| f64::from(k) * self.step).collect()
    }
}
