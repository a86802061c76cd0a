//! Audit of the advisor: twelve questions, and next to each answer the measurements of all
//! candidates that might be cheaper.

use branched_pendulum_advice::{Advisor, Candidates, Measured};

use super::requests::{self, OutputName, Question, SceneName};
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

/// Questions: scene, output, largest error, end time (s), samples per second, number of starts.
const QUESTIONS: [(SceneName, OutputName, f64, f64, f64, u32); 12] = [
    (SceneName::Paper, OutputName::Angles, 1e-2, 10.0, 10.0, 1),
    (SceneName::Paper, OutputName::Angles, 1e-4, 10.0, 10.0, 1),
    (SceneName::Paper, OutputName::Angles, 1e-6, 10.0, 10.0, 1),
    (SceneName::Paper, OutputName::Angles, 1e-9, 5.0, 10.0, 1),
    (SceneName::Paper, OutputName::Energy, 1e-8, 10.0, 10.0, 1),
    (SceneName::Paper, OutputName::Pixels, 0.5, 5.0, 60.0, 1),
    (SceneName::Paper, OutputName::Transfer, 1e-6, 5.0, 20.0, 1),
    (SceneName::Paper, OutputName::Angles, 1e-6, 3.0, 10.0, 32),
    (SceneName::Cascade, OutputName::Angles, 1e-2, 3.0, 10.0, 1),
    (SceneName::Cascade, OutputName::Angles, 1e-7, 3.0, 10.0, 1),
    (SceneName::Branch, OutputName::Pixels, 1.0, 5.0, 60.0, 1),
    (SceneName::Branch, OutputName::Angles, 1e-6, 5.0, 10.0, 1),
];

/// Distance between the settings that are tried, in decades.
const SPACING: f64 = 0.1;

/// Number of competitors that are timed alternately with the choice, and number of repetitions.
const RIVALS: usize = 6;
const ROUNDS: usize = 30;

/// Answers all questions and prints a table.
///
/// # Errors
/// [`Failure`].
pub fn run(job: &Job) -> Result<(), Failure> {
    let progress = job.progress(QUESTIONS.len());
    let mut text = String::from(
        "Choices, and the cheapest of all others that are right: its time over the choice's.\n\n",
    );
    for (scene, output, tolerance, horizon, rate, starts) in QUESTIONS {
        let title = format!(
            "{}: {} to {tolerance:e}, {horizon} s, {rate} Hz, starts: {starts}",
            scene.title(),
            output.word()
        );
        progress.begin(&title);
        let question = Question {
            scene,
            output,
            tolerance,
            horizon,
            rate,
            starts,
        };
        let line = progress.ticking(|| {
            requests::with(&question, |advisor, candidates| {
                let advice = advisor.advise(candidates)?;
                let Some(chosen) = advice.chosen() else {
                    return Ok("  nothing is right\n".to_owned());
                };
                let all = advisor.survey(candidates, SPACING, 1.3 * chosen.seconds)?;
                let (times, own) = retimed(advisor, candidates, chosen, &all);
                let mut line = format!("  {:9.1} µs  {}\n", 1e6 * own, advice.describe(chosen));
                let best = times.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
                line += &match best {
                    Some((rival, seconds)) => {
                        format!("  {:9.2}     {}\n", seconds / own, advice.describe(rival))
                    }
                    None => format!("  none of {} runs is right and as cheap\n", all.len()),
                };
                Ok(line)
            })
        })?;
        text += &format!("{title}\n{line}");
        progress.next();
    }
    job.print(&text)?;
    job.write("audit.txt", text.as_bytes())
}

/// Times the choice and the cheapest other right runs again, alternating between them.
fn retimed<'r>(
    advisor: &Advisor<'_>,
    candidates: &Candidates<'_>,
    chosen: &Measured,
    all: &'r [Measured],
) -> (Vec<(&'r Measured, f64)>, f64) {
    let mut right: Vec<&Measured> = all.iter().filter(|run| run.is_right()).collect();
    right.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    right.truncate(RIVALS);
    let mut times: Vec<(&Measured, f64)> =
        right.into_iter().map(|run| (run, run.seconds)).collect();
    let time = |run: &Measured| match candidates.get(run.candidate) {
        Some(candidate) => advisor.time(candidate, run.setting),
        None => f64::INFINITY,
    };
    let mut own = chosen.seconds;
    for _ in 0..ROUNDS {
        own = own.min(time(chosen));
        for (run, least) in &mut times {
            *least = least.min(time(run));
        }
    }
    (times, own)
}
