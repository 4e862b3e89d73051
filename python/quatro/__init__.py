# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Robust global registration of point clouds.

    import quatro
    scan = quatro.read_cloud('a.bin')                  # or any (N, 3) array
    other = quatro.read_cloud('b.bin')
    answer = quatro.register(scan, other, preset='kitti')
    print(answer)
    if answer.is_registered:
        moved = answer.transform(scan)

Units are meters, radians and seconds. Use register() for clouds, solve() for your own
matched points, and align() to refine a pose that is nearly correct.
"""

from ._quatro import (  # noqa: F401
    Alignment,
    Registration,
    Solution,
    __version__,
    align,
    methods,
    presets,
    read_cloud,
    register,
    solve,
)

__all__ = ['Alignment', 'Registration', 'Solution', 'align', 'methods',
           'presets', 'read_cloud', 'register', 'solve']
