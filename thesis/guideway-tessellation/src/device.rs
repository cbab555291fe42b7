//! Finds an OpenGL device that draws without a window.
//!
//! Input: the platforms of EGL. Output: the first hardware device, else a software rasterizer.

use std::sync::Arc;

use crate::error::GlError;
use crate::sys::{Gl, Limits, Platform, platforms};
use crate::worker::Worker;

/// An OpenGL device without a window: graphics hardware if present, else a software rasterizer.
/// Several methods can share it.
#[derive(Clone, Debug)]
pub struct GlDevice {
    pub(crate) platform: Platform,
    pub(crate) limits: Limits,
    description: String,
    is_software: bool,
}

impl GlDevice {
    /// Searches for a device with OpenGL 4.5 or newer through EGL: first Mesa's choice, then each
    /// device of the computer.
    ///
    /// # Errors
    /// When no device has it: the error names the reasons and what to install.
    pub fn new() -> Result<Arc<Self>, GlError> {
        // On another thread, so that the caller keeps its own current context.
        let found = Worker::start(|| Self::find().map(|found| ((), found)));
        let found = found.unwrap_or(Err(GlError::ThreadEnded));
        let (_, found) = found.map_err(|error| match error {
            GlError::NoDevice { .. } => error,
            _ => GlError::NoDevice {
                reasons: error.to_string(),
            },
        })?;
        Ok(Arc::new(found))
    }

    fn find() -> Result<Self, GlError> {
        let (mut software, mut refusals) = (None, Vec::new());
        for platform in platforms()? {
            match Self::open(platform) {
                Ok(found) if !found.is_software => return Ok(found),
                Ok(found) => software = software.or(Some(found)),
                Err(error) => refusals.push(format!("{platform:?}: {error}")),
            }
        }
        if refusals.is_empty() {
            refusals.push(GlError::NoPlatform.to_string());
        }
        software.ok_or_else(|| GlError::NoDevice {
            reasons: refusals.join("; "),
        })
    }

    fn open(platform: Platform) -> Result<Self, GlError> {
        let gl = Gl::new(platform)?;
        Ok(Self {
            platform,
            limits: gl.limits(),
            description: gl.description(),
            is_software: gl.is_software(),
        })
    }

    /// Name of the device, and its OpenGL version.
    pub fn description(&self) -> &str {
        &self.description
    }

    /// Returns `true` if the device is a software rasterizer.
    pub fn is_software(&self) -> bool {
        self.is_software
    }
}

#[cfg(test)]
mod tests {
    use std::process::Command;

    use super::*;

    /// Set in the child process, which finds no driver.
    const CHILD: &str = "GUIDEWAY_TEST_WITHOUT_EGL";

    #[test]
    fn missing_driver_names_the_packages_to_install() {
        if std::env::var_os(CHILD).is_none() {
            // libglvnd reads the directory of its drivers once per process.
            let child = Command::new(std::env::current_exe().unwrap())
                .args([
                    "--exact",
                    "device::tests::missing_driver_names_the_packages_to_install",
                ])
                .env(CHILD, "1")
                .env("__EGL_VENDOR_LIBRARY_DIRS", "/nowhere")
                .env_remove("__EGL_VENDOR_LIBRARY_FILENAMES")
                .output()
                .unwrap();
            assert!(child.status.success(), "{child:?}");
            return;
        }
        match GlDevice::new() {
            Err(error) => {
                let text = error.to_string();
                assert!(text.contains("OpenGL 4.5"), "{text}");
                assert!(text.contains("`libegl1 libgl1-mesa-dri`"), "{text}");
            }
            Ok(_) => println!("SKIPPED: this libEGL ignores the directory of drivers"),
        }
    }
}
