"""Reads recordings that vispline wrote with the libraries of others: rosbags and mcap, from PyPI.

usage: outside_readers.py <writer> <work folder>
Ends with 77 (skipped) if the libraries cannot be installed. The writer fills a folder for each wire format with
one recording in every container and compression, and expected.txt: topic, time and CRC-32 of each message, in order.
"""
import pathlib
import subprocess
import sys
import venv
import zlib

SKIPPED = 77
PACKAGES = ["rosbags==0.11.9", "mcap==1.3.1", "lz4", "zstandard"]


def enter_environment(work):
    """Runs this script again inside a virtual environment that has the libraries."""
    home = work / "venv"
    python = home / "bin" / "python"
    if not (home / "complete").exists():
        try:
            venv.create(home, with_pip=True)
            subprocess.run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *PACKAGES],
                           check=True, timeout=120)
        except (OSError, subprocess.SubprocessError) as error:
            print(f"skipped: {error}")
            sys.exit(SKIPPED)
        (home / "complete").touch()
    sys.exit(subprocess.run([python, __file__, *sys.argv[1:], "--inside"]).returncode)


def with_rosbags(path):
    from rosbags.highlevel import AnyReader
    from rosbags.typesys import Stores, get_typestore
    with AnyReader([path], default_typestore=get_typestore(Stores.ROS2_HUMBLE)) as reader:
        for connection, time_ns, data in reader.messages():
            yield connection.topic, time_ns, zlib.crc32(data)


def with_mcap(path):
    from mcap.reader import make_reader
    with open(path, "rb") as stream:
        reader = make_reader(stream, validate_crcs=True)
        statistics = reader.get_summary().statistics
        messages = [(c.topic, m.log_time, zlib.crc32(m.data)) for _, c, m in reader.iter_messages(log_time_order=True)]
        assert statistics.message_count == len(messages), path
        return messages


def main():
    work = pathlib.Path(sys.argv[2])
    if "--inside" not in sys.argv:
        work.mkdir(parents=True, exist_ok=True)
        enter_environment(work)
    out = work / "out"
    subprocess.run([sys.argv[1], out], check=True)
    wrong = sum(not check(path, folder / "expected.txt") for folder in sorted(out.iterdir())
                for path in sorted(folder.iterdir()) if path.name != "expected.txt")
    return 1 if wrong else 0


def check(path, expected_path):
    rows = [line.split("\t") for line in expected_path.read_text().splitlines()]
    expected = [(topic, int(time_ns), int(crc)) for topic, time_ns, crc in rows]
    assert len(expected) == 500
    reader = with_mcap if path.suffix == ".mcap" else with_rosbags
    try:
        found = list(reader(path))
    except Exception as error:  # whatever the library finds wrong with our file
        found = repr(error)
    good = found == expected
    print(path.parent.name, path.name, reader.__name__, "good" if good else f"WRONG: {str(found)[:200]}")
    return good


if __name__ == "__main__":
    sys.exit(main())
