//! What `rtc` has to do again after an edit of the shrine: a table of CPU seconds.
//!
//! Every compilation runs in a process of its own, the calling program under another name, with a
//! cache of its own; that process says what it took. Nothing of the working tree is touched.

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use cpu_time::ProcessTime;

use crate::benchmarks::median;

/// First argument of the process that compiles.
pub const CHILD: &str = "rtc";

type Outcome<T> = Result<T, Box<dyn Error>>;

/// What an edit does to the folder of the scene.
type Edit = fn(&Path) -> Outcome<()>;

/// Name of each edit, and what `rtc` is told then; the first makes everything anew.
const EDITS: [(&str, &[&str], Edit); 15] = [
    ("everything (cold)", &[], |_| Ok(())),
    ("nothing", &[], |_| Ok(())),
    ("the camera", &[], |dir| {
        replace(&dir.join("shrine.rts"), "fov.vertical = 42deg", "fov.vertical = 43deg")
    }),
    ("the camera, again", &[], |dir| {
        replace(&dir.join("shrine.rts"), "fov.vertical = 43deg", "fov.vertical = 44deg")
    }),
    ("a material", &[], |dir| replace(&dir.join("parts/materials.rts"), "g = 0.7", "g = 0.6")),
    ("the place of instances: 16 shrubs", &[], |dir| {
        replace(&dir.join("shrine.rts"), "(0, 70 * i, 0)deg", "(0, 71 * i, 0)deg")
    }),
    ("the place of instances with lamps: 5 lanterns", &[], |dir| {
        replace(&dir.join("shrine.rts"), "(0, 15 + 37 * i, 0)deg", "(0, 16 + 37 * i, 0)deg")
    }),
    ("the place of a thing that stands there once: the bridge", &[], |dir| {
        replace(&dir.join("shrine.rts"), "at = (0, 0, 6.6)m", "at = (0, 0, 6.7)m")
    }),
    ("one instance more of a mesh that is stored once: a shrub", &[], |dir| {
        replace(&dir.join("shrine.rts"), "azalea[i in 0..16]", "azalea[i in 0..17]")
    }),
    ("a material of an imported model", &[], |dir| {
        // A name of the same length: the file is another, its geometry is not.
        replace_bytes(&dir.join("generated/hall.glb"), b"stand_in", b"stand_up")
    }),
    ("a vertex of one mesh", &[], |dir| nudge(&dir.join("generated/gate.glb"))),
    ("a parameter that turns the shrubs: `-D turn=0deg`", &["-D", "turn=0deg"], |dir| {
        let scene = dir.join("shrine.rts");
        replace(&scene, "param final", "param turn: angle = 0deg in -180deg..180deg\nparam final")?;
        replace(&scene, "(0, 71 * i, 0)deg", "(0deg, turn + 71deg * i, 0deg)")
    }),
    ("`-D turn=10deg`", &["-D", "turn=10deg"], |_| Ok(())),
    ("a model that is warned of", &["-D", "turn=10deg"], |dir| {
        // Of its two triangles one has no area.
        let model = "v 0 0 0\nv 0.01 0 0\nv 0 0.01 0\nv 0.02 0 0\nf 1 2 3\nf 1 2 4\n";
        std::fs::write(dir.join("generated/odd.obj"), model)?;
        let odd = "asset odd = obj(\"generated/odd.obj\", unit: m, up: +y)\n\
                   instance odd_one { shape = odd }\ninstance bridge";
        replace(&dir.join("shrine.rts"), "instance bridge", odd)
    }),
    ("the camera, with that warning", &["-D", "turn=10deg"], |dir| {
        replace(&dir.join("shrine.rts"), "fov.vertical = 44deg", "fov.vertical = 45deg")
    }),
];

/// In the process that compiles: runs `rtc` and says what it took. Returns the exit code.
#[must_use]
pub fn child(arguments: impl Iterator<Item = String>) -> u8 {
    let code = compiler::cli::run(std::iter::once(CHILD.to_owned()).chain(arguments));
    let cpu = ProcessTime::now().as_duration().as_secs_f64();
    crate::console::line(&format!("{cpu} {} {}", system_seconds(), peak()));
    code
}

/// CPU seconds of the system's work for this process, in steps of 10 ms; 0 where the system does not say.
fn system_seconds() -> f64 {
    /// Linux counts in hundredths of a second for programs, whatever it counts in itself.
    const TICK: f64 = 0.01;
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // The second field, the name of the program, may have spaces; `stime` is the 15th of all.
    let after_name = stat.rsplit_once(')').map_or("", |(_, rest)| rest);
    let ticks = after_name.split_whitespace().nth(12).and_then(|word| word.parse::<f64>().ok());
    ticks.unwrap_or(0.0) * TICK
}

/// Most memory that this process ever had, bytes; 0 where the system does not say.
pub(crate) fn peak() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let number = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
    number.unwrap_or(0) * 1024
}

/// One compilation.
pub(crate) struct Cost {
    /// CPU seconds, its own and the system's for it.
    pub(crate) cpu: f64,
    /// The system's part of them.
    system: f64,
    pub(crate) wall: f64,
    /// Most memory, bytes.
    pub(crate) peak: u64,
    /// The last line that `rtc` said.
    said: String,
}

/// The table, medians of `rounds`; what has to be written is written into `folder`.
///
/// # Errors
/// When a file cannot be written, an edit finds nothing to change, or `rtc` fails.
pub fn table(scenes: &Path, folder: &Path, rounds: usize, text: &mut String) -> Outcome<()> {
    let example = scenes::catalog::find("shrine").ok_or("the shrine exists")?;
    example.generate(scenes, scenes::generate::Extent::Full)?;
    let source = example.source(scenes);
    let from = source.parent().ok_or("a scene lies in a folder")?;
    let pack = folder.join("shrine.pack");
    let mut costs: [Vec<Cost>; EDITS.len()] = Default::default();
    for _ in 0..rounds {
        for (of_edit, cost) in costs.iter_mut().zip(round(from, folder, &pack)?) {
            of_edit.push(cost);
        }
    }
    rows(&costs, std::fs::metadata(&pack)?.len() as f64, text);
    Ok(())
}

/// One edit after the other, in a new copy of the scene in `from` and with an empty cache.
fn round(from: &Path, folder: &Path, pack: &Path) -> Outcome<Vec<Cost>> {
    let folder = tempfile::tempdir_in(folder)?;
    let dir = folder.path().join("shrine");
    copy(from, &dir)?;
    // What an earlier round has left would be taken over.
    let _ = std::fs::remove_file(pack);
    let compile_edited = |(_, arguments, edit): &(&str, &[&str], Edit)| {
        edit(&dir)?;
        compile_with(&dir.join("shrine.rts"), pack, folder.path(), arguments)
    };
    EDITS.iter().map(compile_edited).collect()
}

fn rows(costs: &[Vec<Cost>], size: f64, text: &mut String) {
    let _ = writeln!(
        text,
        "\n## Compiling again: `shrine`, a pack of {:.0} MB\n\n\
        Each row is one edit more, compiled in a process of its own; `rtc --watch` takes over more. System: the \
        part of the CPU seconds that the system takes. Before each a file of half a gigabyte is written and deleted: what \
        a virtual machine takes to get memory is not counted.\n\n\
        | what changed | CPU s | system | of cold | wall s | peak memory, packs | rtc says |\n\
        |---|---|---|---|---|---|---|",
        size / 1e6
    );
    let middle = |runs: &[Cost], of: fn(&Cost) -> f64| median(runs.iter().map(of));
    let cold = middle(&costs[0], |run| run.cpu);
    for ((name, ..), runs) in EDITS.iter().zip(costs) {
        let times: [fn(&Cost) -> f64; 3] = [|run| run.cpu, |run| run.system, |run| run.wall];
        let [cpu, system, wall] = times.map(|of| middle(runs, of));
        let packs = middle(runs, |run| run.peak as f64) / size;
        let (share, said) = (100.0 * cpu / cold, runs.last().map_or("", |run| run.said.as_str()));
        let _ = writeln!(
            text,
            "| {name} | {cpu:.2} | {system:.2} | {share:.1} % | {wall:.2} | {packs:.2} | {said} |"
        );
    }
}

/// One compilation in a process of its own, with the cache in `folder`.
pub(crate) fn compile(scene: &Path, pack: &Path, folder: &Path) -> Outcome<Cost> {
    compile_with(scene, pack, folder, &[])
}

/// As `compile`, with more arguments.
fn compile_with(scene: &Path, pack: &Path, folder: &Path, arguments: &[&str]) -> Outcome<Cost> {
    touch_memory(folder)?;
    let start = Instant::now();
    let output = Command::new(std::env::current_exe()?)
        .env("RTC_CACHE_DIR", folder.join("cache"))
        .arg(CHILD)
        .arg(scene)
        .arg("-o")
        .arg(pack)
        .args(arguments)
        .output()?;
    let wall = start.elapsed().as_secs_f64();
    let log = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        return Err(format!("rtc fails: {log}").into());
    }
    let out = String::from_utf8_lossy(&output.stdout);
    let numbers: Vec<&str> = out.split_whitespace().collect();
    let &[cpu, system, peak] = numbers.as_slice() else {
        return Err("the process says what it took".into());
    };
    let said = log.lines().rfind(|line| !line.is_empty()).unwrap_or_default();
    // Where the pack lies is no news.
    let said = said.rsplit('/').next().unwrap_or(said).to_owned();
    Ok(Cost { cpu: cpu.parse()?, system: system.parse()?, wall, peak: peak.parse()?, said })
}

/// Makes the machine have the memory for a pack in the system's cache, by writing a file and deleting it. Virtual
/// machines get memory when it is first touched and give it back when it is free for a while: a page costs
/// many times as much that way, by chance, which says nothing about what is measured.
fn touch_memory(folder: &Path) -> std::io::Result<()> {
    /// Three times the largest pack that is compiled.
    const BYTES: usize = 1 << 29;
    let path = folder.join("touched");
    std::fs::write(&path, vec![1; BYTES])?;
    std::fs::remove_file(path)
}

fn copy(from: &Path, to: &Path) -> std::io::Result<()> {
    std::fs::create_dir_all(to)?;
    for entry in std::fs::read_dir(from)? {
        let entry = entry?;
        let target = to.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            copy(&entry.path(), &target)?;
        } else {
            std::fs::copy(entry.path(), target)?;
        }
    }
    Ok(())
}

fn replace(path: &Path, from: &str, to: &str) -> Outcome<()> {
    let text = std::fs::read_to_string(path)?;
    if !text.contains(from) {
        return Err(format!("{} has no `{from}`", path.display()).into());
    }
    Ok(std::fs::write(path, text.replacen(from, to, 1))?)
}

/// Replaces the first bytes `from` of a file by as many others.
fn replace_bytes(path: &Path, from: &[u8], to: &[u8]) -> Outcome<()> {
    let mut bytes = std::fs::read(path)?;
    let at = bytes.windows(from.len()).position(|window| window == from);
    let at = at.ok_or_else(|| format!("{} has no such bytes", path.display()))?;
    bytes.get_mut(at..at + to.len()).ok_or("they are as many")?.copy_from_slice(to);
    Ok(std::fs::write(path, bytes)?)
}

/// Moves the second vertex of a GLB a little along y.
fn nudge(path: &Path) -> Outcome<()> {
    let mut bytes = std::fs::read(path)?;
    // A header of 12 bytes, a chunk of JSON and the head of the next chunk, of 8 bytes each.
    let json = bytes.get(12..16).and_then(|word| word.try_into().ok()).map(u32::from_le_bytes);
    let data = 12 + 8 + json.ok_or("a GLB has a header")? as usize + 8;
    // A bit in the middle of the number: the last one would be lost when the scene is normalised.
    let middle = bytes.get_mut(data + 12 + 4 + 1).ok_or("a GLB has vertices")?;
    *middle ^= 1 << 4;
    Ok(std::fs::write(path, bytes)?)
}
