//! `FROM,TO[,TYPE]`: a route in one argument, to draw over a picture.

use guideway::compose::MarkedRoute;
use guideway::layout::{Layout, UserError};
use guideway::network::{RouteError, RouteOptions, Router};
use serde_json::{Value, json};

use crate::cli::text;

/// Start, goal and vehicle type of a route.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct RouteEnds {
    from: String,
    to: String,
    vehicle_type: Option<String>,
}

/// A route to draw, with its sums.
pub(crate) struct FoundRoute {
    pub(crate) mark: MarkedRoute,
    length_m: f64,
    time_s: f64,
}

impl RouteEnds {
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let parts: Vec<&str> = text.split(',').map(str::trim).collect();
        let (from, to, vehicle_type) = match parts[..] {
            [from, to] => (from, to, None),
            [from, to, name] => (from, to, Some(name.to_owned())),
            _ => return Err("write FROM,TO or FROM,TO,TYPE, such as dock-1,PICK-07".to_owned()),
        };
        Ok(Self {
            from: from.to_owned(),
            to: to.to_owned(),
            vehicle_type,
        })
    }

    /// The fastest route in a layout.
    ///
    /// # Errors
    /// When a name is unknown, or there is no way.
    pub(crate) fn find(&self, layout: &Layout) -> Result<FoundRoute, UserError> {
        let vehicle_type = self.vehicle_type.as_deref();
        let vehicle_type = vehicle_type.or_else(|| layout.paths.vehicle_types().only_name());
        let router = Router::new(layout, vehicle_type, &RouteOptions::default());
        let router = router.map_err(|error| {
            let is_of_type = matches!(error, RouteError::VehicleType { .. });
            let mut error = UserError::from(error);
            if is_of_type {
                error.remedy = format!("Name one: --route {},{},TYPE", self.from, self.to);
            }
            error
        })?;
        let route = router.route(&router.place(&self.from)?, &router.place(&self.to)?)?;
        let rows = route.rows.iter();
        Ok(FoundRoute {
            mark: MarkedRoute {
                paths: rows.map(|row| (row.path, row.is_backward)).collect(),
                from: self.from.clone(),
                to: self.to.clone(),
            },
            length_m: route.length_m,
            time_s: route.time_s,
        })
    }
}

impl FoundRoute {
    pub(crate) fn text(&self) -> String {
        let name = |text: &str| text::single_line(text, 40);
        format!(
            "route from {} to {}: {}, {}, {:.1} s\n",
            name(&self.mark.from),
            name(&self.mark.to),
            text::counted(self.mark.paths.len() as u64, "path"),
            text::meters(self.length_m),
            self.time_s
        )
    }

    pub(crate) fn json(&self) -> Value {
        json!({
            "from": self.mark.from,
            "to": self.mark.to,
            "paths": self.mark.paths.len(),
            "length_m": self.length_m,
            "time_s": self.time_s,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parses_two_ends_and_a_type() {
        let ends = RouteEnds::parse("dock-1, PICK 07,tugger").unwrap();
        assert_eq!(
            (ends.from.as_str(), ends.to.as_str()),
            ("dock-1", "PICK 07")
        );
        assert_eq!(ends.vehicle_type.as_deref(), Some("tugger"));
        assert_eq!(RouteEnds::parse("a,b").unwrap().vehicle_type, None);
        assert!(RouteEnds::parse("a").unwrap_err().contains("FROM,TO"));
    }
}
