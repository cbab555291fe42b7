//! Errors of OpenGL devices, contexts and objects.

use guideway_scene::RenderError;

/// The reason why an OpenGL device could not be opened, or failed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GlError {
    /// No device has OpenGL 4.5 without a window.
    #[error(
        "no device has OpenGL 4.5 without a window ({reasons}); install the driver of the graphics \
         card, or Mesa's to draw on the processor (`libegl1 libgl1-mesa-dri` on Debian and Ubuntu)"
    )]
    NoDevice {
        /// The reason of each platform.
        reasons: String,
    },
    /// The thread of the context ended.
    #[error("the OpenGL thread ended unexpectedly; retry, and report this error")]
    ThreadEnded,
    /// libEGL is missing or too old.
    #[error("it needs EGL, which Linux has: libEGL 1.5 cannot be loaded: {message}")]
    NoEgl {
        /// Message of the loader.
        message: String,
    },
    /// EGL offers no platform without a window.
    #[error("EGL has no platform without a window")]
    NoPlatform,
    /// An EGL call failed.
    #[error("EGL cannot {operation}: {message}")]
    Egl {
        /// The operation.
        operation: &'static str,
        /// Message of EGL.
        message: String,
    },
    /// The thread already has a current context.
    #[error("this thread already has an OpenGL context")]
    ContextExists,
    /// The driver lacks an extension, a function or a feature.
    #[error("the driver lacks {feature}")]
    Missing {
        /// The extension, function or feature.
        feature: String,
    },
    /// The driver rejected a shader.
    #[error("the driver cannot compile the {stage} shader: {log}")]
    Compile {
        /// Stage of the shader.
        stage: String,
        /// Message of the compiler.
        log: String,
    },
    /// The driver rejected a program.
    #[error("the driver cannot link the shaders: {log}")]
    Link {
        /// Message of the linker.
        log: String,
    },
    /// A buffer would exceed the range of OpenGL's sizes.
    #[error("{bytes} bytes of {buffer} exceed one OpenGL buffer; draw fewer paths")]
    BufferTooLarge {
        /// Name of the buffer.
        buffer: String,
        /// Its size.
        bytes: u64,
    },
    /// The driver could not create an object.
    #[error("OpenGL cannot create a {object}: {message}")]
    Create {
        /// Kind of the object.
        object: &'static str,
        /// Message of the driver.
        message: String,
    },
    /// The driver cannot draw into a picture of this format.
    #[error("the driver cannot draw into {picture}")]
    Framebuffer {
        /// Size and samples of the picture.
        picture: String,
    },
    /// The device has no memory left.
    #[error(
        "out of memory at {operation}; draw a smaller picture or fewer paths, or close other \
         programs that use the device"
    )]
    OutOfMemory {
        /// The operation.
        operation: String,
    },
    /// The device was reset.
    #[error("the device was reset at {operation}; prepare the scene again")]
    Reset {
        /// The operation.
        operation: String,
    },
    /// The context was lost.
    #[error("the device was lost at {operation}; prepare the scene again")]
    Lost {
        /// The operation.
        operation: String,
    },
    /// OpenGL reported another error.
    #[error("OpenGL error {code:#06x} at {operation}; update the driver, or report this error")]
    Rejected {
        /// The operation.
        operation: String,
        /// OpenGL's error code.
        code: u32,
    },
    /// The driver could not wait for the device.
    #[error("waiting for the device failed")]
    Wait,
}

impl GlError {
    /// The error of a call of `glow` that creates an object.
    pub(crate) fn create(object: &'static str) -> impl FnOnce(String) -> Self {
        move |message| Self::Create { object, message }
    }

    /// The same error as one of a render method.
    pub fn of_method(&self, method: &'static str) -> RenderError {
        RenderError::Device {
            method,
            what: self.to_string(),
        }
    }
}
