//! Parsers of argument values. Each error shows a valid value.

use std::ffi::OsStr;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use guideway::AUTO;
use guideway::layout::Limits;
use guideway::scene::{ClassBreaks, Frame, FrameSize, Palette, ParseColorError, Rgba};
use guideway::spline::Point;

use super::process::MAX_THREADS;

/// The size of a picture that fits one frame, such as `1920x1080`.
pub(crate) fn frame_size(text: &str) -> Result<FrameSize, String> {
    let size = size(text)?;
    if size.pixels() > Frame::MAX_PIXELS {
        return Err(format!(
            "above the limit of {} million pixels; write a smaller size, such as 1920x1080",
            Frame::MAX_PIXELS / 1_000_000
        ));
    }
    Ok(size)
}

/// A picture size such as `1920x1080`.
pub(crate) fn size(text: &str) -> Result<FrameSize, String> {
    let sides = text.split_once(['x', 'X']).and_then(|(width, height)| {
        let width: u32 = width.trim().parse().ok()?;
        let height: u32 = height.trim().parse().ok()?;
        Some((width, height))
    });
    let Some((width, height)) = sides else {
        return Err("write width and height in pixels, such as 1920x1080".into());
    };
    FrameSize::new(width, height).map_err(|_| {
        format!(
            "each side has 1 to {} pixels, such as 1920x1080",
            FrameSize::MAX_SIDE
        )
    })
}

/// A background: a color, or `none`.
pub(crate) fn background(text: &str) -> Result<Rgba, String> {
    match text {
        // White where a program drops the transparency.
        "none" => Ok(Rgba::WHITE.with_opacity(0.0)),
        color => color
            .parse()
            .map_err(|error: ParseColorError| error.to_string()),
    }
}

/// The name of a palette.
pub(crate) fn palette() -> impl TypedValueParser<Value = Palette> {
    PossibleValuesParser::new(Palette::ALL.map(Palette::name))
        .try_map(|name| Palette::named(&name).ok_or("the list of palettes has this name"))
}

/// A range of numbers such as `0..2`.
pub(crate) fn range(text: &str) -> Result<[f64; 2], String> {
    let ends = text.split_once("..").and_then(|(low, high)| {
        let ends = [low.trim().parse().ok()?, high.trim().parse().ok()?];
        (ends.iter().all(|end: &f64| end.is_finite()) && ends[0] < ends[1]).then_some(ends)
    });
    ends.ok_or_else(|| "write the lower and the higher end, such as 0..2".to_owned())
}

/// Class breaks such as `0.3,0.6,1`.
pub(crate) fn breaks(text: &str) -> Result<ClassBreaks, String> {
    let numbers = text.split(',').map(|part| {
        let error = |_| format!("`{part}` is no number; write numbers such as 0.3,0.6,1");
        part.trim().parse::<f64>().map_err(error)
    });
    let numbers: Vec<f64> = numbers.collect::<Result<_, _>>()?;
    ClassBreaks::new(&numbers).map_err(|error| format!("{error}, such as 0.3,0.6,1"))
}

/// A point such as `12.5,-3`.
pub(crate) fn point(text: &str) -> Result<Point<f64>, String> {
    let error = || "write x and y in meters, separated by a comma, such as 12.5,-3".to_owned();
    let (x, y) = text.split_once(',').ok_or_else(error)?;
    let number = |text: &str| text.trim().parse::<f64>().map_err(|_| error());
    let point = Point::new(number(x)?, number(y)?);
    match [point.x, point.y].iter().all(|v| v.abs() <= MAX_M) {
        true => Ok(point),
        false => Err(format!("{}, each at most {MAX_M:e} from 0", error())),
    }
}

/// Largest length and coordinate, in meters: that of the layouts.
const MAX_M: f64 = 1e9;
/// Largest width of a path in pixels: that of a picture.
const MAX_PX: f64 = FrameSize::MAX_SIDE as f64;

/// A length above zero in meters.
pub(crate) fn positive(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value > 0.0 && value <= MAX_M => Ok(value),
        _ => Err("write a number above 0 and at most 1e9, such as 0.5 or 40".into()),
    }
}

/// A factor, such as a scale.
pub(crate) fn factor(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if (1e-9..=1e9).contains(&value) => Ok(value),
        _ => Err("write a number from 1e-9 to 1e9, such as 0.5 or 40".into()),
    }
}

/// A page, counted from 1.
pub(crate) fn page(text: &str) -> Result<u32, String> {
    match text.trim().parse::<u32>() {
        Ok(page) if page > 0 => Ok(page),
        _ => Err("write the number of a page, from 1".into()),
    }
}

/// A width in pixels.
pub(crate) fn width_px(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if (0.0..=MAX_PX).contains(&value) => Ok(value),
        _ => Err(format!(
            "write a number of pixels from 0 to {MAX_PX}, such as 1.5"
        )),
    }
}

/// A number of threads; 0 for one per core.
pub(crate) fn threads(text: &str) -> Result<usize, String> {
    match text.parse::<usize>() {
        Ok(n) if n <= MAX_THREADS => Ok(n),
        _ => Err(format!(
            "write a whole number from 0 to {MAX_THREADS}, such as 4"
        )),
    }
}

/// An angle in degrees.
pub(crate) fn degrees(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err("write an angle in degrees, such as 90 or -12.5".into()),
    }
}

/// A length of at least 0 in meters, or an angle.
pub(crate) fn not_negative(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if (0.0..=MAX_M).contains(&value) => Ok(value),
        _ => Err("write a number from 0 to 1e9, such as 0.1 or 2".into()),
    }
}

/// A number of paths, such as 1000000, 1_000_000, 1e6, 10k or 1M.
pub(crate) fn paths(text: &str) -> Result<usize, String> {
    let max = Limits::default().paths;
    match count(text) {
        Some(n) if (1..=max).contains(&n) => Ok(n as usize),
        _ => Err(format!(
            "write a whole number from 1 to {max}, such as 1_000_000, 1e6 or 10k"
        )),
    }
}

/// A whole number as people write it; `None` if it has a fraction or is no number.
pub(crate) fn count(text: &str) -> Option<u64> {
    let text = text.trim().replace(['_', ','], "");
    let (digits, factor) = match text.char_indices().next_back()? {
        (at, 'k' | 'K') => (&text[..at], 1e3),
        (at, 'm' | 'M') => (&text[..at], 1e6),
        (at, 'g' | 'G') => (&text[..at], 1e9),
        _ => (&text[..], 1.0),
    };
    if let (Ok(number), true) = (digits.parse::<u64>(), factor == 1.0) {
        return Some(number);
    }
    let is_number = digits.starts_with(|first: char| first.is_ascii_digit());
    let number = digits.parse::<f64>().ok().filter(|_| is_number)? * factor;
    // Above 2^53 a float skips whole numbers.
    let is_whole = number.fract() == 0.0 && number < 9e15;
    is_whole.then_some(number as u64)
}

/// A number of frames from 0 to 100,000 that are not measured.
pub(crate) fn warmup(text: &str) -> Result<usize, String> {
    match text {
        "0" => Ok(0),
        _ => frames(text).map_err(|_| "write a whole number from 0 to 100000, such as 3".into()),
    }
}

/// A number of frames from 1 to 100,000.
pub(crate) fn frames(text: &str) -> Result<usize, String> {
    match text.parse::<usize>() {
        Ok(n) if (1..=100_000).contains(&n) => Ok(n),
        _ => Err("write a whole number from 1 to 100000, such as 20".into()),
    }
}

/// A number of minutes, at most a day.
pub(crate) fn minutes(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value > 0.0 && value <= 1440.0 => Ok(value),
        _ => Err("write a number above 0 and at most 1440, such as 9 or 0.5".into()),
    }
}

/// A share in percent, above 0 and at most 100.
pub(crate) fn percent(text: &str) -> Result<f64, String> {
    match text.trim_end_matches('%').trim().parse::<f64>() {
        Ok(value) if value > 0.0 && value <= 100.0 => Ok(value),
        _ => Err("write a number above 0 and at most 100, such as 1, 10 or 100".into()),
    }
}

/// A zoom factor; below 1 zooms out.
pub(crate) fn times(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if (1e-3..=1e9).contains(&value) => Ok(value),
        _ => Err("write a number from 0.001 to 1e9, such as 20".into()),
    }
}

/// The name of a known method with options. The method itself parses the options.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MethodSpec;

impl MethodSpec {
    fn names() -> PossibleValuesParser {
        PossibleValuesParser::new(std::iter::once(AUTO).chain(guideway::method_names()))
    }
}

impl TypedValueParser for MethodSpec {
    type Value = String;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<String, clap::Error> {
        let spec = value.to_string_lossy();
        let name = spec.split('+').next().unwrap_or_default();
        Self::names().parse_ref(command, argument, OsStr::new(name))?;
        Ok(spec.into_owned())
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let names = std::iter::once(AUTO).chain(guideway::method_names());
        Some(Box::new(names.map(PossibleValue::new)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parses_valid_values() {
        assert_eq!(size("1920x1080").unwrap().width(), 1920);
        assert_eq!(size("1X2").unwrap().height(), 2);
        assert_eq!(point("-1.5, 2e3").unwrap(), Point::new(-1.5, 2000.0));
        assert_eq!(positive("0.5"), Ok(0.5));
        assert_eq!(not_negative("0"), Ok(0.0));
        assert_eq!(breaks("-0.5, 1e1").unwrap().numbers(), [-0.5, 10.0]);
        for (text, number) in [
            ("1_000", 1000),
            ("1,000", 1000),
            ("1e3", 1000),
            ("2.5k", 2500),
            ("1M", 1_000_000),
            ("1.02e6", 1_020_000),
        ] {
            assert_eq!(paths(text), Ok(number), "{text}");
        }
        assert_eq!(frames("20"), Ok(20));
        assert_eq!(minutes("0.5"), Ok(0.5));
        assert_eq!(percent("1"), Ok(1.0));
        assert_eq!(percent("100 %"), Ok(100.0));
    }

    #[test]
    fn errors_show_a_valid_value() {
        for bad in ["0x0", "1e9x2", "12", "x", "-1x5", "70000x1", ""] {
            assert!(size(bad).unwrap_err().contains("1920x1080"), "{bad}");
            assert!(frame_size(bad).is_err(), "{bad}");
        }
        assert!(size("65535x65535").is_ok());
        let error = frame_size("65535x65535").unwrap_err();
        assert!(error.contains("1920x1080"), "{error}");
        for bad in ["", "0.3,", "0.3;0.6", "a", "0.6,0.3", "1,1", "0,inf", "NaN"] {
            assert!(breaks(bad).unwrap_err().contains("0.3,0.6,1"), "{bad}");
        }
        for bad in ["1", "1;2", "a,b", "NaN,0", "1,2,3", "inf,0", "1e10,0"] {
            assert!(point(bad).unwrap_err().contains("12.5,-3"), "{bad}");
        }
        for bad in ["NaN", "inf", "-1", "0", "", "1m", "1.1e9", "1e308"] {
            assert!(positive(bad).unwrap_err().contains("such as"), "{bad}");
            assert!(factor(bad).unwrap_err().contains("such as"), "{bad}");
        }
        for bad in ["NaN", "inf", "-1", "", "1e22", "65536"] {
            assert!(width_px(bad).unwrap_err().contains("such as"), "{bad}");
            assert!(threads(bad).unwrap_err().contains("such as"), "{bad}");
        }
        assert!(not_negative("-0.1").is_err());
        for bad in ["0", "-1", "100.1", "NaN", "inf", ""] {
            assert!(percent(bad).unwrap_err().contains("such as"), "{bad}");
        }
        for bad in ["0", "-1", "1441", "NaN", "inf", ""] {
            assert!(minutes(bad).unwrap_err().contains("such as"), "{bad}");
        }
        for bad in ["0", "-1", "100001", "1.5"] {
            assert!(frames(bad).unwrap_err().contains("such as"), "{bad}");
        }
        for bad in [
            "0",
            "-1",
            "1e-1",
            "1.5",
            "k",
            "",
            "inf",
            "NaN",
            "1e400",
            "100000001",
            "1T",
        ] {
            assert!(paths(bad).unwrap_err().contains("such as"), "{bad}");
        }
    }
}
