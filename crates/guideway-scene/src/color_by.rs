//! Colors paths by a column: classes for few distinct values, a continuous scale for many numbers.

use std::cmp::Ordering;
use std::collections::HashMap;

use guideway_layout::{Direction, Layout, Quantity, Value, Values};

use crate::color::Rgba;

/// The column that decides the color of each path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ColorBy {
    /// Name of an attribute, or `level`, `direction` or `vehicle_type`.
    pub column: String,
}

/// Meaning of the colors of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    /// The column that decides the colors.
    pub column: String,
    /// Symbol of the unit of its numbers, if it is known.
    pub unit: Option<&'static str>,
    /// Classes, or samples of a scale, in reading order.
    pub entries: Vec<LegendEntry>,
    /// True if colors between those of the entries occur too.
    pub is_continuous: bool,
}

impl Legend {
    /// Title: the column with its unit, such as `maxSpeed (m/s)`.
    pub fn title(&self) -> String {
        match self.unit {
            Some(unit) => format!("{} ({unit})", self.column),
            None => self.column.clone(),
        }
    }
}

/// A row of a legend.
#[derive(Clone, Debug, PartialEq)]
pub struct LegendEntry {
    /// The value as text.
    pub label: String,
    /// Its color.
    pub color: Rgba,
    /// Number of shown paths of the class; `None` on a scale.
    pub paths: Option<u64>,
}

/// Palette of Okabe and Ito (2008), distinguishable with any color vision. Without its black, and
/// with its yellow darkened for white paper.
const CLASSES: [Rgba; 7] = [
    Rgba::opaque(0, 114, 178),
    Rgba::opaque(230, 159, 0),
    Rgba::opaque(0, 158, 115),
    Rgba::opaque(204, 121, 167),
    Rgba::opaque(213, 94, 0),
    Rgba::opaque(86, 180, 233),
    Rgba::opaque(190, 170, 30),
];
/// Samples of the scale of numbers, from blue over red to orange: lightness and warmth rise. Each
/// color has a contrast of at least 3:1 on white and on dark paper (WCAG 2.2, criterion 1.4.11).
const SCALE: [Rgba; 5] = [
    Rgba::opaque(66, 94, 212),
    Rgba::opaque(136, 80, 190),
    Rgba::opaque(186, 70, 140),
    Rgba::opaque(212, 80, 80),
    Rgba::opaque(226, 112, 20),
];
/// Color of values beyond the palette.
const OTHER: Rgba = Rgba::opaque(90, 90, 90);
/// Color of paths without a value.
const MISSING: Rgba = Rgba::opaque(160, 160, 160);

/// A column that the layout does not have.
pub(crate) struct UnknownColumn {
    /// Columns that it has.
    pub(crate) known: Vec<String>,
}

/// Color per row, and the legend. `drawn` lists the shown rows, which decide the classes or the
/// scale. A column with more distinct numbers than palette colors gets a scale.
pub(crate) fn resolve(
    layout: &Layout,
    by: &ColorBy,
    drawn: &[u32],
) -> Result<(Vec<Rgba>, Legend), UnknownColumn> {
    if let Some(numbers) = numbers(layout, &by.column) {
        let mut distinct: Vec<f64> = Vec::new();
        for value in drawn.iter().filter_map(|&path| numbers(path)) {
            if !distinct.contains(&value) {
                distinct.push(value);
            }
            if distinct.len() > CLASSES.len() {
                return Ok(scale(layout, by, drawn, numbers));
            }
        }
    }
    let label = labels(layout, &by.column)?;
    Ok(classes(layout, by, drawn, label))
}

type Numbers<'a> = Box<dyn Fn(u32) -> Option<f64> + 'a>;
type Labels<'a> = Box<dyn Fn(u32) -> Option<String> + 'a>;

/// Access to the numbers of a column by row; `None` if it is not numeric.
fn numbers<'a>(layout: &'a Layout, column: &str) -> Option<Numbers<'a>> {
    let paths = &layout.paths;
    let column = paths.column(column)?;
    let is_number = matches!(column.values, Values::Int(_) | Values::Float(_));
    let number = |path: u32| match paths.value(path as usize, &column.name)? {
        Value::Int(value) => Some(value as f64),
        Value::Float(value) => value.is_finite().then_some(value),
        Value::Bool(_) | Value::Text(_) | Value::Json(_) => None,
    };
    is_number.then(|| Box::new(number) as Numbers<'_>)
}

/// Access to the values of a column as text, by row.
fn labels<'a>(layout: &'a Layout, column: &str) -> Result<Labels<'a>, UnknownColumn> {
    let paths = &layout.paths;
    if let Some(attribute) = paths.column(column) {
        return Ok(Box::new(|path| {
            let value = paths.value(path as usize, &attribute.name)?;
            Some(value.to_string())
        }));
    }
    match column {
        "level" => Ok(Box::new(|path| {
            let level = &layout.levels[paths.get(path as usize).level()? as usize];
            Some(level.name.clone().unwrap_or_else(|| level.id.clone()))
        })),
        "direction" => Ok(Box::new(|path| {
            let both = paths.get(path as usize).direction() == Direction::Both;
            Some(if both { "both ways" } else { "one way" }.to_owned())
        })),
        "vehicle_type" => Ok(Box::new(|path| {
            let types: Vec<_> = paths.vehicle_types().of(path as usize).collect();
            (!types.is_empty()).then(|| types.join(", "))
        })),
        _ => {
            let own = paths.column_names().map(str::to_owned);
            let built_in = ["level", "direction", "vehicle_type"].map(str::to_owned);
            Err(UnknownColumn {
                known: own.chain(built_in).collect(),
            })
        }
    }
}

fn unit(layout: &Layout, by: &ColorBy) -> Option<&'static str> {
    let column = layout.paths.column(&by.column)?;
    column.quantity.map(Quantity::unit)
}

fn scale(layout: &Layout, by: &ColorBy, drawn: &[u32], number: Numbers<'_>) -> (Vec<Rgba>, Legend) {
    let values = || drawn.iter().filter_map(|&path| number(path));
    let low = values().fold(f64::INFINITY, f64::min);
    let high = values().fold(f64::NEG_INFINITY, f64::max);
    let color = |path| number(path).map_or(MISSING, |v| scale_color((v - low) / (high - low)));
    let colors = (0..layout.paths.len() as u32).map(color).collect();
    let entries = (0..SCALE.len())
        .map(|i| i as f64 / (SCALE.len() - 1) as f64)
        .map(|t| LegendEntry {
            label: format!("{:.6}", low + (high - low) * t)
                .trim_end_matches('0')
                .trim_end_matches('.')
                .to_owned(),
            color: scale_color(t),
            paths: None,
        })
        .collect();
    (
        colors,
        Legend {
            column: by.column.clone(),
            unit: unit(layout, by),
            entries,
            is_continuous: true,
        },
    )
}

/// The color of the scale at a fraction of its range.
fn scale_color(fraction: f64) -> Rgba {
    let step = fraction * (SCALE.len() - 1) as f64;
    let below = (step as usize).min(SCALE.len() - 2);
    SCALE[below].lerp(SCALE[below + 1], step - below as f64)
}

/// Colors of `count` classes: of the scale if they are ordered numbers, else of the palette.
fn class_colors(count: usize, are_numbers: bool) -> Vec<Rgba> {
    let fraction = |class: usize| class as f64 / count.max(2).saturating_sub(1) as f64;
    match are_numbers {
        true => (0..count)
            .map(|class| scale_color(fraction(class)))
            .collect(),
        false => CLASSES[..count].to_vec(),
    }
}

/// Gives each of the most frequent values a color; the others share one.
fn classes(layout: &Layout, by: &ColorBy, drawn: &[u32], label: Labels<'_>) -> (Vec<Rgba>, Legend) {
    let mut counts: HashMap<String, u64> = HashMap::new();
    let mut missing = 0;
    for &path in drawn {
        match label(path) {
            Some(value) => *counts.entry(value).or_insert(0) += 1,
            None => missing += 1,
        }
    }
    let mut by_count: Vec<(String, u64)> = counts.into_iter().collect();
    by_count.sort_by(|a, b| b.1.cmp(&a.1).then_with(|| a.0.cmp(&b.0)));
    let rest = by_count.split_off(by_count.len().min(CLASSES.len()));
    // Numbers are listed in ascending order, not by frequency.
    let number = |value: &String| value.parse::<f64>().ok();
    let are_numbers = by_count.iter().all(|(value, _)| number(value).is_some());
    if are_numbers {
        let by_value = |a: &String, b: &String| number(a).partial_cmp(&number(b));
        by_count.sort_by(|a, b| by_value(&a.0, &b.0).unwrap_or(Ordering::Equal));
    }
    let class_colors = class_colors(by_count.len(), are_numbers);
    let color_of: HashMap<&str, Rgba> = by_count
        .iter()
        .zip(&class_colors)
        .map(|((value, _), color)| (value.as_str(), *color))
        .collect();
    let color = |path| match label(path) {
        Some(value) => color_of.get(value.as_str()).copied().unwrap_or(OTHER),
        None => MISSING,
    };
    let colors = (0..layout.paths.len() as u32).map(color).collect();
    let entry = |label: &str, color, paths| LegendEntry {
        label: label.to_owned(),
        color,
        paths: Some(paths),
    };
    let mut entries: Vec<_> = by_count
        .iter()
        .zip(class_colors)
        .map(|((value, n), color)| entry(value, color, *n))
        .collect();
    if !rest.is_empty() {
        let paths = rest.iter().map(|(_, n)| n).sum();
        entries.push(entry(&format!("{} other values", rest.len()), OTHER, paths));
    }
    if missing > 0 {
        entries.push(entry("no value", MISSING, missing));
    }
    (
        colors,
        Legend {
            column: by.column.clone(),
            unit: unit(layout, by),
            entries,
            is_continuous: false,
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance of WCAG 2.2.
    fn luminance(color: Rgba) -> f64 {
        let linear = |channel: u8| match f64::from(channel) / 255.0 {
            c if c <= 0.04045 => c / 12.92,
            c => ((c + 0.055) / 1.055).powf(2.4),
        };
        0.2126 * linear(color.r) + 0.7152 * linear(color.g) + 0.0722 * linear(color.b)
    }

    #[test]
    fn scale_contrasts_with_light_and_dark_paper() {
        let dark = luminance(Rgba::opaque(24, 26, 30));
        for step in 0..=100 {
            let color = luminance(scale_color(f64::from(step) / 100.0));
            let (on_white, on_dark) = (1.05 / (color + 0.05), (color + 0.05) / (dark + 0.05));
            assert!(
                on_white >= 3.0 && on_dark >= 3.0,
                "{step}: {on_white} {on_dark}"
            );
        }
    }

    #[test]
    fn ordered_classes_span_the_scale() {
        let colors = class_colors(3, true);
        assert_eq!((colors[0], colors[2]), (SCALE[0], SCALE[4]));
        assert_eq!(class_colors(1, true), [SCALE[0]]);
        assert_eq!(class_colors(2, false), CLASSES[..2]);
    }
}
