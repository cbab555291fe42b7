//! Swept areas in arguments and reports: parses `--envelope`, names vehicles and reasons.

use guideway::compose::ComposeError;
use guideway::envelope::{EnvelopeSource, NoEnvelope, SourceError};
use guideway::layout::UserError;

use super::text;

/// Parses `LENGTHxWIDTH`, `LENGTHxWIDTH,REAR` or `file`.
pub(crate) fn source(text: &str) -> Result<EnvelopeSource, SourceError> {
    text.parse()
}

/// The vehicle in the form of `--envelope`, for a report.
pub(crate) fn name(source: EnvelopeSource) -> String {
    match source {
        EnvelopeSource::File => "file".to_owned(),
        EnvelopeSource::Vehicle(body) => {
            let [length, width, rear] =
                [body.length_m(), body.width_m(), body.rear_m].map(text::number);
            format!("{length}x{width},{rear}")
        }
    }
}

/// Fails when no path has an envelope: a check would report nothing without saying why.
pub(crate) fn require_any(
    with: u64,
    without: &[u64; NoEnvelope::ALL.len()],
) -> Result<(), UserError> {
    match NoEnvelope::most_frequent(without) {
        Some(reason) if with == 0 => Err(ComposeError::NoEnvelope { reason }.into()),
        _ => Ok(()),
    }
}

/// The doubt about areas whose orientation is probably in degrees, as a line.
pub(crate) fn doubt(doubtful: u64) -> Option<String> {
    (doubtful > 0).then(|| {
        let paths = text::counted(doubtful, "path");
        format!(
            "{paths} with an orientation beyond what the format allows, perhaps in degrees: the \
             swept areas are in doubt"
        )
    })
}

/// One line per reason: `3 paths without an envelope: the file gives none`.
pub(crate) fn missing(without: &[u64; NoEnvelope::ALL.len()]) -> Vec<String> {
    let reasons = NoEnvelope::ALL
        .into_iter()
        .filter(|&reason| without[reason as usize] > 0);
    reasons
        .map(|reason| {
            let paths = text::counted(without[reason as usize], "path");
            format!("{paths} without an envelope: {reason}")
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_a_vehicle_as_it_is_written() {
        assert_eq!(name(source("2x1.2,.5").unwrap()), "2x1.2,0.5");
        assert_eq!(name(EnvelopeSource::File), "file");
    }

    #[test]
    fn rejects_paths_without_any_envelope_with_the_reason() {
        assert!(require_any(1, &[0, 5, 0, 0]).is_ok() && require_any(0, &[0; 4]).is_ok());
        let error = require_any(0, &[0, 5, 1, 0]).unwrap_err();
        assert!(error.message.contains("the file gives none"));
        assert_eq!(missing(&[1, 0, 2, 0]).len(), 2);
    }
}
