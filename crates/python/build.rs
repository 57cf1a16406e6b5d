//! States commit and profile for `rocking_wall.__version__`.

fn main() {
    fmu_export_build::state_version();
}
