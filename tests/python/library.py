"""Reads libraries of Linux, Windows and macOS: what they export and what they need."""

import hashlib
import struct

import lief

lief.logging.disable()

OLDEST_GLIBC = (2, 17)
OLDEST_MACOS = [11, 0, 0]
# what each system has: the C library and its parts, the unwinder, the loader
SYSTEM = {
    "libc.so.6",
    "libm.so.6",
    "libdl.so.2",
    "libpthread.so.0",
    "libgcc_s.so.1",
    "ld-linux-x86-64.so.2",
    "ld-linux-aarch64.so.1",
    "kernel32.dll",
    "ntdll.dll",
    "/usr/lib/libSystem.B.dylib",
}
# parts of Windows 10 and newer
WINDOWS = "api-ms-win-"
# the functions of FMI 2.0 and FMI 3.0, for co-simulation and Model Exchange
FUNCTIONS = {"fmi2": 44, "fmi3": 75}


def exports(binary):
    """Returns the functions of FMI and the other names that a library exports."""
    names = {function.name.removeprefix("_") for function in binary.exported_functions}
    functions = {name for name in names if name[:4] in FUNCTIONS}
    return functions, names - functions


def problems(path, portable=True):
    """Returns what is wrong with a library; `portable` also judges the oldest systems that it runs on."""
    binary = lief.parse(str(path))
    if isinstance(binary, lief.MachO.Binary):
        universal = lief.MachO.parse(str(path))
        found = [problem for one in universal for problem in _problems(one) + _of_macos(path, one)]
        processors = {one.header.cpu_type.name for one in universal}
        return found + ([f"is for {processors}"] if processors != {"X86_64", "ARM64"} else [])
    found = _problems(binary)
    if isinstance(binary, lief.ELF.Binary):
        # zig cannot leave out other names on Windows and macOS
        found += [f"exports {name}" for name in sorted(exports(binary)[1])]
        if portable:
            versions = [
                need.name.removeprefix("GLIBC_")
                for requirement in binary.symbols_version_requirement
                for need in requirement.get_auxiliary_symbols()
                if need.name.startswith("GLIBC_")
            ]
            newer = [text for text in versions if tuple(map(int, text.split(".")[:2])) > OLDEST_GLIBC]
            found += [f"needs glibc {text}" for text in newer]
    elif lief.PE.Debug.TYPES.REPRO not in {entry.type for entry in binary.debug}:
        # otherwise the time is a hash of the content
        found.append("has the time of its build")
    return found


def _problems(binary):
    needed = [str(getattr(library, "name", library)) for library in binary.libraries]
    found = [
        f"needs {name}"
        for name in needed
        if not (name in SYSTEM or name.lower() in SYSTEM or name.startswith((WINDOWS, "@rpath/")))
    ]
    functions, _ = exports(binary)
    for version, expected in FUNCTIONS.items():
        count = sum(name.startswith(version) for name in functions)
        if count != expected:
            found.append(f"exports {count} functions of {version}, expected {expected}")
    return found


def _of_macos(path, binary):
    found = []
    if list(binary.build_version.minos) > OLDEST_MACOS:
        found.append(f"needs macOS {binary.build_version.minos}")
    # Apple's own processors refuse code without a signature
    if binary.header.cpu_type.name == "ARM64" and not _is_signed(path, binary):
        found.append("has no valid signature")
    return found


def _is_signed(path, binary):
    """Compares the hashes of all pages with those of the code directory (`cs_blobs.h`)."""
    file = path.read_bytes()[binary.fat_offset :]
    start = binary.code_signature.data_offset
    (directory,) = struct.unpack_from(">I", file, start + 16)
    directory += start
    magic, hashes, count, end, size, page = (
        struct.unpack_from(">I", file, directory)[0],
        *(struct.unpack_from(">I", file, directory + at)[0] for at in (16, 28, 32)),
        *(file[directory + at] for at in (36, 39)),
    )
    pages = [file[at : min(at + (1 << page), end)] for at in range(0, end, 1 << page)]
    kept = [file[directory + hashes + size * index :][:size] for index in range(count)]
    return magic == 0xFADE0C02 and end == start and kept == [hashlib.sha256(one).digest() for one in pages]
