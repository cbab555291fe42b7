//! Interprets header variables: `$INSUNITS` as meters per unit, `$ACADVER` as a release name.

use guideway_layout::{Code, Place};

use crate::builder::Builder;

/// Meters per unit of `$INSUNITS`, indexed by its code (source: DXF reference, header variables);
/// code 0 means "no unit".
const UNITS_M: [f64; 25] = [
    0.0,
    0.0254,
    0.3048,
    1_609.344,
    1e-3,
    1e-2,
    1.0,
    1e3,
    0.0254e-6,
    0.0254e-3,
    0.9144,
    1e-10,
    1e-9,
    1e-6,
    0.1,
    10.0,
    100.0,
    1e9,
    149_597_870_700.0,
    9_460_730_472_580_800.0,
    3.085_677_581_491_367e16,
    // US survey foot, inch, yard and mile.
    1_200.0 / 3_937.0,
    100.0 / 3_937.0,
    3_600.0 / 3_937.0,
    6_336_000.0 / 3_937.0,
];

/// Unit of drawings without `$INSUNITS`: a millimeter, the unit of metric CAD templates.
const DEFAULT_UNIT_M: f64 = 1e-3;

/// The header variables that tell the unit.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct UnitVariables {
    /// `$INSUNITS`; 0 if absent.
    pub(super) insertion: i64,
    /// `$LUNITS`: the form in which lengths are displayed.
    pub(super) display: Option<i64>,
    /// `$MEASUREMENT`: 0 for English templates, 1 for metric ones.
    pub(super) measurement: Option<i64>,
}

/// Forms of `$LUNITS` that exist for inches only: feet and inches, decimal or fractional.
const IN_INCHES: [i64; 2] = [3, 4];
const INCH_M: f64 = 0.0254;

/// Meters per drawing unit. Without a unit, reports a finding and assumes millimeters, or inches if
/// lengths are displayed as feet and inches; the layout says so.
pub(super) fn insertion_unit_m(builder: &mut Builder<'_>, units: UnitVariables) -> f64 {
    let code = units.insertion;
    let known = usize::try_from(code)
        .ok()
        .and_then(|code| UNITS_M.get(code));
    if let Some(&unit_m) = known.filter(|_| code != 0) {
        return unit_m;
    }
    let at = || Place::element("$INSUNITS");
    let is_in_inches = units.display.is_some_and(|form| IN_INCHES.contains(&form));
    let message = || {
        let read_as = match (is_in_inches, units.measurement) {
            (true, _) => "inches, because $LUNITS displays feet and inches",
            (false, Some(0)) => {
                "millimeters, but $MEASUREMENT states English units, which hints at inches"
            }
            _ => "millimeters",
        };
        format!("unit code {code} names no unit; positions are read as {read_as}")
    };
    let remedy = "If that is wrong, set the unit of the drawing in the CAD program";
    builder.report(Code::AssumedUnit, &at, message, remedy);
    let unit_m = if is_in_inches { INCH_M } else { DEFAULT_UNIT_M };
    builder.layout.provenance.assumed_unit_m = Some(unit_m);
    unit_m
}

/// The release name for users, such as `2007 (AC1021)`, from the `$ACADVER` code.
pub(super) fn release_name(version: &str, is_binary: bool) -> String {
    const RELEASES: &[(&str, &str)] = &[
        ("AC1006", "R10"),
        ("AC1009", "R12"),
        ("AC1012", "R13"),
        ("AC1014", "R14"),
        ("AC1015", "2000"),
        ("AC1018", "2004"),
        ("AC1021", "2007"),
        ("AC1024", "2010"),
        ("AC1027", "2013"),
        ("AC1032", "2018"),
    ];
    let known = RELEASES.iter().find(|(code, _)| *code == version);
    let name = match known {
        Some((code, name)) => format!("{name} ({code})"),
        None => version.chars().take(16).collect(),
    };
    match is_binary {
        true => format!("{name} binary").trim().to_owned(),
        false => name,
    }
}
