//! Colors paths by a column: classes for few distinct values or between breaks, a ramp for many
//! numbers.

use std::cmp::Ordering;
use std::collections::HashMap;

use guideway_layout::{Direction, Layout, Quantity, Values};

use crate::breaks::ClassBreaks;
use crate::color::Rgba;
use crate::ramp::{NumberColors, Ramp, ticks};

/// The column that decides the color of each path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ColorBy {
    /// Name of an attribute, or `level`, `direction` or `vehicle_type`.
    pub column: String,
}

impl ColorBy {
    /// The least and the largest number of the column; `None` if it has no numbers. Cost: O(paths).
    pub fn range(&self, layout: &Layout) -> Option<[f64; 2]> {
        let number = numbers(layout, &self.column)?;
        let rows = 0..layout.paths.len() as u32;
        let range = range_of(|| rows.clone().filter_map(&number), None);
        range[0].is_finite().then_some(range)
    }

    /// Class breaks at the round numbers of the continuous scale of the column, whose ends are as
    /// in [`NumberColors::range`]. A break that has no number below it is left out if there are
    /// others. `None` if the column has no numbers. Cost: O(paths).
    pub fn round_breaks(&self, layout: &Layout, range: Option<[f64; 2]>) -> Option<ClassBreaks> {
        let [least, _] = self.range(layout)?;
        let number = numbers(layout, &self.column)?;
        let rows = 0..layout.paths.len() as u32;
        let [low, high] = range_of(|| rows.clone().filter_map(&number), range);
        // The texts have no rounding errors.
        let ticks = ticks(low, high).into_iter();
        let round: Vec<f64> = ticks.filter_map(|(_, text)| text.parse().ok()).collect();
        let needless = match round[..] {
            [first, _, ..] if first <= least => 1,
            _ => 0,
        };
        ClassBreaks::new(&round[needless..]).ok()
    }
}

/// Meaning of the colors of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    /// The column that decides the colors.
    pub column: String,
    /// Symbol of the unit of its numbers, if it is known.
    pub unit: Option<&'static str>,
    /// Round numbers of the scale, lowest first; then classes, in reading order.
    pub entries: Vec<LegendEntry>,
    /// The scale of the colors, if colors between those of the entries occur too.
    pub scale: Option<LegendScale>,
}

/// A continuous scale of a legend.
#[derive(Clone, Debug, PartialEq)]
pub struct LegendScale {
    /// Colors evenly along the scale, the lowest number first.
    pub colors: Vec<Rgba>,
    /// Places of the first entries along the scale, from 0 to 1. Further entries are classes.
    pub at: Vec<f64>,
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
/// scale. Numbers get the classes between breaks that are given. Else a column with more distinct
/// numbers than palette colors gets a scale, and so does one whose range is given.
pub(crate) fn resolve(
    layout: &Layout,
    by: &ColorBy,
    style: &NumberColors,
    drawn: &[u32],
) -> Result<(Vec<Rgba>, Legend), UnknownColumn> {
    if let Some(numbers) = numbers(layout, &by.column) {
        if let Some(breaks) = &style.breaks {
            return Ok(graduated(layout, (by, style), breaks, drawn, numbers));
        }
        if style.range.is_some() {
            return Ok(scale(layout, (by, style), drawn, numbers));
        }
        let mut distinct: Vec<f64> = Vec::new();
        for value in drawn.iter().filter_map(|&path| numbers(path)) {
            if !distinct.contains(&value) {
                distinct.push(value);
            }
            if distinct.len() > CLASSES.len() {
                return Ok(scale(layout, (by, style), drawn, numbers));
            }
        }
    }
    let label = labels(layout, &by.column)?;
    Ok(classes(layout, (by, style), drawn, label))
}

type Numbers<'a> = Box<dyn Fn(u32) -> Option<f64> + 'a>;
type Labels<'a> = Box<dyn Fn(u32) -> Option<String> + 'a>;

/// Access to the numbers of a column by row; `None` if it is not numeric.
fn numbers<'a>(layout: &'a Layout, column: &str) -> Option<Numbers<'a>> {
    let paths = &layout.paths;
    let column = paths.column(column)?;
    let is_number = matches!(column.values, Values::Int(_) | Values::Float(_));
    let number = |path: u32| {
        let number = paths.value(path as usize, &column.name)?.number();
        number.filter(|number| number.is_finite())
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
            Some(level.name_or_id().to_owned())
        })),
        "direction" => Ok(Box::new(|path| {
            let both = paths.get(path as usize).direction() == Direction::Both;
            Some(if both { "two-way" } else { "one-way" }.to_owned())
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

fn scale(
    layout: &Layout,
    (by, style): (&ColorBy, &NumberColors),
    drawn: &[u32],
    number: Numbers<'_>,
) -> (Vec<Rgba>, Legend) {
    let values = || drawn.iter().filter_map(|&path| number(path));
    let [low, high] = range_of(values, style.range);
    let ramp = Ramp::new(style);
    let share = |value: f64| match high > low {
        true => (value - low) / (high - low),
        false if value > low => 1.0,
        false => 0.0,
    };
    let color = |path| number(path).map_or(MISSING, |value| ramp.at(share(value)));
    let colors = (0..layout.paths.len() as u32).map(color).collect();
    let (mut entries, mut at) = (Vec::new(), Vec::new());
    for (value, label) in ticks(low, high) {
        let share = share(value).clamp(0.0, 1.0);
        at.push(share);
        entries.push(LegendEntry {
            label,
            color: ramp.at(share),
            paths: None,
        });
    }
    let missing = drawn.len() - values().count();
    entries.extend((missing > 0).then(|| no_value(missing as u64)));
    (
        colors,
        Legend {
            column: by.column.clone(),
            unit: unit(layout, by),
            entries,
            scale: Some(LegendScale {
                colors: ramp.into_colors(),
                at,
            }),
        },
    )
}

/// The ends of a scale: the finite ones of a given range, else the least and the largest value.
fn range_of<V: Iterator<Item = f64>>(values: impl Fn() -> V, given: Option<[f64; 2]>) -> [f64; 2] {
    let [low, high] = given.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
    let or = |end: f64, value: &dyn Fn() -> f64| if end.is_finite() { end } else { value() };
    let low = or(low, &|| values().fold(high, f64::min));
    [low, or(high, &|| values().fold(low, f64::max))]
}

/// Gives each class between breaks a color, whether it has paths or not.
fn graduated(
    layout: &Layout,
    (by, style): (&ColorBy, &NumberColors),
    breaks: &ClassBreaks,
    drawn: &[u32],
    number: Numbers<'_>,
) -> (Vec<Rgba>, Legend) {
    let labels = breaks.labels();
    let class_colors = class_colors(labels.len(), Some(style));
    let mut counts = vec![0; labels.len()];
    let mut missing = 0;
    for &path in drawn {
        match number(path) {
            Some(value) => counts[breaks.class(value)] += 1,
            None => missing += 1,
        }
    }
    let color = |path| number(path).map_or(MISSING, |value| class_colors[breaks.class(value)]);
    let colors = (0..layout.paths.len() as u32).map(color).collect();
    let classes = labels.into_iter().zip(&class_colors).zip(counts);
    let classes = classes.map(|((label, &color), paths)| LegendEntry {
        label,
        color,
        paths: Some(paths),
    });
    let entries = classes.chain((missing > 0).then(|| no_value(missing)));
    (
        colors,
        Legend {
            column: by.column.clone(),
            unit: unit(layout, by),
            entries: entries.collect(),
            scale: None,
        },
    )
}

fn no_value(paths: u64) -> LegendEntry {
    LegendEntry {
        label: "no value".to_owned(),
        color: MISSING,
        paths: Some(paths),
    }
}

/// Colors of `count` classes: of the ramp if they are ordered numbers, else of the list.
fn class_colors(count: usize, numbers: Option<&NumberColors>) -> Vec<Rgba> {
    let share = |class: usize| class as f64 / count.max(2).saturating_sub(1) as f64;
    match numbers.map(Ramp::new) {
        Some(ramp) => (0..count).map(|class| ramp.at(share(class))).collect(),
        None => CLASSES[..count].to_vec(),
    }
}

/// Gives each of the most frequent values a color; the others share one.
fn classes(
    layout: &Layout,
    (by, style): (&ColorBy, &NumberColors),
    drawn: &[u32],
    label: Labels<'_>,
) -> (Vec<Rgba>, Legend) {
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
    let class_colors = class_colors(by_count.len(), are_numbers.then_some(style));
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
        entries.push(no_value(missing));
    }
    (
        colors,
        Legend {
            column: by.column.clone(),
            unit: unit(layout, by),
            entries,
            scale: None,
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ordered_classes_span_the_ramp() {
        let style = NumberColors::default();
        let ramp = Ramp::new(&style);
        let colors = class_colors(3, Some(&style));
        assert_eq!((colors[0], colors[2]), (ramp.at(0.0), ramp.at(1.0)));
        assert_eq!(class_colors(1, Some(&style)), [ramp.at(0.0)]);
        assert_eq!(class_colors(2, None), CLASSES[..2]);
    }
}
