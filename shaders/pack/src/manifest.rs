//! The manifest: names, source lines and counts for people; never needed to render.
//!
//! Turns a [`Manifest`] into bytes and back, with bincode, which no other module knows. Decoding
//! untrusted bytes never panics and never holds more than the limits below. No dates and no
//! absolute paths: the same scene gives the same bytes anywhere.

use serde::{Deserialize, Deserializer, Serialize, de};

use crate::error::PackError;
use crate::kind::MAX_META;

/// Most elements of one list, so that a list of empty names cannot grow far beyond its bytes.
pub const MAX_LIST: usize = 1 << 18;

/// What a pack says about where it came from.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Manifest {
    /// Name of the scene.
    pub scene: String,
    /// Version of the `rtc` that wrote the pack.
    pub rtc_version: String,
    /// Output that the scene asks for, as written there.
    pub output: Option<String>,
    /// Layers that the scene asks for, as written there.
    #[serde(deserialize_with = "list")]
    pub layers: Vec<String>,
    /// Source files and assets as the scene names them; `Named::file` is an index here.
    #[serde(deserialize_with = "list")]
    pub files: Vec<String>,
    /// Materials, same index as in the MATERIAL section.
    #[serde(deserialize_with = "list")]
    pub materials: Vec<Named>,
    /// Instances in the order of the scene. Their primitives are not a range: leaves mix them.
    #[serde(deserialize_with = "list")]
    pub instances: Vec<Named>,
    /// What each instance shows, same index.
    #[serde(deserialize_with = "list")]
    pub shown: Vec<Shown>,
    /// Textures, same index as in the TEXTURE section.
    #[serde(deserialize_with = "list")]
    pub textures: Vec<Named>,
    /// Lights as the scene declares them; one may stand for many emitters.
    #[serde(deserialize_with = "list")]
    pub lights: Vec<Named>,
    /// Light groups that the scene names, by name; what is in none of them has that of `REST` or `SKY`.
    #[serde(deserialize_with = "list")]
    pub groups: Vec<Group>,
    /// Cameras; the first is the one in the pack.
    #[serde(deserialize_with = "list")]
    pub cameras: Vec<Named>,
    /// Kernel features that are in, each with its reason.
    #[serde(deserialize_with = "list")]
    pub features_kept: Vec<Feature>,
    /// Kernel features that were left out, each with its reason.
    #[serde(deserialize_with = "list")]
    pub features_left_out: Vec<Feature>,
    /// How large the kernel is.
    pub kernel: KernelSize,
    /// Options of the compiler that can change the pack.
    #[serde(deserialize_with = "list")]
    pub options: Vec<String>,
    /// What was counted on the way: "vertices", "degenerate triangles dropped", "needles".
    #[serde(deserialize_with = "list")]
    pub counters: Vec<(String, u64)>,
}

/// A declaration of the scene.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Named {
    /// Its name.
    pub name: String,
    /// Index into [`Manifest::files`]; not checked, use [`Manifest::file`].
    pub file: u32,
    /// Line there, from 1; 0 when it has none.
    pub line: u32,
}

/// Light group of what is in no other.
pub const REST: &str = "rest";
/// Light group of a sky that names none.
pub const SKY: &str = "sky";

/// A light group.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Group {
    /// Its name.
    pub name: String,
    /// Whether the sky is in it.
    pub sky: bool,
    /// Objects of the pack that are in it, whether they emit or not: first and count of each run, ascending.
    #[serde(deserialize_with = "list")]
    pub objects: Vec<(u32, u32)>,
}

/// What an instance shows.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shown {
    /// The object whose shape it is; `None`: the shape is declared with the instance.
    pub object: Option<Named>,
    /// `sphere`, `rectangle`, `box` or `mesh`, and where the shape is written.
    pub shape: Named,
    /// The asset that a mesh is from.
    pub asset: Option<Named>,
    /// The part of it that is shown, as the scene names it; `None`: all of it.
    pub part: Option<String>,
}

/// A feature of the kernel, in it or left out.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Feature {
    /// As in [`crate::features::NAMES`], or a part of one of those.
    pub name: String,
    /// Why it is in, or why not.
    pub reason: String,
    /// The first declaration that needs it; of one that was left out, the declaration that might have.
    pub by: Option<Named>,
}

/// How large a kernel is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct KernelSize {
    /// Lines of its WGSL, see [`KernelSize::lines_of`].
    pub lines: u32,
    /// Words of four bytes of its SPIR-V, without names and without runtime checks.
    pub words: u32,
}

impl KernelSize {
    /// Lines of a linked text, without empty ones and without those that name the module of what follows.
    #[must_use]
    pub fn lines_of(wgsl: &str) -> u32 {
        let counts = |line: &&str| !line.trim().is_empty() && !line.starts_with("// ---- ");
        u32::try_from(wgsl.lines().filter(counts).count()).unwrap_or(u32::MAX)
    }
}

impl Manifest {
    /// What the number of an object in a pack stands for: objects are numbered as the instances of the scene, its
    /// lights after them. Names an instance or a light, and what the instance shows.
    #[must_use]
    pub fn object(&self, index: u32) -> Option<(&Named, Option<&Shown>)> {
        let index = index as usize;
        if let Some(instance) = self.instances.get(index) {
            return Some((instance, self.shown.get(index)));
        }
        // A list that was cut does not tell where lights begin.
        let light = index - self.instances.len();
        if self.instances.len() < MAX_LIST { Some((self.lights.get(light)?, None)) } else { None }
    }

    /// `file:line` of a declaration, if it has a place.
    #[must_use]
    pub fn place(&self, named: &Named) -> Option<String> {
        self.file(named.file).map(|file| format!("{file}:{}", named.line))
    }

    /// Display name of a file, if the index is one.
    #[must_use]
    pub fn file(&self, index: u32) -> Option<&str> {
        self.files.get(index as usize).map(String::as_str)
    }

    /// The bytes of the META section. Lists are cut after [`MAX_LIST`] elements; a counter
    /// "manifest entries left out" says how many.
    pub(crate) fn encode(&self) -> Result<Vec<u8>, PackError> {
        let mut manifest = self.clone();
        let left_out = manifest.cut();
        if left_out > 0 {
            manifest.counters.push(("manifest entries left out".to_owned(), left_out as u64));
        }
        let bytes = bincode::serde::encode_to_vec(&manifest, config())
            .map_err(|error| PackError::Manifest(error.to_string()))?;
        if bytes.len() > MAX_META {
            let text = format!("{} bytes, at most {MAX_META} are allowed", bytes.len());
            return Err(PackError::Manifest(text));
        }
        Ok(bytes)
    }

    /// Reads the bytes of a META section.
    pub(crate) fn decode(bytes: &[u8]) -> Result<Self, PackError> {
        let (manifest, used) = bincode::serde::decode_from_slice(bytes, config())
            .map_err(|error| PackError::Manifest(format!("not readable: {error}")))?;
        if used != bytes.len() {
            let text = format!("{} bytes follow the manifest", bytes.len() - used);
            return Err(PackError::Manifest(text));
        }
        Ok(manifest)
    }

    /// Cuts every list; returns how many elements went.
    fn cut(&mut self) -> usize {
        fn cut<T>(list: &mut Vec<T>, max: usize) -> usize {
            let gone = list.len().saturating_sub(max);
            list.truncate(max);
            gone
        }
        cut(&mut self.files, MAX_LIST)
            + cut(&mut self.materials, MAX_LIST)
            + cut(&mut self.instances, MAX_LIST)
            + cut(&mut self.shown, MAX_LIST)
            + cut(&mut self.textures, MAX_LIST)
            + cut(&mut self.lights, MAX_LIST)
            + cut(&mut self.groups, MAX_LIST)
            + self.groups.iter_mut().map(|group| cut(&mut group.objects, MAX_LIST)).sum::<usize>()
            + cut(&mut self.cameras, MAX_LIST)
            + cut(&mut self.features_kept, MAX_LIST)
            + cut(&mut self.features_left_out, MAX_LIST)
            + cut(&mut self.options, MAX_LIST)
            // One less: the counter of what was left out needs a place.
            + cut(&mut self.counters, MAX_LIST - 1)
    }
}

fn config() -> impl bincode::config::Config {
    bincode::config::standard().with_limit::<MAX_META>()
}

/// A list of at most [`MAX_LIST`] elements.
fn list<'de, D, T>(deserializer: D) -> Result<Vec<T>, D::Error>
where
    D: Deserializer<'de>,
    T: Deserialize<'de>,
{
    struct Visitor<T>(std::marker::PhantomData<T>);

    impl<'de, T: Deserialize<'de>> de::Visitor<'de> for Visitor<T> {
        type Value = Vec<T>;

        fn expecting(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            write!(out, "a list of at most {MAX_LIST} elements")
        }

        fn visit_seq<A: de::SeqAccess<'de>>(self, mut seq: A) -> Result<Vec<T>, A::Error> {
            // The length is a claim of the file: memory grows with what was really there.
            let mut list = Vec::new();
            while let Some(element) = seq.next_element()? {
                if list.len() == MAX_LIST {
                    return Err(de::Error::invalid_length(list.len() + 1, &self));
                }
                list.push(element);
            }
            Ok(list)
        }
    }

    deserializer.deserialize_seq(Visitor(std::marker::PhantomData))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example() -> Manifest {
        Manifest {
            scene: "bunny".to_owned(),
            layers: vec!["depth".to_owned()],
            output: Some("bunny.exr".to_owned()),
            groups: vec![Group { name: "key".to_owned(), sky: true, objects: vec![(3, 2)] }],
            files: vec!["bunny.rts".to_owned()],
            materials: vec![Named { name: "clay".to_owned(), file: 0, line: 7 }],
            features_kept: vec![Feature {
                name: "triangles".to_owned(),
                reason: "`bunny` is made of them".to_owned(),
                by: Some(Named { name: "bunny".to_owned(), file: 0, line: 9 }),
            }],
            kernel: KernelSize { lines: 1200, words: 34_567 },
            counters: vec![("vertices".to_owned(), u64::MAX)],
            ..Manifest::default()
        }
    }

    #[test]
    fn a_manifest_comes_back() {
        for manifest in [Manifest::default(), example()] {
            assert_eq!(Manifest::decode(&manifest.encode().unwrap()).unwrap(), manifest);
        }
    }

    #[test]
    fn lines_are_those_of_declarations() {
        assert_eq!(KernelSize::lines_of("// ---- a.wgsl\n// A.\nfn f() {\n\n}\n  \n"), 3);
    }

    #[test]
    fn every_truncation_is_an_error() {
        let bytes = example().encode().unwrap();
        for len in 0..bytes.len() {
            assert!(Manifest::decode(&bytes[..len]).is_err(), "{len} bytes");
        }
        let longer = [bytes, vec![0]].concat();
        let text = Manifest::decode(&longer).unwrap_err().to_string();
        assert_eq!(text, "META: 1 bytes follow the manifest");
    }

    #[test]
    fn claimed_lengths_are_not_believed() {
        // A length of 2^63 in bincode's variable-length integers: tag 253, then eight bytes.
        let huge = [&[253][..], &(1u64 << 63).to_le_bytes()].concat();
        let default = Manifest::default().encode().unwrap();
        for at in 0..default.len() {
            let bytes = [&default[..at], &huge, &default[at..]].concat();
            assert!(Manifest::decode(&bytes).is_err(), "at {at}");
        }
    }

    #[test]
    fn a_list_has_a_longest_length() {
        let mut manifest =
            Manifest { options: vec![String::new(); MAX_LIST + 3], ..Manifest::default() };
        let cut = Manifest::decode(&manifest.encode().unwrap()).unwrap();
        assert_eq!(cut.options.len(), MAX_LIST);
        assert_eq!(cut.counters, [("manifest entries left out".to_owned(), 3)]);
        // The same list without the cut, as a foreign writer might store it.
        manifest.options.truncate(MAX_LIST + 1);
        let bytes = bincode::serde::encode_to_vec(&manifest, config()).unwrap();
        assert!(Manifest::decode(&bytes).is_err());
    }

    #[test]
    fn a_manifest_beyond_the_limit_is_refused() {
        let manifest = Manifest { scene: "x".repeat(17 << 20), ..Manifest::default() };
        let text = manifest.encode().unwrap_err().to_string();
        assert!(text.starts_with("META: ") && text.contains("at most 16777216"), "{text}");
    }
}
