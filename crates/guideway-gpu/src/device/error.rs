//! Errors of the graphics device.

use guideway_scene::RenderError;

/// The reason and the remedy in the words of the system.
const NO_ADAPTER: &str = if cfg!(windows) {
    "neither Vulkan nor DirectX 12 runs. Install the driver of the graphics card's maker; Windows \
     10 and later draw by DirectX 12 without one, unless a policy forbids it"
} else if cfg!(target_os = "macos") {
    "Metal does not run. It needs macOS 10.14 or later and a session on the screen"
} else {
    "there is no Vulkan loader, or no driver for it. On Debian or Ubuntu install `libvulkan1` and \
     `mesa-vulkan-drivers`, which also draw without graphics hardware"
};

/// The reason why an operation of the graphics device failed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DeviceError {
    /// The computer has no graphics adapter or no driver for it.
    #[error("no graphics adapter was found: {NO_ADAPTER}")]
    NoAdapter,
    /// Every adapter refused to open.
    #[error("no graphics adapter could be opened: {reasons}")]
    NotOpened {
        /// Name and reason of each adapter.
        reasons: String,
    },
    /// The driver rejected a shader.
    #[error("the shader `{name}` cannot be compiled: {message}")]
    Shader {
        /// Name of the shader.
        name: String,
        /// Message of the compiler.
        message: String,
    },
    /// The device has no memory left.
    #[error("there is no memory left for {operation}; close other programs or draw fewer paths")]
    OutOfMemory {
        /// Use of the memory.
        operation: String,
    },
    /// The driver rejected an operation.
    #[error("{operation}: {message}")]
    Rejected {
        /// The operation, such as the name of a buffer.
        operation: String,
        /// Message of the driver.
        message: String,
    },
    /// A buffer could not be read back.
    #[error("{operation} cannot be read back: {message}")]
    Readback {
        /// Name of the buffer.
        operation: String,
        /// Message of the driver.
        message: String,
    },
    /// A submission took too long.
    #[error("{operation} did not end within {seconds} s; draw fewer paths, or by another method")]
    Timeout {
        /// The submission.
        operation: String,
        /// The limit.
        seconds: u64,
    },
    /// The device was lost, or failed outside of any operation.
    #[error("{reason}; start again, and update the driver if it happens again")]
    Lost {
        /// The first failure.
        reason: String,
    },
}

impl DeviceError {
    /// The same error as one of a render method.
    pub fn of_method(&self, method: &'static str) -> RenderError {
        RenderError::Device {
            method,
            what: self.to_string(),
        }
    }
}
