//! OpenGL contexts without a window or a surface, through EGL.
//!
//! Input: a platform. Output: a context that is current on the calling thread.

use std::ffi::c_void;
use std::ptr;
use std::sync::OnceLock;

use khronos_egl as egl;

use crate::error::GlError;

type Egl = egl::DynamicInstance<egl::EGL1_5>;

// Values from the specifications EGL_MESA_platform_surfaceless and EGL_EXT_platform_device.
const PLATFORM_SURFACELESS: egl::Enum = 0x31DD;
const PLATFORM_DEVICE: egl::Enum = 0x313F;

/// A way to open a display without a window system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Platform {
    /// The device that Mesa selects.
    Surfaceless,
    /// A device by its index: reaches drivers other than Mesa's.
    Device(usize),
}

/// The EGL library. It stays loaded, because drivers do not support unloading.
fn library() -> Result<&'static Egl, GlError> {
    static LIBRARY: OnceLock<Result<Egl, GlError>> = OnceLock::new();
    let load = || {
        // SAFETY: a library by the name of libEGL has the functions of EGL.
        unsafe { Egl::load_required() }.map_err(|e| GlError::NoEgl {
            message: e.to_string(),
        })
    };
    LIBRARY.get_or_init(load).as_ref().map_err(Clone::clone)
}

/// Lists the platforms that EGL offers on this computer.
///
/// # Errors
/// When libEGL is missing.
pub(crate) fn platforms() -> Result<Vec<Platform>, GlError> {
    let egl = library()?;
    let extensions = egl
        .query_string(None, egl::EXTENSIONS)
        .map_err(failed("list its extensions"))?
        .to_string_lossy();
    let has = |name: &str| extensions.split(' ').any(|e| e == name);
    let mut platforms = Vec::new();
    if has("EGL_MESA_platform_surfaceless") {
        platforms.push(Platform::Surfaceless);
    }
    if has("EGL_EXT_platform_device") {
        platforms.extend((0..devices(egl).len()).map(Platform::Device));
    }
    Ok(platforms)
}

fn devices(egl: &Egl) -> Vec<*mut c_void> {
    type QueryDevices =
        unsafe extern "system" fn(egl::Int, *mut *mut c_void, *mut egl::Int) -> egl::Boolean;
    let Some(address) = egl.get_proc_address("eglQueryDevicesEXT") else {
        return Vec::new();
    };
    // SAFETY: the signature is that of EGL_EXT_device_enumeration; the function writes the number
    // of devices and at most as many devices as the vector holds.
    unsafe {
        let query = std::mem::transmute::<extern "system" fn(), QueryDevices>(address);
        let mut count = 0;
        if query(0, ptr::null_mut(), &raw mut count) == egl::FALSE {
            return Vec::new();
        }
        let mut devices = vec![ptr::null_mut(); usize::try_from(count).unwrap_or(0)];
        if query(count, devices.as_mut_ptr(), &raw mut count) == egl::FALSE {
            return Vec::new();
        }
        devices.truncate(usize::try_from(count).unwrap_or(0));
        devices
    }
}

/// An OpenGL context, current on its thread until dropped. Raw pointers make it `!Send`.
pub(super) struct Context {
    egl: &'static Egl,
    display: egl::Display,
    context: egl::Context,
}

impl Context {
    /// Makes a core context of OpenGL 4.6, or else 4.5, and makes it current.
    ///
    /// # Errors
    /// When the thread already has a context, or EGL fails.
    pub(super) fn new(platform: Platform) -> Result<Self, GlError> {
        let egl = library()?;
        if egl.get_current_context().is_some() {
            return Err(GlError::ContextExists);
        }
        let display = open(egl, platform)?;
        egl.bind_api(egl::OPENGL_API)
            .map_err(failed("select desktop OpenGL"))?;
        let context = create(egl, display)?;
        // From here on, `Drop` cleans up.
        let context = Self {
            egl,
            display,
            context,
        };
        egl.make_current(display, None, None, Some(context.context))
            .map_err(failed("make the context current"))?;
        Ok(context)
    }

    /// The address of an OpenGL function, or null when the driver lacks it.
    pub(super) fn address(&self, function: &str) -> *const c_void {
        let address = self.egl.get_proc_address(function);
        address.map_or(ptr::null(), |f| f as *const c_void)
    }

    /// Loads an OpenGL function.
    ///
    /// # Safety
    /// `F` must be the type of the function with this name.
    ///
    /// # Errors
    /// When the driver lacks the function.
    pub(super) unsafe fn function<F: Copy>(&self, name: &str) -> Result<F, GlError> {
        let address = self.address(name);
        if address.is_null() {
            return Err(GlError::Missing {
                feature: name.to_owned(),
            });
        }
        assert_eq!(size_of::<F>(), size_of_val(&address));
        // SAFETY: the caller guarantees that `F` is a function pointer, and the address is not
        // null.
        Ok(unsafe { std::mem::transmute_copy(&address) })
    }
}

impl Drop for Context {
    fn drop(&mut self) {
        // These calls only fail on a lost device, which has nothing left to clean up. The display
        // stays open because the whole process shares it.
        let _ = self.egl.make_current(self.display, None, None, None);
        let _ = self.egl.destroy_context(self.display, self.context);
    }
}

/// Opens the display of a platform, and checks its extensions.
fn open(egl: &Egl, platform: Platform) -> Result<egl::Display, GlError> {
    let (kind, native) = match platform {
        Platform::Surfaceless => (PLATFORM_SURFACELESS, egl::DEFAULT_DISPLAY),
        Platform::Device(number) => {
            let device = devices(egl).get(number).copied();
            let device = device.ok_or_else(|| GlError::Egl {
                operation: "open the device",
                message: "it was removed".to_owned(),
            })?;
            (PLATFORM_DEVICE, device)
        }
    };
    // SAFETY: EGL offers both platforms; they take the default display, or a device from the list.
    let display = unsafe { egl.get_platform_display(kind, native, &[egl::ATTRIB_NONE]) }
        .map_err(failed("open a display"))?;
    egl.initialize(display)
        .map_err(failed("initialize the display"))?;
    let extensions = egl
        .query_string(Some(display), egl::EXTENSIONS)
        .map_err(failed("list the extensions of the display"))?
        .to_string_lossy();
    for needed in ["EGL_KHR_surfaceless_context", "EGL_KHR_no_config_context"] {
        if !extensions.split(' ').any(|e| e == needed) {
            return Err(GlError::Missing {
                feature: needed.to_owned(),
            });
        }
    }
    Ok(display)
}

/// Creates the newest context that the driver has.
fn create(egl: &Egl, display: egl::Display) -> Result<egl::Context, GlError> {
    // SAFETY: EGL_KHR_no_config_context allows a null configuration.
    let no_config = unsafe { egl::Config::from_ptr(ptr::null_mut()) };
    // Requests notification of device resets; drivers without it get a second try.
    let notifying = [
        egl::CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
        egl::LOSE_CONTEXT_ON_RESET,
    ];
    let mut refusal = GlError::NoPlatform;
    for (minor, extra) in [(6, &notifying[..]), (5, &notifying), (6, &[]), (5, &[])] {
        let mut attributes = vec![
            egl::CONTEXT_MAJOR_VERSION,
            4,
            egl::CONTEXT_MINOR_VERSION,
            minor,
            egl::CONTEXT_OPENGL_PROFILE_MASK,
            egl::CONTEXT_OPENGL_CORE_PROFILE_BIT,
        ];
        attributes.extend(extra);
        attributes.push(egl::NONE);
        match egl.create_context(display, no_config, None, &attributes) {
            Ok(context) => return Ok(context),
            Err(e) => refusal = failed("create an OpenGL 4.5 core context")(e),
        }
    }
    Err(refusal)
}

/// Adds the failed operation to an error of EGL.
fn failed(operation: &'static str) -> impl FnOnce(egl::Error) -> GlError {
    move |error| GlError::Egl {
        operation,
        message: error.to_string(),
    }
}
