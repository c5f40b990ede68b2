//! The most memory that a build has beside its input: a process of its own for each, the same program under
//! another name, which asks the system.

use std::error::Error;
use std::fs;
use std::process::Command;

use compiler::bvh::{self, Input, Preset};

use crate::scene;

/// First argument of the process that builds; the second is the builder.
pub(crate) const CHILD: &str = "--peak";

/// In the process that builds: prints the bytes, or nothing where the system does not tell.
pub(crate) fn child(preset: &str) -> Result<Option<u64>, Box<dyn Error>> {
    let preset = Preset::ALL.into_iter().find(|known| known.to_string() == preset);
    let preset = preset.ok_or("no such builder")?;
    let triangles = scene::scene(true);
    // Forgets the peak so far; what is resident now is the scene.
    let reset = fs::write("/proc/self/clear_refs", "5").is_ok();
    let before = kilobytes("VmRSS:");
    let tree = bvh::build(preset, Input::of_triangles(&triangles))?;
    let peak = kilobytes("VmHWM:");
    assert!(tree.order.len() >= triangles.len(), "{preset} has lost triangles");
    let bytes = peak.zip(before).and_then(|(peak, before)| peak.checked_sub(before));
    Ok(bytes.filter(|_| reset).map(|kilobytes| kilobytes * 1024))
}

/// Peak bytes of the build with `preset`; `None` where the system does not tell.
pub(crate) fn of(preset: Preset) -> Result<Option<f64>, Box<dyn Error>> {
    let mut command = Command::new(std::env::current_exe()?);
    let output = command.args([CHILD, &preset.to_string()]).output()?;
    if !output.status.success() {
        return Err(format!("{preset}: {}", String::from_utf8_lossy(&output.stderr)).into());
    }
    Ok(String::from_utf8(output.stdout)?.trim().parse().ok())
}

fn kilobytes(what: &str) -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(what))?;
    line.split_whitespace().next()?.parse().ok()
}
