//! The crates of the programs as a bill of materials: CycloneDX 1.5 in JSON.

use serde_json::{Value, json};

use super::Dependency;

/// The bill of materials of a version. It has neither time nor serial number, so that equal sources
/// give equal bytes.
pub fn sbom(version: &str, dependencies: &[Dependency]) -> Value {
    let components: Vec<Value> = dependencies.iter().map(component).collect();
    let links = dependencies.iter().map(|krate| {
        let on = krate.links.iter();
        let on: Vec<String> = on.map(|(name, version)| purl(name, version)).collect();
        json!({ "ref": purl(&krate.name, &krate.version), "dependsOn": on })
    });
    json!({
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": {
            "component": {
                "type": "application",
                "bom-ref": "guideway",
                "name": "guideway",
                "version": version,
            },
        },
        "components": components,
        "dependencies": links.collect::<Vec<Value>>(),
    })
}

/// The package URL of a crate.
fn purl(name: &str, version: &str) -> String {
    format!("pkg:cargo/{name}@{}", version.replace('+', "%2B"))
}

fn component(krate: &Dependency) -> Value {
    let purl = purl(&krate.name, &krate.version);
    let mut component = json!({
        "type": "library",
        "bom-ref": purl,
        "name": krate.name,
        "version": krate.version,
        "purl": purl,
    });
    if !krate.license.is_empty() {
        // Older crates separate licenses by a slash, which is no SPDX.
        let license = krate.license.replace('/', " OR ");
        component["licenses"] = json!([{ "expression": license }]);
    }
    if let Some(checksum) = &krate.checksum {
        component["hashes"] = json!([{ "alg": "SHA-256", "content": checksum }]);
    }
    if !krate.repository.is_empty() {
        component["externalReferences"] = json!([{ "type": "vcs", "url": krate.repository }]);
    }
    component
}
