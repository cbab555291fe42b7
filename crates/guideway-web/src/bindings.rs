//! The calls of JavaScript. An error is thrown as JSON with `code`, `message` and `remedy`.

use guideway::layout::UserError;
use serde_json::json;
use wasm_bindgen::prelude::*;

use crate::file::Uint8Array;
#[cfg(feature = "files")]
use crate::files::Saved;
use crate::session::{Drawn, Session};
use crate::work::{open, work};

/// A layout that is open.
#[wasm_bindgen(js_name = Session)]
pub struct JsSession(Session);

/// A picture.
#[wasm_bindgen(js_name = Drawn)]
pub struct JsDrawn(Drawn);

/// A file that was written.
#[cfg(feature = "files")]
#[wasm_bindgen(js_name = Saved)]
pub struct JsSaved(Saved);

/// See [`guideway::compose::add_font`].
#[wasm_bindgen]
#[expect(unreachable_pub, reason = "JavaScript calls it")]
pub fn add_font(data: Vec<u8>) -> bool {
    guideway::compose::add_font(data)
}

/// See [`guideway::compose::has_missed_letters`].
#[wasm_bindgen]
#[expect(unreachable_pub, reason = "JavaScript calls it")]
pub fn has_missed_letters() -> bool {
    guideway::compose::has_missed_letters()
}

fn thrown(error: UserError) -> JsValue {
    let UserError {
        code,
        message,
        remedy,
    } = error;
    let error = json!({ "code": code, "message": message, "remedy": remedy });
    JsValue::from_str(&error.to_string())
}

#[wasm_bindgen(js_class = Session)]
impl JsSession {
    /// Opens the bytes of a file.
    #[wasm_bindgen(constructor)]
    pub fn new(name: &str, bytes: Uint8Array) -> Result<JsSession, JsValue> {
        open(name, bytes).map(Self).map_err(thrown)
    }

    /// See [`Session::set_origin`].
    pub fn set_origin(&mut self, format: &str, version: &str) {
        self.0.set_origin(format, version);
    }

    /// See [`Session::set_floor_plan`].
    pub fn set_floor_plan(
        &mut self,
        name: &str,
        bytes: Vec<u8>,
        placement: &str,
    ) -> Result<(), JsValue> {
        let set = self.0.set_floor_plan(name, bytes, placement);
        set.map_err(thrown)
    }

    /// See [`Session::check_envelope`].
    pub fn check_envelope(&self, text: &str) -> Result<(), JsValue> {
        self.0.check_envelope(text).map_err(thrown)
    }

    /// See [`Session::info`].
    pub fn info(&self) -> String {
        self.0.info()
    }

    /// See [`Session::length_m`].
    pub fn length_m(&self, first: usize, count: usize) -> f64 {
        self.0.length_m(first, count)
    }

    /// See [`Session::check`].
    pub fn check(&self, most: usize) -> String {
        work(|| self.0.check(most))
    }

    /// See [`Session::render`].
    pub fn render(&mut self, look: &str) -> Result<JsDrawn, JsValue> {
        let drawn = work(|| self.0.render(look));
        drawn.map(JsDrawn).map_err(thrown)
    }

    /// See [`Session::png`].
    pub fn png(&mut self, look: &str) -> Result<Vec<u8>, JsValue> {
        work(|| self.0.png(look)).map_err(thrown)
    }

    /// See [`Session::curves`].
    pub fn curves(&mut self, look: &str, format: &str) -> Result<Vec<u8>, JsValue> {
        work(|| self.0.curves(look, format)).map_err(thrown)
    }

    /// See [`Session::hit`].
    pub fn hit(&self, x: f64, y: f64, reach_px: f64) -> String {
        self.0.hit(x, y, reach_px)
    }

    /// See [`Session::element`].
    pub fn element(&self, kind: &str, row: u32) -> Result<String, JsValue> {
        self.0.element(kind, row).map_err(thrown)
    }

    /// See [`Session::find`].
    pub fn find(&self, text: &str, limit: usize) -> String {
        self.0.find(text, limit)
    }

    /// See [`Session::query`].
    pub fn query(&self, text: &str, limit: usize) -> Result<String, JsValue> {
        self.0.query(text, limit).map_err(thrown)
    }

    /// See [`Session::sample`].
    pub fn sample(&self, row: u32, spacing_m: f64) -> Result<String, JsValue> {
        self.0.sample(row, spacing_m).map_err(thrown)
    }

    /// See [`Session::route`].
    pub fn route(&self, ends: &str) -> Result<String, JsValue> {
        self.0.route(ends).map_err(thrown)
    }
}

#[cfg(feature = "files")]
#[wasm_bindgen(js_class = Session)]
impl JsSession {
    /// See [`Session::save`].
    pub fn save(&self, format: &str) -> Result<JsSaved, JsValue> {
        let saved = work(|| self.0.save(format));
        saved.map(JsSaved).map_err(thrown)
    }

    /// See [`Session::edit`].
    pub fn edit(&mut self, script: &str) -> Result<String, JsValue> {
        work(|| self.0.edit(script)).map_err(thrown)
    }

    /// See [`Session::undo`].
    pub fn undo(&mut self) -> bool {
        self.0.undo()
    }

    /// See [`Session::redo`].
    pub fn redo(&mut self) -> bool {
        self.0.redo()
    }

    /// See [`Session::diff`].
    pub fn diff(&self, other: &JsSession, most: usize) -> String {
        work(|| self.0.diff(&other.0, most))
    }
}

#[wasm_bindgen(js_class = Drawn)]
impl JsDrawn {
    /// The report, as JSON.
    #[wasm_bindgen(getter)]
    pub fn report(&self) -> String {
        self.0.report.clone()
    }

    /// R, G, B, A of each pixel, which are here no more afterwards.
    pub fn take_rgba(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.0.rgba)
    }
}

#[cfg(feature = "files")]
#[wasm_bindgen(js_class = Saved)]
impl JsSaved {
    /// The losses, as JSON.
    #[wasm_bindgen(getter)]
    pub fn losses(&self) -> String {
        self.0.losses.clone()
    }

    /// The content of the file, which is here no more afterwards.
    pub fn take_bytes(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.0.bytes)
    }
}
