#!/usr/bin/env python3
"""Checks with abidiff that a structure with `struct_size` may grow at its end without breaking callers, and that changes
which do break them are found.

    check_abi.py CC STAGING HEADER...    exit code 77: abidiff is not installed

The ABI of a C library is what its headers declare, so libraries of empty functions stand for the real one: one is made from
the given headers and the others from changed copies of them. CApi.ExportsWhatItDeclares compares the headers with the real
library.
"""
import pathlib
import re
import shutil
import subprocess
import sys


SKIPPED = 77
# Exit codes of abidiff are bits: 1 and 2 mean that it was used wrongly, 4 that the ABI changes.
WRONG_USE = 3
FUNCTION = re.compile(r"WALR_API\s+([^;{]*?\([^;]*?\));")
STRUCTURE = re.compile(r"^\} (Walr\w+);", re.MULTILINE)
VERSIONED = re.compile(r"typedef struct (\w+) \{\n  uint32_t struct_size;.*?\n\} \1;", re.DOTALL)


def grow_at_end(text):
    return VERSIONED.sub(lambda match: match[0].replace(f"\n}} {match[1]};", f"\n  uint64_t later;\n}} {match[1]};"), text)


def grow_at_start(text):
    return VERSIONED.sub(lambda match: match[0].replace("struct_size;", "struct_size;\n  uint64_t later;"), text)


def replaced(old, new):
    def change(text):
        return text.replace(old, new)

    return change


# Changes that break callers: each must be found.
BREAKING = {
    "a field before the others": grow_at_start,
    "a longer structure without struct_size": replaced("} WalrCamera;", "  float later;\n} WalrCamera;"),
    "a function less": replaced("WALR_API WalrResult walr_reset_history(WalrDenoiser denoiser);", ""),
    "another parameter": replaced("walr_prepare(WalrDenoiser denoiser)", "walr_prepare(WalrDenoiser denoiser, int how)"),
    "another value of an enumerator": replaced("WALR_DEPTH_DEVICE = 2", "WALR_DEPTH_DEVICE = 3"),
}


def build(cc, folder, headers, change):
    """A library of empty functions with the declarations of changed headers."""
    (folder / "walr").mkdir(parents=True, exist_ok=True)
    source = ""
    for header in headers:
        text = change(header.read_text())
        (folder / "walr" / header.name).write_text(text)
        source += f"#include <walr/{header.name}>\n"
        source += "".join(f"{function} {{ return 0; }}\n" for function in FUNCTION.findall(text))
        # abidiff does not look for changes behind the pointers of a structure that may grow, so a function takes each.
        source += "".join(f"int takes_{name}(const {name}* it) {{ return it == 0; }}\n" for name in STRUCTURE.findall(text))
    (folder / "empty.c").write_text(source)
    library = folder / "libwalr.so"
    subprocess.run([cc, "-std=c11", "-g", "-shared", "-fPIC", f"-I{folder}", str(folder / "empty.c"), "-o", str(library)],
                   check=True)
    return library


def differ(suppressions, old, new):
    """The report of abidiff, empty if the ABI is compatible."""
    run = subprocess.run(["abidiff", "--suppressions", str(suppressions), str(old), str(new)], capture_output=True, text=True)
    if run.returncode & WRONG_USE:
        sys.exit(f"abidiff failed: {run.stdout}{run.stderr}")
    return run.stdout if run.returncode else ""


def main():
    cc, staging, headers = sys.argv[1], pathlib.Path(sys.argv[2]), [pathlib.Path(name) for name in sys.argv[3:]]
    if shutil.which("abidiff") is None:
        print("skipped: abidiff is not there (Debian package abigail-tools)")
        sys.exit(SKIPPED)
    shutil.rmtree(staging, ignore_errors=True)
    versioned = [name for header in headers for name in VERSIONED.findall(header.read_text())]
    if not versioned:
        sys.exit("no structure has struct_size")
    staging.mkdir(parents=True)
    suppressions = staging / "growth.ini"
    suppressions.write_text(f"[suppress_type]\n  type_kind = struct\n  name_regexp = ^({'|'.join(versioned)})$\n"
                            "  has_data_member_inserted_at = end\n"
                            # Newer versions of abidiff tell a structure's size apart from the member that makes it larger.
                            "  has_size_change = yes\n")
    today = build(cc, staging / "today", headers, lambda text: text)
    grown = build(cc, staging / "grown", headers, grow_at_end)
    report = differ(suppressions, today, grown)
    if report:
        sys.exit(f"callers break if structures grow at their ends:\n{report}")
    for what, change in BREAKING.items():
        broken = build(cc, staging / what.replace(" ", "_"), headers, change)
        if not differ(suppressions, today, broken):
            sys.exit(f"abidiff does not find {what}")
    print(f"{len(versioned)} structures may grow; {len(BREAKING)} changes that break callers are found")


if __name__ == "__main__":
    main()
