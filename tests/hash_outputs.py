#!/usr/bin/env python3
"""Prints one SHA-256 of the denoised frames per sequence, method and preset: equal hashes mean bit-identical images.

    hash_outputs.py WALR SEQUENCE... [--frames A-B] [--methods LIST]

Run it with two builds on one machine and compare the output. Hashes of two machines may differ, because rounding
depends on the device and its driver.
"""
import argparse
import hashlib
import pathlib
import subprocess
import sys
import tempfile

METHODS = ("walr,walr_paper,walr_paper:robust,refwlr,refwlr:paper,bmfr,bmfr:paper,svgf,svgf:paper,flr,flnr,"
           "flnr:paper,joint_bilateral,accumulate,none")


def denoised_hash(walr, sequence, frames, method, preset, output):
    command = [walr, "denoise", sequence, "--output", output, "--method", method, "--frames", frames]
    if preset:
        command += ["--preset", preset]
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} failed:\n{run.stderr}")
    images = sorted(pathlib.Path(output).glob("denoised_*.exr"))
    if not images:
        sys.exit(f"{method} wrote no image of {sequence}")
    digest = hashlib.sha256()
    for image in images:
        digest.update(image.name.encode() + image.read_bytes())
    return digest.hexdigest()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("walr", help="the program walr")
    parser.add_argument("sequences", nargs="+", help="folders of frames")
    parser.add_argument("--frames", default="0-7", help="frames of each sequence (default: %(default)s)")
    parser.add_argument("--methods", default=METHODS, help="METHOD or METHOD:PRESET, separated by commas")
    options = parser.parse_args()
    for sequence in options.sequences:
        for variant in options.methods.split(","):
            method, _, preset = variant.partition(":")
            with tempfile.TemporaryDirectory() as output:
                digest = denoised_hash(options.walr, sequence, options.frames, method, preset, output)
            print(f"{pathlib.Path(sequence).resolve().name:20} {variant:20} {digest}", flush=True)


if __name__ == "__main__":
    main()
