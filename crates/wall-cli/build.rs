//! States commit and profile for `wall --version`.

fn main() {
    fmu_export_build::state_version();
}
