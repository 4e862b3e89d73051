# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""pip install --no-build-isolation ./python

Builds the library and the module with CMake; nothing is downloaded. CMAKE_ARGS
contains further CMake arguments. QUATRO_BUILD_FOLDER names a build folder of the
repository that is already configured for this Python.
"""

import os
import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent.parent


class CMakeBuild(build_ext):
    def run(self):
        folder = os.environ.get('QUATRO_BUILD_FOLDER')
        if not folder:
            folder = pathlib.Path(self.build_temp).resolve()
            subprocess.run(
                ['cmake', '-S', ROOT, '-B', folder,
                 '-DCMAKE_BUILD_TYPE=Release', '-DBUILD_SHARED_LIBS=OFF',
                 '-DQUATRO_BUILD_PYTHON=ON', '-DQUATRO_BUILD_TESTS=OFF',
                 '-DQUATRO_BUILD_EXPERIMENTS=OFF',
                 '-DPython_EXECUTABLE=' + sys.executable,
                 *os.environ.get('CMAKE_ARGS', '').split()], check=True)
        subprocess.run(['cmake', '--build', folder, '--target', 'quatro_python',
                        '--parallel', str(os.cpu_count() or 1)], check=True)
        subprocess.run(['cmake', '--install', folder, '--component', 'quatro_python',
                        '--prefix', pathlib.Path(self.build_lib).resolve()],
                       check=True)


setup(
    name='quatro',
    version=re.search(r'project\(quatro VERSION ([0-9.]+)',
                      (ROOT / 'CMakeLists.txt').read_text()).group(1),
    description='Robust global registration of point clouds',
    license='MIT',
    packages=['quatro'],
    # No sources, because CMake builds them.
    ext_modules=[Extension('quatro._quatro', sources=[])],
    cmdclass={'build_ext': CMakeBuild},
    python_requires='>=3.9',
    install_requires=['numpy'],
)
