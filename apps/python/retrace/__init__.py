"""Speed-normalised sequence place recognition built on pedestrian odometry.

    import retrace
    route = retrace.build("day.mp4", truth="day.csv")
    run = retrace.localise(route, retrace.read_walk("night.mp4", route))
    print(run.reference_frame, run.probability)

or, with descriptors of any model in the rows of two arrays:

    costs = retrace.enhance(retrace.cost_matrix(query, reference))
    found = retrace.search(costs, sequence_length=10)
    found.reference, found.probability

Keywords are the settings of `retrace --help-all`, with underscores (`retrace.settings()` lists them). Errors of input are
`retrace.Error`, in one line: what, where, what was expected.
"""

from ._retrace import (
    CostMatrix,
    Error,
    Follower,
    Matches,
    Odometry,
    Route,
    Run,
    Walk,
    __version__,
    bootstrap,
    calibrate,
    calibration_error,
    cost_matrix,
    enhance,
    evaluate,
    evaluate_matches,
    localise,
    odometry,
    patch_normalise,
    read_walk,
    search,
    set_threads,
    settings,
)

__all__ = [name for name in dir() if not name.startswith("_")] + ["build", "__version__"]


def build(source, name="reference", *, truth="", trajectory="", track="", progress=None, **settings):
    """A route of one walk: `Route`, `read_walk` and `Route.add` in one call."""
    of_survey = () if settings.get("motion") == "file" else ("axes",) * bool(trajectory) + ("motion_file_gap_s",) * bool(trajectory or track)
    of_walk = {key: value for key, value in settings.items() if key not in of_survey}
    route = Route(**of_walk)
    route.add(name, read_walk(source, progress=progress, **of_walk), truth=truth, trajectory=trajectory, track=track, **settings)
    return route
