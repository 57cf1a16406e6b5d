//! Refuses an output that would overwrite an input or another output.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use run::file::{behind_links, folder};

use super::Console;

/// Returns the path behind all links that identifies a file, which need not exist; nothing for pipes and
/// devices, which any number of outputs may share.
fn identity(path: &Path) -> Option<PathBuf> {
    if let Ok(metadata) = std::fs::metadata(path) {
        return path.canonicalize().ok().filter(|_| metadata.is_file());
    }
    let path = behind_links(path);
    Some(folder(&path).canonicalize().ok()?.join(path.file_name()?))
}

/// Name of the output that goes to standard output.
pub(super) const STDOUT: &str = "-";

impl Console<'_> {
    /// Refuses outputs that would overwrite an input, another output or the file that takes stdout, and PDF.
    /// If one of them is `-`, all messages from here on go to stderr.
    pub(crate) fn check_distinct<'a>(
        &self,
        inputs: impl IntoIterator<Item = &'a PathBuf>,
        outputs: impl IntoIterator<Item = &'a PathBuf>,
    ) -> Result<()> {
        let stdout =
            identity(Path::new("/dev/stdout")).map(|identity| (identity, "standard output".to_owned()));
        let mut taken: Vec<_> = stdout.into_iter().collect();
        for path in inputs {
            taken.extend(identity(path).map(|identity| (identity, format!("the input {}", path.display()))));
        }
        let mut file = None;
        for path in outputs {
            if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("pdf")) {
                bail!(
                    "{}: no output is a PDF; give a page that ends in .html and print it from a browser, or \
                     a picture that ends in .svg",
                    path.display()
                );
            }
            if path.as_os_str() == STDOUT {
                if file.is_some() {
                    bail!("two outputs are -, standard output; give one of them a file");
                }
                file = Some(path);
                self.give_out_to_a_file();
                continue;
            }
            let Some(own) = identity(path) else { continue };
            if let Some((_, other)) = taken.iter().find(|(identity, _)| *identity == own) {
                bail!("{}: is the same file as {other}; give another for the output", path.display());
            }
            taken.push((own, format!("the output {}", path.display())));
        }
        Ok(())
    }
}
