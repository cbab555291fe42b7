//! Parses the text form of an [`EnvelopeSource`]: `LENGTHxWIDTH`, `LENGTHxWIDTH,REAR` or `file`.

use std::error::Error;
use std::fmt;
use std::str::FromStr;

use crate::{Body, EnvelopeSource};

/// Longest accepted side of a vehicle, in meters: a larger value is a mistake in the unit.
const MAX_SIDE_M: f64 = 100.0;

/// A text that does not describe an [`EnvelopeSource`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SourceError;

impl fmt::Display for SourceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "expected LENGTHxWIDTH in meters, each above 0 and at most {MAX_SIDE_M}, optionally \
             followed by a comma and the distance from the rear end to the reference point, such \
             as 2x1.2 or 2x1.2,0.5; or `file` for the areas of the file"
        )
    }
}

impl Error for SourceError {}

impl FromStr for EnvelopeSource {
    type Err = SourceError;

    fn from_str(text: &str) -> Result<Self, SourceError> {
        if text == "file" {
            return Ok(Self::File);
        }
        let (size, rear) = match text.split_once(',') {
            Some((size, rear)) => (size, Some(rear)),
            None => (text, None),
        };
        let number = |text: &str| text.trim().parse::<f64>().map_err(|_| SourceError);
        let (length, width) = size.split_once(['x', 'X']).ok_or(SourceError)?;
        let (length_m, width_m) = (number(length)?, number(width)?);
        let rear_m = rear.map_or(Ok(length_m / 2.0), number)?;
        let is_side = |side_m: f64| side_m > 0.0 && side_m <= MAX_SIDE_M;
        if !(is_side(length_m) && is_side(width_m) && (0.0..=length_m).contains(&rear_m)) {
            return Err(SourceError);
        }
        Ok(Self::Vehicle(Body::vehicle(length_m, width_m, rear_m)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parses_vehicles_and_file() {
        let vehicle =
            |length, width, rear| Ok(EnvelopeSource::Vehicle(Body::vehicle(length, width, rear)));
        assert_eq!("2x1.2".parse(), vehicle(2.0, 1.2, 1.0));
        assert_eq!("2X1.2, 0.5".parse(), vehicle(2.0, 1.2, 0.5));
        assert_eq!("2x1,0".parse(), vehicle(2.0, 1.0, 0.0));
        assert_eq!("file".parse(), Ok(EnvelopeSource::File));
    }

    #[test]
    fn rejects_other_text_with_an_example() {
        for bad in [
            "", "2", "2x", "0x1", "2x-1", "2x1,3", "2x1,-1", "NaNx1", "infx1", "101x1", "2x1,x",
            "2x1,0,0",
        ] {
            let error = bad.parse::<EnvelopeSource>().unwrap_err();
            assert!(error.to_string().contains("2x1.2,0.5"), "{bad}");
        }
    }
}
