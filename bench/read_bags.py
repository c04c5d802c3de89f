#!/usr/bin/env python3
"""Reading speed of every container: vispline beside rosbags and mcap (PyPI), in one run.

usage: python3 bench/read_bags.py [--hours 3] [--build build/release] [--work build/read_bags] [--only CASE]

Writes an Imu recording of that length at 200 Hz with vispline in each container and compression, reads each with
`vispline info` (checks and statistics of every sample), with bench/bag_reader (every Imu message decoded, as the others
do), with the Python libraries, and rosbags with ROS's own library where bench/rosbag_storage_reader was built. Prints MB
of the file per second of CPU and the peak resident memory. The Python packages go into a venv under the work folder.
Build before: cmake --preset release -DVISPLINE_BENCH=ON && ninja -C build/release vispline_cli bag_reader rosbag_storage_reader
"""
import argparse
import pathlib
import subprocess
import sys

CASES = [("rosbag", "none"), ("rosbag", "bz2"), ("rosbag", "lz4"), ("mcap", "none"), ("mcap", "lz4"), ("mcap", "zstd"),
         ("rosbag2", "none"), ("rosbag2", "zstd file"), ("rosbag2", "zstd message")]

ROSBAGS = """
import sys, pathlib
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore
count = 0
with AnyReader([pathlib.Path(sys.argv[1])], default_typestore=get_typestore(Stores.ROS2_HUMBLE)) as reader:
    for connection, _, data in reader.messages():
        count += reader.deserialize(data, connection.msgtype).header.stamp.sec > 0
print(count)
"""

MCAP = """
import sys
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
count = 0
with open(sys.argv[1], "rb") as file:
    for _, _, _, message in make_reader(file, decoder_factories=[DecoderFactory()]).iter_decoded_messages():
        count += message.header.stamp.sec > 0
print(count)
"""


def with_memory(command):
    """Wall and CPU seconds and peak MB of one process, by a helper that has no other child; None if it fails."""
    helper = ("import resource, subprocess, sys, time\n"
              "begin = time.monotonic()\n"
              "code = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode\n"
              "usage = resource.getrusage(resource.RUSAGE_CHILDREN)\n"
              "print(code, time.monotonic() - begin, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)\n")
    out = subprocess.run([sys.executable, "-c", helper, *command], capture_output=True, text=True, check=True).stdout
    code, wall, cpu, memory = out.split()
    return (float(wall), float(cpu), float(memory)) if code == "0" else None


ZSTD = """
import sys, pathlib
from rosbags.rosbag2 import CompressionFormat, CompressionMode, Reader, Writer
from rosbags.typesys import Stores, get_typestore
source, target, mode = sys.argv[1:]
writer = Writer(target, version=8)
writer.set_compression(CompressionMode[mode.upper()], CompressionFormat.ZSTD)
with Reader(source) as reader, writer:
    types = get_typestore(Stores.ROS2_HUMBLE)
    topics = {c.id: writer.add_connection(c.topic, c.msgtype, typestore=types) for c in reader.connections}
    for connection, time, data in reader.messages():
        writer.write(topics[connection.id], time, data)
"""


def size_of(path):
    path = pathlib.Path(path)
    return sum(f.stat().st_size for f in path.rglob("*") if f.is_file()) if path.is_dir() else path.stat().st_size


def make(program, python, work, hours):
    table = work / "imu.csv"
    start = "1600000000"
    if not table.exists():
        subprocess.run([program, "simulate", "--trajectory", "static", "--start", start, "--duration", str(hours * 3600),
                        "--imu-rate", "200", "--noise", "course", "--seed", "1", "--out", str(table)], check=True,
                       stdout=subprocess.DEVNULL)
    files = {}
    for container, compression in CASES:
        suffix = {"rosbag": ".bag", "mcap": ".mcap", "rosbag2": ""}[container]
        path = files[container, compression] = work / f"{container}_{compression.replace(' ', '_')}{suffix}"
        if path.exists():
            continue
        if container == "rosbag2" and compression != "none":  # which vispline reads and does not write
            subprocess.run([python, "-c", ZSTD, str(files["rosbag2", "none"]), str(path), compression.split()[1]],
                           check=True)
        else:
            subprocess.run([program, "convert", str(table), str(path), "--format", container,
                            "--compression", compression], check=True, stdout=subprocess.DEVNULL)
    return files


def python_of(work):
    venv = work / "venv"
    if not venv.exists():
        subprocess.run([sys.executable, "-m", "venv", str(venv)], check=True)
        subprocess.run([str(venv / "bin/pip"), "install", "-q", "rosbags", "mcap", "mcap-ros2-support"], check=True)
    return str(venv / "bin/python")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--hours", type=float, default=3.0)
    parser.add_argument("--build", default="build/release")
    parser.add_argument("--work", default="build/read_bags")
    parser.add_argument("--only", default="", help="one case, such as 'rosbag lz4'")
    arguments = parser.parse_args()
    work = pathlib.Path(arguments.work)
    work.mkdir(parents=True, exist_ok=True)
    program, bench = arguments.build + "/vispline", pathlib.Path(arguments.build) / "bench"
    python = python_of(work)
    files = make(program, python, work, arguments.hours)
    print(f"{'container':20} {'MB':>7}  {'reader':10} {'wall s':>8} {'CPU s':>8} {'MB/CPU s':>9} {'peak MB':>8}")
    for (container, compression), path in files.items():
        if arguments.only not in ("", f"{container} {compression}"):
            continue
        megabytes = size_of(path) / 1e6
        readers = {"info": [program, "info", str(path)], "bag_reader": [str(bench / "bag_reader"), str(path)]}
        if container == "rosbag" and (bench / "rosbag_storage_reader").exists():
            readers["librosbag"] = [str(bench / "rosbag_storage_reader"), str(path)]
        readers["rosbags"] = [python, "-c", ROSBAGS, str(path)]
        if container == "mcap":
            readers["mcap"] = [python, "-c", MCAP, str(path)]
        for name, command in readers.items():
            figures = with_memory(command)
            row = f"{container + ' ' + compression:20} {megabytes:7.0f}  {name:10} "
            if figures is None:
                print(row + "failed", flush=True)
                continue
            wall, cpu, memory = figures
            print(row + f"{wall:8.1f} {cpu:8.1f} {megabytes / cpu:9.1f} {memory:8.0f}", flush=True)


if __name__ == "__main__":
    main()
