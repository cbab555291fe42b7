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

/// Meters per drawing unit. Reports a finding and assumes millimeters if `code` names no unit.
pub(super) fn insertion_unit_m(builder: &mut Builder<'_>, code: i64) -> f64 {
    let known = usize::try_from(code)
        .ok()
        .and_then(|code| UNITS_M.get(code));
    if let Some(&unit_m) = known.filter(|_| code != 0) {
        return unit_m;
    }
    let at = || Place::element("$INSUNITS");
    let message = || format!("unit code {code} names no unit; positions are read as millimeters");
    let remedy = "If that is wrong, set the unit of the drawing in the CAD program";
    builder.report(Code::AssumedUnit, &at, message, remedy);
    DEFAULT_UNIT_M
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
