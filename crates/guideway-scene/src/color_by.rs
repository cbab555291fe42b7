use std::cmp::Ordering;
use std::collections::HashMap;

use guideway_layout::{Direction, Layout, Values};

use crate::{Rgba, SceneError};

/// Which column decides the color.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ColorBy {
    /// Name of an attribute, or `level`, `direction` or `vehicle_type`.
    pub column: String,
}

/// What the colors of a scene mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    /// The column that decided.
    pub column: String,
    /// Classes, or the ends and steps of a scale, in reading order.
    pub entries: Vec<LegendEntry>,
    /// Whether colors between the entries occur too.
    pub is_continuous: bool,
}

/// One line of a legend.
#[derive(Clone, Debug, PartialEq)]
pub struct LegendEntry {
    /// The value, as a person reads it.
    pub label: String,
    /// Its color.
    pub color: Rgba,
    /// Drawn paths of that class; none on a scale.
    pub paths: Option<u64>,
}

/// Okabe and Ito's palette (2008), told apart with any color vision, without its black and with its
/// yellow darkened to show on white.
const CLASSES: [Rgba; 7] = [
    Rgba::opaque(0, 114, 178),
    Rgba::opaque(230, 159, 0),
    Rgba::opaque(0, 158, 115),
    Rgba::opaque(204, 121, 167),
    Rgba::opaque(213, 94, 0),
    Rgba::opaque(86, 180, 233),
    Rgba::opaque(190, 170, 30),
];
/// Steps of the cividis scale (Nuñez, Anderton, Renslow 2018): even in lightness with any color vision.
const SCALE: [Rgba; 5] = [
    Rgba::opaque(0, 32, 77),
    Rgba::opaque(66, 77, 108),
    Rgba::opaque(124, 123, 120),
    Rgba::opaque(187, 173, 108),
    Rgba::opaque(255, 234, 70),
];
const OTHER: Rgba = Rgba::opaque(90, 90, 90);
const MISSING: Rgba = Rgba::opaque(160, 160, 160);

pub(crate) fn resolve(
    layout: &Layout,
    by: &ColorBy,
    drawn: &[u32],
) -> Result<(Vec<Rgba>, Legend), SceneError> {
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

fn numbers<'a>(layout: &'a Layout, column: &str) -> Option<Numbers<'a>> {
    let finite = |v: f64| v.is_finite().then_some(v);
    match &layout.paths.attributes.get(column)?.values {
        Values::Int(v) => Some(Box::new(|path| Some(v.get(path as usize)? as f64))),
        Values::Float(v) => Some(Box::new(move |path| finite(v.get(path as usize)?))),
        Values::Bool(_) | Values::Text { .. } => None,
    }
}

fn labels<'a>(layout: &'a Layout, column: &str) -> Result<Labels<'a>, SceneError> {
    let paths = &layout.paths;
    if let Some(attribute) = paths.attributes.get(column) {
        return Ok(Box::new(|path| {
            attribute.values.get(path as usize).map(|v| v.to_string())
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
            let own = paths.attributes.iter().map(|a| a.name.clone());
            let built_in = ["level", "direction", "vehicle_type"].map(str::to_owned);
            Err(SceneError::UnknownColumn {
                asked: column.to_owned(),
                known: own.chain(built_in).collect(),
            })
        }
    }
}

fn scale(layout: &Layout, by: &ColorBy, drawn: &[u32], number: Numbers<'_>) -> (Vec<Rgba>, Legend) {
    let values = || drawn.iter().filter_map(|&path| number(path));
    let low = values().fold(f64::INFINITY, f64::min);
    let high = values().fold(f64::NEG_INFINITY, f64::max);
    let color_at = |fraction: f64| {
        let step = fraction * (SCALE.len() - 1) as f64;
        let below = (step as usize).min(SCALE.len() - 2);
        SCALE[below].lerp(SCALE[below + 1], step - below as f64)
    };
    let color = |path| number(path).map_or(MISSING, |v| color_at((v - low) / (high - low)));
    let colors = (0..layout.paths.len() as u32).map(color).collect();
    let entries = (0..SCALE.len())
        .map(|i| i as f64 / (SCALE.len() - 1) as f64)
        .map(|t| LegendEntry {
            label: format!("{:.6}", low + (high - low) * t)
                .trim_end_matches('0')
                .trim_end_matches('.')
                .to_owned(),
            color: color_at(t),
            paths: None,
        })
        .collect();
    (
        colors,
        Legend {
            column: by.column.clone(),
            entries,
            is_continuous: true,
        },
    )
}

/// The commonest values get a color each; the rest share one.
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
    // Numbers read from the least to the greatest.
    let number = |value: &String| value.parse::<f64>().ok();
    if by_count.iter().all(|(value, _)| number(value).is_some()) {
        let by_value = |a: &String, b: &String| number(a).partial_cmp(&number(b));
        by_count.sort_by(|a, b| by_value(&a.0, &b.0).unwrap_or(Ordering::Equal));
    }
    let color_of: HashMap<&str, Rgba> = by_count
        .iter()
        .zip(CLASSES)
        .map(|((value, _), color)| (value.as_str(), color))
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
        .zip(CLASSES)
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
            entries,
            is_continuous: false,
        },
    )
}
