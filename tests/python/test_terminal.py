"""The program on a terminal: it shows its progress, and goes on when the terminal is lost."""

import os
import pty
import re
import subprocess

STUDY = """
models = ["CR", "CDC"]
levels = { method = "grid", step = 0.01, top = 3 }
records = { synthetic = { count = 40 } }
report = { resamples = 100 }
walls = [{ name = "1", geometry = { height = 3, thickness = 0.3 } }]
"""


def test_progress_is_shown_and_a_lost_terminal_changes_nothing(wall, tmp_path):
    (tmp_path / "study.toml").write_text(STUDY)
    ours, theirs = pty.openpty()
    command = [wall, "study", "ida", "study.toml", "--threads", "1"]
    with subprocess.Popen(command, cwd=tmp_path, stdout=theirs, stderr=theirs) as process:
        os.close(theirs)
        shown = ""
        while not (found := re.search(r"(\d+) of (\d+) done, [0-9.]+ min left", shown)):
            shown += os.read(ours, 1000).decode()
        done, total = map(int, found.groups())
        assert 0 < done < total, shown
        assert process.poll() is None, "the terminal goes while the program runs"
        os.close(ours)
        assert process.wait() == 0
    assert (tmp_path / "study_results/levels.csv").stat().st_size > 10_000
