//! Compute pipelines: shader sources, compiled kernels and their bind groups.

use std::borrow::Cow;

use super::error::DeviceError;
use super::gpu::Gpu;
use super::memory::DeviceBuffer;

/// A compute shader.
pub struct Source {
    /// Name for messages.
    pub name: &'static str,
    /// WGSL with the entry point `main`.
    pub wgsl: Cow<'static, str>,
    /// Variables of bind group 0, in the order of their bindings.
    pub bindings: &'static [&'static str],
}

/// A compiled compute pipeline. Clones share it.
#[derive(Clone)]
pub struct Kernel {
    name: &'static str,
    pub(super) pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
    bindings: usize,
}

/// The buffers and textures of one kernel, in the order of [`Source::bindings`].
pub struct Bindings(pub(super) wgpu::BindGroup);

impl Kernel {
    /// Compiles a shader with values for its overrides.
    ///
    /// # Errors
    /// [`DeviceError::Shader`] if the shader is invalid; any error of the device.
    pub fn new(gpu: &Gpu, source: &Source, constants: &[(&str, f64)]) -> Result<Self, DeviceError> {
        let device = &gpu.device;
        let compiled = gpu.checked(source.name, || {
            let module = module(gpu, source);
            let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(source.name),
                layout: None,
                module: &module,
                entry_point: Some("main"),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants,
                    // Shaders initialize their workgroup memory themselves, with all threads.
                    zero_initialize_workgroup_memory: false,
                },
                cache: None,
            });
            Self {
                name: source.name,
                layout: pipeline.get_bind_group_layout(0),
                pipeline,
                bindings: source.bindings.len(),
            }
        });
        #[cfg(test)]
        if compiled.is_ok() {
            tests::record(source, constants);
        }
        compiled.map_err(|error| match error {
            DeviceError::Rejected { operation, message } => DeviceError::Shader {
                name: operation,
                message,
            },
            other => other,
        })
    }

    /// Binds one buffer per binding.
    ///
    /// # Errors
    /// [`DeviceError::Rejected`] if a buffer does not suit its binding.
    pub fn bind(&self, gpu: &Gpu, buffers: &[&DeviceBuffer]) -> Result<Bindings, DeviceError> {
        let buffers = buffers.iter().map(|buffer| buffer.raw());
        self.bind_resources(gpu, buffers.map(wgpu::Buffer::as_entire_binding))
    }

    /// Binds one buffer per binding but the last, which is a texture.
    ///
    /// # Errors
    /// [`DeviceError::Rejected`] if a buffer or the texture does not suit its binding.
    pub fn bind_with_texture(
        &self,
        gpu: &Gpu,
        buffers: &[&DeviceBuffer],
        texture: &wgpu::TextureView,
    ) -> Result<Bindings, DeviceError> {
        let buffers = buffers.iter().map(|buffer| buffer.raw());
        let buffers = buffers.map(wgpu::Buffer::as_entire_binding);
        let texture = wgpu::BindingResource::TextureView(texture);
        self.bind_resources(gpu, buffers.chain([texture]))
    }

    fn bind_resources<'a>(
        &self,
        gpu: &Gpu,
        resources: impl Iterator<Item = wgpu::BindingResource<'a>>,
    ) -> Result<Bindings, DeviceError> {
        let entries: Vec<_> = (0..)
            .zip(resources)
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        debug_assert_eq!(entries.len(), self.bindings, "{}", self.name);
        let descriptor = wgpu::BindGroupDescriptor {
            label: Some(self.name),
            layout: &self.layout,
            entries: &entries,
        };
        let group = gpu.checked(self.name, || gpu.device.create_bind_group(&descriptor))?;
        Ok(Bindings(group))
    }
}

/// Compiles a shader without run-time checks of its memory accesses. Measured on an H200: the
/// checks take a fifth of the time of a frame of D1.
#[allow(
    unsafe_code,
    reason = "wgpu omits the checks only for trusted shaders: those of this crate bound every \
              index and loop by a count that they receive or compute, and a test draws the same \
              bits with all checks"
)]
fn module(gpu: &Gpu, source: &Source) -> wgpu::ShaderModule {
    let descriptor = wgpu::ShaderModuleDescriptor {
        label: Some(source.name),
        source: wgpu::ShaderSource::Wgsl(source.wgsl.clone()),
    };
    if gpu.options().checks_shaders {
        return gpu.device.create_shader_module(descriptor);
    }
    let unchecked = wgpu::ShaderRuntimeChecks::unchecked();
    // SAFETY: see above; shaders are constants of this crate, none comes from outside.
    unsafe {
        gpu.device
            .create_shader_module_trusted(descriptor, unchecked)
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use std::sync::{Mutex, PoisonError};

    use naga::{AddressSpace, Module};

    use super::Source;

    /// Each kernel that a test compiled: its name, and its text with the values of its overrides.
    static COMPILED: Mutex<Vec<(&str, String)>> = Mutex::new(Vec::new());

    pub(super) fn record(source: &Source, constants: &[(&str, f64)]) {
        let lines = source.wgsl.lines().map(|line| {
            let Some((name, kind)) = overridden(line) else {
                return line.to_owned();
            };
            let found = constants.iter().find(|(constant, _)| *constant == name);
            let value = found.map(|(_, value)| *value);
            match (kind, value) {
                ("bool", value) => format!("const {name}: bool = {};", value == Some(1.0)),
                (_, Some(value)) => format!("const {name}: {kind} = {kind}({value});"),
                (_, None) => line.replacen("override", "const", 1),
            }
        });
        let text = lines.collect::<Vec<_>>().join("\n");
        let mut all = COMPILED.lock().unwrap_or_else(PoisonError::into_inner);
        all.push((source.name, text));
    }

    /// Name and type of an override.
    fn overridden(line: &str) -> Option<(&str, &str)> {
        let (name, rest) = line.strip_prefix("override ")?.split_once(": ")?;
        Some((name, rest.split([';', ' ']).next()?))
    }

    /// Threads per workgroup, and bytes that they share.
    fn needs(module: &Module) -> (u32, u32) {
        let threads = module.entry_points[0].workgroup_size.iter().product();
        let variables = module.global_variables.iter().map(|(_, variable)| variable);
        let shared = variables.filter(|variable| variable.space == AddressSpace::WorkGroup);
        let bytes = shared.map(|variable| module.types[variable.ty].inner.size(module.to_ctx()));
        (threads, bytes.sum())
    }

    /// The kernels that need more than these threads or shared bytes per workgroup, with their
    /// needs, of all that tests compiled.
    pub(crate) fn kernels_beyond(threads: u32, bytes: u32) -> Vec<(String, u32, u32)> {
        let all = COMPILED.lock().unwrap_or_else(PoisonError::into_inner);
        let of_each = all.iter().map(|(name, text)| {
            let module = naga::front::wgsl::parse_str(text)
                .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(text)));
            let (threads, bytes) = needs(&module);
            ((*name).to_owned(), threads, bytes)
        });
        of_each
            .filter(|(_, t, b)| *t > threads || *b > bytes)
            .collect()
    }
}
