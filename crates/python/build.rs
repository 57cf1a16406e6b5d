//! States commit and profile for `rocking_wall.__version__`; lets macOS link the extension without Python.

fn main() {
    fmu_export_build::state_version();
    pyo3_build_config::add_extension_module_link_args();
}
