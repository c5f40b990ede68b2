//! Which adapters this machine has, best first, and how they are called.

use wgpu::{AdapterInfo, Backends, DeviceType, InstanceDescriptor, InstanceFlags};

/// An adapter, with the instance that found it.
pub struct Adapter {
    pub(super) adapter: wgpu::Adapter,
    info: AdapterInfo,
}

impl Adapter {
    /// Its name alone.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.info.name
    }

    /// Name, kind, interface and driver in one line.
    #[must_use]
    pub fn describe(&self) -> String {
        describe(&self.info)
    }

    /// Whether it renders in software, on the CPU.
    #[must_use]
    pub fn is_software(&self) -> bool {
        self.info.device_type == DeviceType::Cpu
    }

    /// Whether `text` occurs in its name, whatever the case of the letters.
    #[must_use]
    pub fn matches(&self, text: &str) -> bool {
        self.info.name.to_lowercase().contains(&text.to_lowercase())
    }
}

/// Every adapter, best first: discrete, integrated, virtual, other, software.
#[must_use]
pub fn adapters() -> Vec<Adapter> {
    let mut descriptor = InstanceDescriptor::new_without_display_handle();
    descriptor.backends = Backends::PRIMARY;
    // Debug builds would otherwise compile shaders without optimisation on some interfaces.
    descriptor.flags = InstanceFlags::empty();
    let instance = wgpu::Instance::new(descriptor);
    let found = pollster::block_on(instance.enumerate_adapters(Backends::PRIMARY));
    let mut list: Vec<Adapter> =
        found.into_iter().map(|adapter| Adapter { info: adapter.get_info(), adapter }).collect();
    list.sort_by_key(|adapter| rank(adapter.info.device_type));
    list
}

fn rank(kind: DeviceType) -> u32 {
    match kind {
        DeviceType::DiscreteGpu => 0,
        DeviceType::IntegratedGpu => 1,
        DeviceType::VirtualGpu => 2,
        DeviceType::Other => 3,
        DeviceType::Cpu => 4,
    }
}

/// One line about an adapter.
#[must_use]
pub fn describe(info: &AdapterInfo) -> String {
    let kind = match info.device_type {
        DeviceType::DiscreteGpu => "discrete GPU",
        DeviceType::IntegratedGpu => "integrated GPU",
        DeviceType::VirtualGpu => "virtual GPU",
        DeviceType::Other => "other",
        DeviceType::Cpu => "software",
    };
    let driver = [&info.driver, &info.driver_info].map(|text| text.trim());
    let driver = driver.join(" ");
    let driver = if driver.trim().is_empty() { "unknown driver" } else { driver.trim() };
    format!("{} ({kind}, {}, {driver})", info.name, info.backend)
}
