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
    build,
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

__all__ = [name for name in dir() if not name.startswith("_")] + ["__version__"]
