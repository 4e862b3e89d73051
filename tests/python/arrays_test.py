# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""What goes in, in which layouts, and what comes out."""

import gzip
import os
import pathlib
import tracemalloc

import numpy as np
import problems
import pytest

import quatro

TRUTH = problems.pose(2.0, (3, -4, 0.5))


def pose_of(source, target, **options):
    return quatro.solve(source, target, **options).target_from_source


def peak_of_solve(source, target):
    """What NumPy allocated at most, beyond what it had."""
    tracemalloc.start()
    before = tracemalloc.get_traced_memory()[0]
    quatro.solve(source, target, method='arc_consensus', num_pairs=100)
    peak = tracemalloc.get_traced_memory()[1] - before
    tracemalloc.stop()
    return peak


def padded(points):
    """The same in the first columns of wider rows."""
    wide = np.full((len(points), 5), np.nan)
    wide[:, :3] = points
    return wide[:, :3]


def every_second(points):
    wide = np.full((2 * len(points), 3), np.nan)
    wide[::2] = points
    return wide[::2]


@pytest.mark.parametrize('layout', [np.ascontiguousarray, padded, every_second])
def test_rows_are_read_as_they_lie(layout):
    source, target = problems.matches(1, TRUTH, 5000, 5000)
    assert peak_of_solve(layout(source), layout(target)) < source.nbytes / 4


def test_what_is_not_float64_in_rows_is_copied():
    source, target = problems.matches(1, TRUTH, 5000, 5000)
    for other in (source.astype(np.float32), np.asfortranarray(source)):
        assert peak_of_solve(other, target) >= source.nbytes


def misaligned(points):
    raw = np.zeros(points.nbytes + 1, dtype=np.uint8)
    view = np.frombuffer(raw.data, dtype=np.float64, offset=1,
                         count=points.size).reshape(points.shape)
    view[:] = points
    return view


def every_second_column(points):
    wide = np.full((len(points), 6), np.nan)
    wide[:, ::2] = points
    return wide[:, ::2]


@pytest.mark.parametrize('layout', [
    padded, every_second, every_second_column, np.asfortranarray, misaligned,
    lambda points: points[::-1].copy()[::-1],  # Rows that go back in memory.
    lambda points: points.astype('>f8'),
    lambda points: points.astype(np.longdouble),
    lambda points: points.tolist()])
def test_layout_does_not_matter_bit_for_bit(layout):
    source, target = problems.matches(2, TRUTH)
    expected = pose_of(source, target)
    assert np.array_equal(pose_of(layout(source), layout(target)), expected)


def test_float32_and_integers():
    source, target = problems.matches(3, TRUTH)
    single = source.astype(np.float32), target.astype(np.float32)
    exact = pose_of(single[0].astype(float), single[1].astype(float))
    assert np.array_equal(pose_of(*single), exact)
    integers = np.round(source).astype(np.int32)
    assert np.array_equal(pose_of(integers, target), pose_of(integers.astype(float), target))


def test_rows_on_top_of_each_other_are_copied():
    one = np.arange(3.0)
    repeated = np.lib.stride_tricks.as_strided(one, (50, 3), (0, 8))
    assert quatro.solve(repeated, repeated).num_matches == 1


@pytest.mark.parametrize('given, text', [
    (np.zeros((3, 100)), 'source_points has shape (3, 100), must be (N, 3); pass source_points.T'),
    (np.zeros((100, 4)), 'source_points has shape (100, 4), must be (N, 3); it has 4 columns, '
                         'pass source_points[:, :3]'),
    (np.zeros(3), 'source_points has shape (3,), must be (N, 3)'),
    (np.zeros((4, 3, 1)), 'source_points has shape (4, 3, 1), must be (N, 3)'),
    (np.zeros((100, 3), dtype=complex),
     'source_points has dtype complex128, must be real numbers'),
    (np.zeros((100, 3), dtype=bool), 'source_points has dtype bool, must be real numbers'),
    ([['a', 'b', 'c']], 'source_points has dtype <U1, must be real numbers'),
    (None, 'source_points = None, must be an array of real numbers, (N, 3)'),
    ([[1, 2, 3], [4]], 'source_points = [[1, 2, 3], [4]], must be an array of real numbers, (N, 3)'),
])
def test_other_shapes_and_types_are_refused(given, text):
    with pytest.raises(ValueError) as error:
        quatro.solve(given, np.zeros((100, 3)))
    assert str(error.value) == text


def test_masked_entries_are_not_read():
    source, target = problems.matches(3, TRUTH)
    masked = np.ma.array(source, mask=np.zeros(source.shape, bool))
    assert np.array_equal(pose_of(masked, target), pose_of(source, target))
    masked[7, 1] = np.ma.masked
    with pytest.raises(ValueError) as error:
        quatro.solve(masked, target)
    assert str(error.value) == ('source_points has masked entries; pass '
                                'source_points[~source_points.mask.any(axis=1)]')
    kept = ~masked.mask.any(axis=1)
    assert quatro.solve(masked[kept], target[kept]).target_from_source is not None
    guess = np.ma.array(np.eye(4), mask=np.eye(4) == 1)
    with pytest.raises(ValueError, match='guess has masked entries'):
        quatro.solve(source, target, guess=guess, max_yaw_deg=5.0)


@pytest.mark.parametrize('path', ['a.bin', b'a.bin', pathlib.Path('a.bin')])
def test_a_path_is_not_a_cloud(path):
    points = np.zeros((100, 3))
    for function, name in ((quatro.register, 'source'), (quatro.align, 'source'),
                           (quatro.solve, 'source_points')):
        with pytest.raises(TypeError) as error:
            function(path, points)
        assert str(error.value) == ('%s = %r, must be an (N, 3) array; quatro.read_cloud() reads '
                                    'files' % (name, path))


def test_numbers_of_rows_must_agree():
    with pytest.raises(ValueError, match='source_points has 4 rows and target_points 5'):
        quatro.solve(np.zeros((4, 3)), np.zeros((5, 3)))


def test_results_are_views_that_outlive_the_summary():
    registration = quatro.register(problems.scan(1, 1), problems.scan(1, 2))
    matched = registration.matched_source
    assert matched.base is registration
    assert not matched.flags.writeable
    assert matched.shape == (len(registration.matched_target), 3)
    assert matched.dtype == np.float64
    before = matched.copy()
    inliers = registration.inliers
    assert inliers.dtype == np.int64 and not inliers.flags.writeable
    del registration
    assert np.array_equal(matched, before)
    with pytest.raises(ValueError):
        matched[0, 0] = 1.0


def test_files_are_read_into_an_array_of_its_own(tmp_path):
    points = problems.scan(1, 1).astype(np.float32)
    points[7] = np.nan
    path = tmp_path / 'scan.bin'
    np.column_stack([points, np.zeros(len(points), np.float32)]).tofile(path)
    cloud = quatro.read_cloud(path)
    assert cloud.flags.writeable and cloud.flags.c_contiguous
    assert np.array_equal(cloud, np.delete(points, 7, axis=0))
    with pytest.raises(ValueError, match='none.ply'):
        quatro.read_cloud(str(tmp_path / 'none.ply'))


@pytest.mark.parametrize('point_floats', [3, 4, 5, 6, 8])
def test_numbers_of_a_point_are_given_or_inferred(tmp_path, point_floats):
    points = problems.scan(1, 1).astype(np.float32)
    random = np.random.default_rng(1)
    further = random.uniform(0, [255, 1, 64, 1e3, 3][:point_floats - 3],
                             (len(points), point_floats - 3)).astype(np.float32)
    path = tmp_path / 'scan.bin'
    np.column_stack([points, further]).tofile(path)
    assert np.array_equal(quatro.read_cloud(path, point_floats=point_floats), points)
    assert np.array_equal(quatro.read_cloud(path, point_floats), points)
    if point_floats != 8:
        assert np.array_equal(quatro.read_cloud(path), points)
    else:
        with pytest.raises(ValueError, match='point_floats=%d' % point_floats):
            quatro.read_cloud(path)
    for wrong in (-1, 2, 65):
        with pytest.raises(ValueError, match='point_floats = %d, must be' % wrong):
            quatro.read_cloud(path, wrong)


@pytest.mark.parametrize('dtype', ['<f4', '<f8'])
@pytest.mark.parametrize('order', ['C', 'F'])
def test_arrays_and_text_are_clouds(tmp_path, dtype, order):
    points = problems.scan(1, 1)[:500].astype(dtype)
    np.save(tmp_path / 'scan.npy', np.asarray(points, order=order))
    assert np.array_equal(quatro.read_cloud(tmp_path / 'scan.npy'), points)
    for name, options in {'a.xyz': {}, 'b.csv': {'delimiter': ',', 'header': 'x,y,z'},
                          'c.txt': {'delimiter': ';', 'header': 'X;Y;Z', 'comments': ''}}.items():
        np.savetxt(tmp_path / name, points, **options)
        assert np.allclose(quatro.read_cloud(tmp_path / name), points, rtol=1e-15)
    zipped = tmp_path / 'scan.npy.gz'
    zipped.write_bytes(gzip.compress((tmp_path / 'scan.npy').read_bytes()))
    try:
        assert np.array_equal(quatro.read_cloud(zipped), points)
    except ValueError as error:
        assert 'built without zlib' in str(error)
    for wrong, reason in ((points.astype('>f4'), "dtype '>f4'"), (points.T, r'shape \(3, 500\)'),
                          (points.astype(np.int32), "dtype '<i4'")):
        np.save(tmp_path / 'wrong.npy', wrong)
        with pytest.raises(ValueError, match=reason.replace('shape ', "shape '")):
            quatro.read_cloud(tmp_path / 'wrong.npy')


def test_points_at_the_origin_are_left_out(tmp_path):
    points = problems.scan(1, 1)[:100].astype(np.float32)
    with_zeros = np.vstack((points[:50], np.zeros((20, 3), np.float32), points[50:]))
    np.save(tmp_path / 'scan.npy', with_zeros)
    assert np.array_equal(quatro.read_cloud(tmp_path / 'scan.npy'), points)
    answer = quatro.register(with_zeros, points)
    assert answer.num_source_dropped == 20 and answer.num_target_dropped == 0


def test_names_of_files_may_be_any_but_for_nul(tmp_path):
    points = np.ones((2, 4), np.float32)
    name = os.fsencode(tmp_path) + b'/latin\xff.bin'
    with open(name, 'wb') as file:
        points.tofile(file)
    assert len(quatro.read_cloud(name)) == len(quatro.read_cloud(os.fsdecode(name))) == 2
    with pytest.raises(ValueError, match='null byte'):
        quatro.read_cloud(os.fsdecode(name) + '\0.bin')


def test_open3d_clouds():
    open3d = pytest.importorskip('open3d')

    def cloud_of(points):
        return open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points))

    source, target = problems.scan(1, 1), problems.moved(TRUTH, problems.scan(1, 2))
    expected = quatro.register(source, target)
    answer = quatro.register(cloud_of(source), cloud_of(target))
    assert answer.is_registered
    assert np.array_equal(answer.target_from_source, expected.target_from_source)
    # Their points by themselves, read as they lie.
    matched = problems.matches(1, TRUTH, 5000, 5000)
    vectors = [open3d.utility.Vector3dVector(points) for points in matched]
    assert peak_of_solve(*vectors) < matched[0].nbytes / 4
    aligned = quatro.align(cloud_of(source), cloud_of(problems.scan(1, 2)), 'icp')
    assert aligned.is_usable
