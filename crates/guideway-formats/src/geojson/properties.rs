//! GeoJSON properties: keeps the JSON text of each value, and reads it as a value for a column.

use std::borrow::Cow;
use std::collections::HashMap;

use guideway_layout::Value;
use serde::de::{Deserialize, Deserializer, MapAccess};
use serde_json::value::RawValue;

use crate::json::{Field, FromJson, Key};

/// Properties of a feature, in file order. The last value of a repeated name is used.
#[derive(Debug, Default)]
pub(crate) struct Properties<'a> {
    all: Vec<(String, Property<'a>)>,
}

/// The JSON text of a value other than null.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Property<'a>(&'a str);

/// A value in the type of a column.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum ColumnValue<'a> {
    Bool(bool),
    Int(i64),
    Float(f64),
    Text(Cow<'a, str>),
    /// A list or an object, as written.
    Json(&'a str),
}

impl<'a> Property<'a> {
    /// Returns the JSON text.
    pub(super) fn json(self) -> &'a str {
        self.0
    }

    /// Returns the value for a column. A number that no type holds exactly is its digits as text.
    pub(super) fn read(self) -> ColumnValue<'a> {
        let json = self.0;
        match json.as_bytes().first() {
            Some(b'{' | b'[') => ColumnValue::Json(json),
            Some(b'"') => ColumnValue::Text(string(json)),
            Some(b't') => ColumnValue::Bool(true),
            Some(b'f') => ColumnValue::Bool(false),
            _ => number(json),
        }
    }

    /// Returns the value as an identifier; `None` for a list or an object.
    pub(super) fn id(self) -> Option<String> {
        match self.read() {
            ColumnValue::Json(_) => None,
            value => Some(value.value().to_string()),
        }
    }

    /// Returns a string.
    pub(super) fn text(self) -> Option<Cow<'a, str>> {
        match self.read() {
            ColumnValue::Text(text) => Some(text),
            _ => None,
        }
    }

    /// Returns whether the value is a string.
    pub(super) fn is_text(self) -> bool {
        self.0.starts_with('"')
    }

    /// Parses the value into another type; `None` if it has another structure.
    pub(super) fn parse<T: Deserialize<'a>>(self) -> Option<T> {
        serde_json::from_str(self.0).ok()
    }
}

impl ColumnValue<'_> {
    pub(super) fn value(&self) -> Value<'_> {
        match self {
            Self::Bool(value) => Value::Bool(*value),
            Self::Int(value) => Value::Int(*value),
            Self::Float(value) => Value::Float(*value),
            Self::Text(value) => Value::Text(value),
            Self::Json(value) => Value::Json(value),
        }
    }
}

/// Decodes a string in quotes. One with an escape that is no character is kept as written.
fn string(json: &str) -> Cow<'_, str> {
    let inner = &json[1..json.len() - 1];
    if !inner.contains('\\') {
        return Cow::Borrowed(inner);
    }
    let decoded = serde_json::from_str(json).map(Cow::Owned);
    decoded.unwrap_or(Cow::Borrowed(inner))
}

fn number(json: &str) -> ColumnValue<'_> {
    let is_whole = !json.contains(['.', 'e', 'E']);
    match (json.parse(), json.parse::<f64>()) {
        (Ok(whole), _) if is_whole => ColumnValue::Int(whole),
        (_, Ok(number)) if !is_whole && number.is_finite() => ColumnValue::Float(number),
        _ => ColumnValue::Text(Cow::Borrowed(json)),
    }
}

impl<'a> Properties<'a> {
    /// Iterates over the properties in file order.
    pub(super) fn iter(&self) -> impl Iterator<Item = (&str, Property<'a>)> {
        self.all.iter().map(|(name, value)| (name.as_str(), *value))
    }

    /// Returns the value of a name.
    pub(super) fn get(&self, name: &str) -> Option<Property<'a>> {
        self.iter()
            .find(|(n, _)| *n == name)
            .map(|(_, value)| value)
    }

    /// Removes all values but the last of each name; it takes the place of the first.
    fn remove_repeated(&mut self) {
        /// Above this number a table of names is faster than comparing all pairs.
        const FEW: usize = 32;
        let all = std::mem::take(&mut self.all);
        let mut rows: HashMap<String, usize> = HashMap::new();
        let is_few = all.len() <= FEW;
        for (name, value) in all {
            let known = match is_few {
                true => self.all.iter().position(|(n, _)| *n == name),
                false => rows.get(&name).copied(),
            };
            match known {
                Some(row) => self.all[row].1 = value,
                None => {
                    if !is_few {
                        rows.insert(name.clone(), self.all.len());
                    }
                    self.all.push((name, value));
                }
            }
        }
    }
}

impl<'a> FromJson<'a> for Properties<'a> {
    fn from_object<A: MapAccess<'a>>(mut object: A) -> Result<Field<Self>, A::Error> {
        let mut found = Self::default();
        while let Some(name) = object.next_key_seed(Key(str::to_owned))? {
            if let Field::Value(value) = object.next_value()? {
                found.all.push((name, value));
            }
        }
        found.remove_repeated();
        Ok(Field::Value(found))
    }
}

impl<'a> FromJson<'a> for Property<'a> {
    fn field<D: Deserializer<'a>>(deserializer: D) -> Result<Field<Self>, D::Error> {
        let json = <&'a RawValue>::deserialize(deserializer)?.get();
        Ok(match json {
            "null" => Field::Absent,
            json => Field::Value(Self(json)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(json: &str) -> Properties<'_> {
        match serde_json::from_str::<Field<Properties<'_>>>(json).unwrap() {
            Field::Value(properties) => properties,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn values_keep_their_type_and_digits() {
        for (json, value) in [
            ("true", ColumnValue::Bool(true)),
            ("-3", ColumnValue::Int(-3)),
            ("9007199254740993", ColumnValue::Int(9_007_199_254_740_993)),
            (
                "18446744073709551616",
                ColumnValue::Text("18446744073709551616".into()),
            ),
            ("1e400", ColumnValue::Text("1e400".into())),
            ("2.0", ColumnValue::Float(2.0)),
            (r#""a\u00e9\n""#, ColumnValue::Text("aé\n".into())),
            (r#""\ud800""#, ColumnValue::Text(r"\ud800".into())),
            (r#"[1, {"a": 2}]"#, ColumnValue::Json(r#"[1, {"a": 2}]"#)),
        ] {
            assert_eq!(Property(json).read(), value, "{json}");
        }
    }

    #[test]
    fn the_last_value_of_a_name_counts() {
        for count in [3, 100] {
            let fields = (0..count).map(|i| format!(r#""p{i}": {i}"#));
            let fields: Vec<_> = fields.collect();
            let json = format!(r#"{{{}, "p1": "x", "gone": null}}"#, fields.join(","));
            let properties = parse(&json);
            let names: Vec<_> = properties.iter().map(|(name, _)| name).collect();
            assert_eq!((names.len(), names[1]), (count, "p1"));
            assert_eq!(properties.get("p1").unwrap().json(), r#""x""#);
        }
    }
}
