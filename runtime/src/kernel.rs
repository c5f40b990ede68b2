//! The kernel as Rust: what was generated from the full WGSL, in two precisions, the tree that CPUs walk, and rays
//! through it.

pub use kernel_f32::kernel as f32;
pub use kernel_f32::walk;
pub use kernel_f64::kernel as f64;

/// What `rays` hit, one after another on this thread: as pictures trace a ray that has no others beside it, with the
/// widest instructions that the processor has. The bits are those of the kernel's `trace`.
#[must_use]
pub fn trace_each(kernel: &mut f32::Kernel<'_>, rays: &[f32::Ray]) -> Vec<f32::Hit> {
    #[cfg(target_arch = "x86_64")]
    if let Some(wide) = crate::wide::Wide::of_processor(u32::MAX) {
        return wide.trace(kernel, rays);
    }
    rays.iter().map(|ray| kernel.trace(*ray)).collect()
}
