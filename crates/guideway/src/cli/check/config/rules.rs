//! Rules of `guideway.toml`: which findings count, limits and thresholds, for all files and for
//! those whose names fit a pattern.

use std::collections::BTreeMap;

use guideway::layout::Code;
use serde::{Deserialize, Deserializer, de};

use super::super::codes::{CodeName, FailOn};
use super::glob::fits;
use crate::cli::{limits, values};

/// The content of a file.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub(super) struct ConfigFile {
    check: Table,
    limits: LimitSettings,
}

/// Rules for all files, and for some of them.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
struct Table {
    only: Option<Vec<CodeName>>,
    ignore: Vec<CodeName>,
    fail_on: Option<FailOn>,
    #[serde(deserialize_with = "not_negative")]
    gap: Option<f64>,
    #[serde(deserialize_with = "not_negative")]
    kink: Option<f64>,
    #[serde(deserialize_with = "positive")]
    min_radius: Option<f64>,
    #[serde(deserialize_with = "positive")]
    lateral_acceleration: Option<f64>,
    /// Patterns of file names, in a table of `files`.
    paths: Vec<String>,
    /// Rules for the files that patterns fit.
    files: Vec<Table>,
}

/// Limits by name.
#[derive(Clone, Debug, Default)]
struct LimitSettings(Vec<limits::Setting>);

/// The rules for one file.
#[derive(Clone, Debug, Default)]
pub(in super::super) struct Rules {
    /// Kinds that are reported; `None` for all.
    pub(in super::super) only: Option<Vec<Code>>,
    /// Kinds that are not reported.
    pub(in super::super) ignore: Vec<Code>,
    pub(in super::super) fail_on: Option<FailOn>,
    pub(in super::super) gap_m: Option<f64>,
    pub(in super::super) kink_deg: Option<f64>,
    pub(in super::super) min_radius_m: Option<f64>,
    pub(in super::super) lateral_acceleration_m_s2: Option<f64>,
    pub(in super::super) limits: Vec<limits::Setting>,
}

impl ConfigFile {
    /// Parses a file.
    ///
    /// # Errors
    /// When the text is no TOML, or has an unknown key or a bad value; the message has the line.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let file: Self = toml::from_str(text).map_err(|e| e.to_string().trim_end().to_owned())?;
        let table = &file.check;
        if !table.paths.is_empty() {
            return Err("`paths` belongs to a table [[check.files]]".to_owned());
        }
        for (i, rules) in table.files.iter().enumerate() {
            if rules.paths.is_empty() {
                let number = i + 1;
                return Err(format!(
                    "the table [[check.files]] number {number} has no `paths`, such as [\"*.dxf\"]"
                ));
            }
            if !rules.files.is_empty() {
                return Err("a table [[check.files]] has no `files` of its own".to_owned());
            }
        }
        Ok(file)
    }

    /// The rules for a file, by its path from the folder of this file.
    pub(super) fn rules(&self, path: &str) -> Rules {
        let mut rules = Rules {
            limits: self.limits.0.clone(),
            ..Rules::default()
        };
        let own = |table: &&Table| table.paths.iter().any(|pattern| fits(pattern, path));
        for table in std::iter::once(&self.check).chain(self.check.files.iter().filter(own)) {
            rules.apply(table);
        }
        rules
    }
}

impl Rules {
    /// Overrides by the rules of a table. What is ignored adds up.
    fn apply(&mut self, table: &Table) {
        let codes = |names: &[CodeName]| names.iter().map(|name| name.0).collect::<Vec<_>>();
        if let Some(only) = &table.only {
            self.only = Some(codes(only));
        }
        self.ignore.extend(codes(&table.ignore));
        self.fail_on = table.fail_on.or(self.fail_on);
        self.gap_m = table.gap.or(self.gap_m);
        self.kink_deg = table.kink.or(self.kink_deg);
        self.min_radius_m = table.min_radius.or(self.min_radius_m);
        let acceleration = table.lateral_acceleration;
        self.lateral_acceleration_m_s2 = acceleration.or(self.lateral_acceleration_m_s2);
    }

    /// Returns `true` if findings of a kind are reported.
    pub(in super::super) fn reports(&self, code: Code) -> bool {
        let is_wanted = self.only.as_ref().is_none_or(|only| only.contains(&code));
        is_wanted && !self.ignore.contains(&code)
    }
}

impl<'de> Deserialize<'de> for LimitSettings {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let values = BTreeMap::<String, u64>::deserialize(deserializer)?;
        let setting = |(name, value): (String, u64)| limits::setting(&format!("{name}={value}"));
        let settings: Result<Vec<_>, String> = values.into_iter().map(setting).collect();
        settings.map(Self).map_err(de::Error::custom)
    }
}

fn positive<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    number(deserializer, values::positive)
}

fn not_negative<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    number(deserializer, values::not_negative)
}

/// A number that an argument of the command accepts too.
fn number<'de, D: Deserializer<'de>>(
    deserializer: D,
    parse: fn(&str) -> Result<f64, String>,
) -> Result<Option<f64>, D::Error> {
    let value = f64::deserialize(deserializer)?;
    parse(&value.to_string())
        .map(Some)
        .map_err(de::Error::custom)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn later_tables_override_earlier_ones() {
        let text = "
            [check]
            ignore = [\"unused-node\"]
            fail-on = \"warning\"
            min-radius = 1
            [[check.files]]
            paths = [\"old/**\", \"*.dxf\"]
            ignore = [\"kink\"]
            fail-on = \"error\"
            [[check.files]]
            paths = [\"old/a.json\"]
            only = [\"node-gap\"]
            [limits]
            paths = 10
        ";
        let file = ConfigFile::parse(text).unwrap();
        let rules = file.rules("new/a.json");
        assert!(!rules.reports(Code::UnusedNode) && rules.reports(Code::Kink));
        assert_eq!(rules.fail_on, Some(FailOn::Warning));
        assert_eq!((rules.min_radius_m, rules.limits.len()), (Some(1.0), 1));
        let rules = file.rules("old/a.json");
        assert!(rules.reports(Code::NodeGap) && !rules.reports(Code::DeadEnd));
        assert_eq!(
            (rules.fail_on, rules.min_radius_m),
            (Some(FailOn::Error), Some(1.0))
        );
        assert!(!file.rules("new/b.dxf").reports(Code::Kink));
    }

    #[test]
    fn errors_name_line_and_remedy() {
        for (text, said) in [
            ("[check]\nignor = []", &["line 2", "ignor", "`ignore`"][..]),
            (
                "[check]\nignore = [\"kinks\"]",
                &["line 2", "kinks", "nearest is kink"],
            ),
            (
                "[check]\nfail-on = \"never\"",
                &["line 2", "never", "warning"],
            ),
            ("[check]\nmin-radius = -1", &["line 2"]),
            ("[limits]\npath = 3", &["line 1", "paths"]),
            ("[check]\npaths = [\"*\"]", &["[[check.files]]"]),
            ("[[check.files]]\nignore = []", &["number 1", "`paths`"]),
            (
                "[[check.files]]\npaths = [\"*\"]\nfiles = [{}]",
                &["of its own"],
            ),
            ("check", &["line 1"]),
        ] {
            let error = ConfigFile::parse(text).unwrap_err();
            assert!(
                said.iter().all(|part| error.contains(part)),
                "{text}: {error}"
            );
        }
    }
}
