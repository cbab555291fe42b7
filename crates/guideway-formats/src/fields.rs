//! Fields of formats: the name and unit that each format has for a known property.
//!
//! A reader maps a field to its property in SI units; a writer maps it back. A property without a
//! field in a format is a loss of that format's writer.

use guideway_layout::Property;

/// A vocabulary of field names: a format, or a version of one whose names differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Vocabulary {
    Lif1,
    Lif2,
    /// VDA 5050 1.1 to 2.1.
    Vda2,
    /// VDA 5050 from 3.0 on.
    Vda3,
    OpenTcs,
    /// Lanes and vertices of Open-RMF.
    Rmf,
    /// Edges of a Nav2 route graph; the names are those in `metadata`.
    Nav2,
}

/// A field of a vocabulary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FormatField {
    pub(crate) vocabulary: Vocabulary,
    /// Name in the file; `group.name` lies in a nested object.
    pub(crate) name: &'static str,
    /// Name of the property in the layout.
    pub(crate) property: &'static str,
    /// SI units per unit of the file; 1 for values that are not numbers.
    pub(crate) factor: f64,
}

/// Returns the field of a vocabulary with this name.
pub(crate) fn field(vocabulary: Vocabulary, name: &str) -> Option<&'static FormatField> {
    let mut fields = FIELDS.iter();
    fields.find(|field| field.vocabulary == vocabulary && field.name == name)
}

/// Returns the field of a vocabulary for a property. Of several names the first one is written.
pub(crate) fn field_of(vocabulary: Vocabulary, property: &str) -> Option<&'static FormatField> {
    let mut fields = FIELDS.iter();
    fields.find(|field| field.vocabulary == vocabulary && field.property == property)
}

impl FormatField {
    /// A number of the file in SI units.
    pub(crate) fn to_si(self, number: f64) -> f64 {
        match self.units_per_si() {
            Some(units) => number / units,
            None => number * self.factor,
        }
    }

    /// A number in SI units in the unit of the file.
    pub(crate) fn of_si(self, number: f64) -> f64 {
        match self.units_per_si() {
            Some(units) => number * units,
            None => number / self.factor,
        }
    }

    /// Units of the file per SI unit, if they are a whole number: a division by it is the nearest
    /// number, as a decimal of the file means it.
    fn units_per_si(self) -> Option<f64> {
        let units = self.factor.recip().round();
        (units > 1.0 && (units * self.factor - 1.0).abs() < 1e-12).then_some(units)
    }

    /// Returns the property of the field.
    pub(crate) fn property(&self) -> Option<&'static Property> {
        Property::named(self.property)
    }
}

const fn si(vocabulary: Vocabulary, name: &'static str, property: &'static str) -> FormatField {
    scaled(vocabulary, name, property, 1.0)
}

const fn scaled(
    vocabulary: Vocabulary,
    name: &'static str,
    property: &'static str,
    factor: f64,
) -> FormatField {
    FormatField {
        vocabulary,
        name,
        property,
        factor,
    }
}

use Vocabulary::{Lif1, Lif2, Nav2, OpenTcs, Rmf, Vda2, Vda3};

/// All fields. Sources: the schemas of LIF 1.0 and 2.0, the order schemas of VDA 5050, the plant
/// model schemas of openTCS (lengths in mm, speeds in mm/s, angles in
/// degrees), the navigation graphs of Open-RMF, and
/// the documentation of Nav2's route server.
const FIELDS: &[FormatField] = &[
    si(Lif1, "orientationType", "orientationType"),
    si(Lif1, "vehicleOrientation", "vehicleOrientation"),
    si(Lif1, "rotationAllowed", "rotationAllowed"),
    si(
        Lif1,
        "rotationAtStartNodeAllowed",
        "rotationAtStartNodeAllowed",
    ),
    si(Lif1, "rotationAtEndNodeAllowed", "rotationAtEndNodeAllowed"),
    si(Lif1, "maxSpeed", "maxSpeed"),
    si(Lif1, "maxRotationSpeed", "maxRotationSpeed"),
    si(Lif1, "minHeight", "minHeight"),
    si(Lif1, "maxHeight", "maxHeight"),
    si(Lif1, "loadRestriction.unloaded", "loadRestriction.unloaded"),
    si(Lif1, "loadRestriction.loaded", "loadRestriction.loaded"),
    si(
        Lif1,
        "loadRestriction.loadSetNames",
        "loadRestriction.loadSetNames",
    ),
    si(Lif1, "reentryAllowed", "reentryAllowed"),
    si(Lif1, "actions", "actions"),
    si(Lif1, "nodeName", "name"),
    si(Lif1, "edgeName", "name"),
    si(Lif1, "stationName", "name"),
    si(Lif1, "nodeDescription", "description"),
    si(Lif1, "edgeDescription", "description"),
    si(Lif1, "stationDescription", "description"),
    si(Lif1, "layoutDescription", "description"),
    si(Lif1, "mapId", "mapId"),
    si(Lif1, "theta", "theta"),
    si(Lif1, "stationHeight", "height"),
    si(Lif2, "orientationType", "orientationType"),
    si(Lif2, "mobileRobotOrientations", "vehicleOrientations"),
    si(
        Lif2,
        "reachOrientationBeforeEntering",
        "reachOrientationBeforeEntering",
    ),
    si(
        Lif2,
        "rotationAtStartNodeAllowed",
        "rotationAtStartNodeAllowed",
    ),
    si(Lif2, "rotationAtEndNodeAllowed", "rotationAtEndNodeAllowed"),
    si(Lif2, "maximumSpeed", "maxSpeed"),
    si(Lif2, "maximumRotationSpeed", "maxRotationSpeed"),
    si(Lif2, "minimumLoadHandlingDeviceHeight", "minHeight"),
    si(Lif2, "maximumMobileRobotHeight", "maxHeight"),
    si(Lif2, "loadRestriction.unloaded", "loadRestriction.unloaded"),
    si(Lif2, "loadRestriction.loaded", "loadRestriction.loaded"),
    si(
        Lif2,
        "loadRestriction.loadSetNames",
        "loadRestriction.loadSetNames",
    ),
    si(Lif2, "reentryAllowed", "reentryAllowed"),
    si(Lif2, "actions", "actions"),
    si(Lif2, "requiredActions", "requiredActions"),
    si(Lif2, "feasibleActions", "feasibleActions"),
    si(Lif2, "forbiddenActionTypes", "forbiddenActionTypes"),
    si(Lif2, "corridor.maximumLeftWidth", "corridor.leftWidth"),
    si(Lif2, "corridor.maximumRightWidth", "corridor.rightWidth"),
    si(
        Lif2,
        "corridor.corridorReferencePoint",
        "corridor.referencePoint",
    ),
    si(Lif2, "edgeName", "name"),
    si(Lif2, "stationName", "name"),
    si(Lif2, "nodeDescriptor", "description"),
    si(Lif2, "edgeDescriptor", "description"),
    si(Lif2, "stationDescription", "description"),
    si(Lif2, "layoutDescriptor", "description"),
    si(Lif2, "mapId", "mapId"),
    si(Lif2, "theta", "theta"),
    si(Lif2, "stationHeight", "height"),
    si(Lif2, "stationType", "kind"),
    si(Vda2, "nodeDescription", "description"),
    si(Vda2, "edgeDescription", "description"),
    si(Vda2, "released", "released"),
    si(Vda2, "theta", "theta"),
    si(Vda2, "allowedDeviationXY", "allowedDeviationXY"),
    si(Vda2, "allowedDeviationTheta", "allowedDeviationTheta"),
    si(Vda2, "maxSpeed", "maxSpeed"),
    si(Vda2, "maxRotationSpeed", "maxRotationSpeed"),
    si(Vda2, "minHeight", "minHeight"),
    si(Vda2, "maxHeight", "maxHeight"),
    si(Vda2, "orientation", "vehicleOrientation"),
    si(Vda2, "orientationType", "orientationType"),
    si(Vda2, "rotationAllowed", "rotationAllowed"),
    si(Vda2, "length", "length"),
    si(Vda2, "lenght", "length"),
    si(Vda2, "actions", "actions"),
    si(Vda2, "corridor.leftWidth", "corridor.leftWidth"),
    si(Vda2, "corridor.rightWidth", "corridor.rightWidth"),
    si(Vda2, "corridor.corridorRefPoint", "corridor.referencePoint"),
    si(Vda3, "nodeDescriptor", "description"),
    si(Vda3, "edgeDescriptor", "description"),
    si(Vda3, "released", "released"),
    si(Vda3, "theta", "theta"),
    si(Vda3, "allowedDeviationTheta", "allowedDeviationTheta"),
    si(Vda3, "maximumSpeed", "maxSpeed"),
    si(Vda3, "maxRotationSpeed", "maxRotationSpeed"),
    si(Vda3, "maximumRotationSpeed", "maxRotationSpeed"),
    si(Vda3, "minimumLoadHandlingDeviceHeight", "minHeight"),
    si(Vda3, "minimumHeight", "minHeight"),
    si(Vda3, "maximumMobileRobotHeight", "maxHeight"),
    si(Vda3, "maximumHeight", "maxHeight"),
    si(Vda3, "orientation", "vehicleOrientation"),
    si(Vda3, "orientationType", "orientationType"),
    si(
        Vda3,
        "reachOrientationBeforeEntering",
        "reachOrientationBeforeEntering",
    ),
    si(Vda3, "length", "length"),
    si(Vda3, "actions", "actions"),
    si(Vda3, "corridor.leftWidth", "corridor.leftWidth"),
    si(Vda3, "corridor.rightWidth", "corridor.rightWidth"),
    si(
        Vda3,
        "corridor.corridorReferencePoint",
        "corridor.referencePoint",
    ),
    scaled(OpenTcs, "length", "length", 1e-3),
    scaled(OpenTcs, "maxVelocity", "maxSpeed", 1e-3),
    scaled(OpenTcs, "maxReverseVelocity", "maxReverseSpeed", 1e-3),
    scaled(
        OpenTcs,
        "vehicleOrientationAngle",
        "theta",
        std::f64::consts::PI / 180.0,
    ),
    si(OpenTcs, "locked", "locked"),
    si(Rmf, "speed_limit", "maxSpeed"),
    si(Nav2, "abs_speed_limit", "maxSpeed"),
];

#[cfg(test)]
mod tests {
    use guideway_layout::PropertyKind;

    use super::*;

    #[test]
    fn every_field_has_a_known_property() {
        for field in FIELDS {
            let property = field.property();
            let property = property.unwrap_or_else(|| panic!("{}", field.property));
            let is_number = matches!(property.kind, PropertyKind::Number(_));
            assert!(is_number || field.factor == 1.0, "{field:?}");
        }
    }

    #[test]
    fn fields_are_found_by_name_and_by_property() {
        let speed = field(OpenTcs, "maxVelocity").unwrap();
        assert_eq!((speed.property, speed.factor), ("maxSpeed", 1e-3));
        assert_eq!(field_of(Vda2, "length").unwrap().name, "length");
        assert!(field(Lif1, "maximumSpeed").is_none());
    }
}
