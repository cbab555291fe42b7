//! A query that counts the primitives of draws.

use std::rc::Rc;

use glow::HasContext;

use super::Gl;
use crate::error::GlError;

/// Counts the primitives that draws generate.
pub(crate) struct PrimitiveCounter {
    gl: Rc<Gl>,
    query: glow::Query,
}

impl PrimitiveCounter {
    /// Creates a counter.
    pub(crate) fn new(gl: &Rc<Gl>) -> Result<Self, GlError> {
        // SAFETY: the context is current; the call makes an object and takes no memory of the host.
        let query = unsafe { gl.raw.create_query() }.map_err(GlError::create("query"))?;
        Ok(Self {
            gl: Rc::clone(gl),
            query,
        })
    }

    /// Counts the primitives of `draw`.
    pub(crate) fn during(&self, draw: impl FnOnce()) {
        // SAFETY: the object belongs to this context, which is current; no memory of the host is
        // passed.
        unsafe {
            self.gl
                .raw
                .begin_query(glow::PRIMITIVES_GENERATED, self.query);
        }
        draw();
        // SAFETY: the object belongs to this context, which is current; no memory of the host is
        // passed.
        unsafe { self.gl.raw.end_query(glow::PRIMITIVES_GENERATED) };
    }

    /// Returns the last count. Waits for the device.
    pub(crate) fn count(&self) -> u64 {
        // SAFETY: the query belongs to this context; the driver answers by value.
        unsafe {
            self.gl
                .raw
                .get_query_parameter_u64(self.query, glow::QUERY_RESULT)
        }
    }
}

impl Drop for PrimitiveCounter {
    fn drop(&mut self) {
        // SAFETY: the object belongs to this context, and nothing uses it afterwards.
        unsafe { self.gl.raw.delete_query(self.query) };
    }
}
