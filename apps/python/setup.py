"""`pip install --no-build-isolation ./apps/python`: builds the module with the libraries by CMake."""

import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

PROJECT = pathlib.Path(__file__).resolve().parents[2]


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        folder = pathlib.Path(self.build_temp).resolve() / "cmake"
        subprocess.run(["cmake", "-S", PROJECT, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DRETRACE_BUILD_TESTS=OFF", "-DRETRACE_BUILD_PYTHON=ON", f"-DPython3_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", folder, "--target", "retrace_python"], check=True)
        built = next((folder / "python" / "retrace").glob("_retrace*.so"))
        to = pathlib.Path(self.get_ext_fullpath(extension.name))
        to.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(built, to)


setup(
    name="retrace",
    version=re.search(r"project\(retrace VERSION (\S+)", (PROJECT / "CMakeLists.txt").read_text())[1],
    description="Speed-normalised sequence place recognition built on pedestrian odometry",
    packages=["retrace"],
    package_data={"retrace": ["*.pyi", "py.typed"]},
    ext_modules=[Extension("retrace._retrace", [])],
    cmdclass={"build_ext": CMakeBuild},
    python_requires=">=3.9",
    install_requires=["numpy"],
    zip_safe=False,
)
