//! Properties, vehicle types, levels, names and directions.

use guideway_document::{Document, Elements, OperationError, PathSet, PropertyRef};
use guideway_layout::{CompareOptions, Direction, Quantity, Value, differences};
use guideway_scene::{EditError, Table};

use crate::site::{document_of, ends, is_near, p, square};

fn rows(rows: impl IntoIterator<Item = u32>) -> PathSet {
    rows.into_iter().collect()
}

fn property<'a>(of: Table, name: &'a str, vehicle_type: Option<&'a str>) -> PropertyRef<'a> {
    PropertyRef {
        of,
        name,
        vehicle_type,
    }
}

fn speeds(document: &Document) -> [Option<Value<'_>>; 4] {
    let paths = &document.layout().paths;
    let of = |row, vehicle_type| paths.value_for(row, vehicle_type, "maxSpeed");
    [of(0, "tug"), of(0, "stacker"), of(1, "tug"), of(2, "tug")]
}

#[test]
fn sets_and_removes_a_property_for_all_types_and_for_one() {
    let mut document = document_of(square());
    let number = |value| Some(Value::Float(value));
    let all = property(Table::Paths, "maxSpeed", None);
    let tug = property(Table::Paths, "maxSpeed", Some("tug"));
    document.set_property(tug, &rows([0]), number(0.5)).unwrap();
    let others = number(1.5);
    assert_eq!(speeds(&document), [number(0.5), others, others, others]);
    document
        .set_property(all, &rows([0, 1]), Some(Value::Int(2)))
        .unwrap();
    let two = number(2.0);
    assert_eq!(speeds(&document), [two, two, two, others]);
    document.set_property(tug, &rows([0]), None).unwrap();
    assert_eq!(speeds(&document), [None, two, two, others]);
    document.set_property(all, &rows([0, 2]), None).unwrap();
    assert_eq!(speeds(&document), [None, None, two, None]);
    let column = document.layout().paths.column("maxSpeed").unwrap();
    assert_eq!(column.quantity, Some(Quantity::Speed));
    while document.undo().is_some() {}
    assert_eq!(speeds(&document), [others; 4]);
    assert!(
        document
            .layout()
            .paths
            .vehicle_types()
            .attributes
            .is_empty()
    );
}

#[test]
fn sets_properties_of_nodes_and_stations() {
    let mut document = document_of(square());
    let choice = property(Table::Nodes, "type", None);
    let halt = Some(Value::Text("HALT_POSITION"));
    document.set_property(choice, &rows([0, 3]), halt).unwrap();
    let per_type = property(Table::Nodes, "theta", Some("fork"));
    document
        .set_property(per_type, &rows([1]), Some(Value::Float(0.5)))
        .unwrap();
    let nodes = &document.layout().nodes;
    assert_eq!(nodes.attributes.value(3, "type"), halt);
    assert!(
        nodes.vehicle_types().of(1).eq(["tug", "fork"]),
        "a node is open to all types"
    );
    let entry = nodes.vehicle_types().entry_for(1, "fork").unwrap();
    let theta = nodes.vehicle_types().attributes.value(entry, "theta");
    assert_eq!(theta, Some(Value::Float(0.5)));
    let own = property(Table::Stations, "shift", None);
    document
        .set_property(own, &rows([1]), Some(Value::Bool(true)))
        .unwrap();
    let stations = &document.layout().stations;
    assert_eq!(
        stations.attributes.value(1, "shift"),
        Some(Value::Bool(true))
    );
}

#[test]
fn errors_say_what_does_not_fit() {
    let mut document = document_of(square());
    let mut refused = |of, name, vehicle_type, row, value| {
        let property = property(of, name, vehicle_type);
        let set = document.set_property(property, &rows([row]), Some(value));
        set.unwrap_err().to_string()
    };
    let fast = Value::Text("fast");
    for (error, said) in [
        (
            refused(Table::Paths, "maxSpeed", None, 0, fast),
            "a number of at least 0 in m/s, not `fast`",
        ),
        (
            refused(Table::Nodes, "maxSpeed", None, 0, Value::Int(1)),
            "no property of a node",
        ),
        (
            refused(Table::Nodes, "type", None, 0, fast),
            "HALT_POSITION, PARK_POSITION",
        ),
        (
            refused(Table::Paths, "locked", None, 0, fast),
            "true or false",
        ),
        (
            refused(Table::Paths, "maxSpeed", None, 9, Value::Int(1)),
            "no path in row 9",
        ),
        (
            refused(Table::Paths, "maxSpeed", Some("tug"), 1, Value::Int(1)),
            "`bc` has no entry for the vehicle type `tug`",
        ),
        (
            refused(Table::Stations, "height", Some("tug"), 1, Value::Int(1)),
            "stations have no properties per vehicle type",
        ),
        (
            refused(Table::Paths, "maxSpeed", None, 0, Value::Float(f64::NAN)),
            "a number of at least 0 in m/s",
        ),
        (
            refused(Table::Paths, "corridor.leftWidth", None, 0, Value::Int(-1)),
            "a number of at least 0 in m, not `-1`",
        ),
    ] {
        assert!(error.contains(said), "{error}");
    }
    assert!(!document.is_changed());
}

#[test]
fn renames_with_references_and_refuses_taken_names() {
    let mut document = document_of(square());
    document.rename(Table::Nodes, 0, "gate").unwrap();
    let layout = document.to_layout();
    let start = layout.paths.get(0).start_node().unwrap();
    assert_eq!(layout.nodes.id(start), "gate");
    assert_eq!(layout.nodes.id(layout.stations.nodes(0)[0]), "gate");
    let taken = document.rename(Table::Paths, 0, "bc").unwrap_err();
    let (what, id) = ("path", "bc".to_owned());
    assert_eq!(taken, OperationError::IdTaken { what, id });
    let empty = document.rename(Table::Stations, 0, "").unwrap_err();
    assert_eq!(empty, OperationError::EmptyId { what: "station" });
    document
        .rename_all(Table::Paths, &[(0, "bc"), (1, "ab")])
        .unwrap();
    assert_eq!(document.layout().paths.id(0), "bc");
    document.undo();
    document.undo();
    assert_eq!(document.layout().nodes.id(0), "a");
}

#[test]
fn sets_vehicle_types_and_keeps_the_properties_of_those_that_stay() {
    let mut document = document_of(square());
    let tug = property(Table::Paths, "maxSpeed", Some("tug"));
    document
        .set_property(tug, &rows([0]), Some(Value::Float(0.5)))
        .unwrap();
    let types = ["crane", "tug", "crane"];
    document
        .set_vehicle_types(Table::Paths, &rows([0, 2]), &types)
        .unwrap();
    let paths = &document.layout().paths;
    assert!(paths.vehicle_types().of(2).eq(["crane", "tug"]));
    assert_eq!(
        paths.value_for(0, "tug", "maxSpeed"),
        Some(Value::Float(0.5))
    );
    document.undo();
    assert!(
        document
            .layout()
            .paths
            .vehicle_types()
            .of(0)
            .eq(["tug", "stacker"])
    );
    let refused = document.set_vehicle_types(Table::Stations, &rows([0]), &types);
    assert_eq!(refused, Err(EditError::NoVehicleTypes.into()));
}

#[test]
fn nodes_and_stations_follow_paths_to_a_level() {
    let mut document = document_of(square());
    document
        .set_level(&Elements::of_paths([0, 1]), Some(1))
        .unwrap();
    let layout = document.layout();
    let nodes = [0, 1, 2, 3].map(|node| layout.nodes.level(node));
    assert_eq!(
        nodes,
        [Some(0), Some(1), Some(0), Some(0)],
        "only `b` has no other path"
    );
    assert_eq!(layout.paths.get(1).level(), Some(1));
    assert_eq!(layout.stations.level(1), Some(0), "`c` stays");
    document
        .set_level(&Elements::of_paths([0, 1, 2, 3]), Some(1))
        .unwrap();
    assert_eq!(document.layout().stations.level(1), Some(1));
    let unknown = document.set_level(&Elements::of_paths([0]), Some(7));
    assert!(
        unknown
            .unwrap_err()
            .to_string()
            .contains("no level in row 7")
    );
}

#[test]
fn reverses_paths_with_the_properties_of_their_ends_and_sides() {
    let mut layout = square();
    let paths = &mut layout.paths;
    let start = Value::Text("CW");
    paths.attributes.set(0, "rotationAtStartNodeAllowed", start);
    let own = &mut paths.vehicle_types_mut().attributes;
    own.set_quantity(1, "corridor.leftWidth", 0.5, Quantity::Length);
    own.set_quantity(1, "corridor.rightWidth", 0.25, Quantity::Length);
    let mut document = document_of(layout);
    document.reverse(&rows([0])).unwrap();
    let path = document.layout().paths.get(0);
    assert_eq!((path.start_node(), path.end_node()), (Some(1), Some(0)));
    let (from, to) = ends(&document, 0);
    assert!(is_near(from, p(10.0, 0.0)) && is_near(to, p(0.0, 0.0)));
    let paths = &document.layout().paths;
    assert_eq!(paths.value(0, "rotationAtEndNodeAllowed"), Some(start));
    assert_eq!(paths.value(0, "rotationAtStartNodeAllowed"), None);
    let width = |side| paths.value_for(0, "stacker", side);
    assert_eq!(width("corridor.leftWidth"), Some(Value::Float(0.25)));
    assert_eq!(width("corridor.rightWidth"), Some(Value::Float(0.5)));
    document
        .set_direction(&rows([0, 1]), Direction::Both)
        .unwrap();
    assert_eq!(document.layout().paths.get(1).direction(), Direction::Both);
    assert_eq!(document.undo(), Some("make two-way"));
    assert_eq!(document.undo(), Some("reverse"));
    assert!(
        !document
            .layout()
            .paths
            .has_column("rotationAtEndNodeAllowed")
    );
}

#[test]
fn cells_are_set_in_one_step_or_not_at_all() {
    let mut document = document_of(square());
    let values = [
        ("maxSpeed", 0, Some(Value::Float(2.0))),
        ("maxSpeed", 1, Some(Value::Float(2.0))),
        ("maxSpeed", 2, None),
        ("cost", 1, Some(Value::Int(7))),
    ];
    let cells = guideway_document::NewCells {
        of: Table::Paths,
        ids: &[(0, "first"), (1, "ab")],
        values: &values,
    };
    document.set_cells(&cells).unwrap();
    let paths = &document.layout().paths;
    assert_eq!((paths.id(0), paths.id(1)), ("first", "ab"));
    assert_eq!(paths.value(1, "maxSpeed"), Some(Value::Float(2.0)));
    assert_eq!(paths.value(2, "maxSpeed"), None);
    assert_eq!(paths.value(1, "cost"), Some(Value::Int(7)));
    document.undo();
    assert_eq!(document.layout().paths.id(0), "ab");
    assert_eq!(
        document.layout().paths.value(2, "maxSpeed"),
        Some(Value::Float(1.5))
    );
    assert_eq!(document.undo_redo_names().0, None, "it was one step");
    let taken = guideway_document::NewCells {
        ids: &[(0, "cd")],
        ..cells
    };
    assert!(document.set_cells(&taken).is_err());
    assert_eq!(document.layout().paths.value(1, "cost"), None);
}

#[test]
fn a_preview_is_taken_back_and_leaves_no_step() {
    let mut document = document_of(square());
    let all = property(Table::Paths, "maxSpeed", None);
    let set = |value: f64| {
        move |document: &mut Document| {
            document.set_property(all, &rows([0]), Some(Value::Float(value)))
        }
    };
    set(2.0)(&mut document).unwrap();
    document.undo();
    document.take_journal_entries();
    let (before, state) = (document.to_layout(), document.state());
    let names = document.undo_redo_names();
    let values = document.values_revision();
    for value in [3.0, 4.0] {
        document.preview_edit(set(value)).unwrap();
        assert_eq!(speeds(&document)[0], Some(Value::Float(value)));
    }
    assert!(document.is_preview() && document.values_revision() > values);
    assert_eq!(
        (document.state(), document.undo_redo_names()),
        (state, names)
    );
    assert!(document.take_journal_entries().is_empty());
    let unknown = |document: &mut Document| {
        set(5.0)(document)?;
        document.set_property(all, &rows([99]), None)
    };
    assert!(document.preview_edit(unknown).is_err() && !document.is_preview());
    let exact = CompareOptions::default();
    assert_eq!(differences(&before, &document.to_layout(), &exact), []);
    // New rows go too, so that the journal of later edits names the right ones.
    let selected = document.selection().clone();
    document
        .preview_edit(|document| {
            document
                .copy(&Elements::of_paths([0]), 1, p(1.0, 0.0))
                .map(drop)
        })
        .unwrap();
    assert_eq!(document.layout().paths.len(), 5);
    document.redo().unwrap();
    assert_eq!(document.layout().paths.len(), 4);
    assert_eq!(*document.selection(), selected);
    assert_eq!(speeds(&document)[0], Some(Value::Float(2.0)));
}

#[test]
fn nodes_of_a_station_are_set_by_name() {
    let mut document = document_of(square());
    let before = document.to_layout();
    document.set_station_nodes(0, &["c", "b"]).unwrap();
    assert_eq!(document.layout().stations.nodes(0), [2, 1]);
    assert_eq!(
        document
            .index()
            .stations_at(2)
            .filter(|row| *row == 0)
            .count(),
        1
    );
    let error = document.set_station_nodes(0, &["b", "x"]).unwrap_err();
    assert!(
        error.to_string().contains("no node is called `x`"),
        "{error}"
    );
    assert!(document.set_station_nodes(99, &[]).is_err());
    document.undo();
    let exact = CompareOptions::default();
    assert_eq!(differences(&before, &document.to_layout(), &exact), []);
}
