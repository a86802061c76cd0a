//! Files of numbers that a program reads back itself. They are recognised by their header, accepted
//! only if complete, and exact to the last bit.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::input::{Input, InputDifference};

/// Beginning of the first line of such a file, in every version of the format.
pub(super) const MARK: &[u8] = b"branched-pendulum data ";

/// The first line, which ends with the version of the format. It is followed by a line with a
/// checksum of the rest (CRC-32, eight hexadecimal digits), by the identity of the run and by the
/// content, both encoded by `postcard`.
const HEADER: &str = "branched-pendulum data 2\n";

/// Length in bytes of the line with the checksum.
const CHECKSUM: usize = 9;

/// Identity of a run, which does not depend on the process that computes it. Checkpoints and parts
/// of the run are valid only for this run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RunIdentity {
    /// Name of the program.
    pub program: String,
    /// Version of the program.
    pub version: String,
    /// Arguments of the program, as JSON, except those that only determine how the run is computed,
    /// or which part of it.
    pub arguments: String,
    /// Files that the run has read, with digests of their content.
    pub inputs: Vec<Input>,
}

/// Reason why a sealed file was rejected.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SealError {
    /// The file is not a sealed file, or has another version of the format.
    #[error("the file was not written by this version of the program")]
    Format,
    /// Bytes of the file were changed or are missing.
    #[error("the file is damaged: its checksum is wrong")]
    Damaged,
    /// One of another run.
    #[error("the file belongs to another run: {} {} with {}", .0.program, .0.version, .0.arguments)]
    Run(Box<RunIdentity>),
    /// A file that the run reads has changed since the sealed file was written.
    #[error("the file belongs to a run with other input: {0}")]
    Input(InputDifference),
    /// The content does not fit to a run with these arguments.
    #[error("the file belongs to a run with different arguments")]
    Content,
}

impl RunIdentity {
    /// Returns the error that states how this run differs from another one, `now`.
    fn mismatch(self, now: &Self) -> SealError {
        let inputs = Input::first_difference(&self.inputs, &now.inputs);
        let of_run = |run: &Self| {
            (
                run.program.clone(),
                run.version.clone(),
                run.arguments.clone(),
            )
        };
        match inputs {
            Some(difference) if of_run(&self) == of_run(now) => SealError::Input(difference),
            _ => SealError::Run(Box::new(self)),
        }
    }
}

/// The bytes of a file.
pub fn seal<C: Serialize>(run: &RunIdentity, content: &C) -> Result<Vec<u8>, SealError> {
    let body = postcard::to_stdvec(&(run, content)).map_err(|_| SealError::Content)?;
    let mut bytes = format!("{HEADER}{:08x}\n", crc32fast::hash(&body)).into_bytes();
    bytes.extend(body);
    Ok(bytes)
}

/// Returns the content of a sealed file, after checking that it belongs to this run.
///
/// # Errors
/// [`SealError`].
pub fn open<C: DeserializeOwned>(run: &RunIdentity, bytes: &[u8]) -> Result<C, SealError> {
    let rest = bytes.strip_prefix(HEADER.as_bytes());
    let rest = rest.ok_or(SealError::Format)?;
    let (checksum, body) = rest.split_at_checked(CHECKSUM).ok_or(SealError::Damaged)?;
    if checksum != format!("{:08x}\n", crc32fast::hash(body)).as_bytes() {
        return Err(SealError::Damaged);
    }
    let (found, body) =
        postcard::take_from_bytes::<RunIdentity>(body).map_err(|_| SealError::Content)?;
    if found != *run {
        return Err(found.mismatch(run));
    }
    match postcard::take_from_bytes(body) {
        Ok((content, [])) => Ok(content),
        _ => Err(SealError::Content),
    }
}

#[cfg(test)]
mod tests {
    use super::{Input, RunIdentity, SealError, open, seal};

    fn run(arguments: &str) -> RunIdentity {
        RunIdentity {
            program: "test".to_owned(),
            version: "1".to_owned(),
            arguments: arguments.to_owned(),
            inputs: Vec::new(),
        }
    }

    #[test]
    fn numbers_keep_their_bits() {
        let numbers = [0.1, -0.0, 5e-324, f64::MAX, f64::INFINITY, f64::NAN];
        let bytes = seal(&run("{}"), &numbers.to_vec()).unwrap();
        let read: Vec<f64> = open(&run("{}"), &bytes).unwrap();
        assert_eq!(
            read.iter().map(|x| x.to_bits()).collect::<Vec<_>>(),
            numbers.map(f64::to_bits)
        );
    }

    #[test]
    fn what_is_not_whole_or_not_of_the_run_is_refused() {
        let bytes = seal(&run("{}"), &vec![1.5, 2.5]).unwrap();
        let read = |bytes: &[u8]| open::<Vec<f64>>(&run("{}"), bytes);
        assert_eq!(read(&bytes), Ok(vec![1.5, 2.5]));
        for length in 0..bytes.len() {
            assert!(read(&bytes[..length]).is_err());
        }
        for place in 0..bytes.len() {
            let mut changed = bytes.clone();
            changed[place] ^= 4;
            let expected = if place < super::HEADER.len() {
                SealError::Format
            } else {
                SealError::Damaged
            };
            assert_eq!(read(&changed), Err(expected), "{place}");
        }
        let other = open::<Vec<f64>>(&run("{\"seed\":\"2\"}"), &bytes);
        assert_eq!(other, Err(SealError::Run(Box::new(run("{}")))));
        assert_eq!(open::<String>(&run("{}"), &bytes), Err(SealError::Content));
    }

    #[test]
    fn other_input_is_refused_with_the_line_that_differs() {
        let with = |texts: &[&str]| RunIdentity {
            inputs: (0..)
                .zip(texts)
                .map(|(number, text)| Input::of_text(&format!("{number}.txt"), text))
                .collect(),
            ..run("{}")
        };
        let bytes = seal(&with(&["a\n", "b\nc\n"]), &1.5).unwrap();
        let read = |texts: &[&str]| open::<f64>(&with(texts), &bytes);
        assert_eq!(read(&["a\n", "b\nc\n"]), Ok(1.5));
        for (texts, reported) in [
            (
                ["A\n", "b\nc\n"],
                "`0.txt` has changed: line 1 was `a` and is `A`",
            ),
            (
                ["a\n", "b\nd\n"],
                "`1.txt` has changed: line 2 was `c` and is `d`",
            ),
            (
                ["a\n", "b\nc\nd"],
                "`1.txt` has changed: line 3 was `` and is `d`",
            ),
        ] {
            let error = read(&texts).unwrap_err().to_string();
            assert_eq!(
                error,
                format!("the file belongs to a run with other input: {reported}")
            );
        }
        // Fewer files: another run.
        assert!(matches!(read(&["a\n"]), Err(SealError::Run(_))));
    }
}
