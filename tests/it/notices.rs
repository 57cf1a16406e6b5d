//! The notices inside the FMU name every crate in it.

use std::collections::BTreeSet;
use std::process::Command;

#[test]
fn every_linked_crate_is_named() {
    let root = crate::root();
    let output = Command::new(env!("CARGO"))
        .current_dir(root)
        .args(["tree", "--offline", "--locked", "--package", "rocking-wall"])
        .args([
            "--features",
            "fmu",
            "--edges",
            "normal,no-proc-macro",
            "--prefix",
            "none",
            "--format",
            "{p} {l}",
        ])
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let tree = String::from_utf8(output.stdout).unwrap();
    let crates: BTreeSet<_> = tree.lines().filter_map(|line| line.split_whitespace().next()).collect();
    let notices = root.join("modelDescription/documentation/licenses/notices.txt");
    let notices = std::fs::read_to_string(notices).unwrap();
    let named: BTreeSet<_> = notices.lines().filter_map(|line| line.split_whitespace().next()).collect();
    for name in &crates {
        let own = ["rocking-wall", "fmu-export", "ground-motion", "rocking-oscillator"].contains(name);
        assert!(own || named.contains(name), "notices.txt does not name {name}");
    }
    assert!(crates.contains("nalgebra"), "{crates:?}");
    for other in ["clap", "kuva", "argmin", "schemars", "rocking-study"] {
        assert!(!crates.contains(other), "the unit links {other}");
    }
}
