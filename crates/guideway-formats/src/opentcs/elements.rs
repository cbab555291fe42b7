//! Describes the elements of a plant model that a layout holds as JSON, and converts them to it.

use roxmltree::Node;
use serde_json::{Map, Value};

/// Start of the names of properties that hold what openTCS has no member for.
pub(super) const OWN_PREFIX: &str = "guideway:";

/// Kind of the values of an XML attribute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Text,
    /// A whole number.
    Int,
    /// A whole number from 0 to 2^31 - 1, the range of openTCS.
    Unsigned,
    Float,
    Bool,
    /// A color `#RRGGBB`.
    Color,
    /// One of these texts.
    Choice(&'static [&'static str]),
}

impl Kind {
    /// The JSON value of an attribute; text if it is not of the kind.
    pub(super) fn json(self, text: &str) -> Value {
        let typed = match self {
            Self::Int | Self::Unsigned => text.trim().parse::<i64>().ok().map(Value::from),
            Self::Float => text.trim().parse().ok().and_then(finite),
            Self::Bool => text.trim().parse::<bool>().ok().map(Value::from),
            Self::Text | Self::Color | Self::Choice(_) => None,
        };
        typed.unwrap_or_else(|| text.into())
    }

    /// The text of a value in a file, or `None` if the value is not of the kind.
    pub(super) fn text(self, value: &Value) -> Option<String> {
        match (self, value) {
            (Self::Text, Value::String(text)) => Some(text.clone()),
            (Self::Text, Value::Number(number)) => Some(number.to_string()),
            (Self::Int, value) => value.as_i64().map(|number| number.to_string()),
            (Self::Unsigned, value) => {
                let number = value.as_i64().and_then(|number| i32::try_from(number).ok());
                number.filter(|&n| n >= 0).map(|number| number.to_string())
            }
            (Self::Float, value) => value.as_f64().map(|number| format!("{number:?}")),
            (Self::Bool, Value::Bool(value)) => Some(value.to_string()),
            (Self::Color, Value::String(text)) => {
                let digits = text.strip_prefix('#')?;
                let is_color = digits.len() == 6 && digits.bytes().all(|b| b.is_ascii_hexdigit());
                is_color.then(|| text.to_ascii_uppercase())
            }
            (Self::Choice(texts), Value::String(text)) => {
                texts.contains(&text.as_str()).then(|| text.clone())
            }
            _ => None,
        }
    }
}

fn finite(number: f64) -> Option<Value> {
    number.is_finite().then(|| number.into())
}

/// An XML attribute of an element.
pub(super) struct Field {
    pub(super) name: &'static str,
    pub(super) kind: Kind,
    /// Value that is written if the layout has none; `None` for an optional attribute.
    pub(super) default: Option<&'static str>,
}

/// Child elements of one tag.
pub(super) enum Child {
    /// One element, as a JSON object.
    Once(&'static Element),
    /// The same, required in a file.
    Required(&'static Element),
    /// Elements with a name only, as an array of the names.
    Names(&'static str),
    /// Elements `property`, as an object of their values.
    Properties,
}

impl Child {
    pub(super) fn tag(&self) -> &'static str {
        match self {
            Self::Once(element) | Self::Required(element) => element.tag,
            Self::Names(tag) => tag,
            Self::Properties => "property",
        }
    }
}

/// An element, with its attributes and children in the order of the schemas of 6.0.0 and 7.0.0.
pub(super) struct Element {
    pub(super) tag: &'static str,
    pub(super) fields: &'static [Field],
    pub(super) children: &'static [Child],
}

impl Element {
    /// Converts an element of a file: attributes, then children under their tags. Attributes that
    /// the schemas do not have stay text; children that they do not have become arrays.
    pub(super) fn to_json(&self, node: Node<'_, '_>) -> Map<String, Value> {
        let mut object = Map::new();
        for attribute in node.attributes() {
            let mut fields = self.fields.iter();
            let field = fields.find(|field| field.name == attribute.name());
            let kind = field.map_or(Kind::Text, |field| field.kind);
            object.insert(attribute.name().into(), kind.json(attribute.value()));
        }
        for child in node.children().filter(Node::is_element) {
            self.add_child(child, &mut object);
        }
        restore_own(&mut object);
        object
    }

    /// Tells if an object has all attributes of the element, with valid values, and no more.
    pub(super) fn is_whole(&self, object: &Map<String, Value>) -> bool {
        let is_valid = |f: &Field| object.get(f.name).is_some_and(|v| f.kind.text(v).is_some());
        object.len() == self.fields.len() && self.fields.iter().all(is_valid)
    }

    /// The attributes of an element of a new model.
    pub(super) fn default_json(&self) -> Map<String, Value> {
        let fields = self.fields.iter();
        let member = |f: &Field| Some((f.name.to_owned(), f.kind.json(f.default?)));
        fields.filter_map(member).collect()
    }

    fn add_child(&self, node: Node<'_, '_>, object: &mut Map<String, Value>) {
        let tag = node.tag_name().name();
        let name = node.attribute("name");
        let known = self.children.iter().find(|child| child.tag() == tag);
        match (known, name) {
            (Some(Child::Once(element) | Child::Required(element)), _)
                if !object.contains_key(tag) =>
            {
                object.insert(tag.into(), element.to_json(node).into());
            }
            (Some(Child::Names(_)), Some(name)) => push(object, tag, name.into()),
            (Some(Child::Properties), Some(name)) => {
                let values = object.entry(tag).or_insert_with(|| Map::new().into());
                if let (Value::Object(values), Some(value)) = (values, node.attribute("value")) {
                    values.insert(name.into(), value.into());
                }
            }
            _ => push(object, tag, ANY.to_json(node).into()),
        }
    }
}

/// Appends a value to the array of a member. A member that is no array gets a sibling `<name>`.
pub(super) fn push(object: &mut Map<String, Value>, name: &str, value: Value) {
    let is_taken = object.get(name).is_some_and(|value| !value.is_array());
    let name = if is_taken {
        format!("<{name}>")
    } else {
        name.to_owned()
    };
    let array = object
        .entry(name)
        .or_insert_with(|| Value::Array(Vec::new()));
    if let Value::Array(values) = array {
        values.push(value);
    }
}

/// Turns properties with [`OWN_PREFIX`] back into the members that they hold.
fn restore_own(object: &mut Map<String, Value>) {
    let Some(Value::Object(mut properties)) = object.remove("property") else {
        return;
    };
    properties.retain(|name, value| {
        let own = name.strip_prefix(OWN_PREFIX);
        let parsed = value
            .as_str()
            .and_then(|text| serde_json::from_str(text).ok());
        match (own, parsed) {
            (Some(name), Some(value)) if !object.contains_key(name) => {
                object.insert(name.into(), value);
                false
            }
            _ => true,
        }
    });
    if !properties.is_empty() {
        object.insert("property".into(), properties.into());
    }
}

const fn field(name: &'static str, kind: Kind, default: &'static str) -> Field {
    Field {
        name,
        kind,
        default: Some(default),
    }
}

/// An element that the schemas do not have.
pub(super) static ANY: Element = Element {
    tag: "",
    fields: &[],
    children: &[],
};

/// Extents of a vehicle. The defaults are those of the editor.
pub(super) static BOUNDING_BOX: Element = Element {
    tag: "boundingBox",
    fields: &[
        field("length", Kind::Int, "1000"),
        field("width", Kind::Int, "1000"),
        field("height", Kind::Int, "1000"),
        field("referenceOffsetX", Kind::Int, "0"),
        field("referenceOffsetY", Kind::Int, "0"),
    ],
    children: &[],
};

static VEHICLE_LAYOUT: Element = Element {
    tag: "vehicleLayout",
    fields: &[field("color", Kind::Color, "#FF0000")],
    children: &[],
};

/// A vehicle. The defaults are those of the editor.
pub(super) static VEHICLE: Element = Element {
    tag: "vehicle",
    fields: &[
        field("name", Kind::Text, ""),
        field("energyLevelCritical", Kind::Unsigned, "30"),
        field("energyLevelGood", Kind::Unsigned, "90"),
        field("energyLevelFullyRecharged", Kind::Unsigned, "90"),
        field("energyLevelSufficientlyRecharged", Kind::Unsigned, "30"),
        field("maxVelocity", Kind::Unsigned, "1000"),
        field("maxReverseVelocity", Kind::Unsigned, "1000"),
        Field {
            name: "envelopeKey",
            kind: Kind::Text,
            default: None,
        },
    ],
    children: &[
        Child::Required(&BOUNDING_BOX),
        Child::Properties,
        Child::Once(&VEHICLE_LAYOUT),
    ],
};

static LOCATION_TYPE_LAYOUT: Element = Element {
    tag: "locationTypeLayout",
    fields: &[field(
        "locationRepresentation",
        Kind::Choice(REPRESENTATIONS),
        "NONE",
    )],
    children: &[],
};

pub(super) static LOCATION_TYPE: Element = Element {
    tag: "locationType",
    fields: &[field("name", Kind::Text, "")],
    children: &[
        Child::Names("allowedOperation"),
        Child::Names("allowedPeripheralOperation"),
        Child::Properties,
        Child::Once(&LOCATION_TYPE_LAYOUT),
    ],
};

pub(super) static PERIPHERAL_OPERATION: Element = Element {
    tag: "peripheralOperation",
    fields: &[
        field("name", Kind::Text, ""),
        field("locationName", Kind::Text, ""),
        field(
            "executionTrigger",
            Kind::Choice(&["AFTER_ALLOCATION", "AFTER_MOVEMENT"]),
            "AFTER_ALLOCATION",
        ),
        field("completionRequired", Kind::Bool, "false"),
    ],
    children: &[],
};

pub(super) static LAYER: Element = Element {
    tag: "layer",
    fields: &[
        field("id", Kind::Int, "0"),
        field("ordinal", Kind::Int, "0"),
        field("visible", Kind::Bool, "true"),
        field("name", Kind::Text, ""),
        field("groupId", Kind::Int, "0"),
    ],
    children: &[],
};

pub(super) static LAYER_GROUP: Element = Element {
    tag: "layerGroup",
    fields: &[
        field("id", Kind::Int, "0"),
        field("name", Kind::Text, ""),
        field("visible", Kind::Bool, "true"),
    ],
    children: &[],
};

pub(super) static VISUAL_LAYOUT: Element = Element {
    tag: "visualLayout",
    fields: &[
        field("name", Kind::Text, "VLayout"),
        field("scaleX", Kind::Float, "50.0"),
        field("scaleY", Kind::Float, "50.0"),
    ],
    children: &[Child::Properties],
};

/// Kinds of blocks.
pub(super) const BLOCK_TYPES: &[&str] = &["SINGLE_VEHICLE_ONLY", "SAME_DIRECTION_ONLY"];

/// Symbols of locations and their types.
pub(super) const REPRESENTATIONS: &[&str] = &[
    "NONE",
    "DEFAULT",
    "LOAD_TRANSFER_GENERIC",
    "LOAD_TRANSFER_ALT_1",
    "LOAD_TRANSFER_ALT_2",
    "LOAD_TRANSFER_ALT_3",
    "LOAD_TRANSFER_ALT_4",
    "LOAD_TRANSFER_ALT_5",
    "WORKING_GENERIC",
    "WORKING_ALT_1",
    "WORKING_ALT_2",
    "RECHARGE_GENERIC",
    "RECHARGE_ALT_1",
    "RECHARGE_ALT_2",
];
