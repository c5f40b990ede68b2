//! Limits of this process (`ulimit -v`, `ulimit -d`) → bytes that it may still ask for.
//!
//! Only Linux tells; elsewhere nothing is known, and nothing is refused.

/// How much a limit leaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Room {
    /// The limit in bytes.
    pub limit: u64,
    /// What of it is not used, in bytes.
    pub free: u64,
}

/// What the tightest limit of this process leaves; `None` when there is none, or it is not known.
#[must_use]
pub fn room() -> Option<Room> {
    let read = |path: &str| std::fs::read_to_string(path).ok();
    tightest(&read("/proc/self/limits")?, &read("/proc/self/status")?)
}

fn tightest(limits: &str, status: &str) -> Option<Room> {
    let room = |limit: &str, used: &str| {
        let limit = limits.lines().find_map(|line| line.strip_prefix(limit))?;
        let limit: u64 = limit.split_whitespace().next()?.parse().ok()?;
        let used = status.lines().find_map(|line| line.strip_prefix(used))?;
        let used: u64 = used.trim().strip_suffix("kB")?.trim().parse().ok()?;
        Some(Room { limit, free: limit.saturating_sub(used.saturating_mul(1024)) })
    };
    let rooms = [room("Max address space", "VmSize:"), room("Max data size", "VmData:")];
    rooms.into_iter().flatten().min_by_key(|room| room.free)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tightest_limit_counts_and_none_is_none() {
        let limits = |space: &str, data: &str| {
            format!(
                "Limit                     Soft Limit           Hard Limit           Units     \n\
                 Max data size             {data}            unlimited            bytes     \n\
                 Max address space         {space}            unlimited            bytes     \n"
            )
        };
        let status = "Name:\trtr\nVmSize:\t    1000 kB\nVmData:\t     500 kB\n";
        let unlimited = "unlimited";
        assert_eq!(tightest(&limits(unlimited, unlimited), status), None);
        let space = Some(Room { limit: 4_096_000, free: 3_072_000 });
        assert_eq!(tightest(&limits("4096000", unlimited), status), space);
        assert_eq!(tightest(&limits("4096000", "9999999999"), status), space);
        let data = Some(Room { limit: 1_024_000, free: 512_000 });
        assert_eq!(tightest(&limits("4096000", "1024000"), status), data);
        assert_eq!(tightest(&limits("512", unlimited), status), Some(Room { limit: 512, free: 0 }));
        assert_eq!(tightest("", status), None);
        assert_eq!(tightest(&limits("4096000", unlimited), "VmSize: x kB"), None);
    }
}
