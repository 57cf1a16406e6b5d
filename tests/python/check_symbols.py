"""Checks that a library runs on Linux machines as old as glibc 2.17: check_symbols.py LIBRARY."""

import re
import sys

from elftools.elf.dynamic import DynamicSection
from elftools.elf.elffile import ELFFile
from elftools.elf.gnuversions import GNUVerNeedSection

OLDEST_GLIBC = (2, 17)
# libc and its parts, the unwinder of gcc, the loader
ALLOWED = {"libc.so.6", "libm.so.6", "libdl.so.2", "libpthread.so.0", "libgcc_s.so.1", "ld-linux-x86-64.so.2"}


def read(path):
    """Returns the needed libraries, needed symbol versions and exported names of an ELF library."""
    with open(path, "rb") as file:
        elf = ELFFile(file)
        needed = {
            tag.needed
            for section in elf.iter_sections()
            if isinstance(section, DynamicSection)
            for tag in section.iter_tags("DT_NEEDED")
        }
        versions = {
            auxiliary.name
            for section in elf.iter_sections()
            if isinstance(section, GNUVerNeedSection)
            for _, auxiliaries in section.iter_versions()
            for auxiliary in auxiliaries
        }
        symbols = elf.get_section_by_name(".dynsym").iter_symbols()
        exported = {symbol.name for symbol in symbols if symbol["st_shndx"] != "SHN_UNDEF" and symbol.name}
    return needed, versions, exported


def problems(path, portable=True):
    needed, versions, exported = read(path)
    found = [f"needs {name}" for name in sorted(needed - ALLOWED)]
    found += [f"exports {name}" for name in sorted(exported) if not name.startswith("fmi2")]
    # co-simulation has 34 functions, Model Exchange adds 10
    expected = 44 if "fmi2GetDerivatives" in exported else 34
    if len(exported) != expected:
        found.append(f"exports {len(exported)} functions, expected {expected}")
    if portable:
        for version in sorted(versions):
            match = re.fullmatch(r"GLIBC_(\d+)\.(\d+)(\.\d+)?", version)
            if match and (int(match[1]), int(match[2])) > OLDEST_GLIBC:
                found.append(f"needs {version}, newer than GLIBC_{OLDEST_GLIBC[0]}.{OLDEST_GLIBC[1]}")
    return found


if __name__ == "__main__":
    faults = problems(sys.argv[1])
    for fault in faults:
        print(f"{sys.argv[1]}: {fault}")
    needed, versions, exported = read(sys.argv[1])
    print(
        f"{len(exported)} functions; versions {', '.join(sorted(versions))}; "
        f"needs {', '.join(sorted(needed))}"
    )
    sys.exit(bool(faults))
