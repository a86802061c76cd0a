//! Files of numbers that a program reads back itself: told from others, whole or
//! refused, exact to the bit.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// The first line, which ends with the version of what follows: a checksum over all
/// behind it (CRC-32, eight hexadecimal digits, a line), the run, its content, both by `postcard`.
const HEADER: &str = "branched-pendulum data 1\n";

/// Length of the line with the checksum.
const CHECKSUM: usize = 9;

/// Identity of a run, whoever computes it: its parts and checkpoints are of no other.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RunIdentity {
    /// Name of the program.
    pub program: String,
    /// Version of the program.
    pub version: String,
    /// Arguments of the program, as JSON, but for those that say how and which part of the run is
    /// computed.
    pub arguments: String,
}

/// Why a file was not read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SealError {
    /// Another file, or one of another version of this format.
    #[error("it is no file of this program, or of another version of it")]
    Format,
    /// Bytes were changed or are missing.
    #[error("it is damaged: its checksum is wrong")]
    Damaged,
    /// One of another run.
    #[error("it is of {} {} with {}", .0.program, .0.version, .0.arguments)]
    Run(Box<RunIdentity>),
    /// Numbers that are none of such a run.
    #[error("its content is not that of such a run")]
    Content,
}

/// The bytes of a file.
pub fn seal<C: Serialize>(run: &RunIdentity, content: &C) -> Result<Vec<u8>, SealError> {
    let body = postcard::to_stdvec(&(run, content)).map_err(|_| SealError::Content)?;
    let mut bytes = format!("{HEADER}{:08x}\n", crc32fast::hash(&body)).into_bytes();
    bytes.extend(body);
    Ok(bytes)
}

/// The content of a file of this run.
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
        return Err(SealError::Run(Box::new(found)));
    }
    match postcard::take_from_bytes(body) {
        Ok((content, [])) => Ok(content),
        _ => Err(SealError::Content),
    }
}

#[cfg(test)]
mod tests {
    use super::{RunIdentity, SealError, open, seal};

    fn run(arguments: &str) -> RunIdentity {
        RunIdentity {
            program: "test".to_owned(),
            version: "1".to_owned(),
            arguments: arguments.to_owned(),
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
}
