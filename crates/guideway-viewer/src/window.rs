//! Opens the native window and runs the application in it.

use std::sync::{Arc, OnceLock};

use eframe::CreationContext;
use eframe::egui::epaint::text::{FallbackRequest, FontData, FontInsert};
use eframe::egui::{Context, RawInput, RequestRepaintInfo, Ui};
use eframe::egui_wgpu::{WgpuConfiguration, WgpuSetup};
use eframe::wgpu::DeviceType;
use guideway_compose::{SystemFont, system_font};
use guideway_layout::UserError;

use crate::app::{App, FIRST_PICTURE_WAIT};
use crate::background::{RedrawTimer, RepaintGate, RepaintHandle};
use crate::launch_options::LaunchOptions;
use crate::partial_redraw::PartialRedraw;
use crate::preferences::MIN_SIZE;
use crate::services::{AppServices, WINDOW_ERROR};
use crate::window_icon::window_icon;

/// Opens the window and returns when it is closed. Must be called from the main thread.
///
/// # Errors
/// When there is no desktop to open a window on, or no graphics adapter that can draw it.
pub fn run(services: Arc<dyn AppServices>, launch: LaunchOptions) -> Result<(), UserError> {
    let window = Arc::<OnceLock<Context>>::default();
    // The files load while the window opens.
    let mut app = App::launch(repaint_handle(&window), Arc::clone(&services), launch);
    app.first_picture_wait = FIRST_PICTURE_WAIT;
    let options = eframe::NativeOptions {
        viewport: app
            .window_place
            .builder()
            .with_min_inner_size(MIN_SIZE)
            .with_icon(window_icon())
            .with_drag_and_drop(true),
        // The window has no gradients, and dithering slows down software renderers.
        dithering: false,
        wgpu_options: wgpu_options(services),
        ..eframe::NativeOptions::default()
    };
    let create: eframe::AppCreator<'_> = Box::new(move |creation| {
        app.apply_theme(&creation.egui_ctx);
        let fonts = |request: &FallbackRequest<'_>| system_font_for(request.cluster);
        creation.egui_ctx.add_font_provider(Arc::new(fonts));
        adapt_to_adapter(&mut app, creation);
        let repaints = Repaints::start(creation);
        // eframe calls this once, so the lock is empty.
        let _ = window.set(creation.egui_ctx.clone());
        Ok(Box::new(Window { app, repaints }))
    });
    eframe::run_native("Guideway", options, create).map_err(|error| {
        UserError::new(
            WINDOW_ERROR,
            format!(
                "cannot open a window: {}",
                without_source_path(&error.to_string())
            ),
            WINDOW_NEEDS,
        )
    })
}

/// The needs of a window, in the words of the system.
const WINDOW_NEEDS: &str = if cfg!(windows) {
    "A window needs Vulkan or DirectX 12. Install the driver of the graphics card's maker, or in a \
     remote session ask for one with graphics. `guideway render` needs neither"
} else if cfg!(target_os = "macos") {
    "A window needs a session on the screen and Metal, which macOS 10.14 and later have. `guideway \
     render` needs neither"
} else {
    "A window needs a desktop (X11 or Wayland) and a graphics adapter. On Debian or Ubuntu install \
     `libvulkan1` and `mesa-vulkan-drivers`, which need no hardware. `guideway render` needs \
     neither"
};

/// The font of the system for a letter that the fonts of the window lack: the one of pictures.
fn system_font_for(cluster: &str) -> Option<FontInsert> {
    let letter = cluster.chars().next()?;
    let SystemFont { data, index } = system_font(letter)?;
    let name = format!("system font of {letter}");
    let mut font = FontData::from_owned(data);
    font.index = index;
    Some(FontInsert::new(&name, font, Vec::new()))
}

/// Removes the source file and line that winit puts before its reason: they name folders of the
/// computer that built the program.
fn without_source_path(error: &str) -> String {
    let parts = error.split(' ');
    let kept = parts.filter(|part| !(part.contains('/') && part.contains(".rs:")));
    kept.collect::<Vec<_>>()
        .join(" ")
        .replace("os error at ", "")
}

/// Repaints the window once it is open. Earlier calls have no effect: the first frame takes all
/// results.
fn repaint_handle(window: &Arc<OnceLock<Context>>) -> RepaintHandle {
    let window = Arc::clone(window);
    Arc::new(move || {
        if let Some(window) = window.get() {
            window.request_repaint();
        }
    })
}

/// Opens a device on which render methods can draw too. Windows has several ways to one adapter,
/// some of which may be broken; elsewhere there is one, and trying it would take time.
fn wgpu_options(services: Arc<dyn AppServices>) -> WgpuConfiguration {
    let mut options = WgpuConfiguration::default();
    if let WgpuSetup::CreateNew(setup) = &mut options.wgpu_setup {
        if cfg!(windows) {
            let services = Arc::clone(&services);
            setup.native_adapter_selector = Some(Arc::new(move |adapters, surface| {
                let can_present = |adapter: &eframe::wgpu::Adapter| {
                    surface.is_none_or(|surface| adapter.is_surface_supported(surface))
                };
                services.choose_adapter(adapters, &can_present)
            }));
        }
        let plain = Arc::clone(&setup.device_descriptor);
        setup.device_descriptor = Arc::new(move |adapter| {
            let shared = services.device_descriptor(adapter);
            shared.unwrap_or_else(|| plain(adapter))
        });
    }
    options
}

/// Shares the device with render methods, notes the graphics adapter, and lets one that is a
/// processor draw no more than what changes.
fn adapt_to_adapter(app: &mut App, creation: &CreationContext<'_>) {
    let Some(state) = &creation.wgpu_render_state else {
        return;
    };
    let info = state.adapter.get_info();
    app.adapter = format!("{} ({})", info.name, info.backend);
    app.share_device(state);
    if rests_on(&creation.egui_ctx, info.device_type) {
        let redraw = PartialRedraw::new(state.clone());
        creation.egui_ctx.add_plugin(redraw);
    }
}

/// Lets nothing blink or fade on an adapter that is a processor: each blink of the text cursor and
/// each step of a fade would draw a frame. Returns `true` for such an adapter.
fn rests_on(ctx: &Context, device: DeviceType) -> bool {
    let is_processor = device == DeviceType::Cpu;
    if is_processor {
        ctx.all_styles_mut(|style| {
            style.visuals.text_cursor.blink = false;
            style.animation_time = 0.0;
        });
    }
    is_processor
}

/// The frames that the window shows beside those of input events.
struct Repaints {
    gate: Arc<RepaintGate>,
    timer: RedrawTimer,
}

impl Repaints {
    /// Takes over egui's requests for repaints from eframe, which would follow all of them.
    fn start(creation: &CreationContext<'_>) -> Self {
        let ctx = &creation.egui_ctx;
        let native = creation.winit_window().map(Arc::downgrade);
        let redraw = move || {
            if let Some(window) = native.as_ref().and_then(|window| window.upgrade()) {
                window.request_redraw();
            }
        };
        let gate = Arc::new(RepaintGate::new(ctx));
        let timer = RedrawTimer::start(redraw.clone());
        let (admitting, timing) = (Arc::clone(&gate), timer.clone());
        ctx.set_request_repaint_callback(|_| {});
        ctx.set_repaint_observer(Box::new(move |info: RequestRepaintInfo| {
            if !info.delay.is_zero() {
                timing.after(info.delay);
            } else if admitting.admits() {
                redraw();
            }
        }));
        Self { gate, timer }
    }
}

/// Connects the application to eframe.
struct Window {
    app: App,
    repaints: Repaints,
}

impl eframe::App for Window {
    fn raw_input_hook(&mut self, _ctx: &Context, _input: &mut RawInput) {
        self.repaints.timer.clear();
        self.repaints.gate.begin();
    }

    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.repaints.gate.show(ui.ctx());
        self.app.show(ui);
        self.repaints.gate.end(ui.ctx(), self.app.changes_late);
    }

    fn on_exit(&mut self) {
        self.app.leave();
    }
}

#[cfg(test)]
mod tests {
    use eframe::egui::Theme;

    use super::*;

    #[test]
    fn text_cursor_blinks_on_graphics_hardware_only() {
        for (device, is_processor) in [
            (DeviceType::Cpu, true),
            (DeviceType::IntegratedGpu, false),
            (DeviceType::DiscreteGpu, false),
            (DeviceType::Other, false),
        ] {
            let ctx = Context::default();
            assert_eq!(rests_on(&ctx, device), is_processor);
            for theme in [Theme::Light, Theme::Dark] {
                let style = ctx.style_of(theme);
                assert_eq!(style.visuals.text_cursor.blink, !is_processor);
                assert_eq!(style.animation_time == 0.0, is_processor);
            }
        }
    }

    #[test]
    fn error_names_no_folder_of_the_builder() {
        let error = "winit EventLoopError: os error at /home/me/.cargo/registry/linux/mod.rs:765: \
                     neither WAYLAND_DISPLAY nor DISPLAY is set";
        assert_eq!(
            without_source_path(error),
            "winit EventLoopError: neither WAYLAND_DISPLAY nor DISPLAY is set"
        );
    }
}
