"""The module on walks and matrices that the tests make."""

import concurrent.futures
import sys

import numpy as np
import pytest
from drawn_walls import wall, write_walk

import retrace

RNG = np.random.default_rng(1)


@pytest.fixture(scope="module")
def walks(tmp_path_factory):
    """Folders of PGM pictures of one wall: a walk, and another at twice the speed."""
    folder, texture = tmp_path_factory.mktemp("walks"), wall()
    found = {}
    for name, positions in (("day", np.arange(0, 900, 1.0)), ("night", np.arange(60, 840, 2.0))):
        found[name] = (*write_walk(folder, name, texture, positions), positions)
    return folder, found


def test_patch_normalisation_is_equation_2():
    image = RNG.integers(0, 256, (16, 24), dtype=np.uint8)
    out = retrace.patch_normalise(image, min_contrast=0)
    assert out.shape == image.shape and out.dtype == np.float32
    patch = image[8:16, 0:8].astype(float)
    assert np.allclose(out[8:16, 0:8], (patch - patch.mean()) / patch.std(), atol=1e-4)
    assert np.array_equal(retrace.patch_normalise(image[None])[0], retrace.patch_normalise(image))
    with pytest.raises(ValueError):
        retrace.patch_normalise(image, patch_px=7)


def test_costs_are_those_of_numpy():
    query, reference = RNG.normal(size=(5, 40)).astype(np.float32), RNG.normal(size=(7, 40)).astype(np.float32)
    unit = [a / np.linalg.norm(a, axis=1, keepdims=True) for a in (query, reference)]
    cosine = np.asarray(retrace.cost_matrix(query, reference))
    assert cosine.shape == (5, 7) and np.allclose(cosine, 1 - unit[0] @ unit[1].T, atol=1e-3)
    bytes_a, bytes_b = RNG.integers(0, 256, (4, 64), dtype=np.uint8), RNG.integers(0, 256, (6, 64), dtype=np.uint8)
    sad = np.asarray(retrace.cost_matrix(bytes_a, bytes_b, metric="sad"))
    expected = np.abs(bytes_a[:, None].astype(int) - bytes_b[None].astype(int)).mean(axis=2)
    assert np.allclose(sad / sad[0, 0], expected / expected[0, 0], atol=1e-4)  # in deviations of a patch
    strided = retrace.cost_matrix(bytes_a[::2], bytes_b[:, ::-1], metric="sad")
    assert np.array_equal(strided, retrace.cost_matrix(bytes_a[::2].copy(), bytes_b[:, ::-1].copy(), metric="sad"))
    for wrong in ({"metric": "sad"}, {"metric": "euclid"}):
        with pytest.raises(ValueError):
            retrace.cost_matrix(query, reference, **wrong)


def test_matrices_are_looked_at_without_a_copy():
    matrix = retrace.CostMatrix(np.zeros((2, 3), np.float32))
    np.asarray(matrix)[1, 2] = 5
    assert np.asarray(matrix)[1, 2] == 5 and matrix.shape == (2, 3)


def test_standardised_rows_and_columns():
    costs = RNG.normal(3, 2, (20, 30)).astype(np.float32)
    enhanced = np.asarray(retrace.enhance(costs))
    assert np.allclose(enhanced.mean(axis=0), 0, atol=1e-4) and np.allclose(enhanced.std(axis=0), 1, atol=1e-3)
    assert np.array_equal(np.asarray(retrace.enhance(costs, method="none")), costs)


@pytest.mark.parametrize("method", ["path", "lines", "cone", "hybrid", "graph"])
def test_every_search_finds_a_diagonal(method):
    costs = RNG.normal(0, 1, (60, 90)).astype(np.float32)
    costs[np.arange(60), np.arange(60) + 15] -= 5
    found = retrace.search(retrace.CostMatrix(costs), method=method)
    assert found.reference.dtype == np.int64
    inside = slice(6, 54)  # whole sequences of ten
    assert np.mean(np.abs(found.reference[inside] - np.arange(60)[inside] - 15) <= 1) > 0.95
    assert np.array_equal(found.reference, retrace.search(costs, method=method).reference)


def test_search_takes_settings_and_refuses_what_is_wrong():
    costs = RNG.normal(0, 1, (30, 30)).astype(np.float32)
    retrace.search(costs, method="lines", search_range_rad=0.3, sequence_length=5)
    with pytest.raises(retrace.Error, match="search-rang"):
        retrace.search(costs, search_rang_rad=0.3)
    with pytest.raises(retrace.Error, match="sequence-length"):
        retrace.search(costs, sequence_length=0)
    for beside in ({"enhance": "local"}, {"accept_probability": 0.99}, {"verify": 7}):
        with pytest.raises(retrace.Error, match="has no effect"):
            retrace.search(costs, **beside)
    with pytest.raises(ValueError):
        retrace.search(costs[0])


def test_matches_are_counted():
    place, truth = np.array([1.0, 5, 9, np.nan]), np.array([1.0, 8, np.nan, 4])
    found = retrace.evaluate_matches(place, np.array([4.0, 3, 2, 1]), truth, 1)
    # The best threshold takes the first alone: one right, and two queries with a true place missed.
    assert (found["tp"], found["fp"], found["fn"]) == (1, 0, 2)
    assert found["max_f1"] == pytest.approx(0.5)
    assert found["curve"]["precision"].tolist() == pytest.approx([1, 1 / 2, 1 / 3])


def test_bootstrap_pairs_runs():
    time_s = np.arange(0, 100, 0.5)
    truth = np.arange(200.0)
    good, bad = truth.copy(), np.where(RNG.uniform(size=200) < 0.5, truth + 50, truth)
    score = np.ones(200)
    first, second = retrace.bootstrap([(time_s, good, score, truth), (time_s, bad, score, truth)], 1, resamples=200)
    assert first["max_f1"] == (1, 1)
    low, high = second["max_f1_above_first"]
    assert low <= high < 0


def test_calibration_learns_from_decoys():
    decoys = RNG.normal(0, 1, 300)
    scores = np.concatenate([RNG.normal(0, 1, 100), RNG.normal(6, 1, 100)])
    probability = retrace.calibrate(scores, decoys)
    right = np.arange(200) >= 100
    assert retrace.calibration_error(probability, right) < 0.1
    assert probability[right].mean() > 0.9 > 0.2 > probability[~right].mean()


def test_finds_a_walk_on_a_route(walks, tmp_path):
    _, found = walks
    (day, day_csv, _), (night, night_csv, positions) = found["day"], found["night"]
    stages = []
    route = retrace.build(day, "day", truth=day_csv, progress=lambda stage, done, total: stages.append(stage))
    assert stages and route.traverses[0]["name"] == "day"
    route.save(str(tmp_path / "route.db"))
    again = retrace.Route.open(str(tmp_path / "route.db"))
    walk = retrace.read_walk(night, again)
    assert walk.thumbnails.shape == (len(positions), 32, 64)
    run = retrace.localise(again, walk)
    assert len(run.frame) == len(run.reference_frame) == len(run.probability)
    metrics = retrace.evaluate(run, query_truth=night_csv, reference_truth=day_csv, tolerance_m=0.3)
    assert metrics["max_f1"] > 0.9
    with pytest.raises(ValueError, match="pairs, or query_truth"):
        retrace.evaluate(run, pairs="pairs.csv", query_truth=night_csv)
    pairs = tmp_path / "pairs.csv"
    pairs.write_text("query_frame,reference_frame\n" + "".join(f"{q},{r}\n" for q, r in zip(run.frame, run.reference_frame) if r >= 0))
    by_pairs = retrace.evaluate(run, pairs=str(pairs), reference_truth=day_csv, tolerance_m=0.01)
    assert by_pairs["precision"] == 1 and np.isfinite(by_pairs["max_f1_threshold"])
    with pytest.raises(retrace.Error, match="day: is a traverse of the route already"):
        again.add("day", retrace.read_walk(day))
    with pytest.raises(retrace.Error, match="does not exist"):
        retrace.read_walk(str(tmp_path / "none.mp4"))


def test_follows_a_walker(walks):
    folder, found = walks
    day, day_csv, _ = found["day"]
    follower = retrace.Follower(retrace.build(day, truth=day_csv), lag_s=1)
    positions = found["night"][2]
    right = answers = 0
    for i, position in enumerate(positions):
        picture = np.frombuffer((folder / "night" / f"{i}.pgm").read_bytes()[-48 * 96:], np.uint8).reshape(48, 96)
        now = follower.push(picture, i / 30)
        assert now["frame"] == i
        if now["state"] == "on_route":
            answers += 1
            right += abs(now["distance_m"] - position / 100) < 0.5
    assert answers > len(positions) / 2 and right > 0.9 * answers
    earlier = follower.finish()
    assert earlier[0]["frame"] == now["lag"]["frame"] and len(earlier) > 1
    for one in earlier[1:]:
        assert len(positions) - 60 < one["frame"] < len(positions)
        assert abs(one["distance_m"] - positions[one["frame"]] / 100) < 0.5
    with pytest.raises(ValueError):
        follower.push(np.zeros((3, 4, 5), np.uint8), 1e9)


def picture_of(folder, name, i):
    return np.frombuffer((folder / name / f"{i}.pgm").read_bytes()[-48 * 96:], np.uint8).reshape(48, 96)


def test_a_follower_keeps_the_route_it_was_given(walks):
    folder, found = walks
    day, night = retrace.read_walk(found["day"][0]), found["night"][0]
    route = retrace.build(night)
    alone, beside = retrace.Follower(retrace.build(night)), retrace.Follower(route)
    for i in range(150):
        if i == 50:
            route.add("reference", day, replace=True)  # of another length
        picture = picture_of(folder, "night", i)
        assert beside.push(picture, i / 30) == alone.push(picture, i / 30)


def test_a_refused_picture_has_no_number(walks):
    folder, found = walks
    follower = retrace.Follower(retrace.build(found["day"][0]))
    picture = picture_of(folder, "night", 0)
    assert follower.push(picture, 0)["frame"] == 0
    with pytest.raises(ValueError):
        follower.push(picture, 0)
    assert follower.push(picture, 1 / 30)["frame"] == 1
    for lag in (-1, float("nan"), 1e9):
        with pytest.raises(ValueError):
            retrace.Follower(retrace.build(found["day"][0]), lag_s=lag)


def test_a_walk_can_be_stopped(walks):
    walk = retrace.read_walk(walks[1]["day"][0], progress=lambda stage, done, total: done < 100)
    assert 2 <= walk.frames < 900


def test_errors_of_callbacks_come_through(walks):
    def fail(stage, done, total):
        raise KeyError("mine")
    with pytest.raises(KeyError, match="mine"):
        retrace.read_walk(walks[1]["day"][0], progress=fail)


def test_settings_are_those_of_the_table():
    names = [entry["name"] for entry in retrace.settings()]
    assert "sequence_length" in names and len(names) == len(set(names))
    with pytest.raises(retrace.Error):
        retrace.Route(motion="feet")
    with pytest.raises(ValueError, match="set_threads"):
        retrace.Route(threads=1)


if __name__ == "__main__":
    sys.exit(pytest.main([__file__]))


def test_settings_of_a_walk_reach_its_traverse(walks, tmp_path):
    day, _, positions = walks[1]["day"]
    tum = tmp_path / "day.tum"
    tum.write_text("".join(f"{i / 30:.4f} 0 {p / 100:.4f} 0 0 0 0 1\n" for i, p in enumerate(positions)))
    assert retrace.build(day, motion="file", motion_file=str(tum), spacing_m=0.1).traverses
    assert retrace.build(day, trajectory=str(tum), axes="vehicle").traverses
    route = retrace.Route()
    assert isinstance(route.add("day", retrace.read_walk(day, route), trajectory=str(tum), axes="vehicle"), list)


def test_a_route_may_grow_while_it_is_used(walks):
    day = retrace.read_walk(walks[1]["day"][0])
    route = retrace.build(walks[1]["day"][0])
    query = retrace.read_walk(walks[1]["night"][0], route)
    with concurrent.futures.ThreadPoolExecutor() as pool:
        runs = [pool.submit(retrace.localise, route, query) for _ in range(4)]
        for i in range(8):
            route.add(f"d{i}", day)
        assert all(len(run.result().frame) for run in runs)
    assert len(route.traverses) == 9
