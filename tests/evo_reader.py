"""Reads trajectories and a result that vispline wrote with evo, from PyPI, and compares both programs' numbers.

usage: evo_reader.py <writer> <work folder>
Ends with 77 (skipped) if evo cannot be installed.
"""
import pathlib
import subprocess
import sys
import venv

SKIPPED = 77
PACKAGES = ["evo==1.36.5"]


def enter_environment(work):
    """Runs this script again inside a virtual environment that has evo."""
    home = work / "venv"
    python = home / "bin" / "python"
    if not (home / "complete").exists():
        try:
            venv.create(home, with_pip=True)
            subprocess.run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *PACKAGES],
                           check=True, timeout=400)
        except (OSError, subprocess.SubprocessError) as error:
            print(f"skipped: {error}")
            sys.exit(SKIPPED)
        (home / "complete").touch()
    sys.exit(subprocess.run([python, __file__, *sys.argv[1:], "--inside"]).returncode)


def main():
    work = pathlib.Path(sys.argv[2])
    if "--inside" not in sys.argv:
        work.mkdir(parents=True, exist_ok=True)
        enter_environment(work)
    out = work / "out"
    subprocess.run([sys.argv[1], out], check=True)
    check(out)
    return 0


def check(out):
    import copy

    import numpy as np
    from evo.core import metrics, sync
    from evo.main_ape import ape
    from evo.tools import file_interface as files

    tum = files.read_tum_trajectory_file(out / "reference.tum")
    euroc = files.read_euroc_csv_trajectory(out / "reference.csv")
    kitti = files.read_kitti_poses_file(out / "reference.kitti")
    assert tum.num_poses == euroc.num_poses == kitti.num_poses == 200
    for other in (euroc, kitti):
        np.testing.assert_allclose(tum.positions_xyz, other.positions_xyz, atol=1e-12)
        np.testing.assert_allclose(tum.poses_se3, other.poses_se3, atol=1e-12)
    np.testing.assert_allclose(tum.timestamps, euroc.timestamps, atol=1e-6)

    result = files.load_res_file(out / "result.zip", load_trajectories=True)
    estimate = files.read_tum_trajectory_file(out / "estimate.tum")
    reference, estimate = sync.associate_trajectories(tum, estimate)
    theirs = ape(copy.deepcopy(reference), copy.deepcopy(estimate), metrics.PoseRelation.translation_part, align=True)
    assert set(result.stats) == set(theirs.stats), result.stats
    for name, value in theirs.stats.items():
        np.testing.assert_allclose(result.stats[name], value, rtol=1e-9, err_msg=name)
    for name, array in result.np_arrays.items():
        np.testing.assert_allclose(array, theirs.np_arrays[name], atol=1e-6, err_msg=name)
    assert set(result.trajectories) == {"reference", "estimate"}
    assert result.info["label"] == theirs.info["label"]
    print("evo agrees:", {name: float(value) for name, value in sorted(theirs.stats.items())})


if __name__ == "__main__":
    sys.exit(main())
