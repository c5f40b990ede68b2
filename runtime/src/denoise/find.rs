//! Where Open Image Denoise may be → names to load, in order. It loads nothing and runs nothing.

use std::path::{Path, PathBuf};

/// Names of the library, the one with its version first.
#[cfg(target_os = "macos")]
const NAMES: [&str; 2] = ["libOpenImageDenoise.2.dylib", "libOpenImageDenoise.dylib"];
#[cfg(target_os = "windows")]
const NAMES: [&str; 1] = ["OpenImageDenoise.dll"];
#[cfg(not(any(target_os = "macos", target_os = "windows")))]
const NAMES: [&str; 2] = ["libOpenImageDenoise.so.2", "libOpenImageDenoise.so"];

/// Folders of a release, and of a build, that hold it.
const FOLDERS: [&str; 4] = ["", "lib", "lib64", "bin"];

/// Names that the loader of the system knows where to look for.
pub(super) fn of_loader() -> impl Iterator<Item = PathBuf> {
    NAMES.iter().map(PathBuf::from)
}

/// The library that `path` is, or that the folder `path` holds: an absolute path, since loaders look for a plain name in
/// other places than the working folder.
pub(super) fn at(path: &Path) -> Option<PathBuf> {
    let path = std::path::absolute(path).ok()?;
    if path.is_file() {
        return Some(path);
    }
    let mut inside =
        FOLDERS.iter().flat_map(|folder| NAMES.map(|name| path.join(folder).join(name)));
    inside.find(|path| path.is_file())
}

/// The library in the wheel `pyoidn` that the first `python3` of `PATH` would import, found without starting it.
pub(super) fn of_wheel() -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    // What is relative would be another program in each folder.
    let folders = std::env::split_paths(&path).filter(|folder| folder.is_absolute());
    let programs = ["python3", "python3.exe", "python.exe"];
    let mut with_python =
        folders.filter(|folder| programs.iter().any(|p| folder.join(p).is_file()));
    let prefix = with_python.next()?;
    // On Windows it lies in the prefix itself, or in `Scripts`.
    let prefixes = [Some(prefix.as_path()), prefix.parent()];
    let home = std::env::var_os("HOME").map(|home| Path::new(&home).join(".local"));
    let prefixes = prefixes.into_iter().flatten().map(Path::to_owned).chain(home);
    prefixes
        .flat_map(|prefix| packages(&prefix))
        .find_map(|packages| at(&packages.join("pyoidn/oidn")))
}

/// Folders below `prefix` where Python packages are.
fn packages(prefix: &Path) -> Vec<PathBuf> {
    let mut found = vec![prefix.join("Lib/site-packages")];
    for lib in ["lib", "local/lib"] {
        let versions = std::fs::read_dir(prefix.join(lib)).into_iter().flatten().flatten();
        let is_python = |name: &std::ffi::OsStr| name.to_string_lossy().starts_with("python3");
        let versions = versions.filter(|entry| is_python(&entry.file_name()));
        let mut versions: Vec<PathBuf> = versions.map(|entry| entry.path()).collect();
        // The same order everywhere.
        versions.sort();
        let folders = ["site-packages", "dist-packages"];
        found
            .extend(versions.iter().flat_map(|version| folders.map(|folder| version.join(folder))));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn touch(path: &Path) {
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("it can be made");
        std::fs::write(path, "").expect("it can be written");
    }

    #[test]
    fn a_library_is_found_in_a_release_and_in_a_wheel() {
        let root = tempfile::tempdir().expect("a folder");
        let [release, prefix] = ["release", "venv"].map(|name| root.path().join(name));
        assert_eq!(at(&release), None);
        let library = release.join("lib").join(NAMES[0]);
        touch(&library);
        assert_eq!(at(&release), Some(library.clone()));
        assert_eq!(at(&library), Some(library.clone()));
        assert_eq!(at(&release.join("lib")), Some(library));
        let packages_of = prefix.join("lib/python3.11/site-packages");
        touch(&packages_of.join("pyoidn/oidn/lib").join(NAMES[0]));
        assert!(packages(&prefix).contains(&packages_of));
        assert!(at(&packages_of.join("pyoidn/oidn")).is_some());
    }
}
