//! Compute pipelines, and what they are made of.

use super::{DeviceBuffer, Gpu};

/// A compute shader.
pub struct Source {
    /// What it does, for messages.
    pub name: &'static str,
    /// WGSL, with the entry point `main`.
    pub wgsl: &'static str,
    /// The variables that it binds, in the order of their bindings in group 0.
    pub bindings: &'static [&'static str],
}

/// A compute pipeline. Clones share it.
#[derive(Clone)]
pub struct Kernel {
    name: &'static str,
    pub(super) pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
    bindings: usize,
}

/// The buffers of one kernel, in the order of [`Source::bindings`].
pub struct Bindings(pub(super) wgpu::BindGroup);

impl Kernel {
    /// Compiles it, with these values for its overrides.
    pub fn new(gpu: &Gpu, source: &Source, constants: &[(&str, f64)]) -> Result<Self, String> {
        let what = format!("the shader `{}` cannot be compiled", source.name);
        let device = &gpu.device;
        gpu.checked(&what, || {
            let module = module(gpu, source);
            let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(source.name),
                layout: None,
                module: &module,
                entry_point: Some("main"),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants,
                    // Shaders set what they share themselves, with all threads of a workgroup.
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
        })
    }

    /// Binds buffers, one a binding.
    pub fn bind(&self, gpu: &Gpu, buffers: &[&DeviceBuffer]) -> Result<Bindings, String> {
        debug_assert_eq!(buffers.len(), self.bindings, "{}", self.name);
        let entries: Vec<_> = (0..)
            .zip(buffers)
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.raw().as_entire_binding(),
            })
            .collect();
        let descriptor = wgpu::BindGroupDescriptor {
            label: Some(self.name),
            layout: &self.layout,
            entries: &entries,
        };
        let group = gpu.checked(self.name, || gpu.device.create_bind_group(&descriptor))?;
        Ok(Bindings(group))
    }
}

/// Compiles a shader, without checks of every access while it runs: they cost a fifth of a frame
/// (docs/performance/gpu.md, 3).
#[allow(
    unsafe_code,
    reason = "wgpu trusts a shader only so: those of this crate bound every index by a count that they are \
              given or have found themselves, and every loop by such a count, and a test draws the same bits \
              with all checks"
)]
fn module(gpu: &Gpu, source: &Source) -> wgpu::ShaderModule {
    let descriptor = wgpu::ShaderModuleDescriptor {
        label: Some(source.name),
        source: wgpu::ShaderSource::Wgsl(source.wgsl.into()),
    };
    if gpu.options.has_checked_shaders {
        return gpu.device.create_shader_module(descriptor);
    }
    let unchecked = wgpu::ShaderRuntimeChecks::unchecked();
    // SAFETY: see above; shaders are constants of this crate, none comes from outside.
    unsafe {
        gpu.device
            .create_shader_module_trusted(descriptor, unchecked)
    }
}
