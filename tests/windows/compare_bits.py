"""Compares what denoised_bits has written on two systems, method by method.

    compare_bits.py EXPECTED FOLDER
"""
import pathlib
import struct
import sys


def halves(data):
    return struct.unpack(f"<{len(data) // 2}e", data)


def difference(expected, got):
    """Number of values that differ, and the largest difference as a fraction of the greater value."""
    pairs = [(a, b) for a, b in zip(halves(expected), halves(got)) if a != b]
    return len(pairs), max((abs(a - b) / max(abs(a), abs(b)) for a, b in pairs), default=0.0)


expected, folder = (pathlib.Path(name) for name in sys.argv[1:])
names = sorted(path.name for path in expected.iterdir())
if not names or names != sorted(path.name for path in folder.iterdir()):
    sys.exit(f"{expected} and {folder} do not hold the same methods")
differing = 0
for name in names:
    linux, windows = (base / name for base in (expected, folder))
    linux, windows = linux.read_bytes(), windows.read_bytes()
    if not any(linux):
        sys.exit(f"{name}: nothing was denoised")
    if linux == windows:
        print(f"{name}: all {len(linux) // 2} values have the same bits")
        continue
    differing += 1
    if len(linux) != len(windows):
        print(f"{name}: {len(linux)} and {len(windows)} bytes")
        continue
    count, most = difference(linux, windows)
    print(f"{name}: {count} of {len(linux) // 2} values differ, at most by {most:.2%}")
sys.exit(1 if differing else 0)
