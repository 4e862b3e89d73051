# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Every estimator, its options and its errors."""

import inspect
import json
import os
import pickle
import re
import subprocess
import threading
import time

import numpy as np
import problems
import pytest

import quatro

TRUTH = problems.pose(2.0, (3, -4, 0.5))
METHODS = problems.MATCH_METHODS


def solve(source, target, method, **options):
    """With what the method needs."""
    return quatro.solve(source, target, method, **{**problems.needed(method), **options})


def test_methods_are_those_of_the_library():
    assert list(quatro.methods()) == METHODS + problems.REFINING_METHODS + problems.LOCAL_METHODS
    assert all(quatro.methods().values())


@pytest.mark.parametrize('method', problems.REFINING_METHODS + problems.LOCAL_METHODS)
def test_methods_of_clouds_are_not_for_matches(method):
    source, target = problems.matches(1, TRUTH)
    with pytest.raises(ValueError, match='^method %s works on clouds, not on matches$' % method):
        solve(source, target, method)


def test_quatro_ins_needs_an_ins():
    source, target = problems.matches(1, TRUTH)
    with pytest.raises(ValueError, match='^method quatro_ins needs an INS: set ins_mode'):
        quatro.solve(source, target, method='quatro_ins')


@pytest.mark.parametrize('num_wrong, method', [(60, 'quatro'), (19_941, 'arc_consensus')])
def test_auto_chooses_by_the_number_of_matches(num_wrong, method):
    source, target = problems.matches(1, TRUTH, 60, num_wrong)
    chosen = quatro.solve(source, target, method='auto', noise_bound=0.1)
    expected = solve(source, target, method, noise_bound=0.1)
    assert np.array_equal(chosen.target_from_source, expected.target_from_source)
    assert np.array_equal(chosen.consistent, expected.consistent)
    assert chosen.num_tims == expected.num_tims


@pytest.mark.parametrize('method, num', [('ransac1k', 1000), ('ransac10k', 10_000)])
def test_ransac_of_a_number_of_samples(method, num):
    source, target = problems.matches(1, TRUTH, 20, 180)
    answer = solve(source, target, method, noise_bound=0.1)
    expected = quatro.solve(source, target, method='ransac', noise_bound=0.1, max_iterations=num)
    assert np.array_equal(answer.target_from_source, expected.target_from_source)
    with pytest.raises(TypeError, match='has no option max_iterations'):
        solve(source, target, method, max_iterations=1)


@pytest.mark.parametrize('method', METHODS)
@pytest.mark.parametrize('seed', [1, 2, 3])
def test_finds_the_pose_among_wrong_matches(method, seed):
    source, target = problems.matches(seed, TRUTH)
    answer = solve(source, target, method, noise_bound=0.1)
    meters, radians = problems.errors(answer.target_from_source, TRUTH)
    assert answer.is_registered and answer.status == 'registered', answer
    assert answer.method == method
    assert meters < 0.05 and radians < 0.005, answer
    assert np.isin(np.arange(60), answer.inliers).sum() > 50
    assert (answer.inliers >= 60).sum() <= 2
    assert answer.num_matches == 120
    assert len(answer.inliers) == answer.num_translation_inliers
    assert len(answer.consistent) == answer.num_consistent
    assert 50 < answer.num_translation_inliers <= answer.num_consistent <= answer.num_matches
    assert answer.num_inliers == problems.num_inliers(answer.target_from_source, source, target,
                                                      0.1)
    assert 'inliers=%d: ' % answer.num_inliers in repr(answer)
    # Roll and pitch of a method that finds the yaw alone are assumed.
    assert len(answer.unobservable_directions) == (2 if method in ('arc_consensus', 'consensus') else 0)
    assert all('not estimated, but assumed' in text for text in answer.unobservable_directions)
    assert answer.covariance.shape == (6, 6)
    assert np.allclose(answer.covariance, answer.covariance.T)
    assert (np.linalg.eigvalsh(answer.covariance) > 0).all()
    assert answer.yaw == pytest.approx(2.0, abs=0.005)


@pytest.mark.parametrize('method', METHODS)
def test_swapped_matches_give_the_inverse(method):
    source, target = problems.matches(4, TRUTH)
    there = solve(source, target, method, noise_bound=0.1)
    back = solve(target, source, method, noise_bound=0.1)
    meters, radians = problems.errors(
        there.target_from_source @ back.target_from_source, np.eye(4))
    assert meters < 0.05 and radians < 0.005


@pytest.mark.parametrize('method', METHODS)
def test_threads_do_not_matter_bit_for_bit(method):
    source, target = problems.matches(5, TRUTH)
    poses = [solve(source, target, method, num_threads=n).target_from_source for n in (0, 1, 3)]
    assert np.array_equal(poses[0], poses[1]) and np.array_equal(poses[0], poses[2])


@pytest.mark.parametrize('method', METHODS)
@pytest.mark.parametrize('num', [0, 1, 2])
def test_too_few_matches_are_no_registration(method, num):
    source, target = problems.matches(6, TRUTH, num, 0)
    answer = solve(source, target, method)
    assert not answer.is_registered
    assert answer.status in ('ambiguous', 'insufficient', 'degenerate')
    assert answer.reason
    if num < 2:
        assert answer.target_from_source is None and answer.yaw is None
        assert answer.covariance is None


def test_collinear_matches_hold_no_full_rotation():
    source = np.outer(np.arange(30.0), (1.0, 0.0, 0.0))
    answer = quatro.solve(source, problems.moved(TRUTH, source), method='teaser')
    assert not answer.is_registered


@pytest.mark.parametrize('method', METHODS)
def test_far_coordinates_keep_their_digits(method):
    far = problems.pose(2.0, (5e5, 5e6, 100))
    source, target = problems.matches(7, far, 60, 0)
    answer = solve(source, target, method, noise_bound=0.1)
    meters = np.linalg.norm(problems.moved(answer.target_from_source, source) - target, axis=1)
    assert answer.is_registered and np.median(meters) < 0.1


@pytest.mark.parametrize('method', METHODS)
@pytest.mark.parametrize('bad', [np.nan, np.inf])
def test_matches_that_are_not_finite_are_refused(method, bad):
    source, target = problems.matches(8, TRUTH)
    target[3, 1] = bad
    with pytest.raises(ValueError, match='^a matched point is not finite$'):
        solve(source, target, method)


# The library's own words: noise_bound of each options' IsValid() and so on.
@pytest.mark.parametrize('method, options, text', [
    *[(method, {'noise_bound': -1}, 'noise_bound = -1, must be > 0 and finite')
      for method in METHODS],
    *[(method, {'num_threads': -2}, 'num_threads = -2, must be >= 0') for method in METHODS],
    ('quatro', {'noise_bound': float('nan')}, 'noise_bound = nan, must be > 0 and finite'),
    ('arc_consensus', {'num_pairs': 0}, 'num_pairs = 0, must be >= 1'),
    ('arc_consensus', {'max_tilt': 2}, 'max_tilt = 2, must be in [0, pi/2]'),
    ('arc_consensus', {'min_planar_length_factor': -1}, 'min_planar_length_factor = -1, must be >= 0'),
    ('teaser', {'num_scale_tims': 0}, 'num_scale_tims = 0, must be >= 1'),
    ('fgr', {'mu_step': 1}, 'mu_step = 1, must be > 1 and finite'),
    ('fgr', {'start_scale': 0}, 'start_scale = 0, must be > 0 and finite'),
    ('fgr', {'iterations_per_mu': 0}, 'iterations_per_mu = 0, must be >= 1'),
    ('fgr', {'max_iterations': 0}, 'max_iterations = 0, must be >= 1'),
    ('fgr', {'step_tolerance': 0}, 'step_tolerance = 0, must be > 0'),
    ('ransac', {'max_iterations': 0}, 'max_iterations = 0, must be >= 1'),
    ('ransac', {'confidence': 0}, 'confidence = 0, must be in (0, 1]'),
    ('quatro', {'up': (0, 0, 2)}, 'ins.up = (0 0 2), must be a unit vector'),
    ('quatro', {'attitude_std': 0}, 'ins.attitude_std = 0, must be in (0, pi]'),
    ('quatro', {'match_std': -1}, 'ins.match_std = -1, must be >= 0 and finite'),
    ('quatro', {'ins_mode': 'fused', 'source_rpy': (0, np.nan, 0), 'target_rpy': (0, 0, 0)},
     'ins.source_attitude must be finite'),
    ('quatro', {'ins_mode': 'fused', 'source_rpy': (0, 0, 0), 'target_rpy': (0, np.inf, 0)},
     'ins.target_attitude must be finite'),
    ('quatro', {'source_rpy': (0, 0, 0)}, 'source_rpy is given, but ins_mode is none'),
    ('arc_consensus', {'ins_mode': 'leveled', 'source_rpy': (0, 0, 0)},
     'target_rpy is missing, but ins_mode needs it'),
    ('quatro', {'ins_mode': 'full'},
     'ins_mode = "full", must be one of none, relative, leveled, fused'),
    ('quatro', {'seed': -1}, 'seed = -1, must be from 0 to 18446744073709551615'),
    ('quatro', {'num_threads': 2**31},
     'num_threads = 2147483648, must be from -2147483648 to 2147483647'),
])
def test_values_out_of_range_are_refused_in_the_librarys_words(method, options, text):
    source, target = problems.matches(9, TRUTH)
    with pytest.raises(ValueError) as error:
        solve(source, target, method, **options)
    assert str(error.value) == text


def documented(function):
    """{method: [option, ...]} by the docstring."""
    methods, options = {}, []
    for line in function.__doc__.splitlines():
        if match := re.match(r'method="(\w+)"  ', line):
            options = methods[match[1]] = []
        elif match := re.match(r'  (\w+)  ', line):
            options.append(match[1])
    return methods


@pytest.mark.parametrize('method', METHODS)
def test_every_option_refuses_a_value_of_another_type(method):
    source, target = problems.matches(9, TRUTH)
    options = documented(quatro.solve)[method]
    assert len(options) > 6
    for option in options:
        with pytest.raises(TypeError, match='^%s = .*, must be ' % option):
            solve(source, target, method, **{option: object()})


def test_names_that_are_not_known_are_refused():
    source, target = problems.matches(9, TRUTH)
    with pytest.raises(ValueError, match='^method = "orb", must be one of '
                                         'auto, quatro, quatro_single, .*, vgicp$'):
        quatro.solve(source, target, method='orb')
    with pytest.raises(ValueError, match='^preset = "auto", must be one of kitti, .*indoor$'):
        quatro.solve(source, target, preset='auto')
    with pytest.raises(ValueError, match='^method = "kitti", .*vgicp; it is a preset: preset=...$'):
        quatro.solve(source, target, 'kitti')
    for method, option in [('quatro', 'confidence'), ('ransac', 'polish'), ('fgr', 'sample'),
                           ('quatro_exact', 'surrogate'), ('teaser', 'ins_mode'),
                           ('quatro', 'voxel_size')]:
        with pytest.raises(TypeError, match=r'^solve\(method="%s"\) has no option %s, must be '
                                            'one of noise_bound' % (method, option)):
            solve(source, target, method, **{option: 1})


def test_numbers_of_numpy_are_numbers():
    source, target = problems.matches(9, TRUTH)
    plain = quatro.solve(source, target, noise_bound=0.25, seed=3, polish=False)
    numpys = quatro.solve(source, target, noise_bound=np.float32(0.25), seed=np.uint8(3),
                          polish=np.False_)
    assert np.array_equal(plain.target_from_source, numpys.target_from_source)


@pytest.mark.parametrize('method, options, fact', [
    ('quatro', {'polish': False}, lambda a: a.unpolished_target_from_source is None),
    ('quatro', {'polish': True}, lambda a: a.unpolished_target_from_source is not None),
    ('quatro', {'crosscheck': True}, lambda a: a.crosscheck['num_subproblems'] > 0),
    ('quatro', {'pruning': 'none'}, lambda a: len(a.consistent) == 120),
    ('quatro', {'min_probability': 1.0}, lambda a: a.status == 'ambiguous'),
    ('quatro', {'certificate_tolerance': 1e-3}, lambda a: a.certificate['gap'] < 1e-3),
    ('quatro', {}, lambda a: a.certificate['gnc_cost'] is not None),
    ('quatro_exact', {}, lambda a: a.certificate['gnc_cost'] is None),
    ('quatro_exact', {'pruning': 'max_core'}, lambda a: 60 <= len(a.consistent) <= 120),
    ('teaser', {'estimate_scale': True}, lambda a: a.scale == pytest.approx(1, abs=0.01)),
    ('ransac', {'max_iterations': 1, 'sample': 'three_points'}, lambda a: not a.is_registered),
])
def test_options_arrive(method, options, fact):
    source, target = problems.matches(1, TRUTH)
    assert fact(solve(source, target, method, **{'noise_bound': 0.1, **options}))


@pytest.mark.parametrize('method, few', [
    ('ransac', {'max_iterations': 1, 'local_optimization': False}),
    ('arc_consensus', {'num_pairs': 8}),
    ('teaser', {'tim_layout': 'random', 'gnc_max_num_iterations': 1}),
    ('quatro', {'tim_layout': 'random', 'num_random_tims': 20, 'polish': False})])
def test_seeds_draw_differently(method, few):
    source, target = problems.matches(1, TRUTH)

    def answers():
        return [str(solve(source, target, method, seed=seed, **few).target_from_source)
                for seed in range(12)]

    assert answers() == answers()
    assert len(set(answers())) > 1


def test_scale():
    source, target = problems.matches(1, TRUTH)
    answer = quatro.solve(source / 1.5, target, method='teaser', noise_bound=0.1,
                          estimate_scale=True)
    assert answer.scale == pytest.approx(1.5, abs=0.01)


def test_presets_are_the_librarys():
    assert quatro.presets() == ('kitti', 'paper', 'kitti_paper', 'reference', 'indoor', 'auto')
    source, target = problems.matches(1, TRUTH)
    assert quatro.solve(source, target, preset='paper').unpolished_target_from_source is None
    assert quatro.solve(source, target).unpolished_target_from_source is not None


@pytest.mark.parametrize('mode', ['leveled', 'fused', 'relative'])
@pytest.mark.parametrize('method', ['auto', 'quatro', 'quatro_exact', 'quatro_ins',
                                    'arc_consensus'])
def test_ins_takes_the_tilt(mode, method):
    source_rpy, target_rpy = (0.1, -0.05, 0.3), (-0.12, 0.08, 2.3)
    world_from_source = problems.pose(source_rpy[2], (0, 0, 0), *source_rpy[:2])
    world_from_target = problems.pose(target_rpy[2], (0, 0, 0), *target_rpy[:2])
    truth = np.linalg.inv(world_from_target) @ world_from_source
    truth[:3, 3] = (3, -4, 0.5)
    source, target = problems.matches(2, truth)
    polish = {} if method == 'arc_consensus' else {'polish': False}
    plain = solve(source, target, method, noise_bound=0.15, **polish)
    answer = solve(source, target, method, noise_bound=0.15, ins_mode=mode,
                   source_rpy=source_rpy, target_rpy=target_rpy, **polish)
    meters, radians = problems.errors(answer.target_from_source, truth)
    assert meters < 0.1 and radians < 0.01
    assert (plain.target_from_source is None or
            problems.errors(plain.target_from_source, truth)[1] > 0.05)


def test_is_what_the_program_says_bit_for_bit(tmp_path):
    program = os.path.join(os.environ.get('QUATRO_BIN', ''), 'quatro_solve')
    if not os.path.exists(program):
        pytest.skip('quatro_solve is not built')
    source, target = problems.matches(10, TRUTH)
    matches = tmp_path / 'matches.csv'
    np.savetxt(matches, np.hstack([source, target]), fmt='%.17g', delimiter=',')
    for method in METHODS:
        ins = ['--ins_mode=leveled', '--source_rpy_deg=0,0,0', '--target_rpy_deg=0,0,0']
        run = subprocess.run([program, '--correspondences=%s' % matches, '--method=' + method,
                              '--noise_bound=0.06', '--seed=5',
                              *(ins if problems.needed(method) else [])],
                             stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
        report = json.loads(run.stdout)
        answer = solve(source, target, method, noise_bound=0.06, seed=5)
        assert np.array_equal(answer.target_from_source, report['target_from_source'])
        assert answer.probability == report['probability']
        assert answer.reason == report['reason']
        assert len(answer.unobservable_directions) == len(report['unobservable_directions'])
        assert {name: getattr(answer, 'num_' + name) for name in report['counts']} == (
            report['counts'])
        assert np.array_equal(answer.covariance, report['covariance'])


def longest_pause(call):
    """Of another thread while this one calls, as a share of the call's time."""
    ticks = []
    done = threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    begin = time.perf_counter()
    call()
    end = time.perf_counter()
    done.set()
    thread.join()
    ran = [begin] + [t for t in ticks if begin < t < end] + [end]
    return max(np.diff(ran)) / (end - begin)


def test_other_threads_run_meanwhile():
    source, target = problems.matches(11, TRUTH, 2000, 4000)
    assert longest_pause(lambda: quatro.solve(source, target, num_threads=1)) < 0.4
    cloud = np.tile(problems.scan(1, 1), (30, 1))
    assert longest_pause(lambda: quatro.register(cloud, cloud, preset='auto',
                                                 num_threads=1)) < 0.4


def test_repr_and_docstrings():
    source, target = problems.matches(1, TRUTH)
    answer = quatro.solve(source, target, noise_bound=0.1)
    assert re.fullmatch(
        r'Solution\(registered, quatro, probability=[01]\.\d\d, yaw=114\.\d\d deg, '
        r'translation=\([23]\.\d\d\d, -[34]\.\d\d\d, 0\.\d\d\d\) m, matches=120, inliers=\d+: .+\)',
        repr(answer))
    assert repr(quatro.solve(source[:0], target[:0])).startswith(
        'Solution(insufficient, quatro, matches=0, inliers=0: ')
    for function in (quatro.register, quatro.solve, quatro.align, quatro.read_cloud):
        assert '(N, 3)' in function.__doc__ and 'ValueError' in function.__doc__
        assert inspect.signature(function).parameters
    for summary in (quatro.Solution, quatro.Registration, quatro.Alignment):
        fields = [name for name in dir(summary) if not name.startswith('_')]
        assert len(fields) >= 10
        for name in fields:
            assert getattr(summary, name).__doc__, name
    assert answer.stage_seconds and answer.total_seconds > 0
    assert 'surprise' in answer.features
    assert isinstance(answer.notes, dict)


def test_summaries_go_to_other_processes_as_dicts():
    source, target = problems.matches(1, TRUTH)
    cloud = problems.scan(1, 1)
    for make in (lambda: quatro.solve(source, target, noise_bound=0.1),
                 lambda: quatro.solve(source[:0], target[:0]),
                 lambda: quatro.register(cloud, cloud, preset='auto'),
                 lambda: quatro.align(cloud, cloud, 'icp')):
        answer = make()
        fields = [name for name in dir(answer)
                  if not name.startswith('_') and name not in ('as_dict', 'transform')]
        values = answer.as_dict()
        assert sorted(values) == sorted(fields)
        for name in fields:
            if isinstance(values[name], np.ndarray):
                # Of its own, so that it can outlive the answer.
                assert values[name].flags.writeable and values[name].base is None, name
                assert np.array_equal(values[name], getattr(answer, name)), name
        assert repr(pickle.loads(pickle.dumps(values))) == repr(values)


def test_version_is_the_librarys():
    assert quatro.__version__ == os.environ.get('QUATRO_VERSION', quatro.__version__)
    assert re.fullmatch(r'\d+\.\d+\.\d+', quatro.__version__)
