//! The help text.

/// The help text.
pub const HELP: &str = "\
The paper's branched double pendulum: a parent link with two equal children,
released from rest with the children hanging straight down. Does the antiphase
mode θ_d = (θ_2 − θ_3)/2 grow, and which energy transfer W feeds it?

Usage: branched-double [OPTION VALUE]...

  --angles DEG[,DEG]...    initial angles θ_1(0) of the parent link, degrees;
                           FROM:TO:STEP for a range, as in 40:48:0.1
                           [39.5,45,46.4,47.6,47.8,48.6: the paper's range]
  --disturbance RAD        θ_d(0), rad: child 2 starts at +RAD, child 3 at −RAD
                           [0.01: about what waiting for rest by eye leaves; as
                           long as θ_d is small, its growth factor does not
                           depend on it]
  --duration S             time observed after the release, s
                           [32: the span of the paper's spectrum]
  --friction-root C        viscous friction in the parent's pivot, N m s [0]
  --friction-children C    viscous friction in each child's pivot, N m s
                           [0; 3.5e-5 brings onset and peak near the paper's]
  --rate HZ                samples per second in tables and charts [100]
  --precision f64|f32      numbers in which the motion is integrated [f64]
  --tolerance TOL          relative error allowed in one integration step
                           [1e-12 for f64, 1e-5 for f32]
  --output FOLDER          where tables and charts go; files of the same name
                           there are replaced [branched-double-output]
  --help                   this text

It prints the eigenfrequencies and one row for each initial angle, and writes
one CSV file for each angle and four charts as SVG and PNG into FOLDER.
";

#[cfg(test)]
mod tests {
    use super::HELP;
    use crate::branched_double::Arguments;
    use crate::branched_double::arguments::OPTIONS;

    #[test]
    fn the_help_lists_every_option_and_every_default() {
        for option in OPTIONS {
            assert!(HELP.contains(&format!("\n  {option} ")), "{option}");
        }
        let defaults = Arguments::default();
        let angles: Vec<String> = defaults.angles_deg.iter().map(f64::to_string).collect();
        for default in [
            angles.join(","),
            format!("[{}: about", defaults.disturbance),
            format!("[{}: the span", defaults.duration),
            format!("tables and charts [{}]", defaults.rate),
            format!("[{}]", defaults.precision),
            format!("[{:e} for f64, {:e} for f32]", defaults.tolerance, 1e-5),
            format!("[{}]", defaults.output.display()),
        ] {
            assert!(HELP.contains(&default), "{default}");
        }
        assert!(HELP.lines().all(|line| line.chars().count() <= 80));
    }
}
