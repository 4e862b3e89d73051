# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Clouds: the front door, local alignment and the example."""

import os
import pathlib
import signal
import subprocess
import sys

import numpy as np
import problems
import pytest

import quatro

TRUTH = problems.pose(2.0, (3, -4, 0.2))
NEARLY = TRUTH @ problems.pose(0.03, (0.2, -0.2, 0.05))
SOURCE = problems.scan(1, 1)
TARGET = problems.moved(TRUTH, problems.scan(1, 2))
FEW_SOURCE, FEW_TARGET = SOURCE[::4], TARGET[::4]


def check_same_estimate(clouds, matches):
    """Clouds change only the verdict and the covariance."""
    for name in ('target_from_source', 'inliers', 'consistent', 'num_matches',
                 'num_consistent', 'num_tims', 'num_rotation_inliers', 'num_translation_inliers',
                 'num_inliers'):
        assert np.array_equal(getattr(matches, name), getattr(clouds, name)), name


@pytest.mark.parametrize('method', problems.MATCH_METHODS + problems.REFINING_METHODS)
def test_registers_two_scans_of_a_place(method):
    answer = quatro.register(SOURCE, TARGET, 'kitti', method=method, **problems.needed(method))
    meters, radians = problems.errors(answer.target_from_source, TRUTH)
    assert answer.is_registered and meters < 0.2 and radians < 0.02, answer
    assert answer.method == method
    assert 0 < answer.num_inliers <= len(answer.matched_source) <= answer.num_mutual_matches
    assert answer.num_inliers == problems.num_inliers(
        answer.target_from_source, answer.matched_source, answer.matched_target, 0.3)
    assert len(answer.unobservable_directions) == (2 if method in ('arc_consensus', 'consensus') else 0)
    assert answer.num_source_voxels < len(SOURCE)
    assert repr(answer).startswith('Registration(registered, %s, ' % method)
    # The inliers are rows of what was matched, and are those before a refinement.
    pose = answer.target_from_source
    if answer.refinement:
        pose = answer.refinement['unrefined_target_from_source']
    distances = np.linalg.norm(
        problems.moved(pose, answer.matched_source[answer.inliers]) -
        answer.matched_target[answer.inliers], axis=1)
    assert (distances < 0.3 * np.sqrt(3) + 1e-9).all()
    assert len(answer.inliers) == answer.num_translation_inliers
    if method in problems.MATCH_METHODS:
        check_same_estimate(answer, quatro.solve(answer.matched_source, answer.matched_target,
                                                 method=method, **problems.needed(method)))


@pytest.mark.parametrize('method', problems.LOCAL_METHODS)
def test_local_registration_starts_from_the_guess(method):
    answer = quatro.register(SOURCE, TARGET, method=method, guess=NEARLY)
    meters, radians = problems.errors(answer.target_from_source, TRUTH)
    assert meters < 0.1 and radians < 0.01, answer
    # A guess is no evidence.
    assert answer.status == 'ambiguous' and 'from the guess' in answer.reason
    assert answer.method == method == answer.refinement['method']
    assert np.array_equal(answer.refinement['unrefined_target_from_source'], NEARLY)
    assert len(answer.matched_source) == answer.num_matches == answer.num_inliers == 0
    assert repr(answer).startswith('Registration(ambiguous, %s, ' % method)
    unguided = quatro.register(FEW_SOURCE, FEW_TARGET, method=method)
    assert problems.errors(unguided.target_from_source, TRUTH)[1] > 0.5
    outside = quatro.register(FEW_SOURCE, FEW_TARGET, method=method, guess=NEARLY,
                              max_translation=0.01)
    assert outside.target_from_source is None and outside.status == 'insufficient'
    with pytest.raises(ValueError, match='^max_tilt_deg has no effect without other bounds'):
        quatro.register(SOURCE, TARGET, method=method, guess=NEARLY, max_tilt_deg=1.0)


def test_coarse_to_fine_is_quatro_refined_by_gicp():
    answer = quatro.register(SOURCE, TARGET, method='quatro_c2f')
    refined = quatro.register(SOURCE, TARGET, refine='gicp')
    assert np.array_equal(answer.target_from_source, refined.target_from_source)
    assert answer.refinement['method'] == 'gicp' and answer.refinement['is_accepted']


def test_scans_of_two_places_are_not_registered():
    assert not quatro.register(FEW_SOURCE, problems.scan(2, 1)[::4]).is_registered


def test_threads_do_not_matter_bit_for_bit():
    poses = [quatro.register(FEW_SOURCE, FEW_TARGET, num_threads=n).target_from_source
             for n in (1, 2)]
    assert poses[0] is not None and np.array_equal(*poses)


def test_points_that_are_not_finite_are_left_out():
    holed = np.insert(FEW_SOURCE, [0, 100, 100],
                      [[np.nan] * 3, [np.inf] * 3, [0, np.nan, 0]], axis=0)
    answer = quatro.register(holed, FEW_TARGET)
    assert answer.num_source_dropped == 3 and answer.num_target_dropped == 0
    assert answer.is_registered
    assert np.array_equal(answer.target_from_source,
                          quatro.register(FEW_SOURCE, FEW_TARGET).target_from_source)


def test_presets_and_sizes_arrive():
    voxels = {preset: quatro.register(FEW_SOURCE, FEW_TARGET, preset).num_source_voxels
              for preset in ('kitti', 'paper', 'indoor', 'auto')}
    assert voxels['kitti'] == voxels['paper'] < voxels['indoor']
    wide = quatro.register(SOURCE, TARGET, 'kitti', voxel_size=0.5, normal_radius=1.5, fpfh_radius=2.5)
    assert wide.is_registered
    assert wide.num_source_voxels < quatro.register(SOURCE, TARGET, 'kitti').num_source_voxels
    assert voxels['auto'] not in (voxels['kitti'], voxels['indoor'])
    no_tuples = quatro.register(FEW_SOURCE, FEW_TARGET, tuple_test=False)
    assert len(no_tuples.matched_source) == no_tuples.num_mutual_matches


def test_refinement_is_told():
    answer = quatro.register(SOURCE, TARGET, refine='gicp')
    assert answer.refinement['method'] == 'gicp' and answer.refinement['is_accepted']
    assert answer.refinement['moved_translation'] < 0.3
    assert not np.array_equal(answer.refinement['unrefined_target_from_source'],
                              answer.target_from_source)
    assert quatro.register(FEW_SOURCE, FEW_TARGET, 'kitti').refinement is None


@pytest.mark.parametrize('source, options, text', [
    (np.zeros((0, 3)), {}, 'the source has no points'),
    (np.full((9, 3), np.nan), {}, 'the source has no points'),
    (SOURCE, {'voxel_size': -1}, 'voxel_size = -1, must be > 0 and finite'),
    (SOURCE, {'fpfh_radius': 0.1}, 'fpfh_radius = 0.1, must be >= normal_radius = 0.9'),
    (SOURCE, {'noise_bound': 0}, 'noise_bound = 0, must be > 0 and finite'),
    (SOURCE, {'method': 'ransac', 'confidence': 2}, 'confidence = 2, must be in (0, 1]'),
    (SOURCE, {'preset': 'moon'}, 'preset = "moon", must be one of kitti, paper, kitti_paper, '
                                 'reference, indoor, auto'),
    (SOURCE, {'preset': 'teaser'}, 'preset = "teaser", must be one of kitti, paper, kitti_paper, '
                                   'reference, indoor, auto; it is a method: method=...'),
    *[(SOURCE, {'gravity': 'scans', **options},
       'gravity = "scans" has no effect here: it needs two clouds, a method that searches other '
       'poses, such as quatro, max_rung > 0, and neither an INS nor bounds on the pose')
      for options in ({'method': 'quatro_single'}, {'max_rung': 0}, {'max_yaw_deg': 30.0},
                      {'preset': 'paper'})],
    (SOURCE, {'refine': 'ndt'}, 'refine = "ndt", must be one of none, icp, gicp, vgicp'),
])
def test_what_the_library_refuses(source, options, text):
    with pytest.raises(ValueError) as error:
        quatro.register(source, TARGET, **{'preset': 'kitti', **options})
    assert str(error.value) == text


def test_a_direction_is_not_gravity():
    for gravity in ((0, 0, -1), 9.81):
        with pytest.raises(TypeError, match=r'^gravity = .*, must be one of given, scans, none; '
                                            r'a direction is up=\(x, y, z\)$'):
            quatro.register(SOURCE, TARGET, gravity=gravity)


@pytest.mark.parametrize('misspelled, option', [
    ('threads', 'num_threads'), ('max_yaw', 'max_yaw_deg'), ('voxelsize', 'voxel_size')])
def test_the_option_that_was_meant_is_named(misspelled, option):
    with pytest.raises(TypeError) as error:
        quatro.register(SOURCE, TARGET, **{misspelled: 1})
    assert str(error.value) == ('register(method="quatro") has no option %s, did you mean %s? '
                                'help(quatro.register) lists all' % (misspelled, option))


def test_a_cloud_too_wide_is_refused():
    stray = np.vstack([SOURCE, [[1e7, 0, 0]]])
    with pytest.raises(ValueError, match='^source: the cloud is .* more than 2.21 voxels'):
        quatro.register(stray, TARGET, 'kitti')


@pytest.mark.parametrize('method', ['icp', 'gicp', 'vgicp'])
def test_local_alignment_ends_at_the_pose(method):
    answer = quatro.align(SOURCE, TARGET, method, NEARLY)
    meters, radians = problems.errors(answer.target_from_source, TRUTH)
    before = problems.errors(NEARLY, TRUTH)
    assert answer.is_usable and answer.termination == 'converged', answer
    assert meters < 0.05 < before[0] and radians < 0.005 < before[1], answer
    assert answer.costs[-1] < answer.costs[0]
    assert answer.hessian.shape == (6, 6) and answer.num_inliers > 10000
    assert repr(answer).startswith('Alignment(converged, %s, yaw=114.' % method)
    one = quatro.align(SOURCE, TARGET, method, NEARLY, num_threads=1)
    assert np.array_equal(one.target_from_source, answer.target_from_source)
    assert quatro.align(SOURCE, TARGET, method, NEARLY,
                        max_num_iterations=1).termination == 'not_converged'


def test_a_pose_may_be_rounded():
    rounded = np.round(NEARLY, 4)
    rotation = rounded[:3, :3]
    assert not np.allclose(rotation @ rotation.T, np.eye(3), rtol=0, atol=1e-6)
    u, _, vt = np.linalg.svd(rotation)
    nearest = rounded.copy()
    nearest[:3, :3] = u @ vt
    poses = [quatro.align(SOURCE, TARGET, 'icp', start).target_from_source
             for start in (rounded, nearest)]
    assert np.allclose(*poses, rtol=0, atol=1e-6)
    assert np.allclose(poses[0][:3, :3] @ poses[0][:3, :3].T, np.eye(3), rtol=0, atol=1e-9)
    answer = quatro.register(SOURCE, TARGET, guess=rounded, max_yaw_deg=30.0)
    assert answer.target_from_source is not None


@pytest.mark.parametrize('wrong', [None, 1, ['icp']])
def test_a_name_of_another_type_is_refused_in_one_line(wrong):
    for function in (quatro.register, quatro.solve, quatro.align):
        with pytest.raises(TypeError) as error:
            function(SOURCE, TARGET, method=wrong)
        assert str(error.value) == 'method = %r, must be a str' % (wrong,)
    for function in (quatro.register, quatro.solve):
        with pytest.raises(TypeError) as error:
            function(SOURCE, TARGET, preset=wrong)
        assert str(error.value) == 'preset = %r, must be a str' % (wrong,)


def test_a_mirrored_scan_is_not_turned_upside_down():
    scan = problems.scan(1, 1)[::3]
    scan[:, 2] += np.random.default_rng(5).normal(0, 0.03, len(scan))
    # Upside down, the ground fits its mirror image exactly.
    answer = quatro.register(scan * [-1, 1, 1], scan, 'kitti', max_rung=1)
    assert not answer.is_registered, answer
    assert len(answer.candidates) > 3
    for candidate in answer.candidates:
        assert candidate['target_from_source'][2][2] > 0


@pytest.mark.parametrize('function, arguments, options, text', [
    (quatro.register, (), {}, 'register() needs source; call it as register(source, target, '
                              'preset="auto", *, method="quatro", **options)'),
    (quatro.register, (SOURCE,), {}, 'register() needs target; call it as '),
    (quatro.register, (SOURCE, TARGET, 'kitti', 'quatro'), {},
     'register() takes at most 3 arguments without a name, not 4; call it as '),
    (quatro.register, (SOURCE, TARGET), {'source': SOURCE},
     'register() was given source twice; call it as '),
    (quatro.solve, (SOURCE,), {}, 'solve() needs target_points; call it as '),
    (quatro.solve, (SOURCE, TARGET, 'quatro', 'kitti', 1), {}, 'solve() takes at most 4 '),
    (quatro.align, (SOURCE,), {}, 'align() needs target; call it as '),
    (quatro.align, (SOURCE, TARGET, 'icp', np.eye(4), 3), {}, 'align() takes at most 4 '),
    (quatro.read_cloud, (), {}, 'read_cloud() needs path; call it as '
                                'read_cloud(path, point_floats=0)'),
    (quatro.read_cloud, ('a.bin',), {'floats': 4}, 'read_cloud() has no argument floats; call'),
    (quatro.read_cloud, (5,), {}, 'path = 5, must be a str, bytes or os.PathLike'),
    (quatro.read_cloud, (SOURCE,), {}, 'path = array([['),
    (quatro.read_cloud, ('a.bin', 'four'), {}, "point_floats = 'four', must be an integer"),
    (quatro.read_cloud, ('a.bin', 1.5), {}, 'point_floats = 1.5, must be an integer'),
    (quatro.read_cloud, ('a.bin', 10**12), {}, 'point_floats = 1000000000000, must be from '),
    (quatro.methods, (1,), {}, 'methods() takes at most 0 arguments'),
    (quatro.presets, (), {'x': 1}, 'presets() has no argument x; call it as presets()'),
    (quatro.register, (SOURCE, {'points': TARGET}), {}, "target = {'points': array([["),
    (quatro.register, (SOURCE, TARGET), {'voxel_size': 1j}, 'voxel_size = 1j, must be a number'),
    (quatro.register, (SOURCE, TARGET), {'voxel_size': TARGET}, 'voxel_size = array([['),
    (quatro.align, (SOURCE, TARGET, 'icp', {}), {},
     'initial_target_from_source = {}, must be an array of real numbers, (4, 4) or (3, 4)'),
])
def test_wrong_calls_are_refused_in_one_line(function, arguments, options, text):
    with pytest.raises((TypeError, ValueError)) as error:
        function(*arguments, **options)
    message = str(error.value)
    assert message.startswith(text)
    assert '\n' not in message and len(message) < 250


def test_transform_takes_points_alone():
    answer = quatro.align(FEW_SOURCE, FEW_TARGET, 'icp', NEARLY)
    assert np.array_equal(answer.transform(points=SOURCE), answer.transform(SOURCE))
    for arguments, text in [((), 'transform() needs points; call it as transform(points)'),
                            ((SOURCE, SOURCE), 'transform() takes at most 1 ')]:
        with pytest.raises(TypeError) as error:
            answer.transform(*arguments)
        assert str(error.value).startswith(text)


def test_named_arguments_are_left_alone():
    given = {'source': FEW_SOURCE, 'target': FEW_TARGET, 'method': 'icp'}
    quatro.align(**given)
    assert sorted(given) == ['method', 'source', 'target']


def test_ctrl_c_ends_a_call_at_the_end_of_its_stage():
    class Stop(Exception):
        pass

    def stop(*_):
        raise Stop

    before = signal.signal(signal.SIGALRM, stop)
    try:
        for call in (lambda: quatro.register(SOURCE, TARGET, 'kitti'),
                     lambda: quatro.solve(SOURCE, SOURCE, max_tilt=0.1)):
            signal.setitimer(signal.ITIMER_REAL, 0.01)
            with pytest.raises(Stop):
                call()
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    assert quatro.register(SOURCE, TARGET, 'kitti').is_registered


def test_local_alignment_refuses():
    bad = SOURCE.copy()
    bad[5, 0] = np.nan
    for arguments, text in [
            ((bad, TARGET), 'a point of the source is not finite'),
            ((SOURCE, TARGET, 'ndt'), 'method = "ndt", must be one of icp, gicp, vgicp'),
            ((SOURCE, TARGET, 'icp', np.eye(3)),
             'initial_target_from_source has shape (3, 3), must be (4, 4) or (3, 4)'),
            *[((SOURCE, TARGET, 'icp', pose),
               'initial_target_from_source is not a rigid motion: its first three columns must be '
               'a rotation to 1e-3, and a fourth row 0 0 0 1')
              for pose in (2 * np.eye(4), np.diag([1, 1, -1, 1]))]]:
        with pytest.raises(ValueError) as error:
            quatro.align(*arguments)
        assert str(error.value) == text
    with pytest.raises(ValueError, match='^max_correspondence_distance = -1, must be '):
        quatro.align(SOURCE, TARGET, max_correspondence_distance=-1)
    with pytest.raises(TypeError, match=r'^align\(method="icp"\) has no option voxel_size'):
        quatro.align(SOURCE, TARGET, 'icp', voxel_size=1.0)
    assert quatro.align(SOURCE[:2], TARGET).termination == 'insufficient'


def test_the_example_draws(tmp_path):
    pytest.importorskip('matplotlib')
    for name, points in (('source', SOURCE), ('target', TARGET)):
        np.column_stack([points, 0 * points[:, 0]]).astype(np.float32).tofile(
            tmp_path / (name + '.bin'))
    example = (pathlib.Path(__file__).resolve().parents[2] /
               'examples/python/draw_registration.py')
    command = [sys.executable, example, 'source.bin', 'target.bin', '--output', 'drawing.png']
    run = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False,
                         env={**os.environ, 'MPLCONFIGDIR': str(tmp_path)})
    assert run.returncode == 0, run.stderr
    assert run.stdout.startswith('Registration(registered, quatro')
    assert (tmp_path / 'drawing.png').read_bytes()[:4] == b'\x89PNG'
    command[2] = 'none.bin'
    run = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert run.returncode == 2 and 'none.bin' in run.stderr and run.stderr.count('\n') == 1
    command[2:] = ['source.bin', 'target.bin', '--output']
    (tmp_path / 'nan.bin').write_bytes(np.full(4, np.nan, np.float32).tobytes())
    for source, output, problem in (('source.bin', 'none/x.png', 'there is no folder'),
                                    ('source.bin', 'source.bin', 'is a cloud'),
                                    ('nan.bin', 'x.png', '')):
        command[2], command[5:] = source, [output]
        run = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert run.returncode == 2 and problem in run.stderr, run.stderr
        assert run.stderr.count('\n') == 1
