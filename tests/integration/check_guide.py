"""Check that every block of C or C++ in a guide is an exact excerpt of one of the programs.

usage: check_guide.py GUIDE.md PROGRAM...
"""
import pathlib
import re
import sys

guide, *programs = (pathlib.Path(name).read_text() for name in sys.argv[1:])
blocks = re.findall(r"^```(?:c|cpp)\n(.*?)^```$", guide, re.MULTILINE | re.DOTALL)
if not blocks:
    sys.exit("the guide shows no code")
for block in blocks:
    if not any(block in program for program in programs):
        sys.exit(f"none of {sys.argv[2:]} has this:\n{block}")
