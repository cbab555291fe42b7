//! What `--envelope` says.

use guideway::envelope::{Source, SourceError, Without};

use super::{Failure, text};

/// Parses `LENGTHxWIDTH`, `LENGTHxWIDTH,REAR` or `file`.
pub(crate) fn source(text: &str) -> Result<Source, SourceError> {
    text.parse()
}

/// How the source is called in a report.
pub(crate) fn name(source: Source) -> String {
    match source {
        Source::File => "file".to_owned(),
        Source::Vehicle(body) => {
            let [length, width, rear] =
                [body.length_m(), body.width_m(), body.rear_m].map(text::number);
            format!("{length}x{width},{rear}")
        }
    }
}

/// Refuses to go on where no path at all has an envelope, for a picture or a check would say nothing of that.
pub(crate) fn need_some(with: u64, without: &[u64; Without::ALL.len()]) -> Result<(), Failure> {
    let most = Without::ALL
        .into_iter()
        .max_by_key(|&why| without[why as usize]);
    match most {
        Some(why) if with == 0 && without[why as usize] > 0 => Err(Failure::arguments(
            format!("no path has an envelope: {why}"),
            "Say how large the vehicle is, such as `--envelope 2x1.2`",
        )),
        _ => Ok(()),
    }
}

/// `3 paths without an envelope: why`, a line for each reason.
pub(crate) fn lacking(without: &[u64; Without::ALL.len()]) -> Vec<String> {
    let some = Without::ALL
        .into_iter()
        .filter(|&why| without[why as usize] > 0);
    some.map(|why| {
        let paths = text::counted(without[why as usize], "path");
        format!("{paths} without an envelope: {why}")
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_a_vehicle_as_it_is_written() {
        assert_eq!(name(source("2x1.2,.5").unwrap()), "2x1.2,0.5");
    }

    #[test]
    fn none_at_all_is_refused_with_the_reason() {
        assert!(need_some(1, &[0, 5, 0, 0]).is_ok() && need_some(0, &[0; 4]).is_ok());
        let refusal = need_some(0, &[0, 5, 1, 0]).unwrap_err();
        assert!(refusal.message.contains("the file gives none"));
        assert_eq!(lacking(&[1, 0, 2, 0]).len(), 2);
    }
}
