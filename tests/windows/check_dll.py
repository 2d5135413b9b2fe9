"""Checks that a DLL exports exactly the functions that its headers declare, and needs no DLL but Windows' own.

    check_dll.py OBJDUMP PATTERN_OF_DLL HEADER...
"""
import glob
import pathlib
import re
import subprocess
import sys

# Parts of every Windows. MinGW's own, libstdc++-6.dll, libgcc_s_seh-1.dll and libwinpthread-1.dll, are not.
WINDOWS = {"kernel32.dll", "msvcrt.dll"}

objdump, pattern, *headers = sys.argv[1:]
(library,) = glob.glob(pattern)
listing = subprocess.run([objdump, "-p", library], capture_output=True, text=True, check=True).stdout
needed = {name.lower() for name in re.findall(r"DLL Name: (\S+)", listing)}
if not needed or not needed <= WINDOWS:
    sys.exit(f"{library} needs {sorted(needed)}, but may need {sorted(WINDOWS)} only")
declared = set()
for header in headers:
    declared |= set(re.findall(r"^WALR_API [^;]*?\b(walr_\w+)\(", pathlib.Path(header).read_text(), re.MULTILINE))
table = listing.partition("[Ordinal/Name Pointer] Table")[2]
exported = set(re.findall(r"^\s*\[ *\d+\] (?:\+base\[ *\d+\] +[0-9a-f]+ )?(\w+)$", table, re.MULTILINE))
if not declared or exported != declared:
    sys.exit(f"declared only: {sorted(declared - exported)}; exported only: {sorted(exported - declared)}")
