//! OpenGL contexts without a window or a surface.

use std::ffi::c_void;
use std::ptr;
use std::sync::OnceLock;

use khronos_egl as egl;

type Egl = egl::DynamicInstance<egl::EGL1_5>;

// EGL_MESA_platform_surfaceless and EGL_EXT_platform_device.
const PLATFORM_SURFACELESS: egl::Enum = 0x31DD;
const PLATFORM_DEVICE: egl::Enum = 0x313F;

/// Where a context can be made without a window system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Platform {
    /// Whatever Mesa finds.
    Surfaceless,
    /// A device, by its number: the way to a driver that is not Mesa's.
    Device(usize),
}

/// Loaded once and never unloaded: drivers do not survive that.
fn library() -> Result<&'static Egl, String> {
    static LIBRARY: OnceLock<Result<Egl, String>> = OnceLock::new();
    // SAFETY: the library is called libEGL, so it is taken to be one.
    let load = || unsafe { Egl::load_required() }.map_err(|e| format!("libEGL 1.5: {e}"));
    LIBRARY.get_or_init(load).as_ref().map_err(Clone::clone)
}

/// The platforms that this computer's EGL offers.
pub(crate) fn platforms() -> Result<Vec<Platform>, String> {
    let egl = library()?;
    let extensions = egl
        .query_string(None, egl::EXTENSIONS)
        .map_err(|e| format!("EGL tells no extensions: {e}"))?
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
    // SAFETY: this is the function's signature in EGL_EXT_device_enumeration; it writes at most as many
    // devices as there is room for, and their number.
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

/// An OpenGL context, current on the thread that made it until it is dropped. Raw pointers keep it there.
pub(super) struct Context {
    egl: &'static Egl,
    display: egl::Display,
    context: egl::Context,
}

impl Context {
    /// Makes the newest context that will do, 4.6 or 4.5 core, and makes it current.
    pub(super) fn new(platform: Platform) -> Result<Self, String> {
        let egl = library()?;
        if egl.get_current_context().is_some() {
            return Err("this thread has an OpenGL context already".to_owned());
        }
        let display = open(egl, platform)?;
        egl.bind_api(egl::OPENGL_API)
            .map_err(|e| format!("this EGL has no desktop OpenGL: {e}"))?;
        let context = create(egl, display)?;
        // From here on, `Drop` cleans up.
        let context = Self {
            egl,
            display,
            context,
        };
        egl.make_current(display, None, None, Some(context.context))
            .map_err(|e| format!("the context cannot be made current: {e}"))?;
        Ok(context)
    }

    /// The address of an OpenGL function; null when there is none.
    pub(super) fn address(&self, function: &str) -> *const c_void {
        let address = self.egl.get_proc_address(function);
        address.map_or(ptr::null(), |f| f as *const c_void)
    }

    /// An OpenGL function.
    ///
    /// # Safety
    /// `F` is the type of the function of this name.
    pub(super) unsafe fn function<F: Copy>(&self, name: &str) -> Result<F, String> {
        let address = self.address(name);
        if address.is_null() {
            return Err(format!("it has no {name}"));
        }
        assert_eq!(size_of::<F>(), size_of_val(&address));
        // SAFETY: by the caller's word `F` is a function pointer, and the address is not null.
        Ok(unsafe { std::mem::transmute_copy(&address) })
    }
}

impl Drop for Context {
    fn drop(&mut self) {
        // What fails here fails on a lost device, where nothing is left to clean up. The display is the
        // whole process' own and stays open.
        let _ = self.egl.make_current(self.display, None, None, None);
        let _ = self.egl.destroy_context(self.display, self.context);
    }
}

fn open(egl: &Egl, platform: Platform) -> Result<egl::Display, String> {
    let (kind, native) = match platform {
        Platform::Surfaceless => (PLATFORM_SURFACELESS, egl::DEFAULT_DISPLAY),
        Platform::Device(number) => {
            let device = devices(egl).get(number).copied();
            (PLATFORM_DEVICE, device.ok_or("the device is gone")?)
        }
    };
    // SAFETY: both platforms are offered, and take the default display or a device that was just listed.
    let display = unsafe { egl.get_platform_display(kind, native, &[egl::ATTRIB_NONE]) }
        .map_err(|e| format!("no display: {e}"))?;
    egl.initialize(display)
        .map_err(|e| format!("the display does not start: {e}"))?;
    let extensions = egl
        .query_string(Some(display), egl::EXTENSIONS)
        .map_err(|e| format!("the display tells no extensions: {e}"))?
        .to_string_lossy();
    for needed in ["EGL_KHR_surfaceless_context", "EGL_KHR_no_config_context"] {
        if !extensions.split(' ').any(|e| e == needed) {
            return Err(format!("the display lacks {needed}"));
        }
    }
    Ok(display)
}

fn create(egl: &Egl, display: egl::Display) -> Result<egl::Context, String> {
    // SAFETY: EGL_KHR_no_config_context allows for none.
    let no_config = unsafe { egl::Config::from_ptr(ptr::null_mut()) };
    // A driver that can tell when the device was reset is asked to; not all can.
    let telling = [
        egl::CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
        egl::LOSE_CONTEXT_ON_RESET,
    ];
    let mut refusal = String::new();
    for (minor, extra) in [(6, &telling[..]), (5, &telling), (6, &[]), (5, &[])] {
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
            Err(e) => refusal = format!("it gives no OpenGL 4.5 core context: {e}"),
        }
    }
    Err(refusal)
}
