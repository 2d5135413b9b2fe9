"""Check that every block of C or C++ in a guide is in the program that it comes from, word by word.

usage: check_guide.py GUIDE.md PROGRAM
"""
import pathlib
import re
import sys

guide, program = (pathlib.Path(name).read_text() for name in sys.argv[1:])
blocks = re.findall(r"^```(?:c|cpp)\n(.*?)^```$", guide, re.MULTILINE | re.DOTALL)
if not blocks:
    sys.exit("the guide shows no code")
for block in blocks:
    if block not in program:
        sys.exit(f"{sys.argv[2]} does not have this:\n{block}")
