//! What `--envelope` says.

use guideway::envelope::{Body, EnvelopeSource, NoEnvelope};

use super::{Failure, text};

/// Largest side of a vehicle.
const MOST_M: f64 = 100.0;

/// `LENGTHxWIDTH`, `LENGTHxWIDTH,REAR` or `file`.
pub(crate) fn source(text: &str) -> Result<EnvelopeSource, String> {
    if text == "file" {
        return Ok(EnvelopeSource::File);
    }
    let refuse = || {
        format!(
            "write the vehicle's length and width in meters, each above 0 and up to {MOST_M}, and with a comma how far \
             its reference point is from its rear end, such as 2x1.2 or 2x1.2,0.5; or `file` for what the file gives"
        )
    };
    let (size, rear) = match text.split_once(',') {
        Some((size, rear)) => (size, Some(rear)),
        None => (text, None),
    };
    let number = |text: &str| text.trim().parse::<f64>().map_err(|_| refuse());
    let (length, width) = size.split_once(['x', 'X']).ok_or_else(refuse)?;
    let (length_m, width_m) = (number(length)?, number(width)?);
    let rear_m = rear.map_or(Ok(length_m / 2.0), number)?;
    let is_side = |side_m: f64| side_m > 0.0 && side_m <= MOST_M;
    if !(is_side(length_m) && is_side(width_m) && (0.0..=length_m).contains(&rear_m)) {
        return Err(refuse());
    }
    Ok(EnvelopeSource::Vehicle(Body::vehicle(
        length_m, width_m, rear_m,
    )))
}

/// How the source is called in a report.
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

/// Refuses to go on where no path at all has an envelope, for a picture or a check would say nothing of that.
pub(crate) fn need_some(with: u64, without: &[u64; NoEnvelope::ALL.len()]) -> Result<(), Failure> {
    let most = NoEnvelope::ALL
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
pub(crate) fn lacking(without: &[u64; NoEnvelope::ALL.len()]) -> Vec<String> {
    let some = NoEnvelope::ALL
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
    fn a_vehicle_is_read() {
        let vehicle =
            |length, width, rear| Ok(EnvelopeSource::Vehicle(Body::vehicle(length, width, rear)));
        assert_eq!(source("2x1.2"), vehicle(2.0, 1.2, 1.0));
        assert_eq!(source("2X1.2, 0.5"), vehicle(2.0, 1.2, 0.5));
        assert_eq!(source("2x1,0"), vehicle(2.0, 1.0, 0.0));
        assert_eq!(source("file"), Ok(EnvelopeSource::File));
        assert_eq!(name(source("2x1.2,.5").unwrap()), "2x1.2,0.5");
    }

    #[test]
    fn refusals_show_a_good_value() {
        for bad in [
            "", "2", "2x", "0x1", "2x-1", "2x1,3", "2x1,-1", "NaNx1", "infx1", "101x1", "2x1,x",
            "2x1,0,0",
        ] {
            assert!(source(bad).unwrap_err().contains("2x1.2,0.5"), "{bad}");
        }
    }

    #[test]
    fn none_at_all_is_refused_with_the_reason() {
        assert!(need_some(1, &[0, 5, 0, 0]).is_ok() && need_some(0, &[0; 4]).is_ok());
        let refusal = need_some(0, &[0, 5, 1, 0]).unwrap_err();
        assert!(refusal.message.contains("the file gives none"));
        assert_eq!(lacking(&[1, 0, 2, 0]).len(), 2);
    }
}
