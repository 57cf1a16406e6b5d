//! Python environments under the target folder, their packages pinned by hash.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::command::{Result, output, program, read, remove_folder, root, succeed, target, write};

/// Python as it is called.
const PYTHON: &str = if cfg!(windows) { "python" } else { "python3" };
/// What to do where it is missing.
const NEEDED: &str = "install Python 3.11 or newer with its venv module";
/// Name of the environment whose pip installs into the others.
const PIP: &str = "pip";
/// The folder of programs in an environment.
const PROGRAMS: &str = if cfg!(windows) { "Scripts" } else { "bin" };

/// A virtual environment with the packages of a lock file.
pub(crate) struct Environment {
    folder: PathBuf,
}

impl Environment {
    /// Returns the environment of a name, made again if its lock file or Python has changed.
    pub(crate) fn of(name: &str) -> Result<Self> {
        let environment = Self { folder: target().join("python").join(name) };
        // what tests need is locked beside them
        let lock = root().join(match name {
            "tests" => "tests/python/requirements.lock".to_owned(),
            "wheel" => "tests/wheel/requirements.lock".to_owned(),
            "bare" => "tests/wheel/bare.lock".to_owned(),
            other => format!("xtask/locks/{other}.lock"),
        });
        let wanted = output(program(PYTHON).arg("--version"), NEEDED)? + &read(&lock)?;
        let stamp = environment.folder.join("lock");
        if !read(&stamp).is_ok_and(|found| found == wanted) {
            environment.make(&lock)?;
            write(&stamp, wanted)?;
        }
        Ok(environment)
    }

    fn make(&self, lock: &Path) -> Result<()> {
        println!("installing the packages of {}", lock.display());
        remove_folder(&self.folder)?;
        // without a pip of its own, which takes longer to install than most packages
        venv(&["--without-pip"], &self.folder)?;
        let mut pip = if self.folder.ends_with(PIP) { self.first_install()? } else { self.pip_install()? };
        // the lock file lists every package that is installed; what it leaves out is not needed
        pip.args(["--no-compile", "--no-deps", "--require-hashes", "-r"]);
        succeed(pip.arg(lock), "check the network, then run the job again")
    }

    /// Prepares an installation into the environment by the pip that `pip.lock` pins; the pip of Python 3.11
    /// takes 1.7 times as long.
    pub(crate) fn pip_install(&self) -> Result<Command> {
        Ok(self.install_by(Self::of(PIP)?.program("python")))
    }

    /// Prepares the installation of the pinned pip: by Python's own pip if it can install into another
    /// environment, otherwise by the pip that `venv` installs.
    fn first_install(&self) -> Result<Command> {
        // `--help` loads all that an installation needs; a pip before 22.3 does not know `--python`
        if output(self.install_by(program(PYTHON)).arg("--help"), "").is_ok() {
            return Ok(self.install_by(program(PYTHON)));
        }
        let first = Self { folder: self.folder.with_file_name("first-pip") };
        remove_folder(&first.folder)?;
        venv(&[], &first.folder)?;
        Ok(self.install_by(first.program("python")))
    }

    /// Prepares an installation into the environment by the pip of a Python.
    fn install_by(&self, mut python: Command) -> Command {
        python.args(["-m", "pip", "--python"]).arg(&self.folder);
        python.args(["install", "--quiet", "--disable-pip-version-check"]);
        python
    }

    /// Prepares a program of the environment. Python keeps the bytecode of what it imports, even where the
    /// shell forbids it: the tests start a hundred programs, and each would compile its modules again. The
    /// bytecode stands under the target folder, not beside the sources.
    pub(crate) fn program(&self, name: &str) -> Command {
        let mut program = program(self.programs().join(name));
        program.env_remove("PYTHONDONTWRITEBYTECODE");
        program.env("PYTHONPYCACHEPREFIX", target().join("python").join("bytecode"));
        program
    }

    /// Returns the folder of an installed package.
    pub(crate) fn package(&self, name: &str) -> Result<PathBuf> {
        let code = format!("import {name}, os; print(list({name}.__path__)[0])");
        let remedy = "remove the target folder's python/ and run the job again";
        output(self.program("python").args(["-c", &code]), remedy).map(|path| PathBuf::from(path.trim()))
    }

    /// Returns the environment's folder of programs.
    pub(crate) fn programs(&self) -> PathBuf {
        self.folder.join(PROGRAMS)
    }
}

/// Makes a virtual environment.
fn venv(options: &[&str], folder: &Path) -> Result<()> {
    succeed(program(PYTHON).args(["-m", "venv"]).args(options).arg(folder), NEEDED)
}
