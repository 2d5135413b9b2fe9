"""Check that all packages have the version of CMakeLists.txt.

usage: check_packages.py PROJECT_FOLDER
"""
import json
import pathlib
import re
import sys

folder = pathlib.Path(sys.argv[1])
version = re.search(r"project\(walr VERSION (\S+)", (folder / "CMakeLists.txt").read_text()).group(1)
packages = folder / "integration" / "packages"
found = {
    "CHANGELOG.md": re.search(r"^## (\S+?),", (folder / "CHANGELOG.md").read_text(), re.MULTILINE).group(1),
    "vcpkg.json": json.loads((packages / "vcpkg" / "walr" / "vcpkg.json").read_text())["version-semver"],
}
wrong = {name: said for name, said in found.items() if said != version}
if wrong:
    sys.exit(f"the version is {version}, but {wrong}")

# The options that the recipes set must exist in the project.
options = set(re.findall(r"option\((WALR_\w+)", (folder / "CMakeLists.txt").read_text()))
recipes = [packages / "vcpkg" / "walr" / "portfile.cmake", packages / "conan" / "conanfile.py"]
for recipe in recipes:
    text = recipe.read_text()
    unknown = set(re.findall(r"WALR_\w+", text)) - options
    if unknown:
        sys.exit(f"{recipe}: there is no option {unknown}")
compile(recipes[1].read_text(), recipes[1], "exec")
