//! Files, written completely or not at all.

use std::ffi::OsString;
use std::fs::{File, OpenOptions, Permissions};
use std::hash::{BuildHasher, RandomState};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};

/// Most links that lead from one to the next.
const MOST_LINKS: usize = 40;

/// Writes a file completely or not at all, and waits until the disk has it. A link stays and its target is
/// written, an existing file keeps its permissions, and a pipe or a device is written to.
pub(crate) fn to_file(path: &Path, content: &[u8]) -> Result<()> {
    write(path, content, true).with_context(|| format!("{}: cannot be written", path.display()))
}

/// Writes a file like [`to_file`] without waiting for the disk: after a power failure its content may be
/// damaged.
pub(crate) fn to_file_unsynced(path: &Path, content: &[u8]) -> Result<()> {
    write(path, content, false).with_context(|| format!("{}: cannot be written", path.display()))
}

fn write(path: &Path, content: &[u8], sync: bool) -> io::Result<()> {
    // whether the file may be written, and what it is
    let permissions = match OpenOptions::new().write(true).open(path) {
        Ok(mut existing) => {
            let metadata = existing.metadata()?;
            if !metadata.is_file() {
                return existing.write_all(content);
            }
            Some(metadata.permissions())
        }
        Err(error) if error.kind() == ErrorKind::NotFound => None,
        Err(error) => return Err(error),
    };
    let path = behind_links(path);
    // unique, also among processes with the same number on other machines
    let own = RandomState::new().hash_one(std::process::id());
    let part = folder(&path).join(format!(".{own:016x}.part"));
    let written = write_part(&part, content, permissions, sync).and_then(|()| std::fs::rename(&part, &path));
    if written.is_err() {
        // the first error is the one to report; there may be nothing to remove
        let _ = std::fs::remove_file(&part);
    }
    #[cfg(unix)]
    if sync && written.is_ok() {
        // the new name; not every file system can
        let _ = File::open(folder(&path)).and_then(|folder| folder.sync_all());
    }
    written
}

fn write_part(part: &Path, content: &[u8], permissions: Option<Permissions>, sync: bool) -> io::Result<()> {
    let mut file = File::create_new(part)?;
    file.write_all(content)?;
    if let Some(permissions) = permissions {
        file.set_permissions(permissions)?;
    }
    if sync { file.sync_all() } else { Ok(()) }
}

/// Returns the folder of a file.
fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Follows the links at a path to a file, which need not exist.
fn behind_links(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        match path.read_link() {
            Ok(target) => path = folder(&path).join(target),
            Err(_) => break,
        }
    }
    path
}

/// What makes two paths one file: its device and number, or else its canonical path; of a file that does not
/// exist yet, those of its folder and its name.
type Identity = (FileKey, Option<OsString>);

#[cfg(unix)]
type FileKey = (u64, u64);
#[cfg(not(unix))]
type FileKey = PathBuf;

#[cfg(unix)]
fn key(path: &Path) -> Option<FileKey> {
    use std::os::unix::fs::MetadataExt;
    std::fs::metadata(path).ok().map(|metadata| (metadata.dev(), metadata.ino()))
}

#[cfg(not(unix))]
fn key(path: &Path) -> Option<FileKey> {
    path.canonicalize().ok()
}

/// Returns nothing for pipes and devices, which any number of outputs may share.
fn identity(path: &Path) -> Option<Identity> {
    if let Ok(metadata) = std::fs::metadata(path) {
        return if metadata.is_file() { Some((key(path)?, None)) } else { None };
    }
    let path = behind_links(path);
    Some((key(folder(&path))?, path.file_name().map(OsString::from)))
}

/// Refuses outputs that would overwrite an input, another output or the file that takes stdout.
pub(crate) fn check_distinct<'a>(
    inputs: impl IntoIterator<Item = &'a PathBuf>,
    outputs: impl IntoIterator<Item = &'a PathBuf>,
) -> Result<()> {
    let stdout = identity(Path::new("/dev/stdout")).map(|identity| (identity, "standard output".to_owned()));
    let mut taken: Vec<_> = stdout.into_iter().collect();
    for path in inputs {
        taken.extend(identity(path).map(|identity| (identity, format!("the input {}", path.display()))));
    }
    for path in outputs {
        let Some(own) = identity(path) else { continue };
        if let Some((_, other)) = taken.iter().find(|(identity, _)| *identity == own) {
            bail!("{}: is the same file as {other}; give another for the output", path.display());
        }
        taken.push((own, format!("the output {}", path.display())));
    }
    Ok(())
}
