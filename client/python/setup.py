"""Adds to the package what protoc makes of the wire contract; all else is in pyproject.toml.

Needed on the PATH: protoc (3.20 or later) and gRPC's grpc_python_plugin; on Debian the packages
protobuf-compiler and protobuf-compiler-grpc. The contract is proto/ of the repository, of which a
source distribution carries a copy.
"""
import pathlib
import shutil
import subprocess

from setuptools import setup
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

HERE = pathlib.Path(__file__).resolve().parent
PROTO_FOLDERS = ("capfit/v1", "google/rpc")


def proto_root() -> pathlib.Path:
    """The contract: beside this file in a source distribution, else in the repository."""
    return HERE / "proto" if (HERE / "proto").is_dir() else HERE.parents[1] / "proto"


def program(name: str, package: str) -> str:
    """The path of a program; ends the build where it is missing."""
    path = shutil.which(name)
    if path is None:
        raise SystemExit(f"capfit needs {name} to be built: install {package} (Debian's name)")
    return path


def generate(target: pathlib.Path) -> None:
    """Writes the modules capfit.v1 and the descriptors of google.rpc's error details."""
    root = proto_root()
    protoc = program("protoc", "protobuf-compiler")
    plugin = program("grpc_python_plugin", "protobuf-compiler-grpc")
    contract = sorted(str(path) for path in (root / "capfit/v1").glob("*.proto"))
    target.mkdir(parents=True, exist_ok=True)
    call = [protoc, f"-I{root}", f"--python_out={target}", f"--pyi_out={target}"]
    subprocess.run(call + contract, check=True)
    call = [protoc, f"-I{root}", f"--plugin=protoc-gen-grpc={plugin}", f"--grpc_out={target}"]
    subprocess.run(call + [str(root / "capfit/v1/service.proto")], check=True)
    # Not as modules: another package may bring its own google.rpc (see capfit/errors.py).
    details = [str(root / "google/rpc" / name) for name in ("status.proto", "error_details.proto")]
    output = f"--descriptor_set_out={target / 'capfit/error_details.binpb'}"
    subprocess.run([protoc, f"-I{root}", "--include_imports", output] + details, check=True)
    (target / "capfit/v1/__init__.py").write_text('"""The wire contract, generated."""\n')


class BuildWithContract(build_py):
    """Generates into the build folder, for `pip install -e` beside the sources."""

    def run(self) -> None:
        super().run()
        generate(HERE if getattr(self, "editable_mode", False) else pathlib.Path(self.build_lib))


class SdistWithContract(sdist):
    """Carries the contract along."""

    def make_release_tree(self, base_dir, files) -> None:
        super().make_release_tree(base_dir, files)
        for folder in PROTO_FOLDERS:
            for path in (proto_root() / folder).glob("*.proto"):
                target = pathlib.Path(base_dir) / "proto" / folder / path.name
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(path, target)


setup(cmdclass={"build_py": BuildWithContract, "sdist": SdistWithContract})
