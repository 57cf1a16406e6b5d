"""A study leaves Python to other threads, reports progress, and stops at Ctrl-C."""

import signal
import subprocess
import sys
import threading
import time

import pytest

import rocking_wall as rw

LONG = """
models = ["CR", "SDR"]
levels = { method = "step", step = 0.01, top = 10 }
records = { synthetic = { count = 500 } }
walls = [{ name = "1", geometry = { height = 3, thickness = 0.25 } }]
"""

SCRIPT = """
import sys, rocking_wall as rw
study = rw.Study.from_toml(sys.argv[1])
print("started", flush=True)
try:
    study.run(progress=False)
except KeyboardInterrupt:
    print("stopped")
"""


def study(folder, text):
    path = folder / "study.toml"
    path.write_text(text, encoding="utf-8")
    return path


def heed_ctrl_c():
    """What a shell starts in the background ignores Ctrl-C."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def assert_stops(*arguments):
    """Starts Python, sends Ctrl-C and waits for its end, which would otherwise come minutes later."""
    command = [sys.executable, "-c", *arguments]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, preexec_fn=heed_ctrl_c) as process:
        try:
            assert process.stdout.readline() == "started\n"
            time.sleep(0.2)
            assert process.poll() is None, "the work is not long enough"
            process.send_signal(signal.SIGINT)
            told, _ = process.communicate(timeout=30)
        finally:
            process.kill()
    assert told == "stopped\n" and process.returncode == 0


def test_ctrl_c_stops_a_study(tmp_path):
    assert_stops(SCRIPT, str(study(tmp_path, LONG)))


JOBS = {
    "building": "rw.Building('scenes/building/three_storeys.toml').simulate(record, tolerance=1e-6)",
    "calibrate": "wall.calibrate(restitution=np.linspace(0.8, 0.99, 100), a1=np.linspace(0.01, 0.1, 99))",
    "ties": "rw.Wall(tie_height=3).tie([record] * 9, stiffness=np.linspace(1e3, 1e6, 999))",
    "pulses": "wall.pulse_spectrum('ricker', **dict.fromkeys(AXES, np.linspace(0.5, 10, 490)))",
    "walls": "wall.rocking_spectrum(record, heights=np.linspace(1, 9, 99), ratios=np.linspace(4, 20, 999))",
}
JOB = """
import numpy as np, rocking_wall as rw
AXES = ("frequency_ratios", "amplitude_ratios")
wall, record = rw.Wall(), rw.synthetic_record(duration=300)
print("started", flush=True)
try:
    {}
except KeyboardInterrupt:
    print("stopped")
"""


@pytest.mark.parametrize("job", JOBS)
def test_ctrl_c_stops_a_job(job):
    assert_stops(JOB.format(JOBS[job]))


def test_other_threads_run_beside_a_study(tmp_path):
    short = LONG.replace("count = 500", "count = 4").replace("0.01", "0.2")
    counted, finished = 0, threading.Event()

    def count():
        nonlocal counted
        while not finished.is_set():
            counted += 1
            time.sleep(0.001)

    beside = threading.Thread(target=count)
    beside.start()
    reports = []
    native = rw.Study.from_toml(study(tmp_path, short))._native
    folder = rw._native.Folder(str(tmp_path / "out"), native)
    folder.compute(native, folder.missing(1, 1)[0], None, reports.append)
    finished.set()
    beside.join()
    assert counted > 1 and reports == sorted(reports) and max(reports, default=0) <= 8


def test_an_error_in_the_report_stops_the_study(tmp_path):
    def report(done):
        raise LookupError("enough")

    native = rw.Study.from_toml(study(tmp_path, LONG))._native
    folder = rw._native.Folder(str(tmp_path / "out"), native)
    try:
        folder.compute(native, folder.missing(1, 1)[0], 1, report)
    except LookupError as error:
        assert str(error) == "enough"
    else:
        raise AssertionError("the study went on")
