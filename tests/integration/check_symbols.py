"""Check that a shared library exports exactly the functions that its headers declare.

usage: check_symbols.py NM LIBRARY HEADER...
"""
import pathlib
import re
import subprocess
import sys

nm, library, *headers = sys.argv[1:]
declared = set()
for header in headers:
    declared |= set(re.findall(r"^WALR_API [^;]*?\b(walr_\w+)\(", pathlib.Path(header).read_text(), re.MULTILINE))
listing = subprocess.run([nm, "--dynamic", "--defined-only", library], capture_output=True, text=True, check=True).stdout
exported = {line.split()[-1].split("@")[0] for line in listing.splitlines()}
if not declared or exported != declared:
    sys.exit(f"declared only: {sorted(declared - exported)}; exported only: {sorted(exported - declared)}")
