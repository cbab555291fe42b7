use std::sync::Arc;

use crate::sys::{Gl, Limits, Platform, platforms};
use crate::worker::Worker;

/// An OpenGL device that needs no window: real graphics hardware if there is any, else a processor that
/// stands in for it. Share it between methods.
#[derive(Clone, Debug)]
pub struct GlDevice {
    pub(crate) platform: Platform,
    pub(crate) limits: Limits,
    description: String,
    is_software: bool,
}

impl GlDevice {
    /// Looks for a device with OpenGL 4.5 or newer, through EGL: first what Mesa finds, then every device by
    /// itself.
    ///
    /// # Errors
    /// When there is none: a sentence on what is missing and what to install.
    pub fn new() -> Result<Arc<Self>, String> {
        // A thread of its own: whoever asks keeps the context that may be current there.
        let found = Worker::start(|| Self::find().map(|found| ((), found)));
        let (_, found) = found.unwrap_or_else(|| Err("its thread failed".to_owned())).map_err(|why| {
            format!(
                "no OpenGL 4.5 without a window ({why}); install the driver of the graphics card, or for drawing \
                 by the processor Mesa's (`libegl1 libgl1-mesa-dri` on Debian and Ubuntu)"
            )
        })?;
        Ok(Arc::new(found))
    }

    fn find() -> Result<Self, String> {
        let (mut software, mut refusals) = (None, Vec::new());
        for platform in platforms()? {
            match Self::open(platform) {
                Ok(found) if !found.is_software => return Ok(found),
                Ok(found) => software = software.or(Some(found)),
                Err(why) => refusals.push(format!("{platform:?}: {why}")),
            }
        }
        if refusals.is_empty() {
            refusals.push("EGL offers no platform for it".to_owned());
        }
        software.ok_or_else(|| refusals.join("; "))
    }

    fn open(platform: Platform) -> Result<Self, String> {
        let gl = Gl::new(platform)?;
        Ok(Self {
            platform,
            limits: gl.limits(),
            description: gl.description(),
            is_software: gl.is_software(),
        })
    }

    /// What the device and its OpenGL are called.
    pub fn description(&self) -> &str {
        &self.description
    }

    /// Whether the processor does the work of a graphics device.
    pub fn is_software(&self) -> bool {
        self.is_software
    }
}

#[cfg(test)]
mod tests {
    use std::process::Command;

    use super::*;

    /// Set for the process that finds no driver.
    const CHILD: &str = "GUIDEWAY_TEST_WITHOUT_EGL";

    #[test]
    fn without_a_driver_it_says_what_to_install() {
        if std::env::var_os(CHILD).is_none() {
            // libglvnd looks for drivers where this says; it is read once a process.
            let child = Command::new(std::env::current_exe().unwrap())
                .args([
                    "--exact",
                    "device::tests::without_a_driver_it_says_what_to_install",
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
            Err(why) => assert!(
                why.contains("OpenGL 4.5") && why.contains("`libegl1 libgl1-mesa-dri`"),
                "{why}"
            ),
            Ok(_) => println!("SKIPPED: this libEGL finds its driver wherever it is told to look"),
        }
    }
}
