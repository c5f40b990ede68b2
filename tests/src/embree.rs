//! Trees and rays of Embree 3, beside which ours are measured.
//!
//! Turns triangles, spheres and rays into files, has `tests/peers/embree.cpp` build and trace them, and reads what it
//! found and how many CPU seconds that took. The program says what the files look like. It measures nothing of ours.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use tempfile::TempDir;

/// The corners of a triangle.
pub type Triangle = [[f32; 3]; 3];

/// Where the program is.
const SOURCE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/peers/embree.cpp");

/// Distances that differ by less, relative, are of the same hit.
pub const SAME_HIT: f32 = 1e-3;

/// Whether `there`, a distance or −1 as Embree gives it, is the hit at our distance, or a miss like ours.
#[must_use]
pub fn is_same_hit(ours: Option<f32>, there: f32) -> bool {
    ours.map_or(there < 0.0, |t| (there - t).abs() <= t * SAME_HIT)
}

/// Its trees, and how it walks them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quality {
    /// Binned surface-area heuristic.
    Medium,
    /// With spatial splits.
    High,
    /// The same, and rays slip through no edge.
    Robust,
}

impl Quality {
    /// What the program calls it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Medium => "medium",
            Self::High => "high",
            Self::Robust => "robust",
        }
    }
}

/// What a ray asks.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Where it starts.
    pub origin: [f32; 3],
    /// Nothing before this distance is hit.
    pub t_min: f32,
    /// Where to.
    pub dir: [f32; 3],
    /// Nothing beyond this distance is hit.
    pub t_max: f32,
    /// Any hit will do, and not only the nearest.
    pub any: bool,
}

impl Ray {
    /// For the nearest hit, however far.
    #[must_use]
    pub fn nearest(origin: [f32; 3], dir: [f32; 3]) -> Self {
        Self { origin, t_min: 0.0, dir, t_max: f32::INFINITY, any: false }
    }

    fn words(&self) -> [u32; 9] {
        let [[x, y, z], [dx, dy, dz]] = [self.origin, self.dir];
        let [a, b, c, d, e, f, g, h] =
            [x, y, z, self.t_min, dx, dy, dz, self.t_max].map(f32::to_bits);
        [a, b, c, d, e, f, g, h, u32::from(self.any)]
    }
}

/// The program, compiled.
#[derive(Debug)]
pub struct Embree {
    folder: TempDir,
}

/// A scene that it knows.
#[derive(Debug)]
pub struct Scene<'a> {
    embree: &'a Embree,
    file: PathBuf,
}

impl Embree {
    /// Compiles it.
    ///
    /// # Errors
    /// When there is no C++ compiler or no Embree 3.
    pub fn compile() -> Result<Self, Box<dyn Error>> {
        let embree = Self { folder: tempfile::tempdir()? };
        let mut compiler = Command::new("c++");
        compiler.args(["-std=c++17", "-O3", "-march=native", "-Wall", "-Wextra", SOURCE, "-o"]);
        let output = compiler.arg(embree.program()).arg("-lembree3").output();
        let output = output.map_err(|error| format!("c++ cannot be started: {error}"))?;
        if !output.status.success() {
            let said = String::from_utf8_lossy(&output.stderr);
            return Err(format!("this needs a C++ compiler and libembree-dev 3: {said}").into());
        }
        Ok(embree)
    }

    /// Writes a scene; it takes the place of the one before.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn scene(
        &self,
        triangles: &[Triangle],
        spheres: &[[f32; 4]],
    ) -> std::io::Result<Scene<'_>> {
        let mut bytes = (triangles.len() as u64).to_le_bytes().to_vec();
        let corners = triangles.as_flattened().as_flattened();
        bytes.extend(corners.iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend((spheres.len() as u64).to_le_bytes());
        bytes.extend(spheres.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        let file = self.file("scene");
        fs::write(&file, bytes)?;
        Ok(Scene { embree: self, file })
    }

    fn program(&self) -> PathBuf {
        self.file("embree")
    }

    fn file(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The CPU seconds that the program says it took.
    fn run(&self, task: &str, quality: Quality, files: &[&Path]) -> Result<f64, Box<dyn Error>> {
        let mut command = Command::new(self.program());
        let output = command.args([task, quality.name()]).args(files).output()?;
        if !output.status.success() {
            return Err(String::from_utf8_lossy(&output.stderr).into());
        }
        let said = String::from_utf8(output.stdout)?;
        let seconds = said.strip_prefix("cpu ").and_then(|rest| rest.trim().parse().ok());
        Ok(seconds.ok_or("the program says no time")?)
    }
}

impl Scene<'_> {
    /// Builds a binary tree over the triangles: CPU seconds, and the bytes of the tree.
    ///
    /// # Errors
    /// When the program fails.
    pub fn build(&self, quality: Quality) -> Result<(f64, Vec<u8>), Box<dyn Error>> {
        let tree = self.embree.file("tree");
        let cpu = self.embree.run("build", quality, &[&self.file, &tree])?;
        Ok((cpu, fs::read(&tree)?))
    }

    /// Traces rays: CPU seconds without those of the build, and for each ray the distance of its hit, or −1. If any hit
    /// will do, the distance is 0.
    ///
    /// # Errors
    /// When the program fails.
    pub fn trace(&self, quality: Quality, rays: &[Ray]) -> Result<(f64, Vec<f32>), Box<dyn Error>> {
        let [asked, hits] = ["rays", "hits"].map(|name| self.embree.file(name));
        let mut bytes = (rays.len() as u64).to_le_bytes().to_vec();
        bytes.extend(rays.iter().flat_map(Ray::words).flat_map(u32::to_le_bytes));
        fs::write(&asked, bytes)?;
        let cpu = self.embree.run("trace", quality, &[&self.file, &asked, &hits])?;
        let bytes = fs::read(&hits)?;
        let numbers = bytes.get(8..).ok_or("the program wrote no hits")?.as_chunks::<4>().0;
        Ok((cpu, numbers.iter().map(|four| f32::from_le_bytes(*four)).collect()))
    }
}
