//! Adapter + scene → a device with everything uploaded and the kernel compiled.

use super::adapter::Adapter;
use super::error::GpuError;
use super::record::Entry;
use super::stopwatch;
use super::upload::{Uploader, wait_at_most};
use crate::cpu::panic_text;
use crate::setup::{Setup, window_bytes};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};
use wgpu::{
    BindGroupLayout, BindGroupLayoutDescriptor, BindGroupLayoutEntry, BindingType, Buffer,
    BufferBindingType, ComputePipeline, ComputePipelineDescriptor, DeviceDescriptor, ErrorFilter,
    ErrorScopeGuard, Features, Limits, PipelineCompilationOptions, PipelineLayoutDescriptor,
    ShaderModuleDescriptor, ShaderRuntimeChecks, ShaderSource, ShaderStages, SubmissionIndex,
};

/// Window `w` of binding `b` is binding `b + 8 w`.
const WINDOW_STRIDE: u32 = 8;
/// How long a submission may take on a GPU, and on a software adapter: that has only the CPU to run on, optimises the
/// kernel with all features for minutes at the first workgroup, and cannot be lost as a GPU can.
const PATIENCE: [Duration; 2] = [Duration::from_mins(1), Duration::from_mins(15)];
/// The compiler of a large kernel recurses deeply.
const COMPILER_STACK: usize = 32 << 20;

/// How the kernel is compiled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Module {
    /// Without bounds checks and loop limits.
    Trusted,
    /// With them.
    Checked,
}

/// The first thing that went wrong outside of any scope.
#[derive(Clone, Default)]
pub(super) struct Fault(Arc<Mutex<Option<String>>>);

impl Fault {
    fn set(&self, text: String) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(text);
    }

    pub(super) fn get(&self) -> Option<String> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

/// A window of a section: where it is bound.
pub(super) struct Window {
    pub(super) binding: u32,
    pub(super) buffer: Buffer,
    pub(super) offset: u64,
    pub(super) size: u64,
}

/// A device that is ready to render one scene.
pub(super) struct Device {
    pub(super) gpu: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    pub(super) pipeline: ComputePipeline,
    pub(super) entry: Entry,
    pub(super) layout: BindGroupLayout,
    pub(super) windows: Vec<Window>,
    /// What building the pipeline took, with the first workgroup: drivers compile at the first dispatch.
    pub(super) built: Duration,
    /// After which a submission counts as lost.
    patience: Duration,
    /// Set when the device is lost.
    pub(super) lost: Fault,
    /// Set by an error that no scope caught.
    pub(super) uncaptured: Fault,
}

impl Device {
    /// Its kernel has not run yet, see `trial`. `timed`: whether to use the timestamps of an adapter that has them.
    pub(super) fn open(
        adapter: &Adapter,
        setup: &Setup<'_>,
        (module, entry): (Module, Entry),
        timed: bool,
    ) -> Result<Self, GpuError> {
        let limits = adapter.adapter.limits();
        let buffers = setup.buffers();
        check_limits(&limits, &buffers)?;
        let wanted = if timed { stopwatch::FEATURE } else { Features::empty() };
        let features = adapter.adapter.features() & wanted;
        let request = adapter.adapter.request_device(&DeviceDescriptor {
            label: Some("rtr"),
            required_limits: limits,
            required_features: features,
            ..DeviceDescriptor::default()
        });
        let (device, queue) =
            pollster::block_on(request).map_err(|error| GpuError::Device(error.to_string()))?;
        let (lost, uncaptured) = (Fault::default(), Fault::default());
        let fault = lost.clone();
        device.set_device_lost_callback(move |reason, text| {
            fault.set(format!("{reason:?}: {text}"));
        });
        let fault = uncaptured.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            fault.set(error.to_string());
        }));
        let windows = upload_all(&device, &queue, &buffers)?;
        let began = Instant::now();
        let checks = (module == Module::Trusted).then(ShaderRuntimeChecks::unchecked);
        let (layout, pipeline) = compile(&device, (setup.kernel(), entry), &windows, checks)?;
        let (gpu, built) = (device, began.elapsed());
        let patience = PATIENCE[usize::from(adapter.is_software())];
        Ok(Self { gpu, queue, pipeline, entry, layout, windows, built, patience, lost, uncaptured })
    }

    /// Waits for a submission.
    pub(super) fn wait(&self, index: SubmissionIndex) -> Result<(), GpuError> {
        wait_at_most(&self.gpu, index, self.patience)
    }

    /// What became of the device, if anything.
    pub(super) fn fault(&self) -> Result<(), GpuError> {
        let uncaptured = self.uncaptured.get();
        if uncaptured.is_some() {
            // Whatever fails on a lost device says that something is invalid; the loss itself is told
            // by a callback, which needs a poll.
            let _ = self.gpu.poll(wgpu::PollType::Poll);
        }
        if let Some(text) = self.lost.get() {
            return Err(GpuError::Lost(text));
        }
        uncaptured.map_or(Ok(()), |text| Err(GpuError::Api(text)))
    }
}

fn check_limits(limits: &Limits, buffers: &[(u32, &[u8])]) -> Result<(), GpuError> {
    let mut bindings = 1;
    for (binding, bytes) in buffers {
        let needed = bytes.len() as u64;
        if needed > limits.max_buffer_size {
            let available = limits.max_buffer_size;
            return Err(GpuError::Limit { what: "bytes in one buffer", needed, available });
        }
        let needed = needed.min(window_bytes(*binding));
        let available = limits.max_storage_buffer_binding_size;
        if needed > available {
            return Err(GpuError::Limit { what: "bytes in one binding", needed, available });
        }
        bindings += (bytes.len() as u64).div_ceil(window_bytes(*binding));
    }
    let available = u64::from(limits.max_storage_buffers_per_shader_stage);
    if bindings > available {
        return Err(GpuError::Limit { what: "storage buffers", needed: bindings, available });
    }
    Ok(())
}

fn upload_all(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    buffers: &[(u32, &[u8])],
) -> Result<Vec<Window>, GpuError> {
    let mut windows = Vec::new();
    let largest = buffers.iter().map(|(_, bytes)| bytes.len()).max().unwrap_or(0);
    let mut ring = Uploader::new(device, queue, largest);
    for &(binding, bytes) in buffers {
        let (memory, other) = scopes(device);
        let buffer = ring.upload(&format!("binding {binding}"), bytes);
        let (other, memory) = (pop(other), pop(memory));
        if let Some(error) = memory {
            return Err(GpuError::Memory(error));
        }
        if let Some(error) = other {
            return Err(GpuError::Api(error));
        }
        let buffer = buffer?;
        let (size, mut offset, mut window) = (bytes.len() as u64, 0, 0);
        while offset < size {
            let part = (size - offset).min(window_bytes(binding));
            let binding = binding + window * WINDOW_STRIDE;
            windows.push(Window { binding, buffer: buffer.clone(), offset, size: part });
            offset += part;
            window += 1;
        }
    }
    Ok(windows)
}

/// Scopes for memory (outer) and for everything that validation finds (inner).
fn scopes(device: &wgpu::Device) -> (ErrorScopeGuard, ErrorScopeGuard) {
    let memory = device.push_error_scope(ErrorFilter::OutOfMemory);
    (memory, device.push_error_scope(ErrorFilter::Validation))
}

fn pop(scope: ErrorScopeGuard) -> Option<String> {
    pollster::block_on(scope.pop()).map(|error| error.to_string())
}

/// Compiles the kernel, on a thread of its own: error scopes and deep stacks belong to threads, and
/// a panic of the shader compiler ends there.
fn compile(
    device: &wgpu::Device,
    kernel: (&str, Entry),
    windows: &[Window],
    checks: Option<ShaderRuntimeChecks>,
) -> Result<(BindGroupLayout, ComputePipeline), GpuError> {
    std::thread::scope(|scope| {
        std::thread::Builder::new()
            .name("rtr-compile".to_owned())
            .stack_size(COMPILER_STACK)
            .spawn_scoped(scope, || compile_here(device, kernel, windows, checks))
            .map_err(|error| GpuError::Device(error.to_string()))?
            .join()
            .unwrap_or_else(|panic| Err(GpuError::Kernel(panic_text(panic.as_ref()))))
    })
}

fn compile_here(
    device: &wgpu::Device,
    (kernel, entry): (&str, Entry),
    windows: &[Window],
    checks: Option<ShaderRuntimeChecks>,
) -> Result<(BindGroupLayout, ComputePipeline), GpuError> {
    let internal = device.push_error_scope(ErrorFilter::Internal);
    let (memory, validation) = scopes(device);
    let source = ShaderSource::Wgsl(kernel.into());
    let descriptor = ShaderModuleDescriptor { label: Some("kernel"), source };
    let module = create_module(device, descriptor, checks);
    let layout = device.create_bind_group_layout(&BindGroupLayoutDescriptor {
        label: Some("scene"),
        entries: &layout_entries(windows),
    });
    let pipeline_layout = device.create_pipeline_layout(&PipelineLayoutDescriptor {
        label: Some("scene"),
        bind_group_layouts: &[Some(&layout)],
        immediate_size: 0,
    });
    let pipeline = device.create_compute_pipeline(&ComputePipelineDescriptor {
        label: Some(entry.name()),
        layout: Some(&pipeline_layout),
        module: &module,
        entry_point: Some(entry.name()),
        compilation_options: PipelineCompilationOptions::default(),
        cache: None,
    });
    let errors = [pop(validation), pop(memory), pop(internal)];
    match errors.into_iter().flatten().next() {
        Some(error) => Err(GpuError::Kernel(error)),
        None => Ok((layout, pipeline)),
    }
}

fn create_module(
    device: &wgpu::Device,
    descriptor: ShaderModuleDescriptor<'_>,
    checks: Option<ShaderRuntimeChecks>,
) -> wgpu::ShaderModule {
    match checks {
        None => device.create_shader_module(descriptor),
        // SAFETY: without the checks a shader must not index outside of its buffers and arrays, loop
        // for ever or divide integers by zero. A module is trusted only when `trust::judge` found
        // that every declaration in it is our own and the one made for the features of this pack, or when
        // `trust` itself put it together from those declarations for more features, code that no record
        // of the pack asks for (as on the CPU, where that kernel renders every pack with checks); so
        // the code is what was reviewed and tested here; and only for a `Pack<Checked>`, whose rules
        // are what that code relies on: every index of every table lies inside the table it points
        // into, children come after their parents (traversal ends), leaf ranges lie inside, and the
        // traversal stack is at least as long as the checked tree needs. The table offsets in `Frame`
        // come from the same pack, readers expect as many windows as are bound, and the film buffer
        // has the records that the entry point writes of the dispatched tile.
        #[expect(unsafe_code, reason = "checks cost up to half of the speed; see the proof above")]
        Some(checks) => unsafe { device.create_shader_module_trusted(descriptor, checks) },
    }
}

fn layout_entries(windows: &[Window]) -> Vec<BindGroupLayoutEntry> {
    let entry = |binding, ty| BindGroupLayoutEntry {
        binding,
        visibility: ShaderStages::COMPUTE,
        ty: BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
        count: None,
    };
    let read_only = BufferBindingType::Storage { read_only: true };
    let film = BufferBindingType::Storage { read_only: false };
    let mut entries = vec![entry(0, BufferBindingType::Uniform), entry(1, film)];
    entries.extend(windows.iter().map(|window| entry(window.binding, read_only)));
    entries
}
