//! How much memory there is for this process, as far as the system tells.
//!
//! Linux promises memory that it does not have and kills whoever uses it, so an allocation that succeeds says
//! nothing. It does say what is free: for the machine, for the group that a process is in, and of the memory that a
//! process may have (`ulimit -v`). Elsewhere nothing is known.

use crate::limit::room;

/// Bytes that this process can use without making others swap, and without being refused.
#[must_use]
pub fn free() -> Option<u64> {
    machine().into_iter().chain(room().map(|room| room.free)).min()
}

/// Bytes that the machine, or the group that this process is in, has left.
#[must_use]
pub fn machine() -> Option<u64> {
    let read = |path: &str| std::fs::read_to_string(path).ok();
    let machine = read("/proc/meminfo").and_then(|text| kilobytes(&text, "MemAvailable:"));
    let number = |path: &str| read(path)?.trim().parse::<u64>().ok();
    let limit = number("/sys/fs/cgroup/memory.max");
    let used = number("/sys/fs/cgroup/memory.current");
    let cache = read("/sys/fs/cgroup/memory.stat").map_or(0, |text| reclaimable(&text));
    let group =
        limit.zip(used).map(|(limit, used)| limit.saturating_sub(used.saturating_sub(cache)));
    machine.into_iter().chain(group).min()
}

/// Bytes of files that `memory.stat` counts as used, though they are given back when memory is short.
fn reclaimable(stat: &str) -> u64 {
    let counts = |name: &str| matches!(name, "active_file" | "inactive_file");
    let pairs = stat.lines().filter_map(|line| line.split_once(' '));
    let bytes =
        pairs.filter(|(name, _)| counts(name)).filter_map(|(_, n)| n.trim().parse::<u64>().ok());
    bytes.fold(0, u64::saturating_add)
}

/// The bytes that a line `NAME: 3 kB` says.
fn kilobytes(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn free_memory_is_read_where_it_is_told() {
        let available = |text: &str| kilobytes(text, "MemAvailable:");
        assert_eq!(available("MemTotal: 9 kB\nMemAvailable:   1024 kB\n"), Some(1 << 20));
        for text in
            ["", "MemAvailable: x kB", "MemAvailable: 3", "MemAvailable: 18446744073709551615 kB"]
        {
            assert_eq!(available(text), None, "{text}");
        }
        assert_eq!(reclaimable("anon 5\nfile 9\nactive_file 3\ninactive_file 4\nkernel x\n"), 7);
        if cfg!(target_os = "linux") {
            assert!(free().is_some_and(|bytes| bytes > 0));
        }
    }
}
